// The accessors of a glTF file as arrays, every offset and count checked, sparse ones filled in.
// Private to the room.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/gltf_buffers.h"

namespace viewcell {

/// How an accessor's numbers are to be taken.
struct GltfNumbers {
  std::size_t count = 0, n_components = 0;  ///< 3 for "VEC3", 16 for "MAT4"
  std::int64_t component_type = 0;
  bool normalized = false;

  /// What whole numbers are multiplied by: 1, or what takes the largest to 1.
  float scale() const;
};
GltfNumbers read_accessor_shape(const GltfFile& gltf, std::int64_t id);

/// What integers in an accessor stand for.
enum class GltfIntegers {
  as_said,  ///< themselves, or [0, 1] or [-1, 1] where it is "normalized"
  shares    ///< [0, 1] or [-1, 1] always: colours and weights, for which nothing else is allowed
};

/// Accessor `id` of n_components floats each, one after another.
std::vector<float> read_float_accessor(const GltfFile& gltf, std::int64_t id,
                                       std::size_t n_components,
                                       GltfIntegers integers = GltfIntegers::as_said);
/// Of unsigned integers.
std::vector<std::uint32_t> read_integer_accessor(const GltfFile& gltf, std::int64_t id,
                                                 std::size_t n_components);

}  // namespace viewcell
