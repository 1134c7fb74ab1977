// The pictures that a model's materials name, each with the materials that share it.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "base/remarks.h"
#include "formats/glb_material.h"

namespace viewcell {

/// A picture as it lies in the file.
struct ModelPicture {
  std::string bytes;
  std::string name;  ///< for errors: "model.glb: images[3]"
};

/// A material that faces have.
struct PicturedMaterial {
  std::string name;  ///< as read_mesh names it; the look has the file's own name, or none
  GlbMaterial look;  ///< without its pictures
  int color = -1;    ///< index of MaterialPictures::pictures; -1: none
  int normal = -1;
};

struct MaterialPictures {
  std::vector<PicturedMaterial> materials;  ///< in the file's order
  std::vector<ModelPicture> pictures;
  Remarks remarks;   ///< textures of other slots, which are left out
  std::string hash;  ///< hash_hex of the model's file
};

/// By name; null: none has it.
const PicturedMaterial* find_material(const MaterialPictures& model, const std::string& name);
/// Different pictures of materials' colours.
std::size_t count_colors(const MaterialPictures& model);

/// Whether pictures can be asked for by materials: GLB, glTF, and OBJ, whose material libraries
/// then say which (map_Kd).
bool has_material_pictures(const std::filesystem::path& file);

/// What becomes of a picture that is missing or refused.
enum class PictureFaults {
  refuse,    ///< an error
  leave_out  ///< the material has none, which is a remark that names it; so with an OBJ's libraries
};

/// Files that a model names lie in its folder. Metal and roughness are those of the material where
/// no texture of theirs is left out, otherwise 0 and 1. Throws InputError for what read_texture
/// (texture_file.h) refuses, for options of map_Kd that move the picture, and for an OBJ none of
/// whose libraries is there.
MaterialPictures read_material_pictures(const std::filesystem::path& file,
                                        PictureFaults faults = PictureFaults::refuse);

}  // namespace viewcell
