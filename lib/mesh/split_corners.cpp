#include "mesh/split_corners.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/topology.h"

namespace viewcell {
namespace {

// Of a normal against that of twins: above this a triangle is on the one side, below its negative
// on the other; between them it stands across.
constexpr double kSideCosine = 0.1;
// A later normal is nearer than an earlier one only by more than this, so that vertices that were
// split for another reason than their normals are drawn as one.
constexpr float kNearerCosine = 1e-4f;

struct WeightedNormals {
  std::vector<glm::dvec3> of_triangles;  // twice the area long
  std::vector<double> weights;           // by corner: its angle over that length
};

WeightedNormals measure_corners(const TriMesh& mesh) {
  WeightedNormals out;
  out.of_triangles.assign(mesh.triangles.size(), glm::dvec3(0));
  out.weights.assign(3 * mesh.triangles.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& triangle = mesh.triangles[t];
    const glm::dvec3 normal = area_normal(mesh, triangle);
    const double length = glm::length(normal);
    if (!(length > 0)) continue;
    out.of_triangles[t] = normal;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 here(mesh.positions[triangle[k]]);
      const glm::dvec3 a = glm::dvec3(mesh.positions[triangle[(k + 1) % 3]]) - here;
      const glm::dvec3 b = glm::dvec3(mesh.positions[triangle[(k + 2) % 3]]) - here;
      out.weights[3 * t + k] = std::atan2(length, glm::dot(a, b)) / length;
    }
  }
  return out;
}

glm::vec3 unit_or_up(const glm::dvec3& sum) {
  const double length = glm::length(sum);
  return length > 0 ? glm::vec3(sum / length) : glm::vec3(0, 0, 1);
}

// 0: one surface, or across; 1 and 2: its two sides where twins meet.
using Sides = std::vector<std::uint8_t>;  // by corner

// The side of every corner whose position some twin touches.
Sides find_sides(const std::vector<Triangle>& welded, const std::vector<std::uint32_t>& twins,
                 std::size_t n_vertices, const std::vector<glm::dvec3>& normals) {
  Sides sides(3 * welded.size(), 0);
  std::vector<std::uint32_t> axis_of(n_vertices, kNoTwin);  // vertex -> its first twin
  for (std::uint32_t t = 0; t < welded.size(); ++t)
    for (const std::uint32_t v : welded[t])
      if (twins[t] != kNoTwin && axis_of[v] == kNoTwin) axis_of[v] = t;
  for (std::size_t c = 0; c < sides.size(); ++c) {
    const std::uint32_t axis = axis_of[welded[c / 3][c % 3]];
    if (axis == kNoTwin) continue;
    const double across = kSideCosine * glm::length(normals[c / 3]) * glm::length(normals[axis]);
    const double along = glm::dot(normals[c / 3], normals[axis]);
    sides[c] = along > across ? 1 : (along < -across ? 2 : 0);
  }
  return sides;
}

std::vector<glm::vec3> make_normals_of(const TriMesh& mesh, const std::vector<Triangle>& welded,
                                       const std::vector<std::uint32_t>& twins) {
  const WeightedNormals corners = measure_corners(mesh);
  const std::size_t n = mesh.positions.size();
  const bool has_twins = !twins.empty();
  const Sides sides = has_twins ? find_sides(welded, twins, n, corners.of_triangles) : Sides();
  std::vector<glm::dvec3> sums((has_twins ? 3 : 1) * n, glm::dvec3(0));
  const auto slot = [&](std::size_t c) {
    return welded[c / 3][c % 3] + (has_twins ? sides[c] * n : 0);
  };
  for (std::size_t c = 0; c < 3 * welded.size(); ++c)
    sums[slot(c)] += corners.weights[c] * corners.of_triangles[c / 3];
  std::vector<glm::vec3> out(3 * welded.size());
  for (std::size_t c = 0; c < out.size(); ++c) out[c] = unit_or_up(sums[slot(c)]);
  return out;
}

// What a corner shows of its vertex.
struct CornerLook {
  glm::vec3 normal;
  glm::vec2 texcoord{0};
  std::int32_t slot = 0;
  bool operator==(const CornerLook&) const = default;
};

// Splits vertices of several looks.
void split_by_looks(TriMesh& mesh, const SplitOptions& options, VertexLooks& looks) {
  const std::vector<glm::vec3> of_corners = std::exchange(mesh.corner_normals, {});
  const std::vector<glm::vec3> of_vertices = mesh.normals;
  const auto look_at = [&](std::size_t c, std::uint32_t v) {
    CornerLook look{of_corners.empty() ? of_vertices[v] : of_corners[c]};
    if (options.texcoords) look.texcoord = mesh.texcoords[c];
    if (options.materials) look.slot = mesh.materials[c / 3];
    return look;
  };
  const std::size_t n_before = mesh.positions.size();
  std::vector<CornerLook> of(n_before, CornerLook{{0, 0, 1}});  // of a vertex that no triangle uses
  std::vector<bool> is_set(n_before, false);
  std::vector<std::uint32_t> next(n_before, kNoTwin);  // the same vertex with another look
  for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c) {
    std::uint32_t& corner = mesh.triangles[c / 3][c % 3];
    const CornerLook look = look_at(c, corner);
    std::uint32_t v = corner;
    while (is_set[v] && of[v] != look) {
      if (next[v] == kNoTwin) {
        next[v] = static_cast<std::uint32_t>(mesh.positions.size());
        next.push_back(kNoTwin);
        mesh.positions.push_back(mesh.positions[corner]);
        of.push_back(look), is_set.push_back(false);
        if (!mesh.colors.empty()) mesh.colors.push_back(mesh.colors[corner]);
      }
      v = next[v];
    }
    of[v] = look, is_set[v] = true;
    corner = v;
  }
  mesh.normals.clear();
  for (const CornerLook& look : of) {
    mesh.normals.push_back(look.normal);
    if (options.texcoords) looks.texcoords.push_back(look.texcoord);
    if (options.materials) looks.slots.push_back(look.slot);
  }
}

// The vertices that are several at one position, if there are any.
void weld_drawn(SplitMesh& out, std::vector<std::uint32_t> welded) {
  const TriMesh& mesh = out.mesh;
  std::vector<bool> is_used(mesh.positions.size(), false);
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) is_used[v] = true;
  std::vector<std::uint32_t> lowest(mesh.positions.size(), kNoTwin);  // used
  bool any = false;
  for (std::uint32_t v = 0; v < welded.size(); ++v) {
    if (!is_used[v]) continue;
    any |= lowest[welded[v]] != kNoTwin;
    if (lowest[welded[v]] == kNoTwin) lowest[welded[v]] = v;
  }
  if (!any) return;
  for (std::uint32_t v = 0; v < welded.size(); ++v) welded[v] = is_used[v] ? lowest[welded[v]] : v;
  VertexWeld& weld = out.weld;
  weld.welded = std::move(welded);
  weld.members = fill_buckets<std::uint32_t>(mesh.positions.size(), [&](const auto& emit) {
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
      if (is_used[v]) emit(weld.welded[v], v);
  });
}

// One normal for all that are welded: that of the triangles around them.
void find_surface_normals(SplitMesh& out) {
  VertexWeld& weld = out.weld;
  if (weld.is_empty()) return;
  TriMesh joined;
  joined.positions = out.mesh.positions;
  joined.triangles = weld.weld(out.mesh.triangles);
  const std::vector<glm::vec3> made = make_vertex_normals(joined);
  weld.normals = out.mesh.normals;
  for (std::uint32_t v = 0; v < weld.normals.size(); ++v)
    if (weld.members.of(weld.of(v)).size() > 1) weld.normals[v] = made[weld.of(v)];
}

}  // namespace

std::vector<Triangle> VertexWeld::weld(std::span<const Triangle> triangles) const {
  std::vector<Triangle> out(triangles.begin(), triangles.end());
  if (is_empty()) return out;
  for (Triangle& t : out)
    for (std::uint32_t& v : t) v = welded[v];
  return out;
}

std::vector<glm::vec3> compute_corner_normals(const TriMesh& mesh) {
  const VertexWeld weld{match_positions(mesh), {}, {}};
  const std::vector<Triangle> welded = weld.weld(mesh.triangles);
  return make_normals_of(mesh, welded, match_twins(welded, mesh.positions.size()));
}

std::vector<SlotRange> group_by_slot(const VertexLooks& looks, std::vector<Triangle>& triangles) {
  if (!looks.slots.empty())
    std::stable_sort(triangles.begin(), triangles.end(), [&](const Triangle& a, const Triangle& b) {
      return looks.slot_of(a) < looks.slot_of(b);
    });
  std::vector<SlotRange> out;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const std::int32_t slot = looks.slot_of(triangles[t]);
    if (out.empty() || out.back().slot != slot) out.push_back({slot, t, 0});
    ++out.back().n_triangles;
  }
  return out;
}

SplitMesh split_corners(TriMesh mesh, const SplitOptions& options) {
  SplitMesh out;
  const SplitOptions by{options.texcoords && !mesh.texcoords.empty(),
                        options.materials && !mesh.materials.empty()};
  std::vector<std::uint32_t> welded = match_positions(mesh);
  const std::vector<Triangle> triangles = VertexWeld{welded, {}, {}}.weld(mesh.triangles);
  const std::vector<std::uint32_t> twins = match_twins(triangles, mesh.positions.size());
  out.has_twins = !twins.empty();
  if (mesh.normals.empty() && mesh.corner_normals.empty())
    mesh.corner_normals = make_normals_of(mesh, triangles, twins);
  const std::size_t n_before = mesh.positions.size();
  if (!mesh.corner_normals.empty() || by.texcoords || by.materials) {
    split_by_looks(mesh, by, out.looks);
    for (std::size_t v = n_before; v < mesh.positions.size(); ++v) welded.push_back(kNoTwin);
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) welded[mesh.triangles[t][k]] = triangles[t][k];
  }
  out.mesh = std::move(mesh);
  weld_drawn(out, std::move(welded));
  find_surface_normals(out);
  return out;
}

std::vector<Triangle> choose_drawn_vertices(const TriMesh& mesh, const VertexWeld& weld,
                                            std::span<const Triangle> triangles) {
  std::vector<Triangle> out(triangles.begin(), triangles.end());
  if (weld.is_empty()) return out;
  for (Triangle& t : out) {
    const glm::dvec3 long_normal = area_normal(mesh, t);
    const glm::vec3 normal = unit_or_up(long_normal);
    for (std::uint32_t& v : t) {
      float most = -2;
      std::uint32_t best = v;
      for (const std::uint32_t drawn : weld.members.of(v)) {
        const float cosine = glm::dot(normal, mesh.normals[drawn]);
        if (cosine > most + kNearerCosine) most = cosine, best = drawn;
      }
      v = best;
    }
  }
  return out;
}

}  // namespace viewcell
