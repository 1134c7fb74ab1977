// Shader text of the hybrid mode.
#pragma once

#include <string>

#include "scene/lighting.h"

namespace viewcell {

/// n_views: 0 (lit only), 1, or 2 (blended). Vertex inputs: 0 position (cell-local), 1 normal.
/// Uniform mat4 clip_from_local; uniform block 0 DrawBlock as in hybrid_renderer.cpp; texture unit
/// 0: the texels.
std::string make_hybrid_vertex_glsl(int n_views, const Lighting& lighting);
std::string make_hybrid_fragment_glsl(int n_views);
/// Plain dark edges for wireframes.
std::string make_edge_fragment_glsl();

}  // namespace viewcell
