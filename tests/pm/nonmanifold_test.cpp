// Edges of more than two triangles, and vertices where surfaces touch.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesh/surface_samples.h"
#include "pm/build.h"
#include "pm/measure.h"
#include "pm/shapes.h"
#include "pm/ways.h"

namespace viewcell {
namespace {

// n_sheets squares of n x n around the z axis, which all have its vertices 0 ... n.
TriMesh make_sheets(std::uint32_t n_sheets, std::uint32_t n) {
  TriMesh mesh;
  for (std::uint32_t z = 0; z <= n; ++z) mesh.positions.emplace_back(0, 0, z);
  for (std::uint32_t s = 0; s < n_sheets; ++s) {
    const double angle = 2 * std::numbers::pi * s / n_sheets + 0.3;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::uint32_t r = 1; r <= n; ++r)
      for (std::uint32_t z = 0; z <= n; ++z)
        mesh.positions.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
    const auto at = [&](std::uint32_t r, std::uint32_t z) {
      return r == 0 ? z : first + (r - 1) * (n + 1) + z;
    };
    for (std::uint32_t r = 0; r < n; ++r)
      for (std::uint32_t z = 0; z < n; ++z) {
        mesh.triangles.push_back({at(r, z), at(r + 1, z), at(r + 1, z + 1)});
        mesh.triangles.push_back({at(r, z), at(r + 1, z + 1), at(r, z + 1)});
      }
  }
  return mesh;
}

// Two noisy spheres that share a vertex.
TriMesh make_touching_spheres() {
  TriMesh mesh = make_noisy_sphere(3, 0.05, 3);
  const auto n = static_cast<std::uint32_t>(mesh.positions.size());
  const TriMesh other = mesh;
  const glm::vec3 touch = mesh.positions[0];
  for (const glm::vec3& p : other.positions) mesh.positions.push_back(2.0f * touch - p);
  for (Triangle t : other.triangles) {
    for (std::uint32_t& v : t) v = v == 0 ? 0 : v + n;
    mesh.triangles.push_back(t);
  }
  return mesh;
}

// A sphere with triangles that stand on its edges.
TriMesh make_sphere_with_fins(std::size_t n_fins) {
  TriMesh mesh = make_noisy_sphere(3, 0.02, 5);
  for (std::size_t i = 0; i < n_fins; ++i) {
    const Triangle t = mesh.triangles[7 * i];
    const auto tip = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back(0.53f * (mesh.positions[t[0]] + mesh.positions[t[1]]));
    mesh.triangles.push_back({t[0], t[1], tip});
  }
  return mesh;
}

double symmetric_distance(const TriMesh& a, const TriMesh& b) {
  return measure_farthest(a, b, 20000);
}

bool needs_texture(const Way& way) {
  return texture_needs(options_of(way)).coordinates;
}

// Flat sheets that meet in a straight line lose nothing down to two triangles each, and next to
// nothing where the order would have it otherwise.
TEST(NonManifold, SheetsThatMeetInALineGoDownToTwoTrianglesEach) {
  for (const std::uint32_t n_sheets : {3u, 4u, 5u})
    for (const Way& way : kWays) {
      if (needs_texture(way)) continue;
      SCOPED_TRACE(testing::Message()
                   << metric_name(way.metric) << ' ' << placement_name(way.placement) << ", "
                   << n_sheets << " sheets");
      const TriMesh book = make_sheets(n_sheets, 8);
      ProgressiveMesh pm(build_progressive_mesh(book, options_of(way)).record);
      pm.set_faces(4 * n_sheets);
      const TriMesh left = pm.extract();
      EXPECT_LE(left.triangles.size(), 4 * n_sheets);
      EXPECT_NEAR(surface_area(left), n_sheets * 64.0, 0.01 * n_sheets * 64);
      EXPECT_LT(symmetric_distance(book, left), 0.05);
    }
}

// A strip of n x 2 squares that is turned over once: its winding turns somewhere, and it has one
// border.
TriMesh make_moebius_strip(std::uint32_t n) {
  TriMesh mesh;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    for (const double across : {-0.3, 0.0, 0.3}) {
      const double r = 1 + across * std::cos(angle / 2);
      mesh.positions.emplace_back(r * std::cos(angle), r * std::sin(angle),
                                  across * std::sin(angle / 2));
    }
  }
  const auto at = [&](std::uint32_t i, std::uint32_t k) {
    return i < n ? 3 * i + k : 3 * (i - n) + 2 - k;
  };
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t k = 0; k < 2; ++k) {
      mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  return mesh;
}

TEST(NonManifold, BordersStayWhereWindingsMeet) {
  const TriMesh strip = make_moebius_strip(24);
  for (const Way& way : kWays)
    for (const Measure measure : {Measure::max, Measure::mean}) {
      if (needs_texture(way)) continue;
      SCOPED_TRACE(testing::Message() << metric_name(way.metric) << placement_name(way.placement));
      BuildOptions options = options_of(way);
      options.measure = measure;
      ProgressiveMesh pm(build_progressive_mesh(strip, options).record);
      for (const std::size_t n : {94u, 80u, 60u, 48u}) {
        pm.set_faces(n);
        EXPECT_LT(symmetric_distance(strip, pm.extract()), 0.09) << n;
      }
    }
}

TEST(NonManifold, SurfacesThatTouchGoOnSimplifying) {
  const TriMesh mesh = make_touching_spheres();
  for (const Measure measure : {Measure::max, Measure::mean}) {
    BuildOptions options;
    options.metric = MetricKind::mapping;
    options.placement = Placement::full;
    options.measure = measure;
    ProgressiveMesh pm(build_progressive_mesh(mesh, options).record);
    pm.set_faces(100);
    EXPECT_LE(pm.n_faces(), 100u);
    EXPECT_LT(symmetric_distance(mesh, pm.extract()), 0.2);
  }
}

TEST(NonManifold, FinsVanish) {
  const TriMesh mesh = make_sphere_with_fins(20);
  for (const Way& way : kWays) {
    if (needs_texture(way)) continue;
    SCOPED_TRACE(testing::Message() << metric_name(way.metric) << placement_name(way.placement));
    ProgressiveMesh pm(build_progressive_mesh(mesh, options_of(way)).record);
    pm.set_faces(30);
    EXPECT_LE(pm.n_faces(), 30u);
  }
}

// What is said to bound the distance does, whatever sheets are torn along and fins are lost.
TEST(NonManifold, BoundsHold) {
  for (const TriMesh& mesh :
       {make_sheets(3, 6), make_sheets(4, 6), make_touching_spheres(), make_sphere_with_fins(12)})
    for (const Way& way : kWays) {
      if (needs_texture(way)) continue;
      SCOPED_TRACE(testing::Message() << metric_name(way.metric) << placement_name(way.placement));
      BuildOptions options = options_of(way);
      options.track_error = true;
      ProgressiveMesh pm(build_progressive_mesh(mesh, options).record);
      for (std::size_t n = mesh.triangles.size(); n > 8; n = n * 2 / 3) {
        pm.set_faces(n);
        if (pm.error() < 0 || pm.n_faces() > n) continue;
        EXPECT_LE(symmetric_distance(mesh, pm.extract()), pm.error() * 1.0001 + 1e-6) << n;
      }
    }
}

// Each sheet of the star is mapped: the cells' old and new areas are those of its faces.
TEST(NonManifold, RecordsAreSound) {
  for (const TriMesh& mesh : {make_sheets(3, 5), make_touching_spheres(), make_sphere_with_fins(9)})
    for (const Way& way : kWays) {
      if (needs_texture(way)) continue;
      const ProgressiveRecord record = build_progressive_mesh(mesh, options_of(way)).record;
      EXPECT_EQ(check_record(record), "");
      EXPECT_EQ(make_finest(record).extract().triangles, mesh.triangles);
    }
}

}  // namespace
}  // namespace viewcell
