// texadapt: a texture that follows the collapses of a progressive mesh, for levels of it.
#include <cstdio>

#include "arguments.h"
#include "bake/chart_checks.h"
#include "bake/rebake.h"
#include "base/error.h"
#include "common/provenance.h"
#include "common/stopwatch.h"
#include "gl/context.h"
#include "image/io.h"
#include "mesh/io.h"
#include "mesh/texture_file.h"
#include "mesh/write_glb.h"
#include "pm/adapt_file.h"
#include "pm/pm_file.h"

namespace viewcell {
namespace {

constexpr int kOverThreshold = 5;

struct Inputs {
  ProgressiveRecord record;
  TriMesh finest;
  ImageRgba8 texture, normal_map;
  std::vector<ImageRgba8> further;
  std::string charts;  // lines about them
};

Inputs read_inputs(TexadaptArguments& a) {
  Inputs in;
  in.record = read_pm(a.pm);
  if (in.record.texcoords.empty())
    throw InputError(a.pm, "", "has no texture coordinates, so no texture can follow it");
  in.texture = read_texture(a.texture);
  for (const FurtherTexture& f : a.further) in.further.push_back(read_texture(f.from));
  if (!a.normal_map.from.empty()) in.normal_map = read_texture(a.normal_map.from);
  if (!a.start.empty()) a.options.start = read_index_map(a.start);
  AdaptLevelsOptions& o = a.options;
  if (o.width_px == 0) o.width_px = o.start ? o.start->width_px : in.texture.width_px;
  if (o.height_px == 0) o.height_px = o.start ? o.start->height_px : in.texture.height_px;
  ProgressiveMesh mesh(in.record);
  mesh.set_level(mesh.n_splits());
  in.finest = mesh.extract();
  const ChartFindings findings = check_charts(in.finest, o.width_px, o.height_px);
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

// The textures of a level, its mesh, and where they go.
class LevelWriter {
 public:
  LevelWriter(const Tool& tool, const TexadaptArguments& a, const Inputs& in)
      : tool_(tool), a_(a), in_(in) {}

  /// bake(texture) makes what the level shows of a texture; map, normal_map: null where there is
  /// none.
  template <typename Bake>
  void write(std::size_t level, const TriMesh& mesh, const IndexMap* map,
             const ImageRgba8* normal_map, Bake&& bake) const {
    const std::string output = a_.name_at(tool_.common().output, level);
    const std::vector<std::string> comments{std::string("made by texadapt ") + version()};
    if (a_.format == TextureFormat::map)
      write_index_map(output, *map);
    else if (a_.format == TextureFormat::png)
      write_png(output, bake(in_.texture));
    else
      write_glb(
          output, mesh,
          {encode_png(bake(in_.texture)), normal_map ? encode_png(*normal_map) : "", comments[0]});
    if (const std::string file = a_.name_at(a_.mesh, level); file.ends_with(".obj"))
      write_obj(file, mesh, {comments, "", ""});
    else if (!file.empty())
      write_ply(file, mesh, comments);
    if (!a_.index_map.empty()) write_index_map(a_.name_at(a_.index_map, level), *map);
    if (const std::string file = a_.name_at(a_.normal_map.to, level); !file.empty())
      write_png(file, *normal_map);
    for (std::size_t i = 0; i < in_.further.size(); ++i)
      write_png(a_.name_at(a_.further[i].to, level), bake(in_.further[i]));
  }

 private:
  const Tool& tool_;
  const TexadaptArguments& a_;
  const Inputs& in_;
};

// The level's mesh. Beside a normal map it has normals: without, viewers make some of their own,
// and the map is relative to these.
TriMesh extract_level(const AdaptLevels& levels, const TexadaptArguments& a) {
  TriMesh mesh = levels.mesh().extract();
  if (a.has_normal_map && mesh.normals.empty()) mesh.normals = make_vertex_normals(mesh);
  return mesh;
}

BakedNormalMap bake_normals(const AdaptLevels& levels, const TexadaptArguments& a, const Inputs& in,
                            const TriMesh& mesh, const IndexMap& map) {
  if (!a.has_normal_map) return {};
  return bake_normal_map(map, in.normal_map.empty() ? nullptr : &in.normal_map,
                         {in.finest, levels.finest().charts}, {mesh, levels.charts().charts},
                         a.normal_map_options);
}

Json adapt(const Tool& tool, const TexadaptArguments& a, const Inputs& in) {
  const LevelWriter writer(tool, a, in);
  Stopwatch watch;
  const AdaptationLog log = get_log(tool, a, in.record);
  const double log_s = watch.lap_s();
  std::optional<GlContext> context;
  AdaptLevelsOptions options = a.options;
  if (a.engine == AdaptEngine::gl) {
    context.emplace(parse_gl_engine(a.gl));
    options.gl = &context->gl();
  }
  AdaptLevels levels(in.record, log, in.texture, options);
  Json rows = Json::array();
  const bool has_map = a.options.texel != TexelKind::texture;
  double adapt_s = 0;
  for (const std::size_t level : a.levels) {
    const AdaptCounts before = levels.counts();
    watch.lap_s();
    levels.set_faces(level);
    const double level_s = watch.lap_s();
    adapt_s += level_s;
    const IndexMap map = has_map ? levels.map() : IndexMap();
    const TriMesh mesh = extract_level(levels, a);
    const BakedNormalMap normals = bake_normals(levels, a, in, mesh, map);
    writer.write(
        level, mesh, has_map ? &map : nullptr, a.has_normal_map ? &normals.image : nullptr,
        [&](const ImageRgba8& texture) { return has_map ? levels.bake(texture) : levels.bake(); });
    const AdaptCounts& now = levels.counts();
    rows.push_back({{"faces", levels.mesh().n_faces()},
                    {"collapses", levels.n_collapsed()},
                    {"adaptations", now.n_adaptations - before.n_adaptations},
                    {"packs", now.n_packs - before.n_packs},
                    {"texels", now.n_texels - before.n_texels},
                    {"adapt_s", level_s}});
    if (a.has_normal_map)
      rows.back()["normal_map"] = {{"texels", normals.n_texels}, {"clamped", normals.n_clamped}};
    tool.say(std::to_string(levels.mesh().n_faces()) +
             " faces: " + std::to_string(now.n_adaptations - before.n_adaptations) +
             " adaptations in " + std::to_string(now.n_packs - before.n_packs) + " packs");
  }
  if (log.n_folded + log.n_unmapped > 0)
    tool.say(std::to_string(log.n_folded + log.n_unmapped) + " of " +
             std::to_string(log.n_steps()) + " steps turn over in the texture and adapt nothing");
  const AdaptCounts& all = levels.counts();
  return {{"faces", rows.back()["faces"]},
          {"collapses", rows.back()["collapses"]},
          {"adaptations", all.n_adaptations},
          {"packs", all.n_packs},
          {"texels", all.n_texels},
          {"overgrown_texels", all.n_conflicts},
          {"charts", log.n_charts},
          {"refused", {{"fold", log.n_folded}, {"unmapped", log.n_unmapped}}},
          {"moved_edges", log.n_moved},
          {"levels", rows},
          {"timing", {{"log_s", log_s}, {"adapt_s", adapt_s}}}};
}

Json rebake(const Tool& tool, const TexadaptArguments& a, const Inputs& in) {
  const LevelWriter writer(tool, a, in);
  ProgressiveMesh mesh(in.record);
  mesh.set_level(mesh.n_splits());
  Json rows = Json::array();
  Stopwatch watch;
  double bake_s = 0;
  for (const std::size_t level : a.levels) {
    mesh.set_faces(level);
    const TriMesh coarse = mesh.extract();
    watch.lap_s();
    writer.write(level, coarse, nullptr, nullptr, [&](const ImageRgba8& texture) {
      return rebake_texture(coarse, in.finest, texture,
                            {.width_px = a.options.width_px,
                             .height_px = a.options.height_px,
                             .n_threads = tool.common().n_threads,
                             .progress = tool.progress("rows")});
    });
    bake_s += watch.lap_s();
    rows.push_back({{"faces", mesh.n_faces()}});
  }
  return {{"faces", rows.back()["faces"]}, {"levels", rows}, {"timing", {{"bake_s", bake_s}}}};
}

int run(const Tool& tool, TexadaptArguments& a) {
  finish_arguments(tool, a);
  const Inputs in = read_inputs(a);
  const Json report = a.engine == AdaptEngine::rebake ? rebake(tool, a, in) : adapt(tool, a, in);
  tool.say(in.charts);
  tool.report(report);
  for (std::size_t i = 0; i < a.levels.size(); ++i) {
    const auto n = report["levels"][i]["faces"].get<std::size_t>();
    if (n <= a.levels[i]) continue;
    std::fprintf(stderr, "texadapt: %s: %zu faces were asked for, its base has %zu\n", a.pm.c_str(),
                 a.levels[i], n);
    return kOverThreshold;
  }
  return 0;
}

}  // namespace
}  // namespace viewcell

int main(int argc, char** argv) {
  viewcell::Tool tool(
      "texadapt",
      "Makes a texture follow a progressive mesh: what it shows stays where it was on the surface, "
      "while the mesh gets coarser or finer.",
      "pmesh build head.obj --metric mapping -o head.pm\n"
      "  texadapt head.pm skin.png --faces 500 -o skin-500.png --mesh head-500.ply\n"
      "  texadapt head.pm skin.png --levels 8000,2000,500 -o head.glb");
  viewcell::TexadaptArguments arguments;
  viewcell::declare_arguments(tool, arguments);
  return tool.main(argc, argv, [&] { return viewcell::run(tool, arguments); });
}
