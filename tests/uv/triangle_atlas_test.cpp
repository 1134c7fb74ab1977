#include "uv/triangle_atlas.h"

#include <gtest/gtest.h>

#include "common/expect_input_error.h"
#include "common/models.h"
#include "mesh/cube.h"
#include "uv/chart_checks.h"

namespace viewcell {
namespace {

// Twice the area in texels, signed.
double area_px(const std::vector<glm::vec2>& uv, std::size_t t, int side_px) {
  const glm::dvec2 a(uv[3 * t]), b(uv[3 * t + 1]), c(uv[3 * t + 2]);
  return ((b - a).x * (c - a).y - (b - a).y * (c - a).x) * side_px * side_px;
}

TEST(TriangleAtlas, ChartsAreApartAndOneEach) {
  TriMesh mesh = make_lumpy_figure(12);
  for (const auto& [width_px, height_px] :
       {std::pair(512, 512), {1000, 700}, {600, 200}, {256, 1024}}) {
    SCOPED_TRACE(width_px);
    mesh.texcoords = make_triangle_atlas(mesh, width_px, height_px, "m");
    const ChartFindings f = check_charts(mesh, width_px, height_px);
    EXPECT_EQ(f.n_charts, mesh.triangles.size());
    EXPECT_TRUE(f.is_one_to_one()) << describe(f);
    EXPECT_EQ(f.n_outside + f.n_turned + f.n_flat + f.n_crowded + f.n_tiny, 0u) << describe(f);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      EXPECT_GT(area_px(mesh.texcoords, t, 1), 0);
  }
}

// Two triangles of which one is 64 times as large fill the picture as well as squares can.
TEST(TriangleAtlas, LargeTrianglesGetMore) {
  TriMesh mesh = make_mesh({{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {1, 0, 0}, {0, 1, 0}},
                           {{0, 1, 2}, {0, 3, 4}, {0, 3, 4}, {0, 3, 4}});
  const std::vector<glm::vec2> uv = make_triangle_atlas(mesh, 512, 512, "m");
  EXPECT_GT(area_px(uv, 0, 512), 200.0 * 200);
  for (const std::size_t t : {1u, 2u, 3u}) {
    EXPECT_GT(area_px(uv, 0, 512), 3 * area_px(uv, t, 512));
    EXPECT_GT(area_px(uv, t, 512), 20.0 * 20);
  }
}

TEST(TriangleAtlas, LongestEdgesAreHypotenuses) {
  const TriMesh mesh = make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{1, 2, 0}});
  const std::vector<glm::vec2> uv = make_triangle_atlas(mesh, 64, 64, "m");
  EXPECT_GT(glm::distance(uv[0], uv[1]), 1.4 * glm::distance(uv[1], uv[2]));
  EXPECT_NEAR(glm::distance(uv[0], uv[2]), glm::distance(uv[1], uv[2]), 1e-6);
}

TEST(TriangleAtlas, SmallPicturesAreRefused) {
  const TriMesh cube = make_cube();
  EXPECT_INPUT_ERROR(make_triangle_atlas(cube, 16, 16, "m"), "12 triangles need a larger picture");
  EXPECT_INPUT_ERROR(make_triangle_atlas(cube, 400, 4, "m"), "less than 8 texels");
  EXPECT_EQ(make_triangle_atlas(cube, 32, 16, "m").size(), 36u);
}

}  // namespace
}  // namespace viewcell
