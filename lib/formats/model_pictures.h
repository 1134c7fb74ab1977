// The readers behind read_material_pictures. Private to this room.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "formats/material_pictures.h"

namespace viewcell {

/// The name's ending in lower case: ".obj".
std::string lower_ending_of(const std::filesystem::path& file);

MaterialPictures read_gltf_pictures(std::string_view bytes, const std::filesystem::path& file);

/// The materials that the OBJ uses, as its libraries have them, and their map_Kd.
MaterialPictures read_obj_pictures(std::string_view bytes, const std::filesystem::path& file);

}  // namespace viewcell
