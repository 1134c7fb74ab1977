// meshinfo: what there is to know of a mesh file before anything is done with it.
#include "base/error.h"
#include "base/file.h"
#include "common/tool.h"
#include "report/mesh_info.h"

namespace viewcell {
namespace {

struct Arguments {
  std::vector<std::string> files;
  int texture_px = 1024;
};

void declare(Tool& tool, Arguments& arguments) {
  tool.add_option("FILE", &arguments.files,
                  "meshes: OBJ, PLY, PLY.GZ, OFF, STL, GLB, glTF or 3DS (-: standard input); "
                  "several: a table")
      .required()
      .reads("mesh %, which is read");
  tool.add_option("--texture-size", &arguments.texture_px,
                  "side of the texture that charts are checked on, px, where the file names none")
      .show_default()
      .check(in_range(16, 4096));
  tool.add_output("write the text to this file (default -: standard output)", false);
}

int run(const Tool& tool, const Arguments& arguments) {
  std::vector<MeshInfo> infos(arguments.files.size());
  parallel_for(infos.size(), tool.common().n_threads, [&](std::size_t i) {
    infos[i] = measure_mesh_file(arguments.files[i], arguments.texture_px);
  });
  const CommonOptions& common = tool.common();
  const std::string text_file = common.output.empty() ? "-" : common.output;
  if (!(common.json_file == "-" && text_file == "-"))
    write_file(text_file,
               infos.size() == 1 ? format_mesh_info(infos[0]) : format_mesh_table(infos));
  Json files = Json::array();
  for (const MeshInfo& info : infos) files.push_back(report_mesh_info(info));
  tool.report({{"files", files}});
  return 0;
}

}  // namespace
}  // namespace viewcell

int main(int argc, char** argv) {
  viewcell::Tool tool(
      "meshinfo",
      "Says what a mesh file holds: counts, size, parts and borders, what is not manifold, "
      "normals, "
      "texture coordinates and their charts, materials, pictures and their sizes, what readers "
      "leave out, and which \"up\" and \"scale\" a scene would want.",
      "meshinfo model.glb\n  meshinfo models/*.ply --json models.json");
  viewcell::Arguments arguments;
  viewcell::declare(tool, arguments);
  return tool.main(argc, argv, [&] { return viewcell::run(tool, arguments); });
}
