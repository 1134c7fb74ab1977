// Normal maps for levels of a progressive mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "image/image.h"
#include "image/index_map.h"
#include "image/normal_code.h"
#include "mesh/mesh.h"

namespace viewcell {

/// A mesh with texture coordinates, and the charts of its triangles (LevelCharts).
struct ChartedMesh {
  const TriMesh& mesh;
  const std::vector<std::uint32_t>& charts;
};

struct NormalMapOptions {
  NormalMapY y = NormalMapY::up;  ///< of the map that is read; what is written has green up
  int n_threads = 0;              ///< 0: all; the result does not depend on it
};

struct BakedNormalMap {
  ImageRgba8 image;           ///< linear, green up; of the index map's size
  std::size_t n_texels = 0;   ///< in triangles of the level or on their rims
  std::size_t n_clamped = 0;  ///< of these: normals below the level's surface, projected into it
};

/// The normal map with which level shows the normals that finest shows with normal_map.
///
/// A texel of the level stands for the point of finest's texture that map holds there. The normal
/// that finest has there, its map's in the frame of its tangents, normals and triangle at that
/// point, is expressed in the level's frame at the texel's centre. Both frames are those of
/// mesh/tangents.h, with the meshes' own normals or, where they have none, make_vertex_normals':
/// drawn with other normals or tangents the map is wrong. A code's length is kept, so where map
/// holds a texel's own texture coordinates and the frame is still finest's, the codes come back.
///
/// normal_map: any size, fetched bilinearly among texels of charts, which are continued a few
/// texels outwards; null: flat, so what is baked is the smooth shading of finest.
/// A normal below the level's surface (z < 0), which no map may hold, is projected into its plane
/// and counted. Texels within 1.5 texels of a triangle take part in it with their nearest point;
/// all others copy the nearest of these. The same bytes for any number of threads. About a
/// microsecond a texel on one thread.
/// Follows: [Cohen 1998] for the idea of normals kept in a texture; [Chen06 3.2.4] for the map.
BakedNormalMap bake_normal_map(const IndexMap& map, const ImageRgba8* normal_map,
                               const ChartedMesh& finest, const ChartedMesh& level,
                               const NormalMapOptions& options = {});

}  // namespace viewcell
