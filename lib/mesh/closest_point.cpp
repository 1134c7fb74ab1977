#include "mesh/closest_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "rays/ray_scene.h"

namespace viewcell {
namespace {

// Squared height over longest edge below which a triangle's normal is mostly rounding.
constexpr double kThinSquared = 1e-16;

// By how much the hierarchy searches beyond the best distance so far, absolute and relative, in a
// domain of [-1, 1]: the rounding of points and corners to float and of float distances is below.
constexpr double kSlack = 1e-6;

glm::dvec3 closest_point_on_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 ab = b - a;
  const double along = glm::dot(p - a, ab), squared = glm::dot(ab, ab);
  if (!(along > 0)) return a;
  return along >= squared ? b : a + (along / squared) * ab;
}

double distance_squared(const glm::dvec3& p, const glm::dvec3& q) {
  return glm::dot(p - q, p - q);
}

}  // namespace

//            c
//           / \          u, v, w: areas opposite a, b, c, times 2 |n|. Inside, all are at least 0:
//    v < 0 /   \ u < 0   the foot of the perpendicular is nearest. Outside, the nearest point is on
//         /     \        an edge that the foot lies beyond.
//        a-------b
//          w < 0
glm::dvec3 closest_point_on_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                                     const glm::dvec3& c) {
  const glm::dvec3 ab = b - a, ac = c - a, ap = p - a;
  const glm::dvec3 n = glm::cross(ab, ac);
  const double nn = glm::dot(n, n);
  const double longest =
      std::max({glm::dot(ab, ab), glm::dot(ac, ac), distance_squared(b, c)});  // squared
  const bool is_thin = !(nn > kThinSquared * longest * longest);
  const double w = glm::dot(glm::cross(ab, ap), n), v = glm::dot(glm::cross(ap, ac), n);
  const double u = nn - v - w;
  if (!is_thin && u >= 0 && v >= 0 && w >= 0) return p - (glm::dot(ap, n) / nn) * n;
  glm::dvec3 best = a;
  double best_squared = std::numeric_limits<double>::infinity();
  const auto consider = [&](const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 q = closest_point_on_segment(p, from, to);
    const double squared = distance_squared(p, q);
    if (squared < best_squared) best = q, best_squared = squared;
  };
  if (is_thin || w < 0) consider(a, b);
  if (is_thin || u < 0) consider(b, c);
  if (is_thin || v < 0) consider(c, a);
  return best;
}

glm::dvec3 corner_weights(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                          const glm::dvec3& c) {
  const std::array<glm::dvec3, 3> at{a, b, c};
  std::size_t k = 0;  // the longest edge runs from corner k to the next
  const auto squared = [&](std::size_t i) { return distance_squared(at[i], at[(i + 1) % 3]); };
  for (std::size_t i = 1; i < 3; ++i)
    if (squared(i) > squared(k)) k = i;
  const double longest = squared(k);
  const glm::dvec3 n = glm::cross(b - a, c - a);
  const double nn = glm::dot(n, n);
  glm::dvec3 weights(0);
  if (nn > kThinSquared * longest * longest) {
    weights.y = std::max(0.0, glm::dot(glm::cross(p - a, c - a), n) / nn);
    weights.z = std::max(0.0, glm::dot(glm::cross(b - a, p - a), n) / nn);
    weights.x = std::max(0.0, 1 - weights.y - weights.z);
    return weights / (weights.x + weights.y + weights.z);
  }
  const glm::dvec3 &from = at[k], along = at[(k + 1) % 3] - from;
  const double t = longest > 0 ? std::clamp(glm::dot(p - from, along) / longest, 0.0, 1.0) : 0;
  weights[static_cast<int>(k)] = 1 - t;
  weights[static_cast<int>((k + 1) % 3)] = t;
  return weights;
}

struct ClosestPointFinder::Hierarchy {
  const std::vector<Triangle>& triangles;
  std::vector<glm::dvec3> positions;  // in the domain: within [-1, 1]
  glm::dvec3 centre{0};
  double scale = 1;  // a power of two, so that scaling rounds nothing
  RayScene scene;

  Hierarchy(const TriMesh& mesh, const Box& domain, const RayDeviceOptions& options);

  glm::dvec3 into_domain(const glm::dvec3& p) const { return scale * (p - centre); }
  void build(const RayDeviceOptions& options);
};

ClosestPointFinder::Hierarchy::Hierarchy(const TriMesh& mesh, const Box& domain,
                                         const RayDeviceOptions& options)
    : triangles(mesh.triangles), centre(domain.centre()) {
  VIEWCELL_CHECK(!mesh.triangles.empty());
  const glm::dvec3 size = domain.size();
  const double extent = std::max({size.x, size.y, size.z});
  if (extent > 0) scale = std::ldexp(1.0, -std::ilogb(extent));
  positions.reserve(mesh.positions.size());
  for (const glm::vec3& p : mesh.positions) positions.push_back(into_domain(glm::dvec3(p)));
  build(options);
}

void ClosestPointFinder::Hierarchy::build(const RayDeviceOptions& options) {
  // Vertices that no triangle uses may lie outside the domain, beyond what a float holds.
  std::vector<glm::vec3> corners(positions.size(), glm::vec3(0));
  for (const Triangle& t : triangles)
    for (const std::uint32_t v : t) corners[v] = glm::vec3(positions[v]);
  scene = RayScene(RayDevice(options), corners, triangles, {.robust = false});
}

namespace {

constexpr std::uint32_t kNoTriangle = 0xffffffffu;

// What one query has found so far, in the domain.
struct Search {
  const std::vector<Triangle>& triangles;
  const std::vector<glm::dvec3>& positions;
  glm::dvec3 p;
  const glm::dvec3* direction = nullptr;  // that triangles must face, if any
  glm::dvec3 nearest{0};
  double squared = std::numeric_limits<double>::infinity();
  std::uint32_t triangle = kNoTriangle;

  // True when the triangle is nearer than all before.
  bool consider(std::uint32_t id) {
    const Triangle& t = triangles[id];
    const glm::dvec3 &a = positions[t[0]], &b = positions[t[1]], &c = positions[t[2]];
    if (direction && !(glm::dot(glm::cross(b - a, c - a), *direction) > 0)) return false;
    const glm::dvec3 q = closest_point_on_triangle(p, a, b, c);
    const double d = distance_squared(p, q);
    if (d > squared || (d == squared && id >= triangle)) return false;
    squared = d, nearest = q, triangle = id;
    return true;
  }

  float radius() const { return static_cast<float>(std::sqrt(squared) * (1 + kSlack) + kSlack); }
};

bool consider_triangle(RTCPointQueryFunctionArguments* arguments) {
  const NearTriangle& near = NearTriangle::of(arguments);
  Search& search = *static_cast<Search*>(near.user);
  if (!search.consider(near.triangle)) return false;
  near.ball->radius = search.radius();
  return true;
}

void search_scene(const RayScene& scene, Search& search) {
  scene.visit_near(glm::vec3(search.p), search.radius(), consider_triangle, &search);
}

}  // namespace

ClosestPointFinder::ClosestPointFinder(const TriMesh& mesh, const Box& domain, int n_threads,
                                       std::size_t budget_bytes)
    : hierarchy_(
          std::make_unique<Hierarchy>(mesh, domain, RayDeviceOptions{n_threads, budget_bytes})) {}

ClosestPointFinder::~ClosestPointFinder() = default;

ClosestPoint ClosestPointFinder::find(const glm::dvec3& p, std::uint32_t hint) const {
  const Hierarchy& h = *hierarchy_;
  Search search{h.triangles, h.positions, h.into_domain(p)};
  search.consider(hint);
  search_scene(h.scene, search);
  return {search.nearest / h.scale + h.centre, std::sqrt(search.squared) / h.scale,
          search.triangle};
}

std::optional<ClosestPoint> ClosestPointFinder::find_facing(const glm::dvec3& p,
                                                            const glm::dvec3& direction,
                                                            double within) const {
  const Hierarchy& h = *hierarchy_;
  Search search{h.triangles, h.positions, h.into_domain(p), &direction};
  search.squared = (h.scale * within) * (h.scale * within);
  search_scene(h.scene, search);
  if (search.triangle == kNoTriangle) return std::nullopt;
  return ClosestPoint{search.nearest / h.scale + h.centre, std::sqrt(search.squared) / h.scale,
                      search.triangle};
}

}  // namespace viewcell
