#include "mesh/charts.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace viewcell {
namespace {

constexpr std::uint32_t kNo = kNoTextureVertex;

//  0     3---5     Triangles 0 and 1 are a bow tie: they touch in 2. Triangle 2 shares the edge
//  | \ / |  /      3 4 with 1. Two more have no texture, and would lead from 0 to 1 across edges.
//  |  2  | /
//  | / \ |/
//  1     4
const std::vector<Triangle> kBowTie{{0, 1, 2}, {2, 3, 4}, {4, 3, 5}, {kNo, 1, 2}, {kNo, 2, 3}};

TEST(ConnectCharts, WaistsAreNoEdges) {
  const Charts charts = connect_charts(kBowTie, 6, ChartLink::edge);
  EXPECT_EQ(charts.of, (std::vector<std::uint32_t>{0, 1, 1, kNoChart, kNoChart}));
  EXPECT_EQ(charts.first, (std::vector<std::uint32_t>{0, 1}));
}

TEST(ConnectCharts, WaistsJoinCorners) {
  const Charts joined = connect_charts(kBowTie, 6, ChartLink::corner);
  EXPECT_EQ(joined.of, (std::vector<std::uint32_t>{0, 0, 0, kNoChart, kNoChart}));
  EXPECT_EQ(joined.first, (std::vector<std::uint32_t>{0}));
}

bool share(const Triangle& s, const Triangle& t, int n_wanted) {
  int n = 0;
  for (const std::uint32_t v : s) n += v == t[0] || v == t[1] || v == t[2];
  return n >= n_wanted;
}

// Whatever the triangles: those that share what the link asks for are of one chart; a chart is no
// larger than what such steps lead to; and numbers follow the lowest triangles.
TEST(ConnectCharts, AreClosedUnderTheirLink) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const std::uint32_t n = 6 + random.below(40);
    std::vector<Triangle> triangles;
    while (triangles.size() < 25) {
      const Triangle t{random.below(n), random.below(n), random.below(n)};
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
    }
    for (const auto& [link, n_shared] : {std::pair{ChartLink::edge, 2}, {ChartLink::corner, 1}}) {
      std::vector<std::uint32_t> wanted(triangles.size(), kNoChart);
      std::uint32_t n_charts = 0;
      for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        if (wanted[t] != kNoChart) continue;
        std::vector<std::uint32_t> open{t};
        wanted[t] = n_charts;
        while (!open.empty()) {
          const std::uint32_t from = open.back();
          open.pop_back();
          for (std::uint32_t to = 0; to < triangles.size(); ++to)
            if (wanted[to] == kNoChart && share(triangles[from], triangles[to], n_shared))
              wanted[to] = n_charts, open.push_back(to);
        }
        ++n_charts;
      }
      const Charts charts = connect_charts(triangles, n, link);
      ASSERT_EQ(charts.of, wanted);
      ASSERT_EQ(charts.size(), n_charts);
    }
  }
}

}  // namespace
}  // namespace viewcell
