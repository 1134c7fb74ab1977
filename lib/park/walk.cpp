#include "park/walk.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "base/error.h"
#include "base/parallel.h"
#include "cells/grid.h"
#include "park/coverage.h"
#include "park/walk_gaze.h"
#include "park/walk_route.h"

namespace viewcell {
namespace {

constexpr double kSpeed = 27, kDuration = 72;  // units/s, s
constexpr double kSampleStep = 0.25;           // s between the path's samples
constexpr double kSampleLength = kSpeed * kSampleStep;
constexpr std::size_t kSamplesPerMoment = 2;  // a candidate is judged at every second sample
constexpr double kLookStep = kSamplesPerMoment * kSampleStep;
constexpr int kDirections = 72;
constexpr double kClearance = 7;  // of the eye from footprints; the near plane's corner is at 1.3
constexpr double kCellSize = 50;  // for which cells are counted [Chen06 5.3]
constexpr int kNearSamples = 300, kFarSamples = 60;
constexpr double kFarDistance = 300;  // from which the coarse samples do
constexpr double kHalfViewDeg = 25;   // an object this far off the gaze is well in view
constexpr double kLargeBonus = 0.5;   // of looking at a dragon or bunny in the eye's own cell
constexpr int kBatch = 8, kBatches = 40;
// Coverage that walks aim at, somewhat above the least that they must have.
constexpr std::array<double, kParkSizes> kWantedCoverage{0.07, 0.11, 0.17};
constexpr std::array<double, kParkSizes> kLeast{0.06, 0, 0.15};

// What candidates are judged by, the same for all.
struct Judge {
  const Ground& ground;
  HexGrid grid;  // that hexcells lays by default
  const std::vector<SceneMesh>& meshes;
  std::vector<CoverageSamples> near_samples, far_samples;  // per mesh
};

using Panoramas = std::array<Panorama, kParkSizes>;

double yaw_of(const SceneObject& object) {
  return 2 * std::atan2(object.rotation.z, object.rotation.w);
}

// All around the eye, in each size of park.
Panoramas look_around(const Judge& judge, const glm::dvec3& eye) {
  Panorama panorama(eye);
  Panoramas out{panorama, panorama, panorama};
  std::size_t i = 0;
  for (int size = 0; size < kParkSizes; ++size) {
    for (; i < count_statues(ParkSize(size)); ++i) {
      const SceneObject& object = judge.ground.objects[i];
      const bool is_far = glm::length(object.translation - eye) > kFarDistance;
      panorama.draw((is_far ? judge.far_samples : judge.near_samples)[index(object.mesh)],
                    yaw_of(object), object.translation);
    }
    out[static_cast<std::size_t>(size)] = panorama;
  }
  return out;
}

// The objects, ascending, whose footprints meet the closed cell.
std::vector<std::size_t> objects_in(const Ground& ground, const HexGrid& grid, HexCoord cell) {
  const ConvexPolygon corners = corners_of(grid, cell);
  const glm::dvec2 centre = centre_of(grid, cell);
  std::vector<std::size_t> inside;
  for (std::size_t i = 0; i < ground.objects.size(); ++i) {
    const double far = glm::length(glm::dvec2(ground.objects[i].translation) - centre);
    if (far < ground.radii[i] + grid.size && distance(corners, ground.footprints[i]) == 0)
      inside.push_back(i);
  }
  return inside;
}

// --- one candidate ---

// One moment of a walk, and what it shows.
struct Moment {
  glm::dvec3 eye{0};
  double heading_rad = 0, yaw_rad = 0;
  HexCoord cell;
  std::vector<std::size_t> inside;  // the cell's objects
  std::array<double, kParkSizes> coverage{};
  std::array<double, kParkSizes> triangles_inside{};  // in view
  std::array<bool, kParkSizes> is_inside{};
  bool has_large_in_view = false;
};

double eye_height(double along, double phase) {
  return 18 + 1.2 * std::sin(along / 70 + phase) + 0.4 * std::sin(along / 31 + 2.3 * phase);
}

// A moment for every kSamplesPerMoment-th point of the route.
std::vector<Moment> place_moments(const Ground& ground, const HexGrid& grid,
                                  const std::vector<glm::dvec2>& route, double phase) {
  std::vector<Moment> moments;
  for (std::size_t i = 0; i < route.size(); i += kSamplesPerMoment) {
    const glm::dvec2 way = route[std::min(i + 1, route.size() - 1)] - route[i > 0 ? i - 1 : 0];
    Moment moment;
    moment.eye = glm::dvec3(route[i], eye_height(kSampleLength * static_cast<double>(i), phase));
    moment.heading_rad = std::atan2(way.y, way.x);
    moment.cell = coord_at(grid, route[i]);
    const bool is_same = !moments.empty() && moments.back().cell == moment.cell;
    moment.inside = is_same ? moments.back().inside : objects_in(ground, grid, moment.cell);
    moments.push_back(std::move(moment));
  }
  return moments;
}

// Rises from 0 to 1: statues somewhere in view are worth more than one that fills it.
double interest(double coverage, double wanted) {
  return coverage / (coverage + wanted);
}

bool is_near_gaze(const glm::dvec3& eye, double yaw_rad, const SceneObject& object) {
  const glm::dvec2 way = glm::dvec2(object.translation) - glm::dvec2(eye);
  const double off = std::remainder(std::atan2(way.y, way.x) - yaw_rad, 2 * std::numbers::pi);
  return std::abs(glm::degrees(off)) < kHalfViewDeg;
}

// A dragon or bunny of the 2M park.
bool is_large(const Ground& ground, std::size_t i) {
  return i < count_statues(ParkSize::k2m) && index(ground.objects[i].mesh) < 2;
}

Prospect make_prospect(const Ground& ground, const Moment& moment, const Panoramas& view) {
  Prospect prospect{moment.heading_rad, {}};
  for (int d = 0; d < kDirections; ++d) {
    const double yaw = 2 * std::numbers::pi * d / kDirections;
    double sum = 0;
    for (const std::size_t size : {0, 2})
      sum += interest(view[size].coverage(yaw), kWantedCoverage[size]);
    for (const std::size_t i : moment.inside)
      if (is_large(ground, i) && is_near_gaze(moment.eye, yaw, ground.objects[i]))
        sum += kLargeBonus;
    prospect.interest.push_back(sum);
  }
  return prospect;
}

// Turns the walker's eyes to where there is most to see, in the smallest and the largest park
// alike.
void look(const Judge& judge, std::vector<Moment>& moments) {
  std::vector<Panoramas> views;
  std::vector<Prospect> prospects;
  for (const Moment& moment : moments) {
    views.push_back(look_around(judge, moment.eye));
    prospects.push_back(make_prospect(judge.ground, moment, views.back()));
  }
  const std::vector<double> yaw = choose_gaze(prospects, {.step_s = kLookStep});
  for (std::size_t i = 0; i < moments.size(); ++i) {
    moments[i].yaw_rad = yaw[i];
    for (std::size_t size = 0; size < kParkSizes; ++size)
      moments[i].coverage[size] = views[i][size].coverage(yaw[i]);
  }
}

void look_inside_cells(const Judge& judge, std::vector<Moment>& moments) {
  for (Moment& moment : moments)
    for (const std::size_t i : moment.inside) {
      const SceneObject& object = judge.ground.objects[i];
      const bool in_view = is_near_gaze(moment.eye, moment.yaw_rad, object);
      const auto n = static_cast<double>(judge.meshes[index(object.mesh)].n_triangles);
      for (int size = 0; size < kParkSizes; ++size) {
        if (i >= count_statues(ParkSize(size))) continue;
        moment.is_inside[static_cast<std::size_t>(size)] = true;
        if (in_view) moment.triangles_inside[static_cast<std::size_t>(size)] += n;
      }
      if (in_view && is_large(judge.ground, i)) moment.has_large_in_view = true;
    }
}

WalkReport measure(const Ground& ground, std::span<const Moment> moments) {
  WalkReport report;
  const auto n = static_cast<double>(moments.size());
  std::set<std::pair<int, int>> cells;
  double run = 0;
  report.min_clearance = kCellSize;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const Moment& m = moments[i];
    cells.emplace(m.cell.column, m.cell.row);
    if (i > 0) report.length += glm::length(m.eye - moments[i - 1].eye);
    for (std::size_t size = 0; size < kParkSizes; ++size) {
      report.coverage[size] += m.coverage[size] / n;
      report.share_inside[size] += m.is_inside[size] / n;
      report.triangles_inside[size] += m.triangles_inside[size] / n;
    }
    run = m.has_large_in_view ? run + kLookStep : 0;
    report.large_in_view_s = std::max(report.large_in_view_s, run);
    report.min_clearance = clearance(ground, glm::dvec2(m.eye), report.min_clearance);
  }
  report.duration_s = (n - 1) * kLookStep;
  report.n_cells = static_cast<int>(cells.size());
  return report;
}

bool is_good(const WalkReport& r) {
  return r.coverage[0] >= kLeast[0] && r.coverage[2] >= kLeast[2] && r.share_inside[0] >= 0.125 &&
         r.n_cells >= 15 && r.large_in_view_s >= 2.5;
}

// Ranks good walks: statues as near as on the paper's path, not nearer, and few
// triangles of objects inside the eye's cell, which every frame there must draw.
double cost_of(const WalkReport& r) {
  return std::abs(r.coverage[0] / kWantedCoverage[0] - 1) +
         std::abs(r.coverage[2] / kWantedCoverage[2] - 1) +
         (r.triangles_inside[0] + r.triangles_inside[2]) / 1e4;
}

struct Candidate {
  std::vector<glm::dvec2> route;
  double phase = 0;
  std::vector<Moment> moments;
  WalkReport report;
};

std::optional<Candidate> make_candidate(const Judge& judge, std::uint64_t seed) {
  Random random(seed);
  Candidate candidate;
  candidate.phase = random.uniform(0, 2 * std::numbers::pi);
  candidate.route = make_route(judge.ground, random, kSpeed * kDuration, kSampleLength, kClearance);
  if (candidate.route.empty()) return {};
  candidate.moments = place_moments(judge.ground, judge.grid, candidate.route, candidate.phase);
  look(judge, candidate.moments);
  look_inside_cells(judge, candidate.moments);
  candidate.report = measure(judge.ground, candidate.moments);
  return candidate;
}

Candidate choose_candidate(const Judge& judge, std::uint64_t seed, int n_threads) {
  for (std::uint64_t batch = 0; batch < kBatches; ++batch) {
    std::vector<std::optional<Candidate>> candidates(kBatch);
    parallel_for(kBatch, n_threads, [&](std::size_t i) {
      candidates[i] = make_candidate(judge, Random(seed ^ (kBatch * batch + i) << 40).next());
    });
    const Candidate* best = nullptr;
    for (const auto& c : candidates)
      if (c && is_good(c->report) && (!best || cost_of(c->report) < cost_of(best->report)))
        best = &*c;
    if (best) return *best;
  }
  throw BugError("no walk shows enough of the park of seed " + std::to_string(seed));
}

// --- the brief piece ---

bool is_good_piece(const WalkReport& r) {
  return r.n_cells >= 12 && r.n_cells <= 14 && r.large_in_view_s >= 1.5 && r.share_inside[1] >= 0.1;
}

// The best piece by the same measure, or, rather than none, one of 12 cells.
std::span<const Moment> choose_piece(const Ground& ground, std::span<const Moment> all) {
  std::span<const Moment> best = all;
  double most = -1e300;
  constexpr std::size_t kStride = 4;
  for (std::size_t first = 0; first < all.size(); first += kStride)
    for (std::size_t n = 40; first + n <= all.size(); n += kStride) {
      const auto piece = all.subspan(first, n);
      const WalkReport report = measure(ground, piece);
      if (report.n_cells > 14) break;
      const double value = -std::abs(report.coverage[1] / kWantedCoverage[1] - 1) -
                           report.triangles_inside[1] / 5e3 - (is_good_piece(report) ? 0 : 1e3);
      if (report.n_cells >= 12 && value > most) most = value, best = piece;
    }
  return best;
}

// The samples of a piece of the candidate's moments, timed from 0.
CameraPath to_path(const Candidate& candidate, std::size_t first, std::size_t n_moments) {
  CameraPath path;
  for (std::size_t i = 0; i <= (n_moments - 1) * kSamplesPerMoment; ++i) {
    const std::size_t at = first * kSamplesPerMoment + i, moment = at / kSamplesPerMoment;
    const Moment& a = candidate.moments[moment];
    const Moment& b = candidate.moments[std::min(moment + 1, candidate.moments.size() - 1)];
    const double t = static_cast<double>(at % kSamplesPerMoment) / kSamplesPerMoment;
    const double yaw = glm::mix(a.yaw_rad, b.yaw_rad, t);
    const double z = eye_height(kSampleLength * static_cast<double>(at), candidate.phase);
    path.samples.push_back({kSampleStep * static_cast<double>(i),
                            {candidate.route[at], z},
                            {std::cos(yaw), std::sin(yaw), 0}});
  }
  return path;
}

}  // namespace

Walks make_walks(const std::vector<SceneMesh>& meshes, const std::vector<SceneObject>& objects,
                 std::uint64_t seed, int n_threads) {
  const Ground ground = make_ground(meshes, objects);
  Judge judge{ground, make_grid(kParkArea, kCellSize), meshes, {}, {}};
  for (const SceneMesh& mesh : meshes) {
    judge.near_samples.push_back(sample_surface(mesh.mesh, kNearSamples));
    judge.far_samples.push_back(sample_surface(mesh.mesh, kFarSamples));
  }
  const Candidate candidate = choose_candidate(judge, seed, n_threads);
  const auto piece = choose_piece(ground, candidate.moments);
  const auto first = static_cast<std::size_t>(piece.data() - candidate.moments.data());
  return {{to_path(candidate, 0, candidate.moments.size()), candidate.report},
          {to_path(candidate, first, piece.size()), measure(ground, piece)}};
}

}  // namespace viewcell
