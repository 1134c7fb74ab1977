// How far a file may grow as it is read. Private to the room.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "formats/mesh_file.h"

namespace viewcell {

/// Above it no file states a triangle in fewer bytes, unless it places one several times or packs
/// it.
inline constexpr std::uint64_t kMostTrianglesPerByte = 8;
inline constexpr std::uint64_t kAlwaysAllowedTriangles = 1 << 24;

inline double most_triangles(const MeshLimits& limits, std::uint64_t n_bytes) {
  return static_cast<double>(limits.max_triangles != 0 ? std::uint64_t{limits.max_triangles}
                                                       : std::max(kAlwaysAllowedTriangles,
                                                                  kMostTrianglesPerByte * n_bytes));
}

/// "120000000 triangles are more than the 16777216 that a file may become (--max-triangles ...)".
std::string describe_growth(double n, const char* of_what, double most);

}  // namespace viewcell
