#include <optional>

#include "adapt/normal_map.h"
#include "common/stopwatch.h"
#include "gl/context.h"
#include "mesh/mesh.h"
#include "texadapt/level_writer.h"
#include "texadapt/levels.h"

namespace viewcell {
namespace {

// The level's mesh. Beside a normal map it has normals: without, viewers make some of their own,
// and the map is relative to these.
TriMesh extract_level(const AdaptLevels& levels, const TexadaptArguments& a) {
  TriMesh mesh = levels.mesh().extract();
  if (a.has_normal_map && mesh.normals.empty()) mesh.normals = make_vertex_normals(mesh);
  return mesh;
}

BakedNormalMap bake_normals(const AdaptLevels& levels, const TexadaptArguments& a,
                            const TexadaptInputs& in, const TriMesh& mesh, const IndexMap& map) {
  if (!a.has_normal_map) return {};
  return bake_normal_map(map, in.normal_map.empty() ? nullptr : &in.normal_map,
                         {in.finest, levels.finest().charts}, {mesh, levels.charts().charts},
                         a.normal_map_options);
}

// Writes the files of the level where `levels` stands; the counts of its normal map are returned.
BakedNormalMap write_level(const LevelWriter& writer, const TexadaptArguments& a,
                           const TexadaptInputs& in, AdaptLevels& levels, std::size_t level) {
  const bool has_map = a.options.texel != TexelKind::texture;
  const bool is_last = level == a.levels.back();
  const IndexMap map = !has_map ? IndexMap() : is_last ? levels.take_map() : levels.map();
  const TriMesh mesh = extract_level(levels, a);
  BakedNormalMap normals = bake_normals(levels, a, in, mesh, map);
  writer.write(level, mesh, has_map ? &map : nullptr, a.has_normal_map ? &normals.image : nullptr,
               [&](const ImageRgba8& texture) {
                 return has_map ? levels.bake(texture, map) : levels.bake();
               });
  return normals;
}

AdaptCounts counts_since(const AdaptCounts& before, const AdaptCounts& now) {
  AdaptCounts out = now;
  out.n_adaptations -= before.n_adaptations;
  out.n_packs -= before.n_packs;
  out.n_texels -= before.n_texels;
  out.n_conflicts -= before.n_conflicts;
  return out;
}

Json format_row(const AdaptLevels& levels, const AdaptCounts& counts, double level_s) {
  return {{"faces", levels.mesh().n_faces()},
          {"collapses", levels.n_collapsed()},
          {"adaptations", counts.n_adaptations},
          {"packs", counts.n_packs},
          {"texels", counts.n_texels},
          {"overgrown_texels", counts.n_conflicts},
          {"adapt_s", level_s}};
}

void say_level(const Tool& tool, const AdaptLevels& levels, const AdaptCounts& counts) {
  tool.say(std::to_string(levels.mesh().n_faces()) +
           " faces: " + std::to_string(counts.n_adaptations) + " adaptations in " +
           std::to_string(counts.n_packs) + " packs");
}

void say_folds(const Tool& tool, const AdaptationLog& log) {
  if (log.n_folded + log.n_unmapped > 0)
    tool.say(std::to_string(log.n_folded + log.n_unmapped) + " of " +
             std::to_string(log.n_steps()) +
             " steps turn over in the texture and adapt nothing (pmesh build --no-folds refuses "
             "most of them)");
}

void say_overgrown(const Tool& tool, const AdaptCounts& counts) {
  if (counts.n_conflicts > 0)
    tool.say(std::to_string(counts.n_conflicts) +
             " times a chart wanted a texel that another has, or another part of its own, and did "
             "not get it (pmesh build --charts-apart refuses most of that)");
}

struct Times {
  double log_s = 0, adapt_s = 0;
};

Json format_report(const Json& rows, const AdaptCounts& all, const AdaptationLog& log,
                   const Times& times) {
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
          {"timing", {{"log_s", times.log_s}, {"adapt_s", times.adapt_s}}}};
}

}  // namespace

Json adapt_levels(const Tool& tool, const TexadaptArguments& a, const TexadaptInputs& in) {
  const LevelWriter writer(tool, a, in);
  Stopwatch watch;
  const AdaptationLog log = get_log(tool, a, in.record);
  Times times{.log_s = watch.lap_s()};
  std::optional<GlContext> context;
  AdaptLevelsOptions options = a.options;
  if (a.engine == AdaptEngine::gl) {
    context.emplace(parse_gl_engine(a.gl));
    options.gl = &context->gl();
  }
  AdaptLevels levels(in.record, log, in.texture, options);
  Json rows = Json::array();
  for (const std::size_t level : a.levels) {
    const AdaptCounts before = levels.counts();
    watch.lap_s();
    levels.set_faces(level);
    const double level_s = watch.lap_s();
    times.adapt_s += level_s;
    const BakedNormalMap normals = write_level(writer, a, in, levels, level);
    const AdaptCounts counts = counts_since(before, levels.counts());
    rows.push_back(format_row(levels, counts, level_s));
    if (a.has_normal_map)
      rows.back()["normal_map"] = {{"texels", normals.n_texels}, {"clamped", normals.n_clamped}};
    say_level(tool, levels, counts);
  }
  say_folds(tool, log);
  say_overgrown(tool, levels.counts());
  return format_report(rows, levels.counts(), log, times);
}

}  // namespace viewcell
