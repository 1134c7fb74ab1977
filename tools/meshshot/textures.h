// The textures that meshshot draws a mesh with.
#pragma once

#include <optional>
#include <vector>

#include "draw/mesh_renderer.h"
#include "meshshot/arguments.h"

namespace viewcell {

struct ShotTextures {
  std::optional<ImageRgba8> color, normal_map;
  std::vector<TexturedRun> runs;  ///< instead of color, where a model's materials have several
  std::optional<IndexMap> index_map;

  MeshTextures textures() const {
    if (!runs.empty()) return runs;
    return color ? &*color : nullptr;
  }
};

/// Reads what the arguments name, and sets their hashes. Triangles of the mesh are put in the order
/// of their pictures, where there are several. Throws InputError.
ShotTextures read_textures(const Tool& tool, MeshshotArguments& arguments, TriMesh& mesh);

}  // namespace viewcell
