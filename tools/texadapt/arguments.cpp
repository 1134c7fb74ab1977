#include "texadapt/arguments.h"

#include <algorithm>
#include <filesystem>
#include <tuple>

#include "base/error.h"
#include "common/picture_input.h"

namespace viewcell {
namespace {

constexpr std::uint64_t kMostFaces = 2000000000;
constexpr std::uint64_t kMostSide = 32768;

void declare_levels(Command& command, TexadaptArguments& a) {
  command.add_option("--faces", &a.faces, "the finest level of at most so many faces")
      .check(whole_within(1, kMostFaces));
  command
      .add_option(
          "--levels", &a.level_list,
          "N,N,..: several, one after another in this order, finer ones again after coarser "
          "ones too; N is put into the files' names, and each level's mesh is written "
          "beside its texture (as .ply, unless --mesh or --format glb)")
      .excludes("--faces");
  command
      .add_option("--onto", &a.onto,
                  "of --engine rebake: not a level but this mesh, which lies where PM's does; "
                  "without texture coordinates it gets some, a chart a triangle (.glb or --mesh)")
      .excludes("--faces")
      .excludes("--levels")
      .reads("the mesh that is baked onto");
  command.add_option(
      "--from", &a.start_text,
      "N=MAP: start from this indexing map (.exr, .tif) of the level of N faces, not "
      "from the finest level");
  command.add_option("--log", &a.log, "write the adaptations to this file: .adapt").writes();
  command.add_option("--replay", &a.replay, "take the adaptations from such a file")
      .excludes("--log")
      .reads("the log that is read");
}

void declare_outputs(Command& command, TexadaptArguments& a) {
  command.add_option("--mesh", &a.mesh, "write the level's mesh: .ply or .obj");
  command.add_option("--index-map", &a.index_map,
                     "write the indexing map, too: .exr (float) or .tif (16 bits)");
  command.add_option("--also", &a.further_texts,
                     "IMAGE=OUT.png: a further texture with the same coordinates, through the same "
                     "indexing map; may be repeated");
  command.add_option(
      "--normal-map", &a.normal_map_text,
      "IMAGE=OUT.png: a tangent-space normal map with the same coordinates, made anew for the "
      "level's own tangents and normals, which its mesh then has; flat=OUT.png: none, so that the "
      "level is shaded as the finest mesh is; for --format glb, IMAGE or flat alone");
  command
      .add_option("--normal-map-y", &a.normal_map_y,
                  "where the green of IMAGE points: up (OpenGL, glTF) | down (Direct3D); what is "
                  "written points up")
      .needs("--normal-map")
      .check(one_of({"up", "down"}))
      .show_default();
  command
      .add_flag(
          "--no-normal-map", &a.no_normal_map,
          "leave out the normal maps of a GLB or glTF TEXTURE, which --format glb otherwise has")
      .excludes("--normal-map");
  command
      .add_option("--texture-size", &a.texture_side,
                  "pictures that are written have this longer side at most, in pixels; --size is "
                  "that of the map, which they have otherwise")
      .check(in_range(1, static_cast<int>(kMostSide)));
  command
      .add_option(
          "--quality", &a.quality,
          "of pictures of a .glb that were JPEG or lossy WebP and are stored as JPEG again, "
          "1 to 100 (default: their own; of WebP 90); all others are PNG")
      .check(in_range(1, 100));
  command.add_option("--format", &a.format_name, "png | glb, with the mesh (default: as -o ends)")
      .check(one_of({"png", "glb"}));
  command.add_flag("--bake", &a.bake,
                   "resolve the indexing map into an ordinary texture: what a .png "
                   "and a .glb always have");
}

void declare_engine(Command& command, TexadaptArguments& a) {
  command
      .add_option("--engine", &a.engine_name,
                  "cpu | gl (by drawing) | rebake (no adaptation: a new texture from the nearest "
                  "points of the "
                  "finest mesh, to compare with)")
      .check(one_of({"cpu", "gl", "rebake"}))
      .show_default();
  command.add_option("--gl", &a.gl, "of --engine gl: osmesa | egl")
      .check(one_of({"osmesa", "egl"}))
      .show_default();
  command
      .add_option("--texels", &a.texel_name,
                  "of the indexing map: float | half | 16 | 8 bits; or texture: adapt the texture "
                  "itself, which blurs")
      .check(one_of({"float", "half", "16", "8", "texture"}))
      .show_default();
  command.add_option("--size", &a.size, "WxH: of the indexing map (default: the texture's)");
  command.add_flag("--no-pack", &a.one_by_one, "one adaptation after another, on one thread");
  command.add_flag("--allow-overlap", &a.allows_overlap,
                   "go on where two charts lie on the same texels; these follow one of them");
  command.add_flag("--keep-repeating", &a.keeps_repeating,
                   "of a .glb: pictures that repeat on their material stay as they are, on the "
                   "level's texture coordinates, which drift a little (default: refused)");
  declare_max_pixels(command, &a.max_pixels);
}

std::vector<std::size_t> parse_levels(const std::string& list) {
  std::vector<std::size_t> out;
  for (std::size_t at = 0; at <= list.size();) {
    const std::size_t comma = std::min(list.find(',', at), list.size());
    std::size_t n = 0;
    if (!parse_whole(list.substr(at, comma - at), 1, kMostFaces, n))
      throw UsageError("--levels: '" + list + "' is not N,N,.. with numbers of faces from 1 on");
    if (std::find(out.begin(), out.end(), n) != out.end())
      throw UsageError("--levels: " + std::to_string(n) + " is there twice, but its files once");
    out.push_back(n);
    at = comma + 1;
  }
  return out;
}

void parse_size(const std::string& text, AdaptLevelsOptions& options) {
  const std::size_t x = text.find('x');
  std::size_t width = 0, height = 0;
  if (x == std::string::npos || !parse_whole(text.substr(0, x), 1, kMostSide, width) ||
      !parse_whole(text.substr(x + 1), 1, kMostSide, height))
    throw UsageError("--size: '" + text + "' is not WIDTHxHEIGHT, each 1 to " +
                     std::to_string(kMostSide));
  options.width_px = static_cast<int>(width), options.height_px = static_cast<int>(height);
}

// "LEFT=RIGHT", both with something.
std::pair<std::string, std::string> split_pair(const std::string& option, const std::string& text) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos || at == 0 || at + 1 == text.size())
    throw UsageError(option + ": '" + text + "' has no = between two words");
  return {text.substr(0, at), text.substr(at + 1)};
}

void parse_pairs(TexadaptArguments& a) {
  for (const std::string& text : a.further_texts) {
    const auto [from, to] = split_pair("--also", text);
    a.further.push_back({from, to});
  }
  a.has_normal_map = !a.normal_map_text.empty();
  a.normal_map.from = a.normal_map_text;
  if (a.normal_map_text.find('=') != std::string::npos)
    std::tie(a.normal_map.from, a.normal_map.to) = split_pair("--normal-map", a.normal_map_text);
  if (a.normal_map.from == "flat") a.normal_map.from.clear();
  if (a.normal_map_y == "down") a.normal_map_options.y = NormalMapY::down;
  if (a.start_text.empty()) return;
  const auto [faces, map] = split_pair("--from", a.start_text);
  if (!parse_whole(faces, 1, kMostFaces, a.options.start_faces))
    throw UsageError("--from: '" + faces + "' is no number of faces");
  a.start = map;
}

std::string ending_of(const std::string& file) {
  std::string out = std::filesystem::path(file).extension().string();
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return out;
}

void choose_format(const std::string& output, TexadaptArguments& a) {
  const std::string ending = ending_of(output);
  const bool is_map = ending == ".exr" || ending == ".tif" || ending == ".tiff";
  if (a.format_name == "glb" || (a.format_name.empty() && ending == ".glb"))
    a.format = LevelFormat::glb;
  else if (a.format_name.empty() && is_map && !a.bake)
    a.format = LevelFormat::map;
  if (a.format == LevelFormat::png && (a.bake || !a.format_name.empty()))
    check_ending({"-o", output}, {".png"}, "a PNG");
  if (a.format == LevelFormat::png)
    check_ending({"-o", output}, {".png", ".glb", ".exr", ".tif", ".tiff"},
                 "a texture, a GLB or an indexing map");
  if (a.format == LevelFormat::glb) check_ending({"-o", output}, {".glb"}, "a GLB");
}

void check_combinations(const TexadaptArguments& a) {
  const bool has_map = a.engine != AdaptEngine::rebake && a.options.texel != TexelKind::texture;
  if (!has_map && (!a.index_map.empty() || a.format == LevelFormat::map || !a.start.empty()))
    throw UsageError(a.engine == AdaptEngine::rebake
                         ? "--engine rebake has no indexing map"
                         : "--texels texture adapts the texture and has no indexing map");
  if (!a.onto.empty() && a.engine != AdaptEngine::rebake)
    throw UsageError("--onto is for --engine rebake: a texture follows levels of PM alone");
  if (!has_map && a.has_normal_map)
    throw UsageError(
        "--normal-map wants an indexing map, which --engine rebake and --texels "
        "texture have not");
  if (!has_map && !a.further.empty() && a.engine != AdaptEngine::rebake)
    throw UsageError("--texels texture adapts one texture; --also wants an indexing map");
  if (a.engine == AdaptEngine::rebake && (!a.log.empty() || !a.replay.empty()))
    throw UsageError("--engine rebake knows no adaptations: no --log, no --replay");
  if (a.has_normal_map && a.normal_map.to.empty() && a.format != LevelFormat::glb)
    throw UsageError("--normal-map IMAGE alone is for --format glb; elsewhere: IMAGE=OUT.png");
  if (a.options.texel == TexelKind::texture && !a.size.empty())
    throw UsageError("--size is of an indexing map; --texels texture has none");
  if (a.format != LevelFormat::glb && a.quality)
    throw UsageError("--quality is of JPEGs in a .glb; other pictures are PNG");
  if (a.format != LevelFormat::glb && a.no_normal_map)
    throw UsageError("--no-normal-map is for a .glb, which has those of TEXTURE otherwise");
  if (a.keeps_repeating && (a.format != LevelFormat::glb || !a.onto.empty()))
    throw UsageError(
        "--keep-repeating is for levels as .glb, which hold the picture with the mesh");
  if (a.format == LevelFormat::map && a.texture_side > 0)
    throw UsageError("--texture-size is of pictures, not of an indexing map (--size)");
  if (a.format == LevelFormat::glb && !a.mesh.empty())
    throw UsageError("--format glb holds the mesh: no --mesh");
}

// Files with more than their path in the words typed, and those of every level.
void register_files(Tool& tool, const TexadaptArguments& a) {
  const std::string& output = tool.common().output;
  std::vector<NamedFile> inputs{
      {"the normal map that is read", texture_file(a.normal_map.from).string()},
      {"the map that is read", a.start}};
  std::vector<NamedFile> outputs;
  for (const FurtherTexture& f : a.further)
    inputs.push_back({"a texture that is read", texture_file(f.from).string()});
  for (const std::size_t level : a.levels) {
    outputs.push_back({"-o", a.name_at(output, level)});
    outputs.push_back({"--mesh", a.name_at(a.mesh, level)});
    outputs.push_back({"--index-map", a.name_at(a.index_map, level)});
    outputs.push_back({"--normal-map", a.name_at(a.normal_map.to, level)});
    for (const FurtherTexture& f : a.further) outputs.push_back({"--also", a.name_at(f.to, level)});
  }
  tool.reads(inputs);
  tool.writes(outputs);
}

void check_endings(const TexadaptArguments& a) {
  if (!a.mesh.empty()) check_ending({"--mesh", a.mesh}, {".ply", ".obj"}, "a mesh");
  if (!a.index_map.empty())
    check_ending({"--index-map", a.index_map}, {".exr", ".tif", ".tiff"}, "an indexing map");
  if (!a.log.empty()) check_ending({"--log", a.log}, {".adapt"}, "a log of adaptations");
  if (!a.normal_map.to.empty()) check_ending({"--normal-map", a.normal_map.to}, {".png"}, "a PNG");
  for (const FurtherTexture& f : a.further) check_ending({"--also", f.to}, {".png"}, "a PNG");
}

}  // namespace

std::string TexadaptArguments::name_at(const std::string& file, std::size_t level) const {
  if (file.empty() || !names_levels || file == "-") return file;
  const std::filesystem::path path(file);
  return (path.parent_path() /
          (path.stem().string() + "-" + std::to_string(level) + path.extension().string()))
      .string();
}

void declare_arguments(Tool& tool, TexadaptArguments& a) {
  tool.add_option("PM", &a.pm, "progressive mesh with texture coordinates (pmesh build)")
      .required()
      .reads("the progressive mesh that is read");
  tool.add_option("TEXTURE", &a.texture,
                  "its texture; row 0 is v = 1. A picture; one of a GLB's slots "
                  "(model.glb#normal); or a GLB, "
                  "glTF or OBJ with the pictures of its materials, of which several go into a .glb "
                  "together")
      .required()
      .reads("the texture that is read", texture_file);
  declare_levels(tool, a);
  tool.add_mesh_limit(tool);
  declare_outputs(tool, a);
  declare_engine(tool, a);
  tool.add_output_stem(
      "the texture for that level: .png; with its mesh: .glb; as an indexing map: .exr "
      "or .tif (-: a PNG to standard output)");
}

void finish_arguments(Tool& tool, TexadaptArguments& a) {
  if (a.faces)
    a.levels = {*a.faces};
  else if (!a.level_list.empty())
    a.levels = parse_levels(a.level_list), a.names_levels = true;
  else if (!a.onto.empty())
    a.levels = {0};  // none
  else
    throw UsageError("--faces N or --levels N,N,.. says which level");
  if (a.engine_name == "rebake") a.engine = AdaptEngine::rebake;
  if (a.engine_name == "gl") a.engine = AdaptEngine::gl;
  a.options.texel = parse_texel_kind(a.texel_name);
  a.normal_map_options.n_threads = tool.common().n_threads;
  a.options.adapt.n_threads = tool.common().n_threads;
  a.options.adapt.pack = !a.one_by_one;
  if (!a.size.empty()) parse_size(a.size, a.options);
  parse_pairs(a);
  choose_format(tool.common().output, a);
  check_combinations(a);
  if (a.names_levels && tool.common().output == "-" && a.levels.size() > 1)
    throw UsageError("-o - takes one level");
  if (a.names_levels && a.mesh.empty() && a.format != LevelFormat::glb &&
      tool.common().output != "-")
    a.mesh = std::filesystem::path(tool.common().output).replace_extension(".ply").string();
  check_endings(a);
  register_files(tool, a);
}

}  // namespace viewcell
