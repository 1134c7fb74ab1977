// Triangle soups whose corners are a little apart.
#include <gtest/gtest.h>

#include "mesh/surface_distance.h"
#include "mesh/surfaces.h"
#include "pm/build.h"
#include "pm/shapes.h"
#include "pm/ways.h"

namespace viewcell {
namespace {

TEST(WeldedSoup, CollapsesAsASurface) {
  const TriMesh sphere = make_noisy_sphere(4, 0, 1);
  for (const Way& way : std::span(kWays).first(3))
    for (const double noise : {0.0, 1e-6, 1e-5}) {
      SCOPED_TRACE(testing::Message() << metric_name(way.metric) << " noise " << noise);
      const TriMesh soup = make_noisy_soup(sphere, noise, 2);
      const BuildResult built = build_progressive_mesh(soup, options_of(way));
      EXPECT_EQ(built.n_welded, soup.positions.size() - sphere.positions.size());
      EXPECT_EQ(built.welded_apart.n_welded > 0, noise > 0);
      EXPECT_LE(built.welded_apart.gap, 4 * noise);
      EXPECT_EQ(built.pieces.n, 1u);
      EXPECT_EQ(built.n_dropped, 0u);
      ProgressiveMesh pm(built.record);
      EXPECT_LE(pm.n_base_faces(), 8u);
      pm.set_faces(200);
      // 200 faces of a sphere of radius 1: sagitta of caps of 4 pi / 200
      EXPECT_LT(
          measure_surface_distance(sphere, pm.extract(), {.n_samples = 20000}).symmetric().max,
          0.06);
      pm.set_level(pm.n_splits());
      EXPECT_EQ(pm.extract().positions, soup.positions);
      EXPECT_EQ(pm.extract().triangles, soup.triangles);
    }
}

TEST(WeldedSoup, StaysApartWhenAsked) {
  const TriMesh soup = make_noisy_soup(make_octahedron(), 1e-6, 3);
  BuildOptions options;
  options.weld_tolerance = 0;
  const BuildResult apart = build_progressive_mesh(soup, options);
  EXPECT_EQ(apart.welded_apart.n_welded, 0u);
  EXPECT_EQ(apart.pieces.n, 8u);
  EXPECT_EQ(apart.pieces.n_small, 8u);
  EXPECT_EQ(apart.pieces.n_in_small, 8u);
  options.weld_tolerance = 1e-5;
  EXPECT_EQ(build_progressive_mesh(soup, options).pieces.n, 1u);
  // Wide enough to take corners from triangles.
  options.weld_tolerance = 0.5;
  TriMesh strip = make_flat_grid(4);
  for (glm::vec3& p : strip.positions) p.x *= 0.1f;
  EXPECT_GT(build_progressive_mesh(strip, options).n_dropped, 0u);
}

// What a level may be off counts what welding has moved.
TEST(WeldedSoup, BoundsHoldTheGap) {
  const TriMesh soup = make_noisy_soup(make_noisy_sphere(3, 0.1, 4), 1e-3, 5);
  BuildOptions options;
  options.weld_tolerance = 0.01;
  options.error_bound = 0.15f;
  const BuildResult built = build_progressive_mesh(soup, options);
  EXPECT_GT(built.welded_apart.gap, 1e-3);
  ProgressiveMesh pm(built.record);
  EXPECT_LT(pm.n_faces(), soup.triangles.size() / 2);
  for (std::size_t level = 0; level < pm.n_splits(); level += 20) {
    pm.set_level(level);
    EXPECT_GE(pm.error(), built.welded_apart.gap);
    EXPECT_LE(pm.error(), 0.15f);
    EXPECT_LE(measure_surface_distance(soup, pm.extract(), {.n_samples = 5000}).symmetric().max,
              pm.error());
  }
}

}  // namespace
}  // namespace viewcell
