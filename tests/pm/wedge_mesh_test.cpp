#include "pm/wedge_mesh.h"

#include <gtest/gtest.h>

#include "pm/shapes.h"

namespace viewcell {
namespace {

// A seam in the texture from the left border of a grid to its middle, where it ends. A vertex on
// the seam has two wedges, the end has one: into the end the vertex may collapse, but both may not
// move together, for the seam would close behind them.
TEST(WedgeTable, TheEndOfASeamStays) {
  TriMesh grid = make_flat_grid(4);
  const std::uint32_t u = 2 * 5 + 1, v = 2 * 5 + 2;
  for (const Triangle& t : grid.triangles) {
    const bool is_above = t[0] / 5 + t[1] / 5 + t[2] / 5 > 6;
    for (const std::uint32_t w : t) {
      const bool is_split = is_above && (w == u || w == u - 1);
      grid.texcoords.emplace_back(grid.positions[w].x, grid.positions[w].y + (is_split ? 0.3f : 0));
    }
  }
  const WedgeMesh wedges = make_wedges(grid);
  const CollapseMesh mesh(wedges.positions, wedges.vertex_triangles());
  WedgeTable table(wedges);
  EXPECT_TRUE(table.match(mesh, u, v));
  ASSERT_EQ(table.pairs().size(), 2u);
  EXPECT_NE(table.pairs()[0].from, table.pairs()[1].from);
  EXPECT_EQ(table.pairs()[0].to, table.pairs()[1].to);
  EXPECT_FALSE(table.match_both(mesh, v));
  EXPECT_FALSE(table.match(mesh, v, u));
  EXPECT_TRUE(table.match(mesh, u, u - 1));  // along the seam
  EXPECT_TRUE(table.match_both(mesh, u - 1));
  EXPECT_FALSE(table.match(mesh, u, u + 5));  // away from it
  EXPECT_TRUE(table.match(mesh, u + 5, u));   // up to it
  EXPECT_FALSE(table.match_both(mesh, u));
}

}  // namespace
}  // namespace viewcell
