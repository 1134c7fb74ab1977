// What a collapse does to the triangles in the texture.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "pm/wedge_mesh.h"

namespace viewcell {

/// Texture coordinates of both ends of a pair of wedges once they are one: the parent's for a
/// half-edge collapse; for a full-edge one as far from the parent's to the child's as the place is
/// along the edge, from 0 to 1.
inline glm::vec2 merged_texcoord(const glm::vec2& child, const glm::vec2& parent, double along) {
  return along == 0 ? parent : glm::vec2(glm::mix(glm::dvec2(parent), glm::dvec2(child), along));
}

/// Whether the collapse u -> v, which the table has matched last, turns a triangle over in the
/// texture, or leaves one that had an area there without. Triangles that have none are not asked.
/// along: see merged_texcoord; 0 for a half-edge collapse.
bool turns_over_texture(const CollapseMesh& mesh, const WedgeTable& wedges,
                        std::span<const glm::vec2> texcoords, std::uint32_t u, std::uint32_t v,
                        double along);

}  // namespace viewcell
