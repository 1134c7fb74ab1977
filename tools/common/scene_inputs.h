// What tools that work on a scene and its cells read, and what stands in the folders between them.
#pragma once

#include <string>
#include <vector>

#include "common/mesh_input.h"
#include "common/tool.h"
#include "scene/scene.h"

namespace viewcell {

inline const std::vector<std::string> kCaptureFiles = {"captures.json", "centre-*.exr"};
inline const std::vector<std::string> kCellMeshFiles = {"cell-*.ply"};
/// All that stands in a bundle's folder is the bundle's.
inline const std::vector<std::string> kBundleFiles = {"**"};

/// Declares scene.json, cells.json, --cells and --max-triangles.
void declare_scene_inputs(Tool& tool, Target scene_file, Target cells_file, std::string* cell_list);

/// Registers the files that scene.json names: they are inputs, too. Says what was passed over in
/// them.
void register_scene_files(Tool& tool, const Scene& scene, const std::filesystem::path& scene_file);

}  // namespace viewcell
