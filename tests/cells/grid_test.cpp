#include "cells/grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/error.h"
#include "base/random.h"

namespace viewcell {
namespace {

const double kSqrt3 = std::sqrt(3.0);

// The paper's 22 x 24 and 11 x 12 leave a strip uncovered.
TEST(HexGrid, CoversThePapersParkInFull) {
  const Area park{{0, 0}, {1650, 2035}};
  const HexGrid fifty = make_grid(park, 50), hundred = make_grid(park, 100);
  EXPECT_EQ(fifty.columns, 23);
  EXPECT_EQ(fifty.rows, 24);
  EXPECT_EQ(hundred.columns, 12);
  EXPECT_EQ(hundred.rows, 13);
}

TEST(HexGrid, OneCellIsEnoughForAPoint) {
  const HexGrid grid = make_grid({{3, 4}, {3, 4}}, 10);
  EXPECT_EQ(grid.columns, 1);
  EXPECT_EQ(grid.rows, 1);
}

TEST(HexGrid, TooManyCellsAreTheUsersFault) {
  EXPECT_THROW(make_grid({{0, 0}, {1e6, 1}}, 0.01), UsageError);
  EXPECT_THROW(make_grid({{0, 0}, {1, 1e300}}, 1e-6), UsageError);
}

std::vector<glm::dvec2> telling_points(const Area& area, const HexGrid& grid, Random& random) {
  std::vector<glm::dvec2> points{area.lo, area.hi, {area.lo.x, area.hi.y}, {area.hi.x, area.lo.y}};
  for (int i = 0; i < 300; ++i) {
    const glm::dvec2 p{random.uniform(area.lo.x, area.hi.x), random.uniform(area.lo.y, area.hi.y)};
    for (const glm::dvec2& q :
         {p, glm::dvec2{area.lo.x, p.y}, {area.hi.x, p.y}, {p.x, area.lo.y}, {p.x, area.hi.y}})
      points.push_back(q);
  }
  for (int column = 0; column < grid.columns; ++column)  // corners of hexagons, and their edges
    for (const glm::dvec2& p : corners_of(grid, {column, grid.rows / 2}))
      points.push_back(glm::clamp(p, area.lo, area.hi));
  return points;
}

TEST(HexGrid, EveryPointOfTheAreaIsInACell) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const glm::dvec2 lo{random.uniform(-500, 500), random.uniform(-500, 500)};
    const Area area{lo, lo + glm::dvec2(random.uniform(1, 900), random.uniform(1, 900))};
    const HexGrid grid = make_grid(area, random.uniform(5, 200));
    for (const glm::dvec2& p : telling_points(area, grid, random))
      EXPECT_TRUE(cell_at(grid, coord_at(grid, p))) << p.x << " " << p.y;
  }
}

// The low edge is a border of row 0 in odd columns, and far edges may be borders too.
TEST(HexGrid, EdgesThatAreBordersBelongToCells) {
  for (const glm::dvec2 lo : {glm::dvec2(0, 0), {0.1, -7.3}, {1e5, 1e5 / 3}})
    for (int k = 0; k < 4; ++k) {
      const Area area{lo, lo + 50.0 * glm::dvec2(0.5 + 1.5 * k, kSqrt3 * (0.5 + k))};
      const HexGrid grid = make_grid(area, 50);
      for (double t = 0; t <= 1; t += 1.0 / 64) {
        const glm::dvec2 p = glm::mix(area.lo, area.hi, t);
        for (const glm::dvec2& q : {glm::dvec2(p.x, area.lo.y), glm::dvec2(p.x, area.hi.y),
                                    glm::dvec2(area.lo.x, p.y), glm::dvec2(area.hi.x, p.y)})
          EXPECT_TRUE(cell_at(grid, coord_at(grid, q))) << q.x << " " << q.y << " of " << k;
      }
    }
}

// Were there one column or row fewer, some point of the far edges would be in none.
TEST(HexGrid, IsNoLargerThanNeeded) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Area area{{0, 0}, {random.uniform(300, 900), random.uniform(300, 900)}};
    const HexGrid grid = make_grid(area, random.uniform(20, 60));
    std::set<int> columns, rows;
    for (int i = 0; i < grid.columns; ++i)
      for (int j = 0; j < grid.rows; ++j) {
        const glm::dvec2 c = glm::min(centre_of(grid, {i, j}), area.hi);
        columns.insert(coord_at(grid, {area.hi.x, c.y}).column);
        rows.insert(coord_at(grid, {c.x, area.hi.y}).row);
      }
    EXPECT_TRUE(columns.contains(grid.columns - 1));
    EXPECT_TRUE(rows.contains(grid.rows - 1));
  }
}

TEST(HexGrid, PlaceIsTheNearestCentre) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    HexGrid grid{{random.uniform(-9, 9), random.uniform(-9, 9)}, random.uniform(1, 80), 9, 9};
    for (int i = 0; i < 2000; ++i) {
      const glm::dvec2 p{random.uniform(-400, 400), random.uniform(-400, 400)};
      const HexCoord place = coord_at(grid, p);
      const double found = glm::length(p - centre_of(grid, place));
      EXPECT_LE(found, grid.size * (1 + 1e-12));
      for (int dc = -2; dc <= 2; ++dc)
        for (int dr = -2; dr <= 2; ++dr)
          EXPECT_LE(found,
                    1e-9 + glm::length(p - centre_of(grid, {place.column + dc, place.row + dr})));
    }
  }
}

TEST(HexGrid, CentresAndPointsAroundThemAreInTheirCell) {
  const HexGrid grid = make_grid({{0, 0}, {500, 500}}, 50);
  for (int i = 0; i < grid.n_cells(); ++i) {
    const HexCoord place = coord_of(grid, CellId(i));
    const glm::dvec2 c = centre_of(grid, place);
    EXPECT_EQ(coord_at(grid, c), place);
    for (const glm::dvec2& corner : corners_of(grid, place))
      EXPECT_EQ(coord_at(grid, glm::mix(c, corner, 0.999)), place);
    EXPECT_EQ(cell_at(grid, place), CellId(i));
  }
}

// Two hexagons share no inner point: a point just inside one is outside all its neighbours.
TEST(HexGrid, CellsDoNotOverlap) {
  const HexGrid grid{{3, 7}, 50, 5, 5};
  for (const HexCoord place : {HexCoord{2, 2}, {1, 2}, {-1, -3}})
    for (const glm::dvec2& corner : corners_of(grid, place)) {
      const glm::dvec2 p = glm::mix(centre_of(grid, place), corner, 0.9999);
      EXPECT_TRUE(contains(corners_of(grid, place), p));
      for (int face = 0; face < 6; ++face)
        EXPECT_FALSE(contains(corners_of(grid, neighbour(place, face)), p));
    }
}

TEST(HexGrid, CornersAreSizeFromTheCentreCounterClockwise) {
  const HexGrid grid{{3, 7}, 50, 5, 5};
  const HexCoord place{3, 1};
  const ConvexPolygon corners = corners_of(grid, place);
  ASSERT_EQ(corners.size(), 6u);
  for (std::size_t k = 0; k < 6; ++k) {
    const double angle = glm::radians(60.0 * static_cast<double>(k));
    const glm::dvec2 expected =
        centre_of(grid, place) + 50.0 * glm::dvec2(std::cos(angle), std::sin(angle));
    EXPECT_NEAR(glm::length(corners[k] - expected), 0, 1e-9) << k;
  }
}

// Flat-topped: columns 1.5 c apart, rows sqrt(3) c apart.
TEST(HexGrid, CentresAreWhereThePaperPutsThem) {
  const HexGrid grid{{0, 0}, 50, 5, 5};
  EXPECT_EQ(centre_of(grid, {0, 0}), glm::dvec2(0, 0));
  EXPECT_NEAR(centre_of(grid, {1, 0}).x, 75, 1e-12);
  EXPECT_NEAR(centre_of(grid, {1, 0}).y, 25 * kSqrt3, 1e-12);
  EXPECT_NEAR(centre_of(grid, {2, 3}).x, 150, 1e-12);
  EXPECT_NEAR(centre_of(grid, {2, 3}).y, 150 * kSqrt3, 1e-12);
  EXPECT_NEAR(centre_of(grid, {-1, 0}).y, 25 * kSqrt3, 1e-12);  // odd columns left of 0 too
}

TEST(HexGrid, NeighboursAreMutualAndWhereTheirFacesLook) {
  const HexGrid grid{{3, 7}, 50, 5, 5};
  for (int column = -2; column <= 3; ++column)
    for (int row = -2; row <= 2; ++row)
      for (int face = 0; face < 6; ++face) {
        const HexCoord place{column, row}, next = neighbour(place, face);
        EXPECT_EQ(neighbour(next, (face + 3) % 6), place);
        const glm::dvec2 d = centre_of(grid, next) - centre_of(grid, place);
        const double angle = glm::radians(30.0 + 60.0 * face);
        EXPECT_NEAR(d.x, 50 * kSqrt3 * std::cos(angle), 1e-9);
        EXPECT_NEAR(d.y, 50 * kSqrt3 * std::sin(angle), 1e-9);
      }
  EXPECT_THROW(neighbour({0, 0}, 6), BugError);
  EXPECT_THROW(neighbour({0, 0}, -1), BugError);
}

TEST(HexGrid, IdsComeBackTheRimIncluded) {
  const HexGrid grid{{0, 0}, 50, 4, 3};
  for (int i = 0; i < grid.n_centres(); ++i)
    EXPECT_EQ(centre_at(grid, coord_of(grid, CentreId(i))), CentreId(i));
  EXPECT_EQ(grid.n_centres(), 30);
  EXPECT_EQ(coord_of(grid, CentreId(0)), (HexCoord{-1, -1}));
  EXPECT_EQ(coord_of(grid, CentreId(29)), (HexCoord{4, 3}));
  for (const HexCoord& p : {HexCoord{-2, 0}, {5, 0}, {0, -2}, {0, 4}})
    EXPECT_FALSE(centre_at(grid, p));
  for (const HexCoord& p : {HexCoord{-1, 0}, {4, 0}, {0, -1}, {0, 3}}) {
    EXPECT_FALSE(cell_at(grid, p));
    EXPECT_TRUE(centre_at(grid, p));
  }
}

TEST(HexGrid, ViewsAreTheSevenCentresInOrder) {
  const HexGrid grid{{0, 0}, 50, 4, 3};
  for (int i = 0; i < grid.n_cells(); ++i) {
    const HexCoord place = coord_of(grid, CellId(i));
    const auto views = views_of(grid, CellId(i));
    EXPECT_EQ(std::set<CentreId>(views.begin(), views.end()).size(), 7u);
    EXPECT_EQ(coord_of(grid, views[0]), place);
    for (int face = 0; face < 6; ++face)
      EXPECT_EQ(coord_of(grid, views[static_cast<std::size_t>(face) + 1]), neighbour(place, face));
  }
}

}  // namespace
}  // namespace viewcell
