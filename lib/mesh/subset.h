// Parts of meshes.
#pragma once

#include <vector>

#include "mesh/mesh.h"

namespace viewcell {

/// The triangles that are kept, in their order, over all vertices.
TriMesh keep_triangles(const TriMesh& mesh, const std::vector<bool>& is_kept);

}  // namespace viewcell
