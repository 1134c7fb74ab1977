#include "pm/collapse_trial.h"

#include <gtest/gtest.h>

#include "mesh/closest_point.h"
#include "pm/parts.h"

namespace viewcell {
namespace {

// Two vertices and all that is around them, over a disk, in relief: u is 0 and v is 1.
TriMesh make_double_fan(Random& random, bool is_open) {
  TriMesh grid = make_flat_grid(3);
  for (glm::vec3& p : grid.positions)
    p += glm::vec3(random.uniform(-0.25, 0.25), random.uniform(-0.25, 0.25),
                   random.uniform(-0.5, 0.5));
  const std::uint32_t u = is_open ? 1 : 5, v = is_open ? 2 : 6;
  TriMesh out;
  std::vector<std::uint32_t> number(16, 99);
  number[u] = 0, number[v] = 1;
  out.positions = {grid.positions[u], grid.positions[v]};
  for (const Triangle& t : grid.triangles) {
    if (std::none_of(t.begin(), t.end(), [&](auto w) { return w == u || w == v; })) continue;
    Triangle& to = out.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      if (number[t[k]] == 99) {
        number[t[k]] = static_cast<std::uint32_t>(out.positions.size());
        out.positions.push_back(grid.positions[t[k]]);
      }
      to[k] = number[t[k]];
    }
  }
  return out;
}

TriMesh collapse_both(TriMesh mesh, const glm::vec3& place) {
  mesh.positions[0] = mesh.positions[1] = place;
  for (Triangle& t : mesh.triangles) std::replace(t.begin(), t.end(), 0u, 1u);
  std::erase_if(mesh.triangles,
                [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  return mesh;
}

double distance(const TriMesh& mesh, const glm::dvec3& p) {
  double best = 1e30;
  for (const Triangle& t : mesh.triangles) {
    const auto at = [&](std::size_t k) { return glm::dvec3(mesh.positions[t[k]]); };
    best = std::min(best, glm::distance(p, closest_point_on_triangle(p, at(0), at(1), at(2))));
  }
  return best;
}

// Of the points of a triangle.
double largest_distance(const TriMesh& from, const Triangle& t, const TriMesh& to) {
  double largest = 0;
  const auto at = [&](std::size_t k) { return glm::dvec3(from.positions[t[k]]); };
  for (int i = 0; i <= 16; ++i)
    for (int j = 0; i + j <= 16; ++j)
      largest = std::max(largest, distance(to, (1 - (i + j) / 16.0) * at(0) + i / 16.0 * at(1) +
                                                   j / 16.0 * at(2)));
  return largest;
}

double largest_distance(const TriMesh& from, const TriMesh& to) {
  double largest = 0;
  for (const Triangle& t : from.triangles)
    largest = std::max(largest, largest_distance(from, t, to));
  return largest;
}

// No point of either surface is farther from the other than a full-edge collapse is said to bring
// it, inside a mesh and at its boundary; and some are nearly as far.
TEST(CollapseTrial, BoundsTheDistanceOfAFullEdge) {
  for (const bool is_open : {false, true}) {
    double tightest = 0, sum = 0;
    for (std::uint64_t seed = 1; seed <= 150; ++seed) {
      SCOPED_TRACE(seed);
      Random random(seed);
      const TriMesh mesh = make_double_fan(random, is_open);
      const double along = random.uniform(-0.2, 1.2);
      const glm::vec3 place =
          glm::mix(mesh.positions[0], mesh.positions[1], static_cast<float>(along)) +
          glm::vec3(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3),
                    random.uniform(-0.3, 0.3));
      Parts parts(mesh);
      CollapseBound bound(parts.mesh, parts.table, parts.wedges.positions,
                          DeviationBoxes(mesh.triangles.size()));
      const double said = bound.measure(0, 1, place);
      EXPECT_EQ(bound.measure(1, 0, place), said);
      const TriMesh after = collapse_both(mesh, place);
      const double measured =
          std::max(largest_distance(mesh, after), largest_distance(after, mesh));
      EXPECT_LE(measured, said * (1 + 1e-6));
      bound.accept();
      for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
        Triangle t = mesh.triangles[f];
        std::replace(t.begin(), t.end(), 0u, 1u);
        if (std::count(t.begin(), t.end(), 1u) > 1) continue;
        EXPECT_LE(largest_distance(after, t, mesh), bound.deviations().reach(f) * (1 + 1e-6)) << f;
      }
      tightest = std::max(tightest, measured / said);
      sum += measured / said;
    }
    EXPECT_GT(tightest, 0.95);
    EXPECT_GT(sum / 150, 0.77);
  }
}

// What is kept from before a collapse does not show in the next.
TEST(CollapseTrial, ForgetsTheMeshBefore) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    TriMesh sphere = make_noisy_sphere(2, 0.2, seed);
    Parts parts(sphere);
    const DeviationBoxes none(sphere.triangles.size());
    CollapseBound kept(parts.mesh, parts.table, parts.wedges.positions, none);
    for (std::uint32_t u = 0; u < 10; ++u) {
      std::vector<std::uint32_t> ring;
      parts.mesh.ring(u, ring);
      if (parts.mesh.check(u, ring[0], -1) != Refusal::none) continue;
      kept.measure(ring[0], u);  // the star that is about to change
      kept.measure(u, ring[0]);
      kept.measure(ring[0], u);
      parts.mesh.collapse(u, ring[0]);
      kept.accept();
      std::vector<std::uint32_t> around;
      parts.mesh.ring(ring[0], around);
      for (const std::uint32_t w : around) {
        CollapseMap fresh(parts.mesh, parts.table, parts.wedges.positions, {}, Matching::nearest);
        EXPECT_EQ(kept.measure(ring[0], w) < 1e30f, fresh.build(ring[0], w));
      }
    }
  }
}

// The estimate by which the loop puts targets in order is below the cost, also after collapses.
TEST(MappingMetric, CostsAreNotBelowTheirEstimates) {
  for (const Matching matching : {Matching::texture, Matching::nearest}) {
    TriMesh relief = make_relief(7);
    Parts parts(relief);
    MappingMetric metric = parts.metric(matching, true);
    double tightest = 0;
    for (std::uint32_t u = 0; u < relief.positions.size(); ++u) {
      std::vector<std::uint32_t> ring;
      parts.mesh.ring(u, ring);
      for (const std::uint32_t v : ring) {
        const float least = metric.cost_at_least(u, v), cost = metric.cost(u, v);
        EXPECT_LE(least, cost);
        if (cost < 1e30f) tightest = std::max<double>(tightest, least / cost);
      }
      for (const std::uint32_t v : ring)
        if (u % 3 == 0 && parts.mesh.check(u, v, 0) == Refusal::none &&
            parts.table.match(parts.mesh, u, v) && metric.allows(parts.mesh, u, v)) {
          CollapseTrace trace;
          parts.mesh.collapse(u, v, &trace);
          parts.table.apply(trace);
          metric.collapsed(u, v);
          break;
        }
    }
    EXPECT_GT(tightest, 0.99);
  }
}

}  // namespace
}  // namespace viewcell
