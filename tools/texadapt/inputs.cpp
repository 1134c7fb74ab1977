#include "texadapt/inputs.h"

#include <algorithm>

#include "adapt/adapt_file.h"
#include "base/error.h"
#include "common/picture_input.h"
#include "image/index_map.h"
#include "pm/pm_file.h"
#include "texadapt/level_writer.h"

namespace viewcell {
namespace {

TriMesh extract_finest(const ProgressiveRecord& record) {
  return make_finest(record).extract();
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

// With several pictures a level is a GLB, and nothing that is of one picture.
void check_several(const TexadaptArguments& a, const TexadaptInputs& in) {
  const std::size_t n = in.shown.pictures.size();
  if (n == 1 && !in.shown.pictures[0].faces.empty() && !(a.log.empty() && a.replay.empty()))
    throw UsageError("--log and --replay are for one picture on all faces; of " + a.texture +
                     " some show none");
  if (n == 1 && !in.shown.pictures[0].faces.empty() && !a.onto.empty())
    throw UsageError("--onto is for a picture on all faces; of " + a.texture + " some show none");
  if (n < 2) return;
  if (!a.onto.empty())
    throw UsageError("--onto is for one picture; " + a.texture + " has " + std::to_string(n));
  const auto refuse = [&](bool is_given, const char* what) {
    if (is_given)
      throw UsageError(std::string(what) + " is for one picture; " + a.texture + " has " +
                       std::to_string(n) + ", which -o NAME.glb holds together");
  };
  refuse(a.format != LevelFormat::glb, "a .png or an indexing map");
  refuse(!a.index_map.empty(), "--index-map");
  refuse(!a.start.empty(), "--from");
  refuse(!a.further.empty(), "--also");
  refuse(!a.log.empty(), "--log");
  refuse(!a.replay.empty(), "--replay");
  refuse(!a.normal_map.from.empty() || !a.normal_map.to.empty(), "--normal-map IMAGE");
}

// A mesh that is baked onto has one material.
void keep_one_look(ShownPictures& shown) {
  const auto found = std::find(shown.picture_of.begin(), shown.picture_of.end(), 0);
  if (found == shown.picture_of.end()) return;
  shown.looks = {shown.looks[static_cast<std::size_t>(found - shown.picture_of.begin())]};
  shown.picture_of = {0};
  // The picture is made for coordinates in [0, 1]: beside them nothing of the other side.
  GlbSampler& sampler = shown.looks[0].color_sampler;
  sampler.wrap_s = sampler.wrap_t = GlbSampler::kClampToEdge;
}

// ---- charts ----

// Other faces are in no chart: each is one point. So numbers of triangles stay.
TriMesh only_faces(const TriMesh& finest, const std::vector<bool>& faces) {
  TriMesh out = finest;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (faces[f]) continue;
    out.triangles[f].fill(out.triangles[f][0]);
    for (std::size_t k = 0; k < 3; ++k) out.texcoords[3 * f + k] = glm::vec2(0);
  }
  return out;
}

ChartFindings find_charts_of(const TexadaptArguments& a, const TexadaptInputs& in,
                             const ShownPicture& picture) {
  const AdaptLevelsOptions o = options_of(a, picture);
  if (picture.faces.empty()) return check_charts(in.finest, o.width_px, o.height_px);
  return check_charts(only_faces(in.finest, picture.faces), o.width_px, o.height_px);
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

// Whether materials show the picture repeated, where they say how.
bool is_repeated(const ShownPictures& shown, const ShownPicture& picture) {
  const auto id = static_cast<int>(&picture - shown.pictures.data());
  for (std::size_t m = 0; m < shown.looks.size(); ++m)
    if (shown.picture_of[m] == id && !shown.looks[m].color_sampler.is_repeating()) return false;
  return true;
}

// Charts in other tiles of a repeating picture are moved into the first.
void leave_tiles(const TexadaptArguments& a, TexadaptInputs& in) {
  std::vector<glm::vec2> by(in.finest.triangles.size(), glm::vec2(0));
  for (const ShownPicture& picture : in.shown.pictures) {
    const ChartFindings findings = find_charts_of(a, in, picture);
    if (picture.stays || findings.tiles.empty()) continue;
    if (!is_repeated(in.shown, picture))
      throw InputError(a.pm, "",
                       (picture.of.empty() ? "" : picture.of + ": ") +
                           std::to_string(findings.n_elsewhere) +
                           " charts lie beside their picture, which is clamped or mirrored there: "
                           "bring them into [0, 1], or have it repeat");
    for (std::size_t f = 0; f < by.size(); ++f) by[f] -= glm::vec2(findings.tiles[f]);
    in.charts += (picture.of.empty() ? "" : picture.of + ": ") + describe_moves(findings);
  }
  if (in.charts.empty()) return;
  const std::vector<glm::vec2> before = std::move(in.finest.texcoords);
  move_texcoords(in.record, by);
  in.finest = extract_finest(in.record);
  for (std::size_t c = 0; c < before.size(); ++c)
    if (in.finest.texcoords[c] != before[c] + by[c / 3])
      throw InputError(a.pm, "",
                       "charts of different materials share texture coordinates where they meet, "
                       "and lie in different tiles of pictures that repeat");
}

// Sets which of the pictures stay as they are, where that is asked for.
void keep_repeating(const TexadaptArguments& a, TexadaptInputs& in) {
  for (ShownPicture& picture : in.shown.pictures) {
    const ChartFindings findings = find_charts_of(a, in, picture);
    picture.stays = findings.n_repeating > 0 && findings.n_not_finite == 0;
    if (!picture.stays) continue;
    if (picture.normal_map.empty()) picture.has_normal_map = false;
    add_remark(&in.shown.remarks, "pictures that repeat, left as they are");
  }
}

// What is only read, to be baked onto another mesh, may show places twice.
void check_all_charts(const TexadaptArguments& a, TexadaptInputs& in) {
  const bool allows_overlap = a.allows_overlap || !a.onto.empty();
  if (a.keeps_repeating) keep_repeating(a, in);
  leave_tiles(a, in);
  for (const ShownPicture& picture : in.shown.pictures) {
    if (picture.stays) continue;
    const ChartFindings findings = find_charts_of(a, in, picture);
    const std::string of = picture.of.empty() ? "" : picture.of + ": ";
    check_obstacle(a.pm, of, findings, allows_overlap);
    if (a.engine == AdaptEngine::rebake && a.onto.empty() && findings.n_elsewhere == 0)
      add_remark(
          &in.shown.remarks,
          "corners outside the picture, where --engine rebake makes no texels (cpu and gl do)",
          findings.n_outside);
    if (!in.charts.empty() && !in.charts.ends_with('\n')) in.charts += '\n';
    in.charts += of + describe(findings);
  }
}

}  // namespace

void check_obstacle(const std::string& file, const std::string& of, const ChartFindings& findings,
                    bool allows_overlap) {
  const std::string obstacle = find_obstacle(findings, allows_overlap);
  if (obstacle.empty()) return;
  const char* way_out = "";
  if (find_obstacle(findings, true).empty())
    way_out = " (--allow-overlap goes on all the same)";
  else if (findings.n_repeating > 0 && findings.n_not_finite == 0)
    way_out = " (--keep-repeating leaves such pictures of a .glb as they are)";
  throw InputError(file, "", of + obstacle + way_out);
}

AdaptLevelsOptions options_of(const TexadaptArguments& a, const ShownPicture& picture) {
  AdaptLevelsOptions o = a.options;
  if (o.width_px == 0) o.width_px = o.start ? o.start->width_px : picture.texture.width_px;
  if (o.height_px == 0) o.height_px = o.start ? o.start->height_px : picture.texture.height_px;
  return o;
}

TexadaptInputs read_inputs(const Tool& tool, TexadaptArguments& a) {
  TexadaptInputs in;
  in.record = read_pm(a.pm);
  if (in.record.texcoords.empty())
    throw InputError(a.pm, "",
                     std::string("has no texture coordinates, so no texture can follow it") +
                         (a.onto.empty() ? "" : ": --onto takes a .pm that has them"));
  in.shown = read_pictures(tool, a, in.record);
  check_several(a, in);
  if (!a.onto.empty()) keep_one_look(in.shown);
  for (const FurtherTexture& f : a.further)
    in.further.push_back(read_texture_input(tool, f.from, a.max_pixels));
  std::string label;
  if (!a.start.empty()) a.options.start = read_index_map(a.start, nullptr, &label, {a.max_pixels});
  in.finest = extract_finest(in.record);
  check_all_charts(a, in);
  in.hash = adaptation_hash(in.record);
  check_start(a, in, label);
  return in;
}

AdaptationLog get_log(const Tool& tool, const TexadaptArguments& a, const TexadaptInputs& in) {
  if (!a.replay.empty()) return read_adapt(a.replay, in.record);
  std::vector<std::int32_t> groups;
  const bool is_one = in.shown.pictures.size() == 1 && in.shown.pictures[0].faces.empty();
  for (std::size_t f = 0; f < in.record.faces.size() && !is_one; ++f)
    groups.push_back(
        in.shown.picture_of[static_cast<std::size_t>(in.record.attributes.materials[f])]);
  AdaptationLog log = make_adaptation_log(in.record, tool.progress("collapses"), groups);
  if (!a.log.empty()) write_adapt(a.log, log, in.record);
  return log;
}

}  // namespace viewcell
