// Laws of the metrics that place vertices or look at texture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pm/build.h"
#include "pm/lindstrom_turk.h"
#include "pm/qem.h"
#include "pm/shapes.h"
#include "pm/texture_qem.h"

namespace viewcell {
namespace {

TEST(TextureNeeds, ByMetricAndPlacement) {
  using enum MetricKind;
  const auto needs = [](MetricKind metric, Placement placement, bool refuse_folds = false) {
    BuildOptions options;
    options.metric = metric, options.placement = placement, options.refuse_folds = refuse_folds;
    const TextureNeeds out = texture_needs(options);
    return std::pair(out.coordinates, out.no_folds);
  };
  for (const Placement placement : {Placement::half, Placement::full}) {
    EXPECT_EQ(needs(qem3, placement), std::pair(false, false));
    EXPECT_EQ(needs(lt, placement, true), std::pair(false, true));
    EXPECT_EQ(needs(qem5, placement), std::pair(true, true));
  }
  EXPECT_EQ(needs(aps, Placement::half), std::pair(true, true));
  EXPECT_EQ(needs(mapping, Placement::half), std::pair(true, true));
  EXPECT_EQ(needs(mapping, Placement::full), std::pair(false, true));
}

TEST(QemFullMetric, PlacesWhereTheCostIsLeast) {
  TriMesh mesh = make_noisy_sphere(2, 0.2, 1);
  QemFullMetric metric(mesh.positions, mesh.triangles);
  const glm::dvec3 centre = box_centre(mesh.positions);
  const LargeVector<Quadric> quadrics = make_quadrics(mesh.positions, mesh.triangles, centre);
  Random random(2);
  for (const Triangle& t : mesh.triangles) {
    Quadric sum = quadrics[t[0]];
    sum.add(quadrics[t[1]]);
    const glm::dvec3 place = glm::dvec3(metric.optimal_position(t[0], t[1])) - centre;
    const double least = sum.value(place);
    EXPECT_NEAR(metric.cost(t[0], t[1]), std::sqrt(least / sum.weight), 1e-5);
    EXPECT_EQ(metric.optimal_position(t[0], t[1]), metric.optimal_position(t[1], t[0]));
    for (int i = 0; i < 20; ++i) {
      const glm::dvec3 off(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      EXPECT_GE(sum.value(place + 0.1 * off), least * (1 - 1e-4) - 1e-12);
    }
  }
}

// Where planes leave a point free it stays beside the middle of the edge.
TEST(QemFullMetric, FlatPlacesAreTheMiddle) {
  TriMesh grid = make_flat_grid(4);
  QemFullMetric metric(grid.positions, grid.triangles);
  EXPECT_LT(glm::distance(metric.optimal_position(12, 13), glm::vec3(2.5f, 2, 0)), 1e-5f);
  EXPECT_NEAR(metric.cost(12, 13), 0, 1e-6);
}

TEST(LindstromTurk, CostAndPlaceAreTheSameFromBothEnds) {
  TriMesh mesh = make_noisy_sphere(3, 0.2, 3);
  mesh.triangles.resize(400);  // with a boundary
  CollapseMesh work(mesh.positions, mesh.triangles);
  LindstromTurkMetric metric(work, mesh.positions);
  for (const Triangle& t : mesh.triangles) {
    const float cost = metric.cost(t[0], t[1]);
    const glm::vec3 place = metric.optimal_position(t[0], t[1]);
    metric.cost(t[1], t[2]);  // another edge in between
    EXPECT_EQ(metric.cost(t[1], t[0]), cost);
    EXPECT_EQ(metric.optimal_position(t[1], t[0]), place);
    EXPECT_TRUE(std::isfinite(cost) && std::isfinite(glm::length(place)));
  }
}

// A straight boundary of a flat grid stays straight, and an edge along it collapses for nothing.
TEST(LindstromTurk, BoundariesAreKept) {
  TriMesh grid = make_flat_grid(6);
  CollapseMesh work(grid.positions, grid.triangles);
  LindstromTurkMetric metric(work, grid.positions);
  EXPECT_NEAR(metric.cost(2, 3), 0, 1e-4);
  EXPECT_NEAR(metric.optimal_position(2, 3).y, 0, 1e-5);
  EXPECT_NEAR(metric.optimal_position(2, 3).z, 0, 1e-5);
  EXPECT_LT(glm::length(metric.optimal_position(0, 7)), 1e-4f);  // a corner stays where it is
  EXPECT_NEAR(metric.cost(16, 17), 0, 1e-4);
}

// The volume between the old and the new surface is nothing.
TEST(LindstromTurk, OneStepKeepsTheVolume) {
  const TriMesh sphere = make_noisy_sphere(2, 0.2, 4);
  for (std::uint32_t k = 0; k < 20; ++k) {
    TriMesh mesh = sphere;
    CollapseMesh work(mesh.positions, mesh.triangles);
    LindstromTurkMetric metric(work, mesh.positions);
    const std::uint32_t u = mesh.triangles[k][0], v = mesh.triangles[k][1];
    const glm::vec3 place = metric.optimal_position(u, v);
    work.collapse(u, v);
    mesh.positions[v] = place;
    const auto volume = [](const std::vector<glm::vec3>& p,
                           const std::vector<Triangle>& triangles) {
      double sum = 0;
      for (const Triangle& t : triangles)
        sum += glm::dot(glm::dvec3(p[t[0]]), glm::cross(glm::dvec3(p[t[1]]), glm::dvec3(p[t[2]])));
      return sum / 6;
    };
    EXPECT_NEAR(volume(mesh.positions, work.triangles()),
                volume(sphere.positions, sphere.triangles), 1e-6);
  }
}

// No point that keeps the volume changes less volume, squared and summed over the triangles.
TEST(LindstromTurk, PlacesWhereVolumesChangeLeast) {
  TriMesh mesh = make_noisy_sphere(2, 0.2, 5);
  CollapseMesh work(mesh.positions, mesh.triangles);
  LindstromTurkMetric metric(work, mesh.positions);
  Random random(6);
  for (std::size_t k = 0; k < mesh.triangles.size(); k += 3) {
    const std::uint32_t u = mesh.triangles[k][0], v = mesh.triangles[k][1];
    std::vector<glm::dvec3> normals, points;
    glm::dvec3 sum(0);
    for (const Triangle& t : mesh.triangles) {
      if (std::count(t.begin(), t.end(), u) + std::count(t.begin(), t.end(), v) == 0) continue;
      normals.push_back(area_normal(mesh, t));
      points.emplace_back(mesh.positions[t[0]]);
      sum += normals.back();
    }
    const auto changed = [&](const glm::dvec3& p) {
      double total = 0;
      for (std::size_t i = 0; i < normals.size(); ++i)
        total += std::pow(glm::dot(normals[i], p - points[i]), 2);
      return total;
    };
    const glm::dvec3 place(metric.optimal_position(u, v));
    for (int i = 0; i < 20; ++i) {
      const glm::dvec3 any(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      const glm::dvec3 along = any - glm::dot(any, sum) / glm::dot(sum, sum) * sum;
      EXPECT_GE(changed(place + 0.05 * along), changed(place) * (1 - 1e-4));
    }
  }
}

// Memory of earlier stars must not outlive a collapse: on a sphere, and on one with a hole.
TEST(LindstromTurk, CostsAreThoseOfTheMeshAsItIs) {
  for (const bool open : {false, true}) {
    SCOPED_TRACE(open);
    TriMesh mesh = make_noisy_sphere(2, 0.2, 7);
    if (open) mesh.triangles.resize(mesh.triangles.size() / 2);
    CollapseMesh work(mesh.positions, mesh.triangles);
    LindstromTurkMetric metric(work, mesh.positions);
    int n_collapses = 0;
    for (std::size_t step = 0; step < 30; ++step) {
      const std::vector<Triangle> triangles = work.triangles();
      LindstromTurkMetric fresh(work, mesh.positions);
      for (const Triangle& t : triangles)
        for (std::size_t k = 0; k < 3; ++k) {
          const std::uint32_t u = t[k], v = t[(k + 1) % 3];
          EXPECT_EQ(metric.cost(u, v), fresh.cost(u, v)) << step << ": " << u << " " << v;
        }
      const auto [u, v, other] = triangles[7 * step % triangles.size()];
      const glm::vec3 place = metric.optimal_position(u, v);
      if (work.check(u, v, place, -1) != Refusal::none) continue;
      ++n_collapses;
      work.collapse(u, v);
      metric.collapsed(u, v, place);
    }
    EXPECT_GT(n_collapses, 10);
  }
}

// The outline of a flat disk keeps the area that it encloses.
TEST(LindstromTurk, FlatOutlinesKeepTheirArea) {
  TriMesh disk = make_flat_grid(10);
  Random random(8);
  for (glm::vec3& p : disk.positions)
    p += glm::vec3(random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), 0);
  const auto area_of = [](const TriMesh& mesh) {
    double sum = 0;
    for (const Triangle& t : mesh.triangles) sum += area_normal(mesh, t).z / 2;
    return sum;
  };
  BuildOptions options;
  options.metric = MetricKind::lt;
  options.placement = Placement::full;
  ProgressiveMesh pm(build_progressive_mesh(disk, options).record);
  for (const std::size_t n : {150u, 100u, 50u, 25u}) {
    pm.set_faces(n);
    EXPECT_NEAR(area_of(pm.extract()), area_of(disk), 1e-4 * area_of(disk)) << n;
  }
}

TEST(TextureQem, ConstantTextureIsQem3) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    TriMesh mesh = make_noisy_sphere(3, 0.1, seed);
    mesh.triangles.resize(mesh.triangles.size() - 40);  // with a boundary
    BuildOptions options;
    options.placement = seed % 2 ? Placement::half : Placement::full;
    const ProgressiveRecord qem3 = build_progressive_mesh(mesh, options).record;
    mesh.texcoords.assign(3 * mesh.triangles.size(), {0.25f, 0.75f});
    options.metric = MetricKind::qem5;
    const ProgressiveRecord qem5 = build_progressive_mesh(mesh, options).record;
    ASSERT_EQ(qem5.splits.size(), qem3.splits.size());
    for (std::size_t i = 0; i < qem3.splits.size(); ++i)
      ASSERT_NEAR(qem5.splits[i].cost, qem3.splits[i].cost, 1e-5 + 1e-3 * qem3.splits[i].cost) << i;
  }
}

// Position and texture coordinates together, for a vertex inside its chart.
TEST(TextureQemFull, PlacesWhereTheCostIsLeast) {
  TriMesh mesh = make_noisy_sphere(2, 0.2, 4);
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t)
      mesh.texcoords.emplace_back(0.3f * mesh.positions[v].x, 0.3f * mesh.positions[v].y);
  WedgeMesh wedges = make_wedges(mesh);
  CollapseMesh work(wedges.positions, wedges.vertex_triangles());
  WedgeTable table(wedges);
  TextureQemFullMetric metric(work, wedges, table, wedges.positions, wedges.vertex_triangles(),
                              wedges.texcoords);
  const TextureQuadrics quadrics(wedges, wedges.positions, wedges.vertex_triangles(),
                                 wedges.texcoords, {});
  Random random(2);
  for (const Triangle& t : wedges.faces) {
    Quadric5 sum = quadrics.of_wedges[t[0]];
    sum.add(quadrics.of_wedges[t[1]]);
    const glm::dvec3 p = glm::dvec3(metric.optimal_position(t[0], t[1])) - quadrics.centre;
    ASSERT_TRUE(metric.texcoord());
    const glm::dvec2 uv = quadrics.scale * glm::dvec2(*metric.texcoord());
    const double least = sum.value({p.x, p.y, p.z, uv.x, uv.y});
    EXPECT_NEAR(metric.cost(t[0], t[1]), quadrics.cost_scale.cost(least, sum.weight), 1e-4);
    EXPECT_EQ(metric.optimal_position(t[0], t[1]), metric.optimal_position(t[1], t[0]));
    for (int i = 0; i < 20; ++i) {
      const auto off = [&] { return 0.1 * random.uniform(-1, 1); };
      EXPECT_GE(sum.value({p.x + off(), p.y + off(), p.z + off(), uv.x + off(), uv.y + off()}),
                least * (1 - 1e-4) - 1e-9);
    }
  }
}

// Along the border of two charts: on the edge, where the sum is least there.
TEST(TextureQemFull, BorderPlacesAreTheLeastOfTheEdge) {
  TriMesh mesh = make_noisy_sphere(3, 0.2, 6);
  for (const Triangle& t : mesh.triangles) {
    const float z = mesh.positions[t[0]].z + mesh.positions[t[1]].z + mesh.positions[t[2]].z;
    for (const std::uint32_t v : t)
      mesh.texcoords.emplace_back(mesh.positions[v].x + (z > 0 ? 3 : 0), mesh.positions[v].y);
  }
  WedgeMesh wedges = make_wedges(mesh);
  CollapseMesh work(wedges.positions, wedges.vertex_triangles());
  WedgeTable table(wedges);
  TextureQemFullMetric metric(work, wedges, table, wedges.positions, wedges.vertex_triangles(),
                              wedges.texcoords);
  const TextureQuadrics quadrics(wedges, wedges.positions, wedges.vertex_triangles(),
                                 wedges.texcoords, {});
  int n_inside = 0, n_borders = 0;
  for (const Triangle& t : wedges.vertex_triangles()) {
    const std::uint32_t u = t[0], v = t[1];  // no binding: clang 14 captures none
    if (!table.match(work, u, v) || !table.match_both(work, v) || table.pairs().size() != 2)
      continue;
    ++n_borders;
    const std::vector<WedgeTable::Pair> pairs = table.pairs();
    const auto value_at = [&](double along) {
      double value = 0;
      for (const auto& [from, to] : pairs) {
        const Vec5 a = quadrics.point(u, from);
        Vec5 x = quadrics.point(v, to);
        for (std::size_t i = 0; i < 5; ++i) x[i] += along * (a[i] - x[i]);
        value += quadrics.of_wedges[from].value(x) + quadrics.of_wedges[to].value(x);
      }
      return value;
    };
    const glm::dvec3 at_u(wedges.positions[u]), at_v(wedges.positions[v]);
    const glm::dvec3 place(metric.optimal_position(u, v));
    const double along = glm::distance(place, at_v) / glm::distance(at_u, at_v);
    EXPECT_LT(glm::distance(place, glm::mix(at_v, at_u, along)), 1e-5);
    EXPECT_FALSE(metric.texcoord());
    n_inside += along > 0.05 && along < 0.95;
    for (double s = 0; s <= 1; s += 0.05) EXPECT_LE(value_at(along), value_at(s) + 1e-6);
  }
  EXPECT_GT(n_borders, 10);
  EXPECT_GT(n_inside, n_borders / 4);
}

// On a plane with an affine texture wherever the place is, its texture coordinates are the plane's
// there; along the border of two charts both stay on it.
TEST(TextureQemFull, FlatTexturesStay) {
  TriMesh grid = make_flat_grid(8);
  Random random(5);
  for (glm::vec3& p : grid.positions)
    if (p.x > 0 && p.x < 8 && p.x != 4 && p.y > 0 && p.y < 8)
      p += glm::vec3(random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), 0);
  const auto uv_at = [](const glm::vec3& p, bool is_right) {
    return glm::vec2(0.1f * p.x + 0.02f * p.y + (is_right ? 2 : 0), 0.3f - 0.1f * p.y);
  };
  for (const Triangle& t : grid.triangles) {
    const bool is_right = (t[0] % 9) + (t[1] % 9) + (t[2] % 9) > 12;
    for (const std::uint32_t v : t) grid.texcoords.push_back(uv_at(grid.positions[v], is_right));
  }
  BuildOptions options;
  options.metric = MetricKind::qem5;
  options.placement = Placement::full;
  ProgressiveMesh pm(build_progressive_mesh(grid, options).record);
  for (const std::size_t n : {100u, 60u, 30u}) {
    pm.set_faces(n);
    ASSERT_LE(pm.n_faces(), n);
    const TriMesh mesh = pm.extract();
    for (std::size_t c = 0; c < mesh.texcoords.size(); ++c) {
      const glm::vec2 uv = mesh.texcoords[c];
      const glm::vec3 p = mesh.positions[mesh.triangles[c / 3][c % 3]];
      EXPECT_LT(glm::distance(uv, uv_at(p, uv.x > 1.5f)), 1e-4f);
      EXPECT_TRUE(uv.x > 1.5f ? p.x > 4 - 1e-4f : p.x < 4 + 1e-4f) << p.x;
    }
  }
}

// A texture that is an affine map of a plane costs nothing; one that bends does.
TEST(TextureQem, BentTexturesCost) {
  TriMesh grid = make_flat_grid(8);
  for (const Triangle& t : grid.triangles)
    for (const std::uint32_t v : t) {
      const glm::vec3& p = grid.positions[v];
      grid.texcoords.emplace_back(0.1f * p.x + 0.02f * p.y, 0.3f - 0.1f * p.y);
    }
  const auto cost_of = [](const TriMesh& mesh) {
    WedgeMesh wedges = make_wedges(mesh);
    const std::vector<Triangle> triangles = wedges.vertex_triangles();
    CollapseMesh work(wedges.positions, triangles);
    WedgeTable table(wedges);
    return TextureQemMetric(work, wedges, table, wedges.positions, triangles)
        .cost(40, 49);  // upwards
  };
  EXPECT_NEAR(cost_of(grid), 0, 1e-5);
  TriMesh bent = grid;
  for (glm::vec2& uv : bent.texcoords) uv.x += 0.02f * std::sin(20 * uv.y);
  EXPECT_GT(cost_of(bent), 0.01f);
  for (std::size_t c = 0; c < grid.texcoords.size(); ++c)
    if (grid.triangles[c / 3][c % 3] == 40) grid.texcoords[c].x += 0.05f;  // one vertex slides
  EXPECT_GT(cost_of(grid), 0.01f);
}

}  // namespace
}  // namespace viewcell
