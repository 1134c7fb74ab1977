// The textures that a mesh file names or holds.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace viewcell {

struct ListedTexture {
  std::string name;     ///< as the file has it: "skin.png", or "images[2]" of what a GLB holds
  std::string used_by;  ///< "baseColor of 'skin'", several with commas between; may be empty
  std::string format;   ///< "png"; empty where there is a fault
  int width_px = 0, height_px = 0;
  std::string fault;  ///< why it cannot be read; empty
};

/// Of GLB and glTF: all images; of OBJ: what its material libraries map; of PLY: "comment
/// TextureFile". In the order of the file, each once. Other formats, and "-", name none. Libraries
/// that are not there name none; nothing is decoded. Throws InputError for a file that is not
/// there, or a glTF that cannot be read.
std::vector<ListedTexture> list_textures(const std::filesystem::path& mesh_file);

}  // namespace viewcell
