#include "common/scene_inputs.h"

#include <set>

namespace viewcell {
namespace {

// The file that a list of cells is read from, if one is: see select_cells.
std::filesystem::path file_of_list(const std::string& list) {
  for (const std::string prefix : {"@", "path:"})
    if (list.starts_with(prefix)) return list.substr(prefix.size());
  return "";
}

// More files than these with remarks are told of together.
constexpr std::size_t kMostFilesTold = 3;

// "far from the origin: positions are kept about (1, 2, 3)" without what is each file's own.
std::string common_part(std::string what) {
  const auto open = what.rfind(" (");
  if (open == std::string::npos || !what.ends_with(')')) return what;
  what.erase(open);
  return what.ends_with(" about") ? what + " offsets" : what;
}

// The remarks of all files by kind, each with the number of its files.
Remarks sum_remarks(const std::vector<FileRemarks>& files) {
  Remarks sums, n_files;
  for (const auto& [file, remarks] : files) {
    std::set<std::string> kinds;
    for (const auto& [what, count] : remarks) {
      const std::string kind = common_part(what);
      add_remark(&sums, kind, count);
      if (kinds.insert(kind).second) add_remark(&n_files, kind);
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i)
    sums[i].what += ", in " + std::to_string(n_files[i].count) + " files";
  return sums;
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
  if (scene.remarks.size() > kMostFilesTold)
    tool.remark(scene_file, sum_remarks(scene.remarks));
  else
    for (const auto& [file, remarks] : scene.remarks) tool.remark(file, remarks);
}

}  // namespace viewcell
