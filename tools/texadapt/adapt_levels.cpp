#include <optional>

#include "adapt/normal_map.h"
#include "base/error.h"
#include "common/stopwatch.h"
#include "gl/context.h"
#include "mesh/subset.h"
#include "texadapt/advice.h"
#include "texadapt/level_writer.h"
#include "texadapt/levels.h"

namespace viewcell {
namespace {

bool has_normals(const TriMesh& mesh) {
  return !mesh.normals.empty() || !mesh.corner_normals.empty();
}

struct Times {
  double log_s = 0, adapt_s = 0;
};

// Of a level: what was done on the way to it, for all pictures together.
struct Row {
  std::size_t n_faces = 0, n_collapsed = 0;
  AdaptCounts counts;
  double level_s = 0;
  std::size_t n_normal_texels = 0, n_clamped = 0;
};

void add_counts(AdaptCounts& sum, const AdaptCounts& counts) {
  sum.n_adaptations += counts.n_adaptations;
  sum.n_packs += counts.n_packs;
  sum.n_texels += counts.n_texels;
  sum.n_conflicts += counts.n_conflicts;
}

AdaptCounts counts_since(const AdaptCounts& before, const AdaptCounts& now) {
  AdaptCounts out = now;
  out.n_adaptations -= before.n_adaptations;
  out.n_packs -= before.n_packs;
  out.n_texels -= before.n_texels;
  out.n_conflicts -= before.n_conflicts;
  return out;
}

// One picture at one level after another.
class PictureRun {
 public:
  PictureRun(const TexadaptArguments& a, const TexadaptInputs& in, const ShownPicture& picture,
             const AdaptationLog& log, const Gl* gl)
      : a_(a), in_(in), picture_(picture), levels_(in.record, log, picture.texture, with(gl)) {}

  // Adds to the row.
  void go_to(std::size_t level, Row& row) {
    const AdaptCounts before = levels_.counts();
    Stopwatch watch;
    levels_.set_faces(level);
    row.level_s += watch.lap_s();
    row.n_faces = levels_.mesh().n_faces(), row.n_collapsed = levels_.n_collapsed();
    add_counts(row.counts, counts_since(before, levels_.counts()));
  }

  // The level's mesh. Beside a normal map it has normals: without, viewers make some of their own,
  // and the map is relative to these.
  TriMesh extract() const {
    TriMesh mesh = levels_.mesh().extract();
    if (in_.shown.have_normal_maps() && !has_normals(mesh))
      mesh.normals = make_vertex_normals(mesh);
    return mesh;
  }

  bool has_map() const { return a_.options.texel != TexelKind::texture; }
  // The last one may be taken: it is large.
  IndexMap map(bool is_last) { return is_last ? levels_.take_map() : levels_.map(); }
  ImageRgba8 bake(const ImageRgba8& texture, const IndexMap& map) const {
    if (picture_.stays) return texture;
    return has_map() ? levels_.bake(texture, map) : levels_.bake();
  }

  BakedNormalMap bake_normals(const TriMesh& mesh, const IndexMap& map, Row& row) const {
    if (!picture_.has_normal_map) return {};
    if (picture_.stays) return {.image = picture_.normal_map};
    const TriMesh finest = part_of(in_.finest, in_.finest.triangles.size(), nullptr);
    const TriMesh level = part_of(mesh, mesh.triangles.size(), &levels_.mesh());
    BakedNormalMap out = bake_normal_map(
        map, picture_.normal_map.empty() ? nullptr : &picture_.normal_map,
        {finest, levels_.finest().charts}, {level, levels_.charts().charts}, a_.normal_map_options);
    row.n_normal_texels += out.n_texels, row.n_clamped += out.n_clamped;
    return out;
  }

 private:
  AdaptLevelsOptions with(const Gl* gl) const {
    AdaptLevelsOptions o = options_of(a_, picture_);
    o.gl = gl;
    return o;
  }

  // The triangles that show the picture, with the normals that all of them give. level: whose faces
  // the mesh has; null: the input's.
  TriMesh part_of(TriMesh mesh, std::size_t n, const ProgressiveMesh* level) const {
    if (!has_normals(mesh)) mesh.normals = make_vertex_normals(mesh);
    if (picture_.faces.empty()) return mesh;
    std::vector<bool> is_kept;
    for (std::size_t f = 0; f < picture_.faces.size(); ++f)
      if (level == nullptr || level->has_face(f)) is_kept.push_back(picture_.faces[f]);
    VIEWCELL_CHECK(is_kept.size() == n, is_kept.size(), n);
    return keep_triangles(mesh, is_kept);
  }

  const TexadaptArguments& a_;
  const TexadaptInputs& in_;
  const ShownPicture& picture_;
  AdaptLevels levels_;
};

// ---- reports ----

Json format_row(const Row& row, bool has_normal_maps) {
  Json out{{"faces", row.n_faces},
           {"collapses", row.n_collapsed},
           {"adaptations", row.counts.n_adaptations},
           {"packs", row.counts.n_packs},
           {"texels", row.counts.n_texels},
           {"overgrown_texels", row.counts.n_conflicts},
           {"adapt_s", row.level_s}};
  if (has_normal_maps)
    out["normal_map"] = {{"texels", row.n_normal_texels}, {"clamped", row.n_clamped}};
  return out;
}

void say_level(const Tool& tool, const Row& row) {
  tool.say(std::to_string(row.n_faces) + " faces: " + std::to_string(row.counts.n_adaptations) +
           " adaptations in " + std::to_string(row.counts.n_packs) + " packs");
}

void say_folds(const Tool& tool, const TexadaptInputs& in, const AdaptationLog& log) {
  const std::size_t n = log.n_folded + log.n_unmapped;
  if (n > 0)
    tool.say(std::to_string(n) + " of " + std::to_string(log.n_steps()) +
             " steps turn over in the texture and adapt nothing" +
             advise_no_folds(in.record, log.n_folded));
}

void say_overgrown(const Tool& tool, const TexadaptArguments& a, const TexadaptInputs& in,
                   const AdaptCounts& counts) {
  if (counts.n_conflicts > 0)
    tool.say(std::to_string(counts.n_conflicts) +
             " times a chart wanted a texel that another has, or another part of its own, and did "
             "not get it" +
             (a.allows_overlap ? "" : advise_charts_apart(in.record)));
}

Json format_report(const std::vector<Row>& rows, bool has_normal_maps, const AdaptationLog& log,
                   const Times& times) {
  AdaptCounts all;
  Json levels = Json::array();
  for (const Row& row : rows) {
    add_counts(all, row.counts);
    levels.push_back(format_row(row, has_normal_maps));
  }
  return {{"faces", rows.back().n_faces},
          {"collapses", rows.back().n_collapsed},
          {"adaptations", all.n_adaptations},
          {"packs", all.n_packs},
          {"texels", all.n_texels},
          {"overgrown_texels", all.n_conflicts},
          {"charts", log.n_charts},
          {"refused", {{"fold", log.n_folded}, {"unmapped", log.n_unmapped}}},
          {"moved_edges", log.n_moved},
          {"levels", levels},
          {"timing", {{"log_s", times.log_s}, {"adapt_s", times.adapt_s}}}};
}

// ---- runs ----

// The log of what a picture's faces show.
AdaptationLog log_of(const ShownPicture& picture, const AdaptationLog& log) {
  const std::size_t n = log.charts.size();
  if (picture.stays) return keep_faces(log, std::vector<bool>(n, false));
  return keep_faces(log, picture.faces.empty() ? std::vector<bool>(n, true) : picture.faces);
}

// Every file of a level is written when its turn comes.
void run_one(const TexadaptArguments& a, const TexadaptInputs& in, const LevelWriter& writer,
             const AdaptationLog& log, const Gl* gl, std::vector<Row>& rows) {
  const ShownPicture& picture = in.shown.pictures[0];
  PictureRun run(a, in, picture, log, gl);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    run.go_to(a.levels[i], rows[i]);
    const IndexMap map = run.has_map() ? run.map(i + 1 == rows.size()) : IndexMap();
    const TriMesh mesh = run.extract();
    const BakedNormalMap normals = run.bake_normals(mesh, map, rows[i]);
    writer.write(a.levels[i], mesh, run.has_map() ? &map : nullptr,
                 picture.has_normal_map ? &normals.image : nullptr,
                 [&](const ImageRgba8& texture) { return run.bake(texture, map); });
  }
}

// One picture after another, so that one map is in memory; levels when all are there.
void run_several(const Tool& tool, const TexadaptArguments& a, const TexadaptInputs& in,
                 const LevelWriter& writer, const AdaptationLog& log, const Gl* gl,
                 std::vector<Row>& rows) {
  std::vector<std::vector<EncodedPicture>> encoded(rows.size());
  std::vector<TriMesh> meshes;
  const Progress progress = tool.progress("pictures");
  for (std::size_t p = 0; p < in.shown.pictures.size(); ++p) {
    const ShownPicture& picture = in.shown.pictures[p];
    const AdaptationLog own = log_of(picture, log);
    PictureRun run(a, in, picture, own, gl);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      run.go_to(a.levels[i], rows[i]);
      if (p == 0) meshes.push_back(run.extract());
      const IndexMap map = run.has_map() ? run.map(i + 1 == rows.size()) : IndexMap();
      const BakedNormalMap normals = run.bake_normals(meshes[i], map, rows[i]);
      encoded[i].push_back(writer.encode(picture, run.bake(picture.texture, map),
                                         picture.has_normal_map ? &normals.image : nullptr));
    }
    if (progress) progress(p + 1, in.shown.pictures.size());
  }
  for (std::size_t i = 0; i < rows.size(); ++i)
    writer.write_model(a.levels[i], meshes[i], encoded[i]);
}

}  // namespace

Json adapt_levels(const Tool& tool, const TexadaptArguments& a, const TexadaptInputs& in) {
  const LevelWriter writer(tool, a, in);
  Stopwatch watch;
  const AdaptationLog log = get_log(tool, a, in);
  Times times{.log_s = watch.lap_s()};
  std::optional<GlContext> context;
  if (a.engine == AdaptEngine::gl) context.emplace(parse_gl_engine(a.gl));
  const Gl* gl = context ? &context->gl() : nullptr;
  std::vector<Row> rows(a.levels.size());
  if (in.shown.pictures.size() > 1)
    run_several(tool, a, in, writer, log, gl, rows);
  else if (const ShownPicture& one = in.shown.pictures[0]; one.stays || !one.faces.empty())
    run_one(a, in, writer, log_of(one, log), gl, rows);
  else
    run_one(a, in, writer, log, gl, rows);
  AdaptCounts all;
  for (const Row& row : rows) {
    times.adapt_s += row.level_s;
    add_counts(all, row.counts);
    say_level(tool, row);
  }
  say_folds(tool, in, log);
  say_overgrown(tool, a, in, all);
  return format_report(rows, in.shown.have_normal_maps(), log, times);
}

}  // namespace viewcell
