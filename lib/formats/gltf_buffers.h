// A glTF file taken apart: its JSON, its buffers and views of them, every offset and size checked.
// Private to the room.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/json.h"
#include "base/remarks.h"

namespace viewcell {

/// A buffer view's bytes; stride: its "byteStride", or 0.
struct GltfView {
  std::string_view bytes;
  std::size_t stride = 0;
};

/// A glTF file's JSON and its buffers. Not for several threads at once.
struct GltfFile {
  struct Decoded {
    std::string bytes;
    std::size_t stride = 0;
  };

  std::filesystem::path file;
  Json json;
  /// Empty where a buffer only stands for what compressed views hold.
  std::vector<std::string_view> buffers;
  std::map<std::string, std::string> loaded;  ///< by URI: what lies outside the file's own bytes
  std::uint64_t n_bytes = 0;                  ///< of the file and of `loaded`
  /// Of compressed views, made when first asked for.
  mutable std::map<std::int64_t, Decoded> decoded;
  mutable std::uint64_t n_decoded = 0;  ///< bytes in them

  JsonCursor root() const { return {json, file}; }
};

/// Splits .glb or parses .gltf, and loads the buffers: embedded, base64, or files of its folder.
/// bytes must outlive the result. Throws InputError for anything else than glTF 2, for a required
/// extension that is not read, and for buffers shorter than they say. remarks: extensions that are
/// used, not required, and not read.
GltfFile parse_gltf_file(std::string_view bytes, const std::filesystem::path& file,
                         Remarks* remarks = nullptr);

/// Decoded where it is compressed (EXT_meshopt_compression).
GltfView read_view(const GltfFile& gltf, std::int64_t id);

/// The bytes of image `id` as they are (PNG, JPEG, WebP): embedded, base64, or of a file of the
/// folder.
std::string read_image_bytes(const GltfFile& gltf, std::int64_t id);

/// An index of an array of the file: a whole number from 0 on.
std::int64_t gltf_index(const JsonCursor& value);
/// Of object[key], or -1 without it.
std::int64_t optional_gltf_index(const JsonCursor& object, const char* key);
/// object["extensions"][name], if it is there.
bool has_extension(const JsonCursor& object, const char* name);
JsonCursor extension_of(const JsonCursor& object, const char* name);

}  // namespace viewcell
