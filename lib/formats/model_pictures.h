// The readers behind read_material_pictures. Private to this room.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "formats/material_pictures.h"

namespace viewcell {

/// The name's ending in lower case: ".obj".
std::string lower_ending_of(const std::filesystem::path& file);

/// What picture() gives, or -1 and a remark when it throws InputError and faults are left out.
int or_left_out(PictureFaults faults, Remarks& remarks, const std::function<int()>& picture);

MaterialPictures read_gltf_pictures(std::string_view bytes, const std::filesystem::path& file,
                                    PictureFaults faults = PictureFaults::refuse);

/// The materials that the OBJ uses, as its libraries have them, and their map_Kd.
MaterialPictures read_obj_pictures(std::string_view bytes, const std::filesystem::path& file,
                                   PictureFaults faults = PictureFaults::refuse);

}  // namespace viewcell
