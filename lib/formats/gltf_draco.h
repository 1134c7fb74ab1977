// Meshes as KHR_draco_mesh_compression packs them. Private to the room.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/json.h"
#include "mesh/mesh.h"

namespace viewcell {

/// What the primitive's accessors say that the bytes hold.
struct DracoShape {
  std::size_t n_vertices = 0, n_triangles = 0;
  /// By name ("POSITION"): Draco's number for it, and its components.
  struct Attribute {
    std::int64_t id = 0;
    std::size_t n_components = 0;
  };
  std::map<std::string, Attribute> attributes;
};

struct DracoMesh {
  std::vector<Triangle> triangles;  ///< of vertices that exist
  /// n_components a vertex, whole numbers as they are stored.
  std::map<std::string, std::vector<float>> attributes;
};

/// Decoded by Draco, which is given no more than `shape` allows: the counts in the bytes are held
/// against it before anything is decoded. Throws InputError at the extension.
DracoMesh decode_draco(std::string_view packed, const DracoShape& shape,
                       const JsonCursor& extension);

}  // namespace viewcell
