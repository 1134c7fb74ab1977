#include "adapt/adapt_file.h"

#include <gtest/gtest.h>

#include <cmath>

#include "adapt/texture_adapt.h"
#include "common/expect_input_error.h"
#include "common/temporary_folder.h"
#include "pm/build.h"
#include "pm/pm_file.h"
#include "pm/shapes.h"

namespace viewcell {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

ProgressiveRecord make_replay_record(std::uint64_t seed, Placement placement) {
  BuildOptions options;
  options.metric = MetricKind::mapping;
  options.placement = placement;
  TriMesh mesh = make_relief(seed);
  for (glm::vec2& uv : mesh.texcoords) uv = uv / 9.0f + 0.1f;
  return build_progressive_mesh(mesh, options).record;
}

// Down to the base and up again; every texel stays a number.
void adapt_all(const ProgressiveRecord& record, const AdaptationLog& log) {
  ProgressiveMesh mesh(record);
  mesh.set_level(mesh.n_splits());
  TextureAdapter<glm::vec2> adapter(log, make_index_map<glm::vec2>(48, 32),
                                    make_level_charts(mesh, log), 0, {.n_threads = 1});
  for (const std::size_t n : {log.n_collapses(), std::size_t{0}}) {
    adapter.go_to(n);
    for (const glm::vec2& uv : adapter.image().pixels)
      ASSERT_TRUE(std::isfinite(uv.x) && std::isfinite(uv.y));
  }
}

template <typename T>
T& pick(std::vector<T>& values, Random& random) {
  return values[random.below(static_cast<std::uint32_t>(values.size()))];
}

float any_number(Random& random) {
  constexpr float kNumbers[] = {0, -1, 2, 50, -9000, 1e5f, 1e30f, 3e38f, INFINITY, NAN};
  return kNumbers[random.below(10)];
}

TEST(AdaptFile, ReadsBack) {
  const TemporaryFolder folder;
  for (const Placement placement : {Placement::half, Placement::full}) {
    const ProgressiveRecord record = make_replay_record(1, placement);
    const AdaptationLog log = make_adaptation_log(record);
    write_adapt(folder.path() / "a.adapt", log, record);
    const AdaptationLog read = read_adapt(folder.path() / "a.adapt", record);
    EXPECT_EQ(read.first_point, log.first_point);
    EXPECT_EQ(read.first_triangle, log.first_triangle);
    EXPECT_EQ(read.charts, log.charts);
    EXPECT_EQ(read.steps_per_collapse, log.steps_per_collapse);
    ASSERT_EQ(read.points.size(), log.points.size());
    for (std::size_t i = 0; i < log.points.size(); ++i)
      EXPECT_EQ(read.points[i].after, log.points[i].after);
  }
}

TEST(AdaptFile, PointsBeyondReachAreRefused) {
  const TemporaryFolder folder;
  const ProgressiveRecord record = make_replay_record(2, Placement::half);
  const AdaptationLog log = make_adaptation_log(record);
  for (const float far : {1.1e4f, -1e30f, 3e38f, INFINITY, -INFINITY, NAN})
    for (const auto place : {&AdaptationPoint::before, &AdaptationPoint::after})
      for (const int k : {0, 1}) {
        AdaptationLog wrong = log;
        (wrong.points.back().*place)[k] = far;
        write_adapt(folder.path() / "a.adapt", wrong, record);
        EXPECT_INPUT_ERROR(read_adapt(folder.path() / "a.adapt", record), "far outside");
      }
}

// Cells that reach far out of the texture take room for what of them lies in it.
TEST(AdaptFile, FarPointsTakeNoRoom) {
  const ProgressiveRecord record = make_replay_record(6, Placement::half);
  AdaptationLog log = make_adaptation_log(record);
  for (std::size_t i = 0; i < log.points.size(); i += 5) log.points[i].after = {-9000, 9000};
  adapt_all(record, log);
}

// A log that is read can be followed, whatever it holds.
TEST(AdaptFile, WrongNumbersAreRefusedOrHarmless) {
  const TemporaryFolder folder;
  const ProgressiveRecord record = make_replay_record(3, Placement::full);
  const AdaptationLog whole = make_adaptation_log(record);
  Random random(4);
  int n_refused = 0;
  constexpr int kTimes = 200;
  for (int i = 0; i < kTimes; ++i) {
    SCOPED_TRACE(i);
    AdaptationLog log = whole;
    const std::uint32_t wrong = random.below(3) ? random.below(100) : kNone;
    switch (random.below(6)) {
      case 0:
        pick(log.points, random).before[0] = any_number(random);
        break;
      case 1:
        pick(log.points, random).after[1] = any_number(random);
        break;
      case 2:
        pick(log.triangles, random).corners[1] = static_cast<std::uint16_t>(wrong);
        break;
      case 3:
        pick(log.triangles, random).chart = wrong;
        break;
      case 4:
        pick(log.triangles, random).flags = static_cast<std::uint16_t>(wrong);
        break;
      case 5:
        pick(random.below(2) ? log.first_point : log.first_triangle, random) = wrong;
        break;
    }
    write_adapt(folder.path() / "a.adapt", log, record);
    try {
      log = read_adapt(folder.path() / "a.adapt", record);
    } catch (const InputError&) {
      ++n_refused;
      continue;
    }
    adapt_all(record, log);
  }
  EXPECT_GT(n_refused, kTimes / 4);
  EXPECT_LT(n_refused, kTimes * 3 / 4);
}

// What read_pm lets pass gives a log, and that can be followed: its collapses are of edges.
TEST(AdaptFile, LogsOfWrongRecordsAreRefusedOrHarmless) {
  const TemporaryFolder folder;
  int n_refused = 0;
  constexpr int kTimes = 400;
  for (int i = 0; i < kTimes; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    ProgressiveRecord r =
        make_replay_record(5, random.below(2) ? Placement::half : Placement::full);
    const std::uint32_t wrong = random.below(4) ? random.below(200) : kNone;
    switch (random.below(9)) {
      case 0:
        pick(r.splits, random).child = wrong;
        break;
      case 1:
        pick(r.splits, random).parent = wrong;
        break;
      case 2:
        pick(r.pairs, random).child = wrong;
        break;
      case 3:
        pick(r.pairs, random).parent = wrong;
        break;
      case 4:
        pick(r.faces, random)[random.below(3)] = wrong;
        break;
      case 5:
        pick(r.texcoords, random)[0] = any_number(random);
        break;
      case 6:
        pick(random.below(2) ? r.born : r.moved, random) = wrong;
        break;
      case 7:
        std::swap(pick(r.splits, random), pick(r.splits, random));
        break;
      case 8:
        if (r.is_full_edge())
          pick(r.parent_texcoords, random)[1] = any_number(random);
        else
          pick(r.vertex_of, random) = wrong;
        break;
    }
    write_pm(folder.path() / "a.pm", r);
    try {
      r = read_pm(folder.path() / "a.pm");
    } catch (const InputError&) {
      ++n_refused;
      continue;
    }
    adapt_all(r, make_adaptation_log(r));
  }
  EXPECT_GT(n_refused, kTimes / 4);
  EXPECT_LT(n_refused, kTimes);
}

}  // namespace
}  // namespace viewcell
