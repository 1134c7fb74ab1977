#include "adapt/adapt_file.h"

#include <algorithm>

#include "base/file.h"
#include "base/json.h"
#include "base/section_file.h"

namespace viewcell {
namespace {

constexpr std::uint32_t kKind = 5;
constexpr const char* kFormat = "viewcell-adapt";
constexpr int kVersion = 1;

// Steps lie one after another, from 0 to n.
bool is_partition(const std::vector<std::uint32_t>& first, std::size_t n_steps, std::size_t n) {
  return first.size() == n_steps + 1 && first.front() == 0 && first.back() == n &&
         std::is_sorted(first.begin(), first.end());
}

std::string find_fault(const AdaptationLog& log, const ProgressiveRecord& record) {
  const std::size_t n_steps = log.steps_per_collapse * record.splits.size();
  if (!is_partition(log.first_point, n_steps, log.points.size()) ||
      !is_partition(log.first_triangle, n_steps, log.triangles.size()))
    return "has steps that do not follow one another";
  if (log.charts.size() != record.faces.size()) return "has not one chart a face";
  if (log.n_charts > log.charts.size()) return "has more charts than faces";
  for (const std::uint32_t chart : log.charts)
    if (chart >= log.n_charts) return "names a chart that is not there";
  for (const AdaptationPoint& point : log.points)
    if (!is_within_reach(point)) return "has a point far outside the texture, or no number";
  for (std::size_t step = 0; step < n_steps; ++step) {
    const Adaptation adaptation = log.of(step);
    for (const AdaptationTriangle& t : adaptation.triangles)
      if (std::any_of(t.corners.begin(), t.corners.end(),
                      [&](std::uint16_t c) { return c >= adaptation.points.size(); }) ||
          t.chart >= log.n_charts)
        return "has a triangle whose corners or chart are not there";
  }
  return "";
}

}  // namespace

std::string adaptation_hash(const ProgressiveRecord& record) {
  std::string hashes;
  const auto add = [&](const auto& values) {
    hashes += hash_hex(
        {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(*values.data())});
  };
  add(record.attributes.positions), add(record.vertex_of), add(record.extra_sources);
  add(record.texcoords), add(record.faces), add(record.born), add(record.moved);
  add(record.moved_by), add(record.pairs), add(record.parent_positions);
  add(record.parent_texcoords);
  std::vector<std::uint32_t> splits;
  for (const VertexSplit& s : record.splits)
    splits.insert(splits.end(), {s.child, s.parent, s.n_born, s.n_moved, s.n_pairs});
  add(splits);
  return hash_hex(hashes);
}

void write_adapt(const std::filesystem::path& file, const AdaptationLog& log,
                 const ProgressiveRecord& record) {
  SectionWriter writer(kKind);
  const Json info{{"format", kFormat},
                  {"version", kVersion},
                  {"mesh_hash", adaptation_hash(record)},
                  {"steps_per_collapse", log.steps_per_collapse},
                  {"charts", log.n_charts},
                  {"folded", log.n_folded},
                  {"unmapped", log.n_unmapped},
                  {"moved", log.n_moved}};
  writer.add_bytes("INFO", info.dump());
  writer.add("POINTS", log.points);
  writer.add("TRIANGLE", log.triangles);
  writer.add("ATPOINT", log.first_point);
  writer.add("ATTRI", log.first_triangle);
  writer.add("CHARTS", log.charts);
  writer.write(file);
}

AdaptationLog read_adapt(const std::filesystem::path& file, const ProgressiveRecord& record) {
  const SectionReader reader(file, kKind, "a log of adaptations (.adapt)");
  const Json json = reader.read_info(kFormat, kVersion);
  const JsonCursor info(json, file);
  if (info.at("mesh_hash").string() != adaptation_hash(record))
    throw InputError(file, "", "is the log of another progressive mesh");
  AdaptationLog log;
  constexpr std::int64_t kMost = std::int64_t{1} << 40;
  const auto count = [&](const char* key) {
    return static_cast<std::size_t>(info.at(key).integer(0, kMost));
  };
  log.steps_per_collapse = record.is_full_edge() ? 2 : 1;
  if (count("steps_per_collapse") != log.steps_per_collapse)
    info.at("steps_per_collapse").fail("is not that of the mesh");
  log.n_charts = count("charts"), log.n_folded = count("folded");
  log.n_unmapped = count("unmapped"), log.n_moved = count("moved");
  reader.read("POINTS", log.points);
  reader.read("TRIANGLE", log.triangles);
  reader.read("ATPOINT", log.first_point);
  reader.read("ATTRI", log.first_triangle);
  reader.read("CHARTS", log.charts);
  if (const std::string fault = find_fault(log, record); !fault.empty())
    throw InputError(file, "", fault);
  return log;
}

}  // namespace viewcell
