// Pieces that vanish whole.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "common/temporary_folder.h"
#include "pm/build.h"
#include "pm/measure.h"
#include "pm/pm_file.h"
#include "pm/shapes.h"
#include "pm/ways.h"

namespace viewcell {
namespace {

void add(TriMesh& mesh, TriMesh piece, const glm::vec3& at, float scale = 1) {
  const auto n = static_cast<std::uint32_t>(mesh.positions.size());
  for (const glm::vec3& p : piece.positions) mesh.positions.push_back(at + scale * p);
  for (const Triangle& t : piece.triangles)
    mesh.triangles.push_back({n + t[0], n + t[1], n + t[2]});
}

void add_slanted_texture(TriMesh& mesh) {
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) {
      const glm::vec3& p = mesh.positions[v];
      mesh.texcoords.emplace_back(0.03f * p.x + 0.007f * p.z, 0.03f * p.y + 0.011f * p.z);
    }
}

constexpr std::size_t kLamps = 12;

// A room of 20 units a side, 192 triangles, with small lamps of 32 triangles in it.
TriMesh make_room(std::uint64_t seed = 1) {
  Random random(seed);
  TriMesh mesh;
  add(mesh, make_fine_cube(4), {0, 0, 0}, 5);
  const auto place = [&] { return static_cast<float>(random.uniform(1, 19)); };
  for (std::size_t i = 0; i < kLamps; ++i)
    add(mesh, make_noisy_sphere(1, 0.2, seed + i), {place(), place(), place()}, 0.05f);
  add_slanted_texture(mesh);
  return mesh;
}

std::size_t count_pieces(const TriMesh& mesh) {
  return connect_charts(mesh.triangles, mesh.positions.size(), ChartLink::corner).size();
}

Box box_of(const TriMesh& mesh) {
  Box box;
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) box.add(mesh.positions[v]);
  return box;
}

// Pieces are there whole or not at all, and those that are not are counted.
TEST(Vanish, LampsGoBeforeTheRoom) {
  const TriMesh room = make_room();
  for (const Way& way : kWays)
    for (const Measure measure : {Measure::max, Measure::mean}) {
      if (measure == Measure::mean && way.metric != MetricKind::mapping) continue;
      SCOPED_TRACE(testing::Message() << metric_name(way.metric) << placement_name(way.placement));
      BuildOptions options = options_of(way);
      options.measure = measure;
      const BuildResult built = build_progressive_mesh(room, options);
      EXPECT_EQ(built.counts.n_vanished, kLamps);
      EXPECT_EQ(check_record(built.record), "");
      ProgressiveMesh pm(built.record);
      EXPECT_EQ(pm.n_vanished(), kLamps);
      EXPECT_EQ(count_vanishing_pieces(built.record), kLamps);
      EXPECT_GE(pm.n_faces(), 4u);
      pm.set_faces(15);  // the room is a box of 12
      EXPECT_EQ(pm.n_vanished(), kLamps);
      const Box box = box_of(pm.extract());
      EXPECT_GE(glm::length(box.size()), 0.9 * glm::length(glm::dvec3(20)));
      for (;; pm.refine()) {
        ASSERT_EQ(count_pieces(pm.extract()) + pm.n_vanished(), kLamps + 1) << pm.level();
        if (pm.level() == pm.n_splits()) break;
      }
      EXPECT_EQ(pm.extract().positions, room.positions);
      EXPECT_EQ(pm.extract().triangles, room.triangles);
    }
}

TEST(Vanish, PiecesMayBeKept) {
  const TriMesh room = make_room();
  for (const Way& way : kWays) {
    SCOPED_TRACE(testing::Message() << metric_name(way.metric) << placement_name(way.placement));
    BuildOptions options = options_of(way);
    options.keep_pieces = true;
    const BuildResult built = build_progressive_mesh(room, options);
    EXPECT_EQ(built.counts.n_vanished, 0u);
    EXPECT_EQ(count_pieces(ProgressiveMesh(built.record).extract()), kLamps + 1);
  }
}

// A square stays for its border; the octahedra beside it have none.
TEST(Vanish, LockedPiecesStay) {
  TriMesh mesh = make_noisy_sphere(2, 0.1, 1);
  add(mesh, make_octahedron(), {3, 0, 0}, 0.1f);
  add(mesh, make_flat_grid(1), {0, 3, 0}, 0.01f);
  BuildOptions options;
  EXPECT_EQ(build_progressive_mesh(mesh, options).counts.n_vanished, 2u);
  options.lock_borders = true;
  const BuildResult built = build_progressive_mesh(mesh, options);
  EXPECT_EQ(built.counts.n_vanished, 1u);
  const TriMesh base = ProgressiveMesh(built.record).extract();
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NE(std::find(base.positions.begin(), base.positions.end(),
                        mesh.positions[mesh.positions.size() - 1 - i]),
              base.positions.end());
}

// Of the lamps some are beside a wall.
TEST(Vanish, BoundsHold) {
  TriMesh room = make_room(2);
  room.texcoords.clear();
  for (int i = 0; i < 6; ++i) add(room, make_octahedron(), {0.2f, 3.0f * i + 1, 7}, 0.05f);
  add_slanted_texture(room);
  for (const Way& way : kWays) {
    SCOPED_TRACE(testing::Message() << metric_name(way.metric) << placement_name(way.placement));
    BuildOptions options = options_of(way);
    options.track_error = true;
    ProgressiveMesh pm(build_progressive_mesh(room, options).record);
    for (std::size_t level = 0; level <= pm.n_splits(); level += 1 + pm.n_splits() / 40) {
      pm.set_level(level);
      ASSERT_GE(pm.error(), 0) << level;
      ASSERT_LE(measure_farthest(room, pm.extract()), pm.error() * (1 + 1e-6)) << level;
    }
    options.error_bound = 0.5f;
    const BuildResult bounded = build_progressive_mesh(room, options);
    EXPECT_EQ(bounded.counts.n_vanished, 6u);
    EXPECT_LE(ProgressiveMesh(bounded.record).error(), 0.5f);
    EXPECT_LE(measure_farthest(room, ProgressiveMesh(bounded.record).extract()), 0.5);
  }
}

// Costs of these metrics are distances, also where pieces vanish.
TEST(Vanish, CostsThatAreBoundsHold) {
  const TriMesh room = make_room(3);
  for (const Way& way : kWays) {
    if (way.metric != MetricKind::aps && way.metric != MetricKind::mapping) continue;
    SCOPED_TRACE(testing::Message() << metric_name(way.metric) << placement_name(way.placement));
    BuildOptions options = options_of(way);
    for (const float most : {0.3f, 5.0f}) {
      options.max_cost = most;
      const BuildResult built = build_progressive_mesh(room, options);
      const double measured = measure_farthest(room, ProgressiveMesh(built.record).extract());
      EXPECT_LE(built.counts.last_cost, most);
      EXPECT_LE(measured, built.counts.last_cost * (1 + 1e-6));
      EXPECT_EQ(built.counts.n_vanished > 0, most > 1);
    }
  }
}

TEST(Vanish, AFarSpeckGoesEarly) {
  for (const Way& way : {kWays[0], kWays[1], kWays[2], kWays[7]}) {
    TriMesh scan = make_noisy_sphere(4, 0.05, 1);
    add(scan, make_octahedron(), {100, 0, 0}, 0.002f);
    ProgressiveMesh pm(build_progressive_mesh(scan, options_of(way)).record);
    pm.set_faces(scan.triangles.size() / 2);
    EXPECT_EQ(pm.n_vanished(), 1u) << metric_name(way.metric) << placement_name(way.placement);
  }
}

// Triangles of every size, each alone; and as two-sided cards.
TEST(Vanish, LooseTrianglesTakeTimeInProportion) {
  for (const bool has_two_sides : {false, true}) {
    Random random(7);
    TriMesh soup;
    constexpr std::uint32_t kTriangles = 10000;
    const auto number = [&](double most) { return static_cast<float>(random.uniform(0, most)); };
    for (std::uint32_t i = 0; i < kTriangles; ++i) {
      const glm::vec3 at(number(100), number(100), number(100));
      const float size = 0.1f + number(1);
      soup.positions.insert(soup.positions.end(), {at, at + size * glm::vec3(1, number(1), 0),
                                                   at + size * glm::vec3(0, 1, number(1))});
      soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
      if (has_two_sides) soup.triangles.push_back({3 * i, 3 * i + 2, 3 * i + 1});
    }
    BuildOptions options;
    options.track_error = true;
    const BuildResult built = build_progressive_mesh(soup, options);
    EXPECT_EQ(built.counts.n_vanished, kTriangles - 1);
    EXPECT_LT(built.counts.n_visited, 100u * kTriangles);
    ProgressiveMesh pm(built.record);
    EXPECT_EQ(pm.n_faces(), has_two_sides ? 2u : 1u);
    pm.set_faces(1000);
    EXPECT_EQ(pm.n_faces(), 1000u);
    EXPECT_LE(measure_farthest(soup, pm.extract()), pm.error());
    EXPECT_LT(pm.error(), 60);
  }
}

// The last vertex of a hub's triangles and of links with other hubs.
TEST(Vanish, PiecesWithHubs) {
  TriMesh mesh = make_noisy_sphere(3, 0.1, 1);
  TriMesh cones;  // two tips over one rim
  constexpr std::uint32_t kRim = 400;
  cones.positions = {{0, 0, 1}, {0, 0, -1}};
  for (std::uint32_t i = 0; i < kRim; ++i) {
    const float angle = 6.2831853f * static_cast<float>(i) / kRim;
    cones.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
    const std::uint32_t a = 2 + i, b = 2 + (i + 1) % kRim;
    cones.triangles.push_back({0, a, b});
    cones.triangles.push_back({1, b, a});
  }
  add(mesh, cones, {5, 0, 0}, 0.05f);
  std::vector<std::uint32_t> faces;
  const auto n_sphere = static_cast<std::uint32_t>(mesh.triangles.size() - 2 * kRim);
  for (std::uint32_t f = n_sphere; f < mesh.triangles.size(); ++f) faces.push_back(f);
  CollapseMesh work(mesh.positions, mesh.triangles);
  CollapseTrace trace;
  work.remove(faces, trace);
  EXPECT_EQ(trace.died, faces);
  EXPECT_EQ(work.n_triangles(), n_sphere);
  EXPECT_EQ(work.n_sheet_triangles(), n_sphere);
  EXPECT_EQ(work.triangles(), make_noisy_sphere(3, 0.1, 1).triangles);
  EXPECT_FALSE(work.has_triangles(mesh.triangles.back()[0]));
  EXPECT_FALSE(work.lists().has_hubs());
  EXPECT_FALSE(work.hub_links().has_hubs());
  BuildOptions options;
  options.min_cosine = 0.999f;  // the tips are hubs to the end
  const BuildResult built = build_progressive_mesh(mesh, options);
  EXPECT_EQ(built.counts.n_vanished, 1u);
  EXPECT_EQ(check_record(built.record), "");
}

TEST(Vanish, FilesReadBack) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.pm";
  const auto has = [&](const std::string& words) {
    std::ifstream in(file, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(in), {});
    return bytes.find(words) != std::string::npos;
  };
  for (const Way& way : kWays) {
    const ProgressiveRecord record = build_progressive_mesh(make_room(), options_of(way)).record;
    write_pm(file, record);
    EXPECT_TRUE(has("\"version\":2"));
    ProgressiveMesh a(record), b(read_pm(file));
    for (const std::size_t n : {1u, 50u, 200u, 400u, 1000u}) {
      a.set_faces(n), b.set_faces(n);
      EXPECT_EQ(a.n_vanished(), b.n_vanished());
      EXPECT_EQ(a.extract().positions, b.extract().positions);
      EXPECT_EQ(a.extract().triangles, b.extract().triangles);
      EXPECT_EQ(a.extract().texcoords, b.extract().texcoords);
    }
  }
  write_pm(file, build_progressive_mesh(make_noisy_sphere(2, 0.1, 1), {}).record);
  EXPECT_TRUE(has("\"version\":1"));
}

// An octahedron and a triangle that vanishes first: split n - 1.
TEST(Vanish, HostileRecordsAreRefused) {
  TriMesh mesh = make_octahedron();
  mesh.positions.insert(mesh.positions.end(), {{3, 0, 0}, {3.1f, 0, 0}, {3, 0.1f, 0}});
  mesh.triangles.push_back({6, 7, 8});
  const ProgressiveRecord whole = build_progressive_mesh(mesh, {}).record;
  ASSERT_EQ(check_record(whole), "");
  const auto found = std::find_if(whole.splits.begin(), whole.splits.end(),
                                  [](const VertexSplit& split) { return split.is_piece(); });
  ASSERT_NE(found, whole.splits.end());
  const auto at = static_cast<std::size_t>(found - whole.splits.begin());
  const auto check = [&](auto&& change) {
    ProgressiveRecord wrong = whole;
    change(wrong, wrong.splits[at]);
    const std::string said = check_record(wrong), begin = "split " + std::to_string(at) + " ";
    return said.starts_with(begin) ? said.substr(begin.size()) : said;
  };
  EXPECT_EQ(check([](auto&, VertexSplit& s) { s.child = s.parent = 0; }),
            "has a child that is there already");
  EXPECT_EQ(check([](auto&, VertexSplit& s) { s.child = s.parent = 9; }),
            "names a vertex out of range");
  const std::string joins = "brings a piece that joins what is there, or a face without an area";
  EXPECT_EQ(check([](auto& r, VertexSplit&) { r.faces[8] = {6, 7, 0}; }), joins);
  EXPECT_EQ(check([](auto& r, VertexSplit&) {
              r.faces[8] = {6, 7, 7};
            }),
            "a face has two corners at one vertex");
  EXPECT_EQ(check([](auto& r, VertexSplit& s) {
              s.n_pairs = 1;
              r.pairs.push_back({6, 6});
            }),
            "brings a piece and moves others");
  EXPECT_EQ(check([&](auto& r, VertexSplit&) {
              const auto here = r.splits.begin() + static_cast<std::ptrdiff_t>(at);
              r.splits.insert(here, {8, 8, 0, 0, 0, 0, -1});
            }),
            "brings a piece without its vertex");
}

// A number changed anywhere is refused, or makes a record whose splits can still be made.
TEST(Vanish, WrongNumbersAreRefusedOrHarmless) {
  const ProgressiveRecord whole = build_progressive_mesh(make_room(4), {}).record;
  std::vector<std::size_t> pieces;
  for (std::size_t i = 0; i < whole.splits.size(); ++i)
    if (whole.splits[i].is_piece()) pieces.push_back(i);
  Random random(5);
  int n_refused = 0;
  for (int i = 0; i < 300; ++i) {
    ProgressiveRecord r = whole;
    const std::size_t at = pieces[random.below(kLamps)];
    VertexSplit &split = r.splits[at], &other = r.splits[at > 0 ? at - 1 : 1];
    const std::uint32_t wrong = random.below(3) ? random.below(900) : 0xffffffffu;
    const auto n_born = static_cast<std::uint32_t>(r.born.size());
    switch (random.below(6)) {
      case 0:
        split.child = split.parent = wrong;
        break;
      case 1:
        split.child = wrong;
        break;
      case 2:
        ++split.n_born, --other.n_born;
        break;
      case 3:
        std::swap(r.born[random.below(n_born)], r.born[random.below(n_born)]);
        break;
      case 4:
        r.faces[r.born[random.below(n_born)]][random.below(3)] = wrong;
        break;
      case 5:
        std::swap(split, r.splits[random.below(static_cast<std::uint32_t>(r.splits.size()))]);
        break;
    }
    n_refused += is_refused(r);
  }
  EXPECT_GT(n_refused, 200);
}

// A figure whose charts hold every collapse back, on a large plate: it does not go at one blow.
TEST(Vanish, WhatIsStuckStays) {
  TriMesh mesh;
  add(mesh, make_noisy_sphere(3, 0.1, 4), {0, 0, 0});
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) mesh.texcoords.emplace_back(3 * t + (k == 1), k == 2);
  add(mesh, make_flat_grid(1), {-50, -50, -2}, 100);
  for (int c = 0; c < 6; ++c) mesh.texcoords.emplace_back(0.1f * c, 0.01f * c * c);
  for (const MetricKind metric : {MetricKind::qem3, MetricKind::qem5}) {
    BuildOptions options;
    options.metric = metric;
    const BuildResult built = build_progressive_mesh(mesh, options);
    EXPECT_EQ(built.counts.n_vanished, 0u);
    EXPECT_GE(ProgressiveMesh(built.record).n_faces(), 512u);
  }
}

}  // namespace
}  // namespace viewcell
