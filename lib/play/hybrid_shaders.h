// Shader text of the hybrid mode.
#pragma once

#include <string>

#include "scene/lighting.h"

namespace viewcell {

/// What is drawn of a surface.
enum class DrawnSides {
  front,
  both,   ///< also where either side has triangles of its own
  masked  ///< with holes, as both: fragments that the views see through are discarded
};

/// n_views: 0 (lit only), 1, or 2 (blended). Of both sides each is lit on its own, and a view shows
/// a fragment only from the eye's side of its triangle. Vertex inputs: 0 position (cell-local), 1
/// normal. Uniform mat4 clip_from_local; uniform block 0 DrawBlock as in hybrid_renderer.cpp;
/// texture unit 0: the texels.
std::string make_hybrid_vertex_glsl(int n_views, DrawnSides sides, const Lighting& lighting);
std::string make_hybrid_fragment_glsl(int n_views, DrawnSides sides);
/// Plain dark edges for wireframes.
std::string make_edge_fragment_glsl();

}  // namespace viewcell
