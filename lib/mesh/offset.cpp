#include "mesh/offset.h"

#include <algorithm>
#include <cmath>

namespace viewcell {
namespace {

constexpr double kNearSides = 8;  // floats have bits to spare so near to the origin

double largest(const glm::dvec3& v) {
  return std::max({v.x, v.y, v.z});
}

}  // namespace

glm::dvec3 choose_offset(const Box& box) {
  constexpr double kStepShare = 0x1p-18;    // of the longest side
  constexpr double kPointShare = 0x1p-30;   // of its coordinates: the side of a box that is a point
  constexpr double kDigitsShare = 0x1p-27;  // likewise: what a float in nine digits may be off
  if (!(box.lo.x <= box.hi.x)) return glm::dvec3(0);
  const glm::dvec3 reach = glm::max(glm::abs(box.lo), glm::abs(box.hi));
  const double most = largest(reach);
  if (!(most > 0)) return glm::dvec3(0);
  const double off_floats = largest(glm::abs(box.lo - glm::dvec3(glm::vec3(box.lo))));
  if (box.lo == box.hi && off_floats <= kDigitsShare * most) return glm::dvec3(0);
  const double side = std::max(largest(box.size()), kPointShare * most);
  const double step = std::ldexp(1.0, std::ilogb(most) - 23);
  if (!(step > kStepShare * side)) return glm::dvec3(0);
  const double unit = std::exp2(std::ceil(std::log2(side)));
  glm::dvec3 offset(0);
  for (int k = 0; k < 3; ++k)
    if (reach[k] > kNearSides * side) offset[k] = std::round(box.centre()[k] / unit) * unit;
  return offset;
}

bool is_offset_near(const Box& box, const glm::dvec3& offset) {
  const glm::dvec3 reach = glm::max(glm::abs(box.lo - offset), glm::abs(box.hi - offset));
  return largest(reach) <= kNearSides * largest(box.size());
}

void place_vertices(TriMesh& mesh, std::span<const glm::dvec3> places, const glm::dvec3& offset) {
  mesh.offset = offset;
  mesh.positions.clear();
  mesh.positions.reserve(places.size());
  for (const glm::dvec3& p : places) mesh.positions.emplace_back(p - offset);
}

void change_offset(TriMesh& mesh, const glm::dvec3& offset) {
  const glm::dvec3 by = mesh.offset - offset;
  mesh.offset = offset;
  if (by == glm::dvec3(0)) return;
  for (glm::vec3& p : mesh.positions) p = glm::vec3(glm::dvec3(p) + by);
}

}  // namespace viewcell
