#include "common/scene_inputs.h"

namespace viewcell {
namespace {

// The file that a list of cells is read from, if one is: see select_cells.
std::filesystem::path file_of_list(const std::string& list) {
  for (const std::string prefix : {"@", "path:"})
    if (list.starts_with(prefix)) return list.substr(prefix.size());
  return "";
}

}  // namespace

void declare_scene_inputs(Tool& tool, Target scene_file, Target cells_file,
                          std::string* cell_list) {
  tool.add_option("scene", scene_file, "scene.json").required().reads("the scene that is read");
  tool.add_option("cells", cells_file, "cells.json")
      .required()
      .reads("the file of cells that is read");
  tool.add_option("--cells", cell_list, "all | 3,7,10-19 | @FILE | path:path.json")
      .show_default()
      .reads("the file of --cells", file_of_list);
  tool.add_mesh_limit(tool);
}

void register_scene_files(Tool& tool, const Scene& scene, const std::filesystem::path& scene_file) {
  std::vector<NamedFile> files;
  for (const SceneMesh& mesh : scene.meshes)
    files.push_back({"a mesh of the scene", (scene_file.parent_path() / mesh.file).string()});
  for (const ScenePicture& picture : scene.pictures)
    files.push_back({"a picture of the scene", (scene_file.parent_path() / picture.file).string()});
  tool.reads(files);
  for (const auto& [file, remarks] : scene.remarks) tool.remark(file, remarks);
}

}  // namespace viewcell
