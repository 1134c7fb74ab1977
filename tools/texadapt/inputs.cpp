#include "texadapt/inputs.h"

#include "adapt/adapt_file.h"
#include "base/error.h"
#include "common/picture_input.h"
#include "image/index_map.h"
#include "pm/pm_file.h"
#include "texadapt/level_writer.h"
#include "uv/chart_checks.h"

namespace viewcell {
namespace {

// The map is of the start's size or the texture's, unless told.
void settle_size(AdaptLevelsOptions& o, const ImageRgba8& texture) {
  if (o.width_px == 0) o.width_px = o.start ? o.start->width_px : texture.width_px;
  if (o.height_px == 0) o.height_px = o.start ? o.start->height_px : texture.height_px;
}

TriMesh extract_finest(const ProgressiveRecord& record) {
  ProgressiveMesh mesh(record);
  mesh.set_level(mesh.n_splits());
  return mesh.extract();
}

// A map that says what it is of must be of this level.
void check_start(const TexadaptArguments& a, const TexadaptInputs& in, const std::string& label) {
  if (!label.starts_with(kLabelStart)) return;
  ProgressiveMesh mesh(in.record);
  mesh.set_faces(a.options.start_faces);
  if (label == map_label(in.hash, mesh.n_faces())) return;
  const bool same_mesh = label.starts_with(kLabelStart + in.hash);
  throw InputError(a.start, "",
                   same_mesh ? "is the map of another level than --from " +
                                   std::to_string(a.options.start_faces) + ": " + label
                             : "is the map of another progressive mesh");
}

std::string describe_moves(const ChartFindings& findings) {
  const glm::ivec2 tile = findings.tile;
  if (tile != glm::ivec2(0))
    return "the mesh lies in another tile of a picture that repeats: " + std::to_string(-tile.x) +
           " is added to u and " + std::to_string(-tile.y) + " to v\n";
  return std::to_string(findings.n_elsewhere) + " of " + std::to_string(findings.n_charts) +
         " charts lie in other tiles of a picture that repeats: they are moved by whole tiles into "
         "the first\n";
}

// Charts in other tiles of a repeating picture are moved into the first.
void leave_tiles(TexadaptInputs& in, ChartFindings& findings, const TexadaptArguments& a) {
  if (findings.tiles.empty()) return;
  std::vector<glm::vec2> by;
  for (const glm::ivec2& tile : findings.tiles) by.push_back(-glm::vec2(tile));
  move_texcoords(in.record, by);
  in.finest = extract_finest(in.record);
  in.charts = describe_moves(findings);
  findings = check_charts(in.finest, a.options.width_px, a.options.height_px);
}

}  // namespace

TexadaptInputs read_inputs(const Tool& tool, TexadaptArguments& a) {
  const auto read = [&](const std::string& name) {
    return read_texture_input(tool, name, a.max_pixels);
  };
  TexadaptInputs in;
  in.record = read_pm(a.pm);
  if (in.record.texcoords.empty())
    throw InputError(a.pm, "", "has no texture coordinates, so no texture can follow it");
  in.texture = read(a.texture);
  for (const FurtherTexture& f : a.further) in.further.push_back(read(f.from));
  if (!a.normal_map.from.empty()) in.normal_map = read(a.normal_map.from);
  std::string label;
  if (!a.start.empty()) a.options.start = read_index_map(a.start, nullptr, &label, {a.max_pixels});
  settle_size(a.options, in.texture);
  in.finest = extract_finest(in.record);
  ChartFindings findings = check_charts(in.finest, a.options.width_px, a.options.height_px);
  leave_tiles(in, findings, a);
  in.hash = adaptation_hash(in.record);
  check_start(a, in, label);
  if (const std::string obstacle = find_obstacle(findings, a.allows_overlap); !obstacle.empty())
    throw InputError(a.pm, "",
                     obstacle + (findings.overlaps.empty() || a.allows_overlap
                                     ? ""
                                     : " (--allow-overlap goes on all the same)"));
  in.charts += describe(findings);
  return in;
}

AdaptationLog get_log(const Tool& tool, const TexadaptArguments& a,
                      const ProgressiveRecord& record) {
  if (!a.replay.empty()) return read_adapt(a.replay, record);
  AdaptationLog log = make_adaptation_log(record, tool.progress("collapses"));
  if (!a.log.empty()) write_adapt(a.log, log, record);
  return log;
}

}  // namespace viewcell
