#include "pm/vanish_map.h"

#include <cmath>
#include <limits>
#include <numeric>

#include "mesh/closest_point.h"

namespace viewcell {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;
// Of a walk to nearer faces.
constexpr int kMostSteps = 64;

// Rounded outwards.
VectorBox box_around(const glm::dvec3& lo, const glm::dvec3& hi) {
  VectorBox box;
  for (int k = 0; k < 3; ++k) {
    constexpr float kFar = std::numeric_limits<float>::infinity();
    box.lo[k] = std::nextafter(static_cast<float>(lo[k]), -kFar);
    box.hi[k] = std::nextafter(static_cast<float>(hi[k]), kFar);
  }
  return box;
}

}  // namespace

VanishMapper::VanishMapper(const CollapseMesh& mesh, std::span<const glm::vec3> positions,
                           std::span<const Triangle> input)
    : mesh_(mesh), positions_(positions), input_(input), tree_(positions), into_(positions.size()) {
  std::iota(into_.begin(), into_.end(), 0u);
  for (std::uint32_t v = 0; v < positions.size(); ++v)
    if (!mesh.has_triangles(v)) tree_.set_present(v, false);
}

// Where the last triangle of v died too, v goes to its third corner.
void VanishMapper::traced(std::uint32_t u, std::uint32_t v, const CollapseTrace& trace) {
  into_[u] = v;
  if (mesh_.has_triangles(v)) return;
  for (const std::uint32_t t : trace.died)
    for (std::uint32_t c = 3 * t; c < 3 * t + 3; ++c)
      if (const std::uint32_t w = mesh_.vertex_at(c); mesh_.has_triangles(w)) into_[v] = w;
}

std::uint32_t VanishMapper::live_vertex(std::uint32_t v) {
  while (into_[v] != v) v = into_[v] = into_[into_[v]];
  return v;
}

void VanishMapper::set_present(std::span<const std::uint32_t> input_faces, bool is_present) {
  for (const std::uint32_t f : input_faces)
    for (const std::uint32_t v : input_[f]) tree_.set_present(v, is_present);
}

glm::dvec3 VanishMapper::corner(std::uint32_t face, std::uint32_t k) const {
  return glm::dvec3(positions_[mesh_.vertex_at(3 * face + k)]);
}

glm::dvec3 VanishMapper::closest_on(std::uint32_t face, const glm::dvec3& p) const {
  return closest_point_on_triangle(p, corner(face, 0), corner(face, 1), corner(face, 2));
}

void VanishMapper::look_around(std::uint32_t v, const glm::dvec3& p, Nearest& nearest) const {
  mesh_.for_each_sheet_corner(v, [&](std::uint32_t c) {
    const glm::dvec3 off = closest_on(c / 3, p) - p;
    if (const double distance2 = glm::dot(off, off); distance2 < nearest.distance2)
      nearest = {c / 3, distance2};
  });
}

std::uint32_t VanishMapper::find_face(const glm::dvec3& p, std::uint32_t from) const {
  Nearest nearest{kNone, std::numeric_limits<double>::infinity()};
  look_around(from, p, nearest);
  for (int step = 0; step < kMostSteps && nearest.face != kNone; ++step) {
    const std::uint32_t at = nearest.face;
    for (std::uint32_t c = 3 * at; c < 3 * at + 3; ++c)
      if (const std::uint32_t v = mesh_.vertex_at(c); !mesh_.is_hub(v)) look_around(v, p, nearest);
    if (nearest.face == at) break;
  }
  return nearest.face;
}

bool VanishMapper::build(std::span<const std::uint32_t> input_faces,
                         std::span<const std::uint32_t> live_faces) {
  set_present(input_faces, false);
  Box box;
  for (const std::uint32_t f : live_faces)
    for (std::uint32_t k = 0; k < 3; ++k) box.add(corner(f, k));
  const std::uint32_t vertex = tree_.nearest(box.centre());
  if (vertex == PointTree::kNone) return false;
  map_.onto = find_face(box.centre(), live_vertex(vertex));
  if (map_.onto == kNone) return false;
  map_.faces.clear();
  for (const std::uint32_t f : live_faces) {
    Box shift;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const glm::dvec3 p = corner(f, k);
      shift.add(p - closest_on(map_.onto, p));
    }
    map_.faces.push_back({f, box_around(shift.lo, shift.hi)});
  }
  return true;
}

}  // namespace viewcell
