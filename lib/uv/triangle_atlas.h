// Texture coordinates for any mesh: each triangle is a chart of its own.
#pragma once

#include <vector>

#include "mesh/mesh.h"

namespace viewcell {

/// For each corner a place in a picture of that size. Every triangle becomes a right-angled one,
/// two in a square, its longest edge the hypotenuse; squares are halved until their sides are in
/// proportion to the triangles', so far as powers of two can be. 4 texels lie between any two
/// triangles, for bilinear fetches; mipmaps mix their colours. Throws InputError(name) where the
/// picture is too small: 8 x 8 texels hold two triangles. O(n log n).
std::vector<glm::vec2> make_triangle_atlas(const TriMesh& mesh, int width_px, int height_px,
                                           const std::string& name);

}  // namespace viewcell
