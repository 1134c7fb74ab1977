// Which edges, charts, originals and folds a log of adaptations knows of.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "adapt/adaptation_areas.h"
#include "pm/build.h"
#include "pm/shapes.h"

namespace viewcell {
namespace {

// ---- Borders of charts -------------------------------------------------------------------------

// A relief that a seam at x = 4 cuts in two charts, `apart` in the texture; or from y = 3 upwards
// only, so that it stays one chart with a dart.
TriMesh make_two_charts(std::uint64_t seed, const glm::vec2& apart, bool is_dart = false) {
  TriMesh mesh = make_relief(seed);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    float middle = 0;
    for (const std::uint32_t v : mesh.triangles[t]) middle += mesh.positions[v].x / 3;
    for (std::size_t k = 0; k < 3 && middle > 4; ++k)
      if (!is_dart || mesh.positions[mesh.triangles[t][k]].y > 3.5f)
        mesh.texcoords[3 * t + k] += apart;
  }
  return mesh;
}

// The length in the texture of the edges of some faces of a level that no other face has, by vertex
// and texture coordinates.
template <typename Is>
double border_length(const ProgressiveMesh& mesh, const Is& is_of_star) {
  const ProgressiveRecord& record = mesh.record();
  using End = std::tuple<std::uint32_t, float, float>;
  std::map<std::pair<End, End>, std::pair<int, bool>> edges;
  const std::size_t n = record.attributes.positions.size();
  const auto vertex = [&](std::uint32_t w) {
    return record.vertex_of[w < n ? w : record.extra_sources[w - n]];
  };
  const auto end = [&](std::uint32_t w) {
    return End(vertex(w), record.texcoords[w].x, record.texcoords[w].y);
  };
  for (std::size_t f = 0; f < record.faces.size(); ++f) {
    if (!mesh.has_face(f)) continue;
    const Triangle& t = record.faces[f];
    const bool is_in = is_of_star(vertex(t[0]), vertex(t[1]), vertex(t[2]));
    for (std::size_t k = 0; k < 3; ++k) {
      auto& [times, is_star] = edges[std::minmax(end(t[k]), end(t[(k + 1) % 3]))];
      ++times, is_star = is_star || is_in;
    }
  }
  double sum = 0;
  for (const auto& [ends, edge] : edges) {
    const auto& [a, b] = ends;
    if (edge.first == 1 && edge.second)
      sum += glm::distance(glm::vec2(std::get<1>(a), std::get<2>(a)),
                           glm::vec2(std::get<1>(b), std::get<2>(b)));
  }
  return sum;
}

// Whether an edge of a vertex is a seam that ends there: the vertex has one place in the texture on
// both sides of it, its neighbour has two.
bool is_torn(const ProgressiveMesh& mesh, std::uint32_t v) {
  const ProgressiveRecord& record = mesh.record();
  const std::size_t n = record.attributes.positions.size();
  const auto vertex = [&](std::uint32_t w) {
    return record.vertex_of[w < n ? w : record.extra_sources[w - n]];
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, glm::vec2> places;  // of (wedge, neighbour)
  bool torn = false;
  for (std::size_t f = 0; f < record.faces.size(); ++f)
    for (std::size_t k = 0; k < 3 && mesh.has_face(f); ++k) {
      const Triangle& t = record.faces[f];
      if (vertex(t[k]) != v) continue;
      for (const std::uint32_t w : {t[(k + 1) % 3], t[(k + 2) % 3]}) {
        const glm::vec2& place = record.texcoords[w];
        torn = torn || places.try_emplace({t[k], vertex(w)}, place).first->second != place;
      }
    }
  return torn;
}

double flagged_length(const Adaptation& adaptation, glm::vec2 AdaptationPoint::*place) {
  double sum = 0;
  for (const AdaptationTriangle& t : adaptation.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      if (t.is_border(k))
        sum += glm::distance(adaptation.points[t.corners[k]].*place,
                             adaptation.points[t.corners[(k + 1) % 3]].*place);
  return sum;
}

// The marked edges of a step make up the border that its star has: all of it, once, and no more.
// Where a seam ends in the vertex that goes nothing is adapted, but its faces move.
TEST(AdaptationLog, MarksTheBordersOfCharts) {
  for (const Placement placement : {Placement::half, Placement::full}) {
    std::size_t n_borders = 0, n_inside = 0, n_torn = 0;
    for (const glm::vec2 apart : {glm::vec2(3, 0), glm::vec2(0, 0.7f), glm::vec2(0, 0)})
      for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        SCOPED_TRACE(seed);
        const bool is_dart = seed > 4;
        BuildOptions options;
        options.metric = seed % 2 ? MetricKind::mapping : MetricKind::qem5;
        options.placement = placement;
        const BuildResult built =
            build_progressive_mesh(make_two_charts(seed, apart, is_dart), options);
        const AdaptationLog log = make_adaptation_log(built.record);
        EXPECT_EQ(log.n_charts, apart == glm::vec2(0) || is_dart ? 1u : 2u);
        ProgressiveMesh mesh(built.record), finest(built.record);
        mesh.set_level(mesh.n_splits()), finest.set_level(finest.n_splits());
        for (std::size_t i = 0; i < log.n_collapses(); ++i) {
          const VertexSplit& split = built.record.splits[mesh.level() - 1];
          const Adaptation first = log.of(i * log.steps_per_collapse);
          const Adaptation last = log.of((i + 1) * log.steps_per_collapse - 1);
          const auto has = [](std::uint32_t v) {
            return [v](auto a, auto b, auto c) { return a == v || b == v || c == v; };
          };
          const double before = border_length(mesh, has(split.child));
          const double original = original_area(mesh, finest, split.child);
          const bool is_child_torn = is_torn(mesh, split.child);
          mesh.coarsen();
          if (placement == Placement::half) {
            n_torn += is_child_torn;
            EXPECT_TRUE(first.triangles.empty() || !is_child_torn) << i;
            if (first.triangles.empty()) continue;
            EXPECT_LT(original_area(first), original + 1e-4) << i;
            EXPECT_NEAR(flagged_length(first, &AdaptationPoint::before), before, 1e-4) << i;
          } else {
            // Those that end with a move of the parent.
            if (is_child_torn || is_torn(mesh, split.parent)) continue;
            double star = 0;
            const ProgressiveRecord& record = mesh.record();
            const std::size_t n = record.attributes.positions.size();
            for (std::size_t f = 0; f < record.faces.size(); ++f) {
              if (!mesh.has_face(f)) continue;
              std::array<glm::vec2, 3> p;
              bool is_of_star = false;
              for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t w = record.faces[f][k];
                p[k] = record.texcoords[w];
                is_of_star =
                    is_of_star ||
                    record.vertex_of[w < n ? w : record.extra_sources[w - n]] == split.parent;
              }
              if (is_of_star) star += std::abs(area(p));
            }
            double covered = 0;
            for (const AdaptationTriangle& t : last.triangles)
              covered += area(last, t, &AdaptationPoint::after);
            if (last.triangles.empty() || std::abs(covered - star) > 1e-5) continue;
            EXPECT_NEAR(flagged_length(last, &AdaptationPoint::after),
                        border_length(mesh, has(split.parent)), 1e-4)
                << i;
          }
          ++(before > 0 ? n_borders : n_inside);
        }
      }
    EXPECT_GT(n_borders, 100u);
    EXPECT_GT(n_inside, 40u);
    EXPECT_TRUE(n_torn > 5 || placement == Placement::full) << n_torn;
  }
}

// Cells of a face are its chart's; a face is as in the finest mesh until a step adapts it.
TEST(AdaptationLog, KnowsChartsAndOriginals) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    BuildOptions options;
    options.metric = MetricKind::mapping;
    const BuildResult built = build_progressive_mesh(make_two_charts(seed, {9, 0}), options);
    const AdaptationLog log = make_adaptation_log(built.record);
    ProgressiveMesh mesh(built.record);
    const ProgressiveRecord& record = built.record;
    mesh.set_level(mesh.n_splits());
    const LevelCharts finest = make_level_charts(mesh, log);
    const std::uint32_t left = log.charts[0];
    std::size_t n_original = 0, n_other = 0;
    for (std::size_t i = 0; i < log.n_collapses(); ++i) {
      const LevelCharts level = make_level_charts(mesh, log);
      for (std::size_t f = 0; f < level.faces.size(); ++f)
        ASSERT_EQ(level.charts[f] == left, level.faces[f][0].x < 8.5f);
      for (const AdaptationTriangle& t : log.of(i).triangles) {
        std::array<glm::dvec2, 3> p;
        for (std::size_t k = 0; k < 3; ++k) p[k] = log.of(i).points[t.corners[k]].before;
        const glm::dvec2 middle = (p[0] + p[1] + p[2]) / 3.0;
        EXPECT_EQ(t.chart == left, middle.x < 8.5);
        if (!t.is_original()) {
          ++n_other;
          continue;
        }
        ++n_original;
        // Its face is one of the finest mesh's.
        const auto holds = [&](const std::array<glm::vec2, 3>& face) {
          const glm::dvec2 a = glm::dvec2(face[1]) - glm::dvec2(face[0]),
                           b = glm::dvec2(face[2]) - glm::dvec2(face[0]),
                           at = middle - glm::dvec2(face[0]);
          const double det = a.x * b.y - a.y * b.x;
          const double s = (at.x * b.y - at.y * b.x) / det, u = (a.x * at.y - a.y * at.x) / det;
          return std::min({s, u, 1 - s - u}) > -1e-6;
        };
        const auto is_finest = [&](const std::array<glm::vec2, 3>& face) {
          return std::find(finest.faces.begin(), finest.faces.end(), face) != finest.faces.end();
        };
        EXPECT_TRUE(std::any_of(level.faces.begin(), level.faces.end(), [&](const auto& face) {
          return holds(face) && is_finest(face);
        })) << i;
      }
      mesh.coarsen();
    }
    EXPECT_GT(n_original, 150u);
    EXPECT_GT(n_other, 150u);
    EXPECT_EQ(record.faces.size(), log.charts.size());
  }
}

// ---- Folds -------------------------------------------------------------------------------------

// What rounding of its corners to float may change the area of a cell by.
double rounding(const Adaptation& adaptation, const AdaptationTriangle& t,
                glm::vec2 AdaptationPoint::*place) {
  std::array<glm::vec2, 3> p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = adaptation.points[t.corners[k]].*place;
  return 0x1p-24 * std::max({1.0f, std::abs(p[0].x), std::abs(p[0].y)}) *
         (glm::distance(p[1], p[0]) + glm::distance(p[2], p[0]));
}

// Collapses that turn faces over in the texture adapt nothing, are counted, and leave nothing; what
// they move is no original any more.
TEST(AdaptationLog, FoldedStepsAreEmpty) {
  std::size_t n_folded = 0, n_unmapped = 0, n_moved = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    TriMesh mesh = make_relief(seed);
    for (glm::vec2& uv : mesh.texcoords) {  // wound up: borders bend, straight ones fold over
      const double turn = 0.35 * uv.y;
      uv = glm::vec2((uv.x + 4) * std::cos(turn), (uv.x + 4) * std::sin(turn));
    }
    BuildOptions options;
    options.metric = MetricKind::qem3;
    options.placement = seed % 2 ? Placement::half : Placement::full;
    if (seed % 4 > 1) options.qem.boundary_weight = 0;  // borders go inwards, which has no map
    const BuildResult built = build_progressive_mesh(mesh, options);
    const AdaptationLog log = make_adaptation_log(built.record);
    ProgressiveMesh level(built.record), finest(built.record);
    level.set_level(level.n_splits()), finest.set_level(finest.n_splits());
    std::size_t n = 0;
    for (std::size_t step = 0; step < log.n_steps(); ++step) {
      const Adaptation adaptation = log.of(step);
      n += adaptation.triangles.empty();
      EXPECT_EQ(adaptation.triangles.empty(), adaptation.points.empty()) << step;
      for (const AdaptationTriangle& t : adaptation.triangles) {
        const double b = area(adaptation, t, &AdaptationPoint::before);
        const double a = area(adaptation, t, &AdaptationPoint::after);
        const bool is_rounding =
            std::abs(b) < 2 * rounding(adaptation, t, &AdaptationPoint::before) ||
            std::abs(a) < 2 * rounding(adaptation, t, &AdaptationPoint::after);
        EXPECT_TRUE(is_rounding || a * b > 0) << step << ": " << b << " to " << a;
      }
      if (options.placement == Placement::full) continue;
      const std::uint32_t child = built.record.splits[level.level() - 1].child;
      EXPECT_LT(original_area(adaptation), original_area(level, finest, child) + 1e-4) << step;
      level.coarsen();
    }
    EXPECT_EQ(n, log.n_folded + log.n_unmapped);
    n_folded += log.n_folded, n_unmapped += log.n_unmapped, n_moved += log.n_moved;
  }
  EXPECT_GT(n_folded, 20u);
  EXPECT_GT(n_unmapped, 0u);
  EXPECT_GT(n_moved, 50u);
}

// The middle of a square collapses into a corner; in the texture the corner after the next lies
// beyond the diagonal by more than rounding, or by less.
//   3---2
//   |4\ |    4, the middle, goes to 0
//   0---1
TEST(AdaptationLog, FoldsAreMoreThanRounding) {
  TriMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5f, 0.4f, 0}};
  for (std::uint32_t i = 0; i < 4; ++i) mesh.triangles.push_back({4, i, (i + 1) % 4});
  mesh.texcoords.assign(12, glm::vec2(0));
  BuildOptions options;
  options.metric = MetricKind::qem3;
  options.target_faces = 2;
  std::uint32_t parent = 0;
  const auto log_of = [&](float beyond) {
    std::array<glm::vec2, 5> uv{{{0, 0}, {1, 0}, {1, 1}, {0.5f, 0.5f - beyond}, {0.6f, 0.3f}}};
    std::rotate(uv.begin(), uv.begin() + (4 - parent) % 4, uv.begin() + 4);
    for (std::size_t c = 0; c < 12; ++c) mesh.texcoords[c] = uv[mesh.triangles[c / 3][c % 3]];
    const BuildResult built = build_progressive_mesh(mesh, options);
    EXPECT_EQ(built.record.splits.size(), 1u);
    EXPECT_EQ(built.record.splits[0].child, 4u);
    parent = built.record.splits[0].parent;
    return make_adaptation_log(built.record);
  };
  log_of(-0.5f);  // which corner
  const std::uint32_t corner = parent;
  EXPECT_EQ(log_of(-0.2f).n_folded, 0u);
  EXPECT_EQ(log_of(0x1p-24f).n_folded, 0u);
  EXPECT_EQ(log_of(0x1p-20f).n_folded, 1u);
  EXPECT_EQ(log_of(0.1f).n_folded, 1u);
  EXPECT_EQ(parent, corner);
}

}  // namespace
}  // namespace viewcell
