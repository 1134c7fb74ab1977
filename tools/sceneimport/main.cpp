// sceneimport: makes a scene of a level that another program wrote.
#include <algorithm>
#include <cstdio>

#include "base/error.h"
#include "base/file.h"
#include "base/folder_lock.h"
#include "common/length.h"
#include "common/mesh_input.h"
#include "common/picture_input.h"
#include "common/provenance.h"
#include "common/tool.h"
#include "formats/texture_list.h"
#include "import/import_level.h"

namespace viewcell {
namespace {

struct Options {
  std::string level;
  std::string unit = "m";
  std::optional<std::size_t> max_pixels;
  ImportOptions import;
};

double parse_unit(const std::string& text) {
  if (text == "m") return 1;
  if (text == "cm") return 0.01;
  if (text == "mm") return 0.001;
  if (text == "ft") return 0.3048;
  if (text == "in") return 0.0254;
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || *end != 0 || !(value >= 1e-6 && value <= 1e6))
    throw UsageError("--unit: '" + text + "' is not m, cm, mm, ft, in or metres from 1e-6 to 1e6");
  return value;
}

void declare(Tool& tool, Options& o) {
  tool.add_option("level", &o.level, "GLB, glTF or OBJ, or any other mesh file")
      .required()
      .reads("the level that is read");
  tool.add_option("--unit", &o.unit, "what the file's 1 is: m, cm, mm, ft, in, or so many metres")
      .show_default();
  tool.add_option("--up", &o.import.up, "the file's axis that points up: x, y, z, -x, -y or -z")
      .show_default()
      .check(one_of({"x", "y", "z", "-x", "-y", "-z"}));
  tool.add_option("--floor", &o.import.floor_m,
                  "height that people stand at, in metres along the axis that points up (default: "
                  "where most of the area lies that faces upwards)")
      .check(within(-1e6, 1e6));
  tool.add_option("--piece", &o.import.piece_m,
                  "side of the pieces that the level is cut into, in metres (default: 8, or more "
                  "of a level that would have more than some thousand)")
      .check(within(0.01, 1e6));
  tool.add_option("--max-texture", &o.import.max_texture_px,
                  "make pictures smaller whose longer side has more pixels")
      .show_default()
      .check(in_range(16, kMaxImageSidePx));
  declare_max_pixels(tool, &o.max_pixels);
  tool.add_mesh_limit(tool);
  tool.add_output_folder("folder to write: scene.json, meshes/, textures/",
                         {"scene.json", "meshes/*", "textures/*"});
}

Json make_report(const ImportedLevel& level) {
  const glm::dvec3 size = level.box_m.size();
  return {{"triangles", count_triangles(level.scene)},
          {"objects", level.scene.objects.size()},
          {"materials", level.scene.materials.size()},
          {"pictures", level.pictures.size()},
          {"size_m", {size.x, size.y, size.z}},
          {"floor_m", level.floor_m},
          {"components", level.pieces.n_components},
          {"components_cut", level.pieces.n_cut},
          {"triangles_dropped", level.pieces.n_dropped},
          {"units_per_metre", kUnitsPerMetre},
          {"piece_m", level.piece_m}};
}

// Most levels are rooms, streets and landscapes.
void hint_at_unit(const Tool& tool, const ImportedLevel& level) {
  const glm::dvec3 size = level.box_m.size();
  const double largest = std::max({size.x, size.y, size.z});
  if (largest >= 2 && largest <= 20000) return;
  char text[160];
  std::snprintf(text, sizeof text,
                "the level is %.3g m long: if that is not so, say --unit (m, cm, mm or a number)",
                largest);
  tool.say(text);
}

// Files beside the level that it names are inputs, too.
void register_pictures(Tool& tool, const std::string& level) {
  std::vector<NamedFile> files;
  const std::filesystem::path folder = std::filesystem::path(level).parent_path();
  for (const ListedTexture& texture : list_textures(level))
    if (!texture.name.starts_with("images["))
      files.push_back({"a picture of the level", (folder / texture.name).string()});
  tool.reads(files);
}

int run(Tool& tool, Options& o) {
  o.import.unit_m = parse_unit(o.unit);
  register_pictures(tool, o.level);
  o.import.limits = mesh_limits(tool);
  o.import.image_limits = {o.max_pixels};
  ImportedLevel level = import_level(o.level, o.import);
  tool.remark(o.level, level.remarks);
  hint_at_unit(tool, level);
  const Json made_by = make_provenance(tool,
                                       {{"unit_m", o.import.unit_m},
                                        {"up", o.import.up},
                                        {"floor_m", level.floor_m},
                                        {"piece_m", level.piece_m},
                                        {"max_texture", o.import.max_texture_px}},
                                       {{"level", level.hash}});
  make_folder(tool.common().output);
  const FolderLock lock(tool.common().output, tool.name(), hash_hex(made_by.dump()));
  write_level(level, tool.common().output, made_by, tool.progress("mesh"));
  tool.report(make_report(level));
  tool.say(std::to_string(count_triangles(level.scene)) + " triangles in " +
           std::to_string(level.scene.objects.size()) + " objects, " +
           std::to_string(level.pictures.size()) + " pictures");
  return 0;
}

}  // namespace
}  // namespace viewcell

int main(int argc, char** argv) {
  viewcell::Tool tool("sceneimport", "Make a scene of a level: GLB, glTF or OBJ.",
                      "sceneimport house.glb -o house/");
  viewcell::Options options;
  viewcell::declare(tool, options);
  return tool.main(argc, argv, [&] { return viewcell::run(tool, options); });
}
