#include "texadapt/inputs.h"

#include "bake/chart_checks.h"
#include "base/error.h"
#include "image/index_map.h"
#include "mesh/texture_file.h"
#include "pm/adapt_file.h"
#include "pm/pm_file.h"

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

}  // namespace

TexadaptInputs read_inputs(TexadaptArguments& a) {
  TexadaptInputs in;
  in.record = read_pm(a.pm);
  if (in.record.texcoords.empty())
    throw InputError(a.pm, "", "has no texture coordinates, so no texture can follow it");
  in.texture = read_texture(a.texture);
  for (const FurtherTexture& f : a.further) in.further.push_back(read_texture(f.from));
  if (!a.normal_map.from.empty()) in.normal_map = read_texture(a.normal_map.from);
  if (!a.start.empty()) a.options.start = read_index_map(a.start);
  settle_size(a.options, in.texture);
  in.finest = extract_finest(in.record);
  const ChartFindings findings = check_charts(in.finest, a.options.width_px, a.options.height_px);
  if (const std::string obstacle = find_obstacle(findings, a.allows_overlap); !obstacle.empty())
    throw InputError(a.pm, "", obstacle);
  in.charts = describe(findings);
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
