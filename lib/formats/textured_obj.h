// An OBJ with its material library and its picture: three files that belong together.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace viewcell {

/// Writes NAME.obj, NAME.mtl and the picture, NAME + picture_extension (".png"), in one folder; the
/// mesh has one material, called NAME. write_picture fills the file that it is given. All three are
/// written beside their places and then renamed, the OBJ last; an OBJ that was there is removed
/// before: after a kill it is absent, or old or new with its own files. Throws MachineError.
void write_textured_obj(const std::filesystem::path& obj, const TriMesh& mesh,
                        const std::string& picture_extension,
                        const std::function<void(const std::filesystem::path&)>& write_picture,
                        const std::vector<std::string>& comments);

}  // namespace viewcell
