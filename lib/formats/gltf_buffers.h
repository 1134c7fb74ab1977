// The accessors of a glTF file as arrays, every offset and count checked. Private to the room.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/json.h"
#include "mesh/mesh.h"

namespace viewcell {

/// A glTF file's JSON and its buffers.
struct GltfFile {
  std::filesystem::path file;
  Json json;
  std::vector<std::string> buffers;

  JsonCursor root() const { return {json, file}; }
};

/// Splits .glb or parses .gltf, and loads the buffers: embedded, base64, or files of its folder.
/// Throws InputError for anything else than glTF 2, for a required extension that changes geometry
/// in a way that is not read (Draco, meshopt), and for buffers shorter than they say.
GltfFile parse_gltf_file(std::string_view bytes, const std::filesystem::path& file);

/// Accessor `id` of n_components floats each; integers are normalised to [0, 1] or [-1, 1] where
/// the accessor says so. One after another.
std::vector<float> read_float_accessor(const GltfFile& gltf, std::int64_t id,
                                       std::size_t n_components);
/// A scalar accessor of unsigned integers.
std::vector<std::uint32_t> read_index_accessor(const GltfFile& gltf, std::int64_t id);
/// The bytes of image `id` as they are (PNG, JPEG, WebP): embedded, base64, or of a file of the
/// folder.
std::string read_image_bytes(const GltfFile& gltf, std::int64_t id);
/// 3 for "VEC3", and so on.
std::size_t accessor_components(const GltfFile& gltf, std::int64_t id);

}  // namespace viewcell
