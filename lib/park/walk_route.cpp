#include "park/walk_route.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace viewcell {
namespace {

constexpr double kBandStep = 12;  // between the points of the band that becomes the route
constexpr int kBandRounds = 70;   // of smoothing; each point then depends on some 100 units around
constexpr double kEdge = 60;      // the route keeps this far from the area's edge
constexpr double kWantedClearance = 13;  // clearance that the band is pushed to
// A stop is passed between kNearPass and kFarPass from its footprint's circle; a large one nearer.
constexpr double kNearPass = 16, kFarPass = 70, kFarPassLarge = 32;

bool is_large_mesh(const SceneObject& object) {
  return index(object.mesh) < 2;
}  // dragon, bunny

// The 2M park's objects in the order in which the walk passes them: each time one of the near ones
// that lie ahead, large ones rather than small. The second is a large one.
std::vector<std::size_t> choose_stops(const Ground& ground, Random& random, double length) {
  const std::size_t n = count_statues(ParkSize::k2m);
  const auto at = [&](std::size_t i) { return glm::dvec2(ground.objects[i].translation); };
  std::vector<std::size_t> stops{random.below(static_cast<std::uint32_t>(n))};
  glm::dvec2 heading(0);
  for (double walked = 0; walked < length;) {
    const glm::dvec2 here = at(stops.back());
    std::optional<std::size_t> best;
    double least = 1e300;
    for (std::size_t i = 0; i < n; ++i) {
      if (std::find(stops.begin(), stops.end(), i) != stops.end()) continue;
      if (stops.size() == 1 && !is_large_mesh(ground.objects[i])) continue;
      const glm::dvec2 way = at(i) - here;
      const double far = glm::length(way);
      const double turn = 1 - glm::dot(way / far, heading);  // 0 straight on, 2 back
      const double cost =
          (far + 60) * (1 + turn * turn) * random.uniform(0.5, 1.5) / std::sqrt(ground.radii[i]);
      if (cost < least) least = cost, best = i;
    }
    if (!best) break;
    walked += glm::length(at(*best) - here);
    heading = glm::normalize(at(*best) - here);
    stops.push_back(*best);
  }
  return stops;
}

// Points beside the stops, now left, now right of them.
std::vector<glm::dvec2> pass_beside(const Ground& ground, const std::vector<std::size_t>& stops,
                                    Random& random) {
  std::vector<glm::dvec2> points;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    const auto at = [&](std::size_t k) {
      return glm::dvec2(ground.objects[stops[std::min(k, stops.size() - 1)]].translation);
    };
    const glm::dvec2 along = at(i + 1) - at(i > 0 ? i - 1 : 0);
    const glm::dvec2 side = glm::dvec2(-along.y, along.x) / std::max(glm::length(along), 1e-9);
    const double far = is_large_mesh(ground.objects[stops[i]]) ? kFarPassLarge : kFarPass;
    const double off = ground.radii[stops[i]] + random.uniform(kNearPass, far);
    points.push_back(at(i) + (random.below(2) == 0 ? off : -off) * side);
  }
  return points;
}

// Points `step` apart along a polyline, its start included.
std::vector<glm::dvec2> resample(const std::vector<glm::dvec2>& line, double step) {
  std::vector<glm::dvec2> out{line.front()};
  double left = step;  // to the next point
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const glm::dvec2 way = line[i + 1] - line[i];
    const double length = glm::length(way);
    double at = left;
    for (; at <= length; at += step) out.push_back(line[i] + at / length * way);
    left = at - length;
  }
  return out;
}

// Away from footprints that are nearer than wanted.
glm::dvec2 push_away(const Ground& ground, const glm::dvec2& p) {
  glm::dvec2 push(0);
  for (std::size_t i = 0; i < ground.objects.size(); ++i) {
    const glm::dvec2 away = p - glm::dvec2(ground.objects[i].translation);
    const double far = glm::length(away);
    if (far > ground.radii[i] + kWantedClearance || far < 1e-9) continue;
    const double gap = distance({p}, ground.footprints[i]);
    if (gap < kWantedClearance) push += 0.5 * (kWantedClearance - gap) / far * away;
  }
  return push;
}

// An elastic band: each point goes to its neighbours' middle, away from footprints and edges.
void smooth_band(const Ground& ground, std::vector<glm::dvec2>& band) {
  for (int round = 0; round < kBandRounds; ++round) {
    std::vector<glm::dvec2> next = band;
    for (std::size_t i = 0; i < band.size(); ++i) {
      const bool is_end = i == 0 || i + 1 == band.size();
      const glm::dvec2 middle = is_end ? band[i] : 0.5 * (band[i - 1] + band[i + 1]);
      next[i] = glm::mix(band[i], middle, 0.6) + push_away(ground, band[i]);
      next[i] = glm::clamp(next[i], kParkArea.lo + kEdge, kParkArea.hi - kEdge);
    }
    band = std::move(next);
  }
}

// Round off the corners of the band: Chaikin's scheme tends to a quadratic B-spline.
std::vector<glm::dvec2> round_corners(std::vector<glm::dvec2> line) {
  for (int round = 0; round < 3; ++round) {
    std::vector<glm::dvec2> next{line.front()};
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      next.push_back(glm::mix(line[i], line[i + 1], 0.25));
      next.push_back(glm::mix(line[i], line[i + 1], 0.75));
    }
    next.push_back(line.back());
    line = std::move(next);
  }
  return line;
}

}  // namespace

Ground make_ground(const std::vector<SceneMesh>& meshes, std::vector<SceneObject> objects) {
  std::vector<ConvexPolygon> hulls;
  for (const SceneMesh& mesh : meshes) hulls.push_back(make_footprint(mesh.mesh));
  Ground ground;
  for (const SceneObject& object : objects) {
    const ConvexPolygon& hull = hulls[index(object.mesh)];
    double radius = 0;
    for (const glm::dvec2& p : hull) radius = std::max(radius, glm::length(p));
    ground.footprints.push_back(place_footprint(hull, object));
    ground.radii.push_back(radius * object.scale);
  }
  ground.objects = std::move(objects);
  return ground;
}

double clearance(const Ground& ground, const glm::dvec2& point, double reach) {
  double least = reach;
  for (std::size_t i = 0; i < ground.objects.size(); ++i) {
    const double far = glm::length(point - glm::dvec2(ground.objects[i].translation));
    if (far < ground.radii[i] + least)
      least = std::min(least, distance({point}, ground.footprints[i]));
  }
  return least;
}

std::vector<glm::dvec2> make_route(const Ground& ground, Random& random, double length, double step,
                                   double min_clearance) {
  const auto stops = choose_stops(ground, random, 1.6 * length);
  if (stops.size() < 3) return {};
  std::vector<glm::dvec2> band = resample(pass_beside(ground, stops, random), kBandStep);
  smooth_band(ground, band);
  std::vector<glm::dvec2> route = resample(round_corners(std::move(band)), step);
  const auto n = static_cast<std::size_t>(length / step) + 1;
  if (route.size() < n) return {};
  route.resize(n);
  for (const glm::dvec2& p : route)
    if (clearance(ground, p, min_clearance) < min_clearance) return {};
  return route;
}

}  // namespace viewcell
