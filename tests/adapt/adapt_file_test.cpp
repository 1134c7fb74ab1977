#include "adapt/adapt_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

#include "base/file.h"
#include "base/json.h"
#include "base/section_file.h"
#include "common/temporary_folder.h"
#include "pm/build.h"
#include "pm/shapes.h"

namespace viewcell {
namespace {

ProgressiveRecord make_file_record(Placement placement) {
  BuildOptions options;
  options.metric = MetricKind::mapping;
  options.placement = placement;
  options.target_faces = 40;
  return build_progressive_mesh(make_relief(5), options).record;
}

// A log and its mesh; every count differs from every other.
struct Logged {
  ProgressiveRecord record;
  AdaptationLog log;

  explicit Logged(Placement placement)
      : record(make_file_record(placement)), log(make_adaptation_log(record)) {
    log.n_folded = 11, log.n_unmapped = 7, log.n_moved = 5;
  }
};

template <typename T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

// The error's text; empty when the log reads.
std::string error_of_reading(const std::filesystem::path& file, const ProgressiveRecord& record) {
  try {
    read_adapt(file, record);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(AdaptFile, KeepsEveryMember) {
  const TemporaryFolder folder;
  for (const Placement placement : {Placement::half, Placement::full}) {
    const Logged made(placement);
    const AdaptationLog& log = made.log;
    write_adapt(folder / "a.adapt", log, made.record);
    const AdaptationLog back = read_adapt(folder / "a.adapt", made.record);
    EXPECT_EQ(bytes_of(back.points), bytes_of(log.points));
    EXPECT_EQ(bytes_of(back.triangles), bytes_of(log.triangles));
    EXPECT_EQ(back.first_point, log.first_point);
    EXPECT_EQ(back.first_triangle, log.first_triangle);
    EXPECT_EQ(back.charts, log.charts);
    EXPECT_EQ(back.steps_per_collapse, placement == Placement::full ? 2u : 1u);
    EXPECT_EQ(back.n_charts, 1u);
    EXPECT_EQ(back.n_folded, 11u);
    EXPECT_EQ(back.n_unmapped, 7u);
    EXPECT_EQ(back.n_moved, 5u);
    write_adapt(folder / "b.adapt", back, made.record);
    EXPECT_EQ(read_file(folder / "a.adapt"), read_file(folder / "b.adapt"));
  }
}

// Whatever the cells depend on makes another mesh.
TEST(AdaptFile, IsOfOneMesh) {
  const TemporaryFolder folder;
  const Logged made(Placement::full);
  write_adapt(folder / "a.adapt", made.log, made.record);
  using Change = std::function<void(ProgressiveRecord&)>;
  const std::vector<Change> changes{
      [](auto& r) { r.attributes.positions[3].z += 1; },
      [](auto& r) { r.vertex_of[1] = 0; },
      [](auto& r) { r.extra_sources.push_back(0); },
      [](auto& r) { r.texcoords[2].y += 1; },
      [](auto& r) { std::swap(r.faces[4][0], r.faces[4][1]); },
      [](auto& r) { std::swap(r.born[0], r.born[1]); },
      [](auto& r) { std::swap(r.moved.front(), r.moved.back()); },
      [](auto& r) { r.moved_by[0] ^= 1; },
      [](auto& r) { r.pairs[0].parent ^= 1; },
      [](auto& r) { r.parent_positions[0].x += 1; },
      [](auto& r) { r.parent_texcoords[0].x += 1; },
      [](auto& r) { std::swap(r.splits[0].child, r.splits[0].parent); },
      [](auto& r) { ++r.splits[1].n_born, --r.splits[2].n_born; },
      [](auto& r) { ++r.splits[1].n_moved, --r.splits[2].n_moved; },
      [](auto& r) { ++r.splits[1].n_pairs, --r.splits[2].n_pairs; },
  };
  for (std::size_t i = 0; i < changes.size(); ++i) {
    ProgressiveRecord other = made.record;
    changes[i](other);
    EXPECT_NE(error_of_reading(folder / "a.adapt", other).find("of another progressive mesh"),
              std::string::npos)
        << i;
  }
  // Costs and errors do not move a cell.
  ProgressiveRecord same = made.record;
  same.splits[0].cost += 1, same.splits[0].error += 1, same.made_by += " ";
  EXPECT_EQ(error_of_reading(folder / "a.adapt", same), "");
}

TEST(AdaptFile, NumbersOutOfRangeAreRefused) {
  const TemporaryFolder folder;
  const Logged made(Placement::half);
  struct Case {
    const char* text;
    std::function<void(AdaptationLog&)> damage;
  };
  const auto n_of = [](const AdaptationLog& log, std::size_t step) {
    return static_cast<std::uint16_t>(log.of(step).points.size());
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Case> cases{
      {"steps that do not follow", [](auto& log) { log.first_point[0] = 1; }},
      {"steps that do not follow", [](auto& log) { log.first_triangle[0] = 1; }},
      {"steps that do not follow",
       [](auto& log) { std::swap(log.first_point[2], log.first_point[3]); }},
      {"steps that do not follow", [](auto& log) { log.first_point[2] = 1u << 30; }},
      {"steps that do not follow", [](auto& log) { --log.first_point.back(); }},
      {"steps that do not follow", [](auto& log) { ++log.first_triangle.back(); }},
      {"steps that do not follow",
       [](auto& log) { log.first_point.push_back(log.first_point.back()); }},
      {"steps that do not follow", [](auto& log) { log.first_triangle.clear(); }},
      {"one chart a face", [](auto& log) { log.charts.pop_back(); }},
      {"one chart a face", [](auto& log) { log.charts.push_back(0); }},
      {"names a chart", [](auto& log) { log.charts[3] = 1; }},
      {"more charts than faces", [](auto& log) { log.n_charts = log.charts.size() + 1; }},
      {"or no number", [&](auto& log) { log.points[1].before.x = nan; }},
      {"or no number", [&](auto& log) { log.points[1].before.y = nan; }},
      {"or no number", [&](auto& log) { log.points[1].after.x = nan; }},
      {"or no number", [](auto& log) { log.points.back().after.y = -HUGE_VALF; }},
      {"corners or chart", [&](auto& log) { log.triangles[0].corners[0] = n_of(log, 0); }},
      {"corners or chart",
       [&](auto& log) { log.triangles.back().corners[2] = n_of(log, log.n_steps() - 1); }},
      {"corners or chart", [](auto& log) { log.triangles[2].chart = 1; }},
  };
  for (std::size_t i = 0; i < cases.size(); ++i) {
    AdaptationLog log = made.log;
    cases[i].damage(log);
    write_adapt(folder / "a.adapt", log, made.record);
    const std::string error = error_of_reading(folder / "a.adapt", made.record);
    EXPECT_NE(error.find(cases[i].text), std::string::npos) << i << ": " << error;
    EXPECT_NE(error.find("a.adapt"), std::string::npos) << error;
  }
}

// The file with one member of its INFO changed, and all hashes right.
void rewrite(const std::filesystem::path& from, const std::filesystem::path& to,
             const std::string& key, const Json& value) {
  constexpr std::uint32_t kKind = 5;
  const SectionReader reader(from, kKind);
  const auto text = reader.read<char>("INFO");
  Json info = parse_json(std::string(text.begin(), text.end()), from);
  info[key] = value;
  SectionWriter writer(kKind);
  writer.add_bytes("INFO", info.dump());
  for (const char* tag : {"POINTS", "TRIANGLE", "ATPOINT", "ATTRI", "CHARTS"})
    writer.add(tag, reader.read<char>(tag));
  writer.write(to);
}

TEST(AdaptFile, OtherFormatsAreRefused) {
  const TemporaryFolder folder;
  const Logged made(Placement::half);
  write_adapt(folder / "a.adapt", made.log, made.record);
  rewrite(folder / "a.adapt", folder / "b.adapt", "charts", 2);
  EXPECT_EQ(error_of_reading(folder / "b.adapt", made.record), "");
  const std::vector<std::pair<std::string, Json>> changes{
      {"format", "viewcell-bundle"}, {"version", 2}, {"mesh_hash", "0"},
      {"steps_per_collapse", 2},     {"charts", -1}, {"folded", "many"}};
  for (const auto& [key, value] : changes) {
    rewrite(folder / "a.adapt", folder / "b.adapt", key, value);
    const std::string error = error_of_reading(folder / "b.adapt", made.record);
    EXPECT_NE(error.find(key == "mesh_hash" ? "another progressive mesh" : key), std::string::npos)
        << key << ": " << error;
  }
  SectionWriter writer(6);
  writer.write(folder / "other");
  EXPECT_NE(error_of_reading(folder / "other", made.record), "");
}

}  // namespace
}  // namespace viewcell
