#include "park/scatter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/random.h"

namespace viewcell {
namespace {

constexpr double kGap = 14;    // between footprints, in the park's units
constexpr double kMargin = 2;  // between footprints and the area's edge
constexpr int kAttempts = 100000;

// A footprint already on the ground.
struct Placed {
  ConvexPolygon hull;
  glm::dvec2 centre;
  double radius;
};

double radius_of(const ConvexPolygon& hull) {
  double radius = 0;
  for (const glm::dvec2& p : hull) radius = std::max(radius, glm::length(p));
  return radius;
}

bool is_inside_area(const ConvexPolygon& hull) {
  return std::all_of(hull.begin(), hull.end(), [](const glm::dvec2& p) {
    return p.x > kParkArea.lo.x + kMargin && p.y > kParkArea.lo.y + kMargin &&
           p.x < kParkArea.hi.x - kMargin && p.y < kParkArea.hi.y - kMargin;
  });
}

bool is_free(const Placed& candidate, const std::vector<Placed>& placed) {
  return std::all_of(placed.begin(), placed.end(), [&](const Placed& other) {
    const double apart = glm::length(candidate.centre - other.centre);
    if (apart > candidate.radius + other.radius + kGap) return true;
    return distance(candidate.hull, other.hull) > kGap;
  });
}

SceneObject random_object(Random& random) {
  SceneObject object;
  const glm::dvec2 size = kParkArea.hi - kParkArea.lo;
  const double x = kParkArea.lo.x + size.x * random.uniform();
  const double y = kParkArea.lo.y + size.y * random.uniform();
  object.translation = {x, y, 0};
  const double half = std::numbers::pi * random.uniform();
  object.rotation = glm::dquat(std::cos(half), 0, 0, std::sin(half));
  return object;
}

// Which kinds the park of a size adds to the smaller one, large ones first: they are hard to place.
std::vector<std::size_t> kinds_to_add(ParkSize size) {
  std::vector<std::size_t> kinds;
  const auto s = static_cast<std::size_t>(size);
  for (std::size_t k = 0; k < kStatueKinds; ++k) {
    const auto& counts = statue_kinds()[k].counts;
    const int n = counts[s] - (s > 0 ? counts[s - 1] : 0);
    kinds.insert(kinds.end(), static_cast<std::size_t>(n), k);
  }
  return kinds;
}

}  // namespace

std::size_t count_statues(ParkSize size) {
  std::size_t n = 0;
  for (const StatueKind& kind : statue_kinds())
    n += static_cast<std::size_t>(kind.counts[static_cast<std::size_t>(size)]);
  return n;
}

ConvexPolygon make_footprint(const TriMesh& mesh) {
  std::vector<glm::dvec2> points;
  for (const glm::vec3& p : mesh.positions) points.emplace_back(p.x, p.y);
  return convex_hull(std::move(points));
}

ConvexPolygon place_footprint(const ConvexPolygon& footprint, const SceneObject& object) {
  ConvexPolygon hull;
  for (const glm::dvec2& p : footprint)
    hull.emplace_back(object.world_from_model(glm::dvec3(p, 0)));
  return hull;
}

std::vector<SceneObject> scatter_statues(const std::vector<SceneMesh>& meshes, std::uint64_t seed) {
  VIEWCELL_CHECK(meshes.size() == kStatueKinds, meshes.size());
  std::vector<ConvexPolygon> footprints;
  for (const SceneMesh& mesh : meshes) footprints.push_back(make_footprint(mesh.mesh));
  Random random(seed);
  std::vector<SceneObject> objects;
  std::vector<Placed> placed;
  std::array<int, kStatueKinds> n_of_kind{};
  for (int size = 0; size < kParkSizes; ++size)
    for (const std::size_t kind : kinds_to_add(ParkSize(size))) {
      for (int attempt = 0;; ++attempt) {
        VIEWCELL_CHECK(attempt < kAttempts, "no room for another", meshes[kind].name);
        SceneObject object = random_object(random);
        const ConvexPolygon hull = place_footprint(footprints[kind], object);
        const Placed candidate{hull, object.translation, radius_of(footprints[kind])};
        if (!is_inside_area(hull) || !is_free(candidate, placed)) continue;
        object.name = meshes[kind].name + "-" + std::to_string(++n_of_kind[kind]);
        object.mesh = MeshId(kind);
        object.materials = {static_cast<int>(kind)};
        objects.push_back(object);
        placed.push_back(candidate);
        break;
      }
    }
  return objects;
}

}  // namespace viewcell
