// What every reader of meshes promises, whatever the file.
#pragma once

#include <string_view>

#include "mesh/mesh.h"

namespace viewcell {

/// Finite numbers, indices in range, arrays of the right lengths, unit normals, colours in [0, 1].
void hold_mesh_laws(const TriMesh& mesh);

/// Reads the bytes as a file of that name. A mesh that is taken keeps the laws; written in one of
/// the formats, which the bytes' number decides, and read again, its triangles are where they were.
void fuzz_mesh_reader(const char* name, std::string_view bytes);

}  // namespace viewcell
