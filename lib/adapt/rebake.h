// A texture for a coarse mesh, made from nothing but the fine mesh and its texture: every texel
// takes the colour of the point of the fine surface that is nearest to it.
#pragma once

#include "base/parallel.h"
#include "image/image.h"
#include "mesh/mesh.h"

namespace viewcell {

struct RebakeOptions {
  int width_px = 0;   ///< of the result; 0: the texture's
  int height_px = 0;  ///< of the result; 0: the texture's
  int n_threads = 0;  ///< 0: all; the result does not depend on it
  Progress progress;  ///< called with the rows done
};

/// The texture of level, a simplified original, over level's own texture coordinates. A texel whose
/// centre lies in a triangle of level stands for a point of it, and shows what the nearest point of
/// original shows:
/// - of two sides of a thin sheet, the one that faces as level's triangle does;
/// - where that point lies on a seam of original, on the side whose texture coordinates are nearer
///   to the texel's own;
/// - fetched bilinearly from texels of the chart that was hit alone (chart_map.h).
/// Texels within 1.5 texels of a triangle show its nearest point, so that bilinear fetches on level
/// meet nothing else; all others copy the nearest of these (gutter.h). Where level shows nothing at
/// all the result is 0. Of triangles that share a texel, the lowest number wins.
///
/// Both meshes need texture coordinates, finite positions and indices in range, original a
/// triangle; parts outside [0, 1] are left out of the result and continue the texture's rim as a
/// source (see check_charts). Throws MachineError. About a microsecond a texel shown, on one
/// thread.
ImageRgba8 rebake_texture(const TriMesh& level, const TriMesh& original, const ImageRgba8& texture,
                          const RebakeOptions& options = {});

}  // namespace viewcell
