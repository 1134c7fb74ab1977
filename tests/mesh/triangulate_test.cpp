#include "mesh/triangulate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "base/random.h"

namespace viewcell {
namespace {

using Polygon = std::vector<glm::vec3>;

Polygon in_plane(const std::vector<glm::vec2>& points) {
  Polygon out;
  for (const glm::vec2& p : points) out.emplace_back(p, 0);
  return out;
}

glm::dvec3 doubled_area(const Polygon& polygon, const Triangle& t) {
  const glm::dvec3 a(polygon.at(t[0]));
  return glm::cross(glm::dvec3(polygon.at(t[1])) - a, glm::dvec3(polygon.at(t[2])) - a);
}

struct Cover {
  double area = 0;      // of all triangles, along z
  double smallest = 1;  // of one, negative when it turns over
  std::set<std::uint32_t> corners;
};
Cover cover_of(const Polygon& polygon, const std::vector<Triangle>& triangles) {
  Cover out;
  for (const Triangle& t : triangles) {
    const double area = doubled_area(polygon, t).z / 2;
    out.area += area;
    out.smallest = std::min(out.smallest, area);
    out.corners.insert(t.begin(), t.end());
  }
  return out;
}

// Triangles that turn as the polygon does, use every corner, and have this area.
void expect_covered(const Polygon& polygon, double area, std::size_t n_corners) {
  std::vector<Triangle> triangles;
  EXPECT_NE(triangulate_polygon(polygon, triangles), PolygonCut::crossed);
  const Cover cover = cover_of(polygon, triangles);
  EXPECT_NEAR(cover.area, area, 1e-9 * area);
  EXPECT_GE(cover.smallest, 0);
  EXPECT_EQ(cover.corners.size(), n_corners);
}

std::vector<Triangle> fan_of(std::uint32_t n) {
  std::vector<Triangle> out;
  for (std::uint32_t k = 1; k + 1 < n; ++k) out.push_back({0, k, k + 1});
  return out;
}

std::vector<glm::vec2> rotated(std::vector<glm::vec2> points, std::size_t by) {
  std::rotate(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(by), points.end());
  return points;
}

//   5---4
//   |   |
//   |   3---2
//   |       |
//   0-------1
const std::vector<glm::vec2> kL = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};

TEST(Triangulate, AnLFromEveryCornerOnEverySide) {
  for (std::size_t start = 0; start < kL.size(); ++start)
    for (int axis = 0; axis < 3; ++axis)
      for (const bool is_turned : {false, true}) {
        SCOPED_TRACE(testing::Message() << start << " " << axis << " " << is_turned);
        Polygon polygon;
        for (const glm::vec2& p : rotated(kL, start)) {
          glm::vec3 q(3);
          q[(axis + 1) % 3] = p.x, q[(axis + 2) % 3] = p.y;
          polygon.push_back(q);
        }
        if (is_turned) std::reverse(polygon.begin(), polygon.end());
        std::vector<Triangle> triangles;
        EXPECT_NE(triangulate_polygon(polygon, triangles), PolygonCut::crossed);
        EXPECT_EQ(triangles.size(), 4u);
        double sum = 0;
        for (const Triangle& t : triangles) {
          const double area = doubled_area(polygon, t)[axis] / 2;
          EXPECT_GE(is_turned ? -area : area, 0);
          sum += area;
        }
        EXPECT_DOUBLE_EQ(sum, is_turned ? -3 : 3);
      }
}

// With corners on its edges, and by floats that are not quite on the circle: what files have had
// as fans stays so.
TEST(Triangulate, ConvexPolygonsStayFans) {
  for (std::uint32_t n = 3; n < 40; ++n) {
    Polygon polygon;
    for (std::uint32_t k = 0; k < n; ++k) {
      const double a = 2 * std::acos(-1.0) * k / n;
      const glm::dvec3 u(0.36, 0.48, -0.8), v(-0.8, 0.6, 0);
      polygon.emplace_back(100.0 + std::cos(a) * u + std::sin(a) * v);
      if (k % 3 == 0) polygon.push_back(polygon.back());  // and twice
    }
    std::vector<Triangle> triangles;
    EXPECT_EQ(triangulate_polygon(polygon, triangles), PolygonCut::fan) << n;
    EXPECT_EQ(triangles, fan_of(static_cast<std::uint32_t>(polygon.size()))) << n;
  }
  std::vector<glm::vec2> square;
  for (int k = 0; k < 9; ++k) square.emplace_back(0.1f * static_cast<float>(k), 0.1f);
  for (int k = 0; k < 9; ++k) square.emplace_back(0.9f, 0.1f + 0.1f * static_cast<float>(k));
  square.emplace_back(0, 1);
  for (std::size_t start = 0; start < square.size(); ++start) {
    std::vector<Triangle> triangles;
    EXPECT_EQ(triangulate_polygon(in_plane(rotated(square, start)), triangles), PolygonCut::fan);
  }
  std::vector<Triangle> saddle;  // a quad that is not plane
  EXPECT_EQ(triangulate_polygon(Polygon{{0, 0, 0}, {1, 0, 1}, {1, 1, 0}, {0, 1, 1}}, saddle),
            PolygonCut::fan);
}

// A way from the outside to a hole and back: the corners at its ends stand twice.
TEST(Triangulate, HolesThatAWayLeadsTo) {
  const Polygon one = in_plane({{0, 0},
                                {4, 0},
                                {4, 4},
                                {0, 4},
                                {0, 0},  // and in
                                {1, 1},
                                {1, 3},
                                {3, 3},
                                {3, 1},
                                {1, 1}});
  expect_covered(one, 16 - 4, 8);
  const Polygon two = in_plane({{0, 0},
                                {9, 0},
                                {9, 4},
                                {0, 4},
                                {0, 0},
                                {1, 1},
                                {1, 3},
                                {3, 3},
                                {3, 1},
                                {1, 1},
                                {0, 0},
                                {5, 1},
                                {5, 2},
                                {6, 2},
                                {6, 1},
                                {5, 1}});
  expect_covered(two, 36 - 4 - 1, 12);
  const Polygon touching = in_plane({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 2}, {2, 1}});
  expect_covered(touching, 16 - 1.5, 7);
  const Polygon spike = in_plane({{0, 0}, {4, 0}, {6, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}});
  std::vector<Triangle> triangles;
  EXPECT_EQ(triangulate_polygon(spike, triangles), PolygonCut::sweep);
  EXPECT_DOUBLE_EQ(cover_of(spike, triangles).area, 10);
}

// ---- polyominoes: cells of a grid, one after another beside those that are there ----

using Cell = std::pair<int, int>;

std::set<Cell> grow_cells(Random& random, std::size_t n) {
  std::vector<Cell> list{{0, 0}};
  std::set<Cell> cells{{0, 0}};
  while (cells.size() < n) {
    auto [x, y] = list[random.below(static_cast<std::uint32_t>(list.size()))];
    (random.below(2) ? x : y) += random.below(2) ? 1 : -1;
    if (cells.insert({x, y}).second) list.emplace_back(x, y);
  }
  return cells;
}

// Their outline, inside on the left, which turns left where cells meet in a corner; empty when
// there are several.
std::vector<glm::vec2> outline_of(const std::set<Cell>& cells) {
  std::map<Cell, std::vector<Cell>> next;
  std::size_t n_edges = 0;
  const auto add = [&](Cell from, Cell to) { next[from].push_back(to), ++n_edges; };
  for (const auto& [x, y] : cells) {
    if (!cells.contains({x, y - 1})) add({x, y}, {x + 1, y});
    if (!cells.contains({x + 1, y})) add({x + 1, y}, {x + 1, y + 1});
    if (!cells.contains({x, y + 1})) add({x + 1, y + 1}, {x, y + 1});
    if (!cells.contains({x - 1, y})) add({x, y + 1}, {x, y});
  }
  std::vector<glm::vec2> out;
  const Cell start = next.begin()->first;
  Cell at = start, to = next[start][0];
  const Cell first_to = to;
  do {
    out.emplace_back(at.first, at.second);
    const int dx = to.first - at.first, dy = to.second - at.second;
    const Cell left{to.first - dy, to.second + dx};
    const std::vector<Cell>& ways = next[to];
    at = to;
    to = std::find(ways.begin(), ways.end(), left) != ways.end() ? left : ways[0];
  } while (at != start || to != first_to);
  return out.size() == n_edges ? out : std::vector<glm::vec2>{};
}

TEST(Triangulate, OutlinesOfPolyominoes) {
  int n_outlines = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const std::set<Cell> cells = grow_cells(random, 2 + random.below(40));
    std::vector<glm::vec2> points = outline_of(cells);
    if (points.empty()) continue;
    ++n_outlines;
    points = rotated(points, random.below(static_cast<std::uint32_t>(points.size())));
    Polygon polygon;  // sheared: no two edges along an axis, and every coordinate exact
    for (const glm::vec2& p : points)
      polygon.emplace_back(3 * p.x - p.y, p.x + 5 * p.y, 2 * p.x - p.y);
    expect_covered(polygon, 16 * static_cast<double>(cells.size()), points.size());
    expect_covered(in_plane(points), static_cast<double>(cells.size()), points.size());
  }
  EXPECT_GT(n_outlines, 200);
}

// A ring of spikes around the origin: as many corners as asked for, radii at random.
TEST(Triangulate, RandomStars) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const std::uint32_t n = 4 + random.below(200);
    Polygon polygon;
    double area = 0;
    for (std::uint32_t k = 0; k < n; ++k) {
      const double a = 2 * std::acos(-1.0) * k / n, r = random.uniform(0.1, 1);
      polygon.emplace_back(r * std::cos(a), r * std::sin(a), 0.2 * r);
    }
    for (std::uint32_t k = 0; k < n; ++k) {
      const glm::dvec3 p(polygon[k]), q(polygon[(k + 1) % n]);
      area += (p.x * q.y - p.y * q.x) / 2;
    }
    expect_covered(polygon, area, n);
  }
}

// ---- a million corners ----

TEST(Triangulate, AMillionCornersOfAComb) {
  constexpr int kTeeth = 250'000;  // 1 wide each, 100 long
  std::vector<glm::vec2> points;
  for (int k = 0; k < kTeeth; ++k) {
    const auto x = static_cast<float>(2 * k);
    points.insert(points.end(), {{x, 0}, {x, -100}, {x + 1, -100}, {x + 1, 0}});
  }
  points.emplace_back(2 * kTeeth, 0);
  points.emplace_back(2 * kTeeth, 1);
  points.emplace_back(0, 1);
  for (glm::vec2& p : points) p = {p.y, -p.x};  // every tooth is open at once
  expect_covered(in_plane(points), 100.0 * kTeeth + 2 * kTeeth, points.size());
}

TEST(Triangulate, ALongSpiral) {
  constexpr std::uint32_t kSide = 100'000;
  Polygon polygon(2 * kSide);
  for (std::uint32_t k = 0; k < kSide; ++k) {
    const double a = 0.01 * k, r = 10 + a;
    for (const double more : {0.0, 2.0}) {
      const glm::dvec3 p(std::cos(a), std::sin(a), 0);
      polygon[more > 0 ? k : 2 * kSide - 1 - k] = glm::vec3((r + more) * p);
    }
  }
  std::vector<Triangle> triangles;
  EXPECT_EQ(triangulate_polygon(polygon, triangles), PolygonCut::sweep);
  EXPECT_EQ(cover_of(polygon, triangles).corners.size(), polygon.size());
}

// ---- what no triangulation is right for ----

TEST(Triangulate, CrossedAndDegenerateOnesAreFansAndSaidToBe) {
  const Polygon degenerate[] = {
      in_plane({{0, 0}, {1, 1}, {1, 0}, {0, 1}}),          // as much to the left as to the right
      in_plane({{0, 0}, {3, 3}, {3, 0}, {0, 1}}),          // not as much
      in_plane({{0, 0}, {1, 0}, {2, 0}, {3, 0}}),          // a line
      in_plane({{0, 0}, {1, 0}, {0, 0}, {1, 0}}),          // there and back
      in_plane({{1, 1}, {1, 1}, {1, 1}, {1, 1}, {1, 1}}),  // a point
      in_plane({{0, 4}, {-2, -3}, {4, 1}, {-4, 1}, {2, -3}})};  // a pentagram
  for (const Polygon& polygon : degenerate) {
    std::vector<Triangle> triangles{{7, 7, 7}};
    EXPECT_EQ(triangulate_polygon(polygon, triangles), PolygonCut::crossed) << polygon.size();
    triangles.erase(triangles.begin());
    EXPECT_EQ(triangles, fan_of(static_cast<std::uint32_t>(polygon.size())));
  }
}

TEST(Triangulate, RandomPointsNeverCrash) {
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const std::uint32_t n = 3 + random.below(30), range = 2 + random.below(6);
    Polygon polygon;
    for (std::uint32_t k = 0; k < n; ++k)
      polygon.emplace_back(random.below(range), random.below(range), random.below(2));
    std::vector<Triangle> triangles;
    const PolygonCut cut = triangulate_polygon(polygon, triangles);
    for (const Triangle& t : triangles)
      for (const std::uint32_t corner : t) EXPECT_LT(corner, n);
    if (cut != PolygonCut::sweep) {
      EXPECT_EQ(triangles, fan_of(n));
    }
  }
}

}  // namespace
}  // namespace viewcell
