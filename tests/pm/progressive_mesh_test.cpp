#include "pm/progressive_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <span>

#include "adapt/adaptation.h"
#include "base/error.h"
#include "common/expect_input_error.h"
#include "common/temporary_folder.h"
#include "pm/build.h"
#include "pm/measure.h"
#include "pm/pm_file.h"
#include "pm/shapes.h"
#include "pm/ways.h"

namespace viewcell {
namespace {

// A noisy sphere cut into two charts at the plane x = 0, with every attribute.
TriMesh make_textured_sphere(std::uint64_t seed) {
  TriMesh mesh = make_noisy_sphere(3, 0.05, seed);
  mesh.normals = make_vertex_normals(mesh);
  mesh.material_names = {"left", "right"};
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    mesh.colors.emplace_back(static_cast<float>(v) / 1000);
  for (const Triangle& t : mesh.triangles) {
    float x = 0;
    for (const std::uint32_t v : t) x += mesh.positions[v].x;
    mesh.materials.push_back(x > 0);
    for (const std::uint32_t v : t) {
      const glm::vec3 p = glm::normalize(mesh.positions[v]);
      mesh.texcoords.emplace_back(0.25f + 0.2f * p.y + (x > 0 ? 0.5f : 0.0f), 0.5f + 0.4f * p.z);
    }
  }
  return mesh;
}

// The same, its vertices split where the charts meet, as glTF has it.
TriMesh split_at_charts(const TriMesh& mesh) {
  TriMesh out = mesh;
  std::map<std::pair<std::uint32_t, int>, std::uint32_t> copies;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::uint32_t& v : out.triangles[t]) {
      if (mesh.materials[t] == 0) continue;
      const auto next = static_cast<std::uint32_t>(out.positions.size());
      const auto [found, is_new] = copies.try_emplace({v, 1}, next);
      if (is_new) {
        out.positions.push_back(mesh.positions[v]);
        out.normals.push_back(mesh.normals[v]);
        out.colors.push_back(mesh.colors[v]);
      }
      v = found->second;
    }
  return out;
}

void expect_same(const TriMesh& a, const TriMesh& b) {
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.colors, b.colors);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.texcoords, b.texcoords);
  EXPECT_EQ(a.materials, b.materials);
  EXPECT_EQ(a.material_names, b.material_names);
}

TEST(ProgressiveMesh, FullyRefinedIsTheInput) {
  for (const Way& way : kWays)
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      SCOPED_TRACE(seed);
      const TriMesh whole = make_textured_sphere(seed);
      for (const TriMesh& mesh : {whole, split_at_charts(whole)}) {
        const BuildResult built = build_progressive_mesh(mesh, options_of(way));
        EXPECT_EQ(check_record(built.record), "");
        ProgressiveMesh pm(built.record);
        EXPECT_LT(pm.n_faces(), mesh.triangles.size() / 4);
        pm.set_level(pm.n_splits());
        expect_same(pm.extract(), mesh);
        EXPECT_EQ(pm.cost(), 0);
      }
    }
}

TEST(ProgressiveMesh, RefineThenCoarsenIsTheIdentity) {
  for (const Way& way : kWays) {
    const BuildResult built = build_progressive_mesh(make_textured_sphere(7), options_of(way));
    ProgressiveMesh pm(built.record);
    std::map<std::size_t, TriMesh> seen;
    Random random(3);
    for (int i = 0; i < 60; ++i) {
      pm.set_level(random.below(static_cast<std::uint32_t>(pm.n_splits() + 1)));
      const auto [found, is_new] = seen.try_emplace(pm.level(), pm.extract());
      if (!is_new) expect_same(pm.extract(), found->second);
    }
    ProgressiveMesh other(built.record);
    for (const auto& [level, mesh] : seen) {
      other.set_level(level);
      expect_same(other.extract(), mesh);
    }
  }
}

// At every level the faces of one chart are where they were, those of the other are moved.
TEST(ProgressiveMesh, ChartsMoveAtAllLevels) {
  const TriMesh mesh = make_textured_sphere(3);
  for (const Placement placement : {Placement::half, Placement::full}) {
    BuildOptions options;
    options.placement = placement;
    const ProgressiveRecord record = build_progressive_mesh(mesh, options).record;
    ProgressiveRecord moved = record;
    std::vector<glm::vec2> by;
    for (const std::int32_t material : mesh.materials) by.emplace_back(material ? 2 : 0, 0);
    move_texcoords(moved, by);
    ProgressiveMesh before(record), after(moved);
    for (const std::size_t level : {before.n_splits(), before.n_splits() / 2, std::size_t{0}}) {
      before.set_level(level), after.set_level(level);
      const TriMesh a = before.extract(), b = after.extract();
      ASSERT_EQ(a.triangles, b.triangles);
      for (std::size_t c = 0; c < a.texcoords.size(); ++c) {
        const float u = a.texcoords[c].x + (a.materials[c / 3] ? 2.0f : 0.0f);
        ASSERT_NEAR(b.texcoords[c].x, u, 1e-6) << c;
        ASSERT_EQ(b.texcoords[c].y, a.texcoords[c].y);
      }
    }
  }
}

TEST(ProgressiveMesh, EveryLevelIsAClosedManifoldOfGenusNought) {
  for (const Way& way : kWays) {
    const bool is_textured = texture_needs(options_of(way)).no_folds;
    ProgressiveMesh pm(
        build_progressive_mesh(is_textured ? make_textured_sphere(4) : make_noisy_sphere(3, 0.1, 4),
                               options_of(way))
            .record);
    for (;;) {
      const TriMesh mesh = pm.extract();
      ASSERT_EQ(mesh.triangles.size(), pm.n_faces());
      ASSERT_TRUE(is_closed_manifold(mesh.triangles)) << pm.level();
      ASSERT_EQ(euler_characteristic(mesh.triangles), 2);
      if (pm.level() == pm.n_splits()) break;
      pm.refine();
    }
  }
}

TEST(ProgressiveMesh, FacesAreAtMostWhatIsAskedFor) {
  ProgressiveMesh pm(build_progressive_mesh(make_noisy_sphere(4, 0.1, 5), {}).record);
  Random random(6);
  for (int i = 0; i < 50; ++i) {
    const std::size_t n = pm.n_base_faces() + random.below(2100);
    pm.set_faces(n);
    ASSERT_LE(pm.n_faces(), n);
    ASSERT_GE(pm.n_faces() + 1, std::min<std::size_t>(n, 2048));
  }
  pm.set_faces(1);
  EXPECT_EQ(pm.level(), 0u);
}

TEST(ProgressiveMesh, TheCoarsestLevelWithinADistance) {
  const TriMesh sphere = make_noisy_sphere(3, 0.1, 5);
  BuildOptions tracked;
  tracked.track_error = true;
  ProgressiveMesh pm(build_progressive_mesh(sphere, tracked).record);
  const float base = pm.error();
  ASSERT_GT(base, 0);
  Random random(7);
  for (int i = 0; i < 50; ++i) {
    const double most = base * random.below(1000) / 1000.0;
    ASSERT_TRUE(pm.set_error(most));
    ASSERT_LE(pm.error(), most);
    ASSERT_GT(pm.level(), 0u);
    pm.coarsen();
    ASSERT_GT(pm.error(), most);
  }
  EXPECT_TRUE(pm.set_error(base));
  EXPECT_EQ(pm.level(), 0u);
  ProgressiveMesh unknown(build_progressive_mesh(sphere, {}).record);
  unknown.set_level(3);
  EXPECT_FALSE(unknown.set_error(1e9));
  EXPECT_EQ(unknown.level(), 3u);
}

// Charts with straight boundaries stay tiled by their triangles while their corners are there.
//
//   +---+---+      each half of the grid is a chart; their common side is x = n / 2
//   | 0 | 1 |
//   +---+---+
TEST(ProgressiveMesh, ChartsKeepTheirArea) {
  TriMesh grid = make_flat_grid(12);
  Random random(8);
  for (glm::vec3& p : grid.positions) p.z = static_cast<float>(0.3 * random.uniform());
  for (const Triangle& t : grid.triangles) {
    float x = 0;
    for (const std::uint32_t v : t) x += grid.positions[v].x / 3;
    for (const std::uint32_t v : t)
      grid.texcoords.emplace_back(grid.positions[v].x + (x > 6 ? 10.0f : 0.0f),
                                  grid.positions[v].y);
  }
  const BuildResult built = build_progressive_mesh(grid, {});
  EXPECT_GT(built.counts.n_refused[static_cast<std::size_t>(Refusal::chart)], 0u);
  ProgressiveMesh pm(built.record);
  std::size_t n_levels = 0;
  for (std::size_t level = 0; level <= pm.n_splits(); ++level) {
    pm.set_level(level);
    std::vector<std::uint32_t> source;
    const TriMesh mesh = pm.extract(&source);
    const auto is_there = [&](std::uint32_t v) {
      return std::find(source.begin(), source.end(), v) != source.end();
    };
    const std::uint32_t corners[] = {0, 6, 12, 156, 162, 168};
    if (!std::all_of(std::begin(corners), std::end(corners), is_there)) continue;
    ++n_levels;
    double area[2] = {0, 0};
    for (std::size_t c = 0; c < mesh.texcoords.size(); c += 3) {
      const glm::dvec2 a = mesh.texcoords[c], b = mesh.texcoords[c + 1], d = mesh.texcoords[c + 2];
      area[a.x + b.x + d.x > 39] += 0.5 * ((b.x - a.x) * (d.y - a.y) - (b.y - a.y) * (d.x - a.x));
    }
    ASSERT_NEAR(area[0], 72, 1e-9) << level;
    ASSERT_NEAR(area[1], 72, 1e-9) << level;
  }
  EXPECT_GT(n_levels, pm.n_splits() / 2);
}

// Full-edge collapses too: the line between two charts of a flat grid stays where it is.
TEST(ProgressiveMesh, ChartBordersStayWhenBothEndsMove) {
  TriMesh grid = make_flat_grid(12);
  grid.material_names = {"left", "right"};
  for (const Triangle& t : grid.triangles) {
    float x = 0;
    for (const std::uint32_t v : t) x += grid.positions[v].x / 3;
    grid.materials.push_back(x > 6);
    for (const std::uint32_t v : t)
      grid.texcoords.emplace_back(grid.positions[v].x + (x > 6 ? 10.0f : 0.0f),
                                  grid.positions[v].y);
  }
  for (const Way& way : {kWays[1], kWays[2]}) {
    ProgressiveMesh pm(build_progressive_mesh(grid, options_of(way)).record);
    for (std::size_t n = 280; n >= 60; n -= 10) {
      pm.set_faces(n);
      const TriMesh mesh = pm.extract();
      double left = 0;
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (mesh.materials[t] == 0) left += area_normal(mesh, mesh.triangles[t]).z / 2;
        for (std::size_t c = 3 * t; c < 3 * t + 3; ++c)
          EXPECT_EQ(mesh.texcoords[c].x > 9.5f, mesh.materials[t] == 1);
      }
      EXPECT_NEAR(left, 72, 1e-3) << n;
    }
  }
}

// Vertices that a file has split at chart borders collapse as one.
TEST(ProgressiveMesh, SplitVerticesAreWelded) {
  for (const Way& way : kWays) {
    const TriMesh whole = make_textured_sphere(16);
    const BuildResult a = build_progressive_mesh(whole, options_of(way));
    const BuildResult b = build_progressive_mesh(split_at_charts(whole), options_of(way));
    EXPECT_EQ(a.n_welded, 0u);
    EXPECT_GT(b.n_welded, 10u);
    ASSERT_EQ(a.record.splits.size(), b.record.splits.size());
    for (std::size_t i = 0; i < a.record.splits.size(); ++i)
      ASSERT_EQ(a.record.splits[i].cost, b.record.splits[i].cost);
    EXPECT_EQ(a.record.born, b.record.born);
  }
}

TEST(ProgressiveMesh, SizeDoesNotMatter) {
  for (const Way& way : std::span(kWays).first(3)) {
    const TriMesh mesh = make_noisy_sphere(3, 0.1, 9);
    const ProgressiveRecord record = build_progressive_mesh(mesh, options_of(way)).record;
    for (const float scale : {0x1p100f, 0x1p-100f}) {
      TriMesh scaled = mesh;
      for (glm::vec3& p : scaled.positions) p *= scale;
      const ProgressiveRecord other = build_progressive_mesh(scaled, options_of(way)).record;
      EXPECT_EQ(other.faces, record.faces);
      EXPECT_EQ(other.moved, record.moved);
      ASSERT_EQ(other.splits.size(), record.splits.size());
      for (std::size_t i = 0; i < record.splits.size(); ++i)
        ASSERT_EQ(other.splits[i].cost, scale * record.splits[i].cost);
    }
  }
}

double volume_of(const TriMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles)
    sum += glm::dot(glm::dvec3(mesh.positions[t[0]]),
                    glm::cross(glm::dvec3(mesh.positions[t[1]]), glm::dvec3(mesh.positions[t[2]])));
  return sum / 6;
}

TEST(ProgressiveMesh, LindstromTurkKeepsTheVolume) {
  const TriMesh sphere = make_noisy_sphere(4, 0.05, 10);
  ProgressiveMesh lt(build_progressive_mesh(sphere, options_of(kWays[2])).record);
  ProgressiveMesh half(build_progressive_mesh(sphere, options_of(kWays[0])).record);
  for (const std::size_t n : {1000u, 300u, 100u, 50u}) {
    lt.set_faces(n), half.set_faces(n);
    EXPECT_NEAR(volume_of(lt.extract()), volume_of(sphere), 1e-4 * volume_of(sphere)) << n;
    EXPECT_LT(volume_of(half.extract()), (1 - 1e-4) * volume_of(sphere)) << n;
  }
}

// Places are least somewhere far away where a surface is nearly flat or nearly balanced; they are
// not gone to.
TEST(ProgressiveMesh, NoVertexGoesAstray) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    const TriMesh mesh = seed % 2 ? make_relief(seed) : make_noisy_sphere(2, 0.5, seed);
    Box box;
    for (const glm::vec3& p : mesh.positions) box.add(p);
    BuildOptions options;
    options.placement = Placement::full;
    options.metric = seed % 4 < 2 ? MetricKind::lt : MetricKind::qem3;
    options.min_cosine = -1;
    const ProgressiveRecord record = build_progressive_mesh(mesh, options).record;
    const double slack = 0.5 * glm::length(box.size());
    for (const glm::vec3& p : record.attributes.positions) {
      const glm::dvec3 off = glm::max(box.lo - glm::dvec3(p), glm::dvec3(p) - box.hi);
      EXPECT_LT(std::max({off.x, off.y, off.z}), slack);
    }
  }
}

TEST(ProgressiveMesh, LazyCostsAreFewer) {
  const TriMesh sphere = make_noisy_sphere(4, 0.05, 11);
  for (const Way& way : std::span(kWays).first(3)) {
    BuildOptions lazy = options_of(way), exact = lazy;
    lazy.lazy = true, exact.lazy = false;
    lazy.target_faces = exact.target_faces = 200;
    const BuildResult a = build_progressive_mesh(sphere, lazy);
    const BuildResult b = build_progressive_mesh(sphere, exact);
    EXPECT_LT(a.counts.n_costs, b.counts.n_costs);
    EXPECT_LT(a.counts.last_cost, 1.2f * b.counts.last_cost);
  }
}

TEST(ProgressiveMesh, StopsAtACostOrACount) {
  const TriMesh sphere = make_noisy_sphere(4, 0.05, 12);
  BuildOptions options;
  options.target_faces = 500;
  const ProgressiveMesh at_count(build_progressive_mesh(sphere, options).record);
  EXPECT_LE(at_count.n_faces(), 500u);
  EXPECT_GE(at_count.n_faces(), 499u);
  options.target_faces = 0;
  options.max_cost = 0.01f;
  const BuildResult at_cost = build_progressive_mesh(sphere, options);
  for (const VertexSplit& split : at_cost.record.splits) EXPECT_LE(split.cost, 0.01f);
  EXPECT_GT(at_cost.record.splits.size(), 100u);
}

TEST(ProgressiveMesh, HalfEdgeLtIsRefused) {
  BuildOptions options;
  options.metric = MetricKind::lt;
  EXPECT_THROW(build_progressive_mesh(make_octahedron(), options), UsageError);
}

// A flat fan of triangles that share no vertices: its apex may go first.
TriMesh make_soup(std::uint32_t n) {
  TriMesh soup;
  for (std::uint32_t i = 0; i < n; ++i) {
    soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    soup.positions.emplace_back(0, 0, 0);
    for (const std::uint32_t k : {i, (i + 1) % n}) {
      const double angle = 6.283185307179586 * k / n;
      soup.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
    }
  }
  return soup;
}

// Its apex is as many wedges as triangles, and one byte tells 256 apart.
TEST(ProgressiveMesh, SoupsFanOfManyTriangles) {
  for (const std::uint32_t n : {255u, 256u, 257u, 300u})
    for (const Placement placement : {Placement::half, Placement::full}) {
      SCOPED_TRACE(n);
      const TriMesh soup = make_soup(n);
      BuildOptions options;
      options.placement = placement;
      const BuildResult built = build_progressive_mesh(soup, options);
      EXPECT_EQ(check_record(built.record), "");
      ProgressiveMesh pm(built.record);
      EXPECT_LT(pm.n_faces(), 10u);
      pm.set_level(pm.n_splits());
      EXPECT_EQ(pm.extract().triangles, soup.triangles);
    }
}

// On a strip of three faces, wedge w at vertex w:  1---3---4
//                                                 | / \ | /
// each of these splits is no collapse of an edge. 0-----2
TEST(ProgressiveMesh, SplitsThatAreNoCollapsesAreRefused) {
  TriMesh strip;
  strip.positions = {{0, 0, 0}, {0, 1, 0}, {2, 0, 0}, {1, 1, 0}, {3, 1, 0}};
  strip.triangles = {{0, 3, 1}, {0, 2, 3}, {2, 4, 3}};
  BuildOptions options;
  options.target_faces = 2;
  const ProgressiveRecord whole = build_progressive_mesh(strip, options).record;
  ASSERT_EQ(whole.splits.size(), 1u);
  ASSERT_EQ(check_record(whole), "");
  const auto check = [&](auto&& change) {
    ProgressiveRecord wrong = whole;
    change(wrong);
    return check_record(wrong);
  };
  const VertexSplit split = whole.splits[0];
  EXPECT_EQ(check([&](auto& r) { r.splits[0].child = split.parent; }),
            "split 0 has a child that is there already");
  EXPECT_EQ(check([&](auto& r) { std::swap(r.splits[0].child, r.splits[0].parent); }),
            "split 0 has a child that is there already");
  EXPECT_EQ(check([&](auto& r) { r.pairs.at(0).child = split.parent; }),
            "split 0 has a pair of wedges that are not the child's and the parent's");
  EXPECT_EQ(check([&](auto& r) { r.splits[0].parent = (split.parent + 1) % 5; }).substr(0, 7),
            "split 0");
  EXPECT_EQ(check([&](auto& r) {
              r.faces[r.born.at(0)] = {0, 2, 3};
              r.faces[r.born[0]][0] = split.child;
              r.faces[r.born[0]][1] = split.child;
            }),
            "a face has two corners at one vertex");
  EXPECT_EQ(check([&](auto& r) {
              for (std::uint32_t& w : r.faces[r.born.at(0)])
                for (std::uint32_t v = 0; w == split.parent; ++v)
                  if (v != split.parent && v != split.child &&
                      std::count(r.faces[r.born[0]].begin(), r.faces[r.born[0]].end(), v) == 0)
                    w = v;
            }),
            "split 0 brings a face that has not the edge");
  const auto add_wedge = [&](auto& r) {  // of the child, with texture coordinates
    r.extra_sources.push_back(split.child);
    r.texcoords.resize(6);
  };
  EXPECT_EQ(check(add_wedge), "");
  // A pair of wedges that meet at no face is harmless, but no collapse within charts.
  ProgressiveRecord torn = whole;
  add_wedge(torn);
  torn.pairs.at(0).child = 5;
  EXPECT_EQ(check_record(torn), "");
  EXPECT_NO_THROW(make_adaptation_log(torn));
  torn.texcoords[5] = {1, 1};
  EXPECT_THROW(make_adaptation_log(torn), InputError);
}

TEST(PmFile, ReadsBack) {
  const TemporaryFolder folder;
  for (const Way& way : kWays) {
    ProgressiveRecord record =
        build_progressive_mesh(make_textured_sphere(13), options_of(way)).record;
    record.made_by = R"({"tool":"test"})";
    write_pm(folder.path() / "a.pm", record);
    const ProgressiveRecord read = read_pm(folder.path() / "a.pm");
    EXPECT_EQ(read.made_by, record.made_by);
    ProgressiveMesh a(record), b(read);
    expect_same(a.extract(), b.extract());
    a.set_faces(200), b.set_faces(200);
    expect_same(a.extract(), b.extract());
    a.set_level(a.n_splits()), b.set_level(b.n_splits());
    expect_same(a.extract(), b.extract());
  }
}

// A number changed anywhere is refused, or makes a record whose splits can still be made.
TEST(PmFile, WrongNumbersAreRefusedOrHarmless) {
  const ProgressiveRecord whole =
      build_progressive_mesh(make_textured_sphere(14), options_of(kWays[1])).record;
  Random random(15);
  int n_refused = 0;
  for (int i = 0; i < 400; ++i) {
    ProgressiveRecord r = whole;
    const auto pick = [&](auto& values) -> auto& {
      return values[random.below(static_cast<std::uint32_t>(values.size()))];
    };
    const std::uint32_t wrong = random.below(3) ? random.below(1000) : 0xffffffffu;
    switch (random.below(8)) {
      case 0:
        pick(r.faces)[random.below(3)] = wrong;
        break;
      case 1:
        pick(r.splits).n_moved = wrong % 9;
        break;
      case 2:
        pick(r.splits).parent = wrong;
        break;
      case 3:
        pick(r.born) = wrong;
        break;
      case 4:
        pick(r.moved) = wrong;
        break;
      case 5:
        pick(r.moved_by) = static_cast<std::uint8_t>(wrong);
        break;
      case 6:
        pick(r.pairs).parent = wrong;
        break;
      case 7:
        pick(r.vertex_of) = wrong;
        break;
    }
    n_refused += is_refused(r);
  }
  EXPECT_GT(n_refused, 250);
}

}  // namespace
}  // namespace viewcell
