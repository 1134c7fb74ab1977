// What a collapse does to the triangles in the texture.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "pm/wedge_mesh.h"

namespace viewcell {

/// Whether the collapse u -> v, which the table has matched last, turns a triangle over in the
/// texture, or leaves one that had an area there without. Triangles that have none are not asked.
/// merged: what the wedges of each of the table's pairs get. full: those of v get it, too.
bool turns_over_texture(const CollapseMesh& mesh, const WedgeTable& wedges,
                        std::span<const glm::vec2> texcoords, std::uint32_t u, std::uint32_t v,
                        std::span<const glm::vec2> merged, bool full);

}  // namespace viewcell
