// Buffer views as EXT_meshopt_compression packs them. Private to the room.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "base/json.h"

namespace viewcell {

/// What the extension says of a view.
struct MeshoptView {
  std::size_t count = 0, stride = 0;
  std::string mode, filter;
};
/// Throws InputError for what is out of range, or does not fit together. most_bytes: of count *
/// stride.
MeshoptView read_meshopt_view(const JsonCursor& extension, std::size_t n_packed,
                              std::size_t most_bytes);

/// count * stride bytes. Throws InputError at the extension when `packed` does not hold them.
/// Decoded by meshoptimizer, which reads version 0 of each stream.
std::string decode_meshopt(const MeshoptView& view, std::string_view packed,
                           const JsonCursor& extension);

}  // namespace viewcell
