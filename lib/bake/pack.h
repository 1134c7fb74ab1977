// Packing captures and meshes into a bundle.
#pragma once

#include "bake/weighted_mesh_file.h"
#include "base/parallel.h"
#include "bundle/bundle.h"
#include "capture/captures.h"

namespace viewcell {

struct PackInputs {
  std::filesystem::path scene_file, cells_file, captures, svmesh, mvmesh;
};

struct PackCounts {
  std::size_t n_cells = 0, n_centres = 0;
  std::size_t n_single_view = 0, n_multi_view = 0, n_unseen = 0;   ///< object-cell pairs, as are
  std::size_t n_inside = 0, n_own = 0;                             ///< those drawn as they are
  std::size_t n_triangles_originals = 0, n_triangles_outside = 0;  ///< over all cells
  std::size_t texel_bytes = 0;
};

/// Packs the given cells. Each needs its PLY in both svmesh and mvmesh, and every object outside a
/// cell must be in exactly one of them; otherwise InputError. All inputs are checked before
/// anything is written; a bundle that was there plays on until the new one is whole
/// (bundle/bundle_writer.h). cells: read from inputs.cells_file.
PackCounts pack_bundle(const Scene& scene, const CellSet& cells, const PackInputs& inputs,
                       const std::vector<CellId>& list, TextureFormat format, const Json& made_by,
                       const std::filesystem::path& bundle, int n_threads,
                       const Progress& progress);

/// Encodes a filled capture as a tile: appends its texels. is_masked: of an object with masks,
/// where code 0 says that a texel shows nothing of it.
void append_tile(const CaptureTile& tile, bool is_masked, CentreTextures& textures);

}  // namespace viewcell
