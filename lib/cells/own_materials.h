// Which objects outside a cell are better drawn as they are, in their own materials.
#pragma once

#include "cells/cells.h"

namespace viewcell {

struct OwnMaterialOptions {
  int resolution_px = 1024;  ///< of the captures, per width of a side face
  /// Pixels of a capture, by the object's ball, that a triangle is worth: of plain objects, and of
  /// those with a picture or colours, of which texels show less than the object itself.
  double px_per_triangle = 256, px_per_detailed_triangle = 32;
  std::size_t few_triangles = 64;  ///< as many are always worth it
};

/// By cell, ascending: the objects outside that are drawn as they are. Either of few triangles for
/// what shows of them: captures would cost more, in texels and draws, and show less. Or with a
/// picture or colours, and so near that captures, which have a texel a pixel as seen from the
/// centres, would have less than half a texel a pixel at some eye of the cell: nearer to the cell's
/// centre than twice its size. The scene's meshes must be there.
std::vector<std::vector<ObjectId>> find_own_materials(const Scene& scene, const CellSet& cells,
                                                      const OwnMaterialOptions& options = {});

}  // namespace viewcell
