// Indexing maps: pictures of texture coordinates, and their files (docs/formats.md).
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>

#include "image/header.h"
#include "image/image.h"

namespace viewcell {

/// Each texel holds texture coordinates (u, v) into another picture; v runs up, rows down: the
/// identity holds ((x + 0.5) / width, 1 - (y + 0.5) / height) at (x, y). Follows: [Chen06 3.2.4].
using IndexMap = Image<glm::vec2>;

/// What texel (x, y) of the identity holds [Chen06 3.2.4].
inline glm::vec2 own_texcoords(int x, int y, int width_px, int height_px) {
  return {float((x + 0.5) / width_px), float(1 - (y + 0.5) / height_px)};
}

/// Writes a map, whole or not at all, by the file's ending:
/// - .exr, and "-" (standard output): two channels of float, "texcoord.u" and "texcoord.v", zip;
///   bit for bit, with coordinates outside [0, 1] too;
/// - .tif, .tiff: two channels of 16 bits, round(65535 * coordinate), clamped to [0, 1]; zip.
/// The same map gives the same bytes: no date. Every number must be finite, the map not empty.
/// label: a line about what the map is of, kept as the picture's description.
/// Throws UsageError for another ending, MachineError when it cannot be written.
void write_index_map(const std::filesystem::path& file, const IndexMap& map,
                     const std::string& label = "");

/// Reads both back ("-": standard input), recognised by their first bytes, and a two-channel TIFF
/// of 8 bits. An EXR gives its data window. hash: hash_hex of the file's bytes; label: "" where
/// there is none; if wanted. Size, channels and their types are checked before pixels are read.
/// Throws InputError for all else, and for numbers that are not finite or beyond 1e30.
IndexMap read_index_map(const std::filesystem::path& file, std::string* hash = nullptr,
                        std::string* label = nullptr, const ImageLimits& limits = {});

}  // namespace viewcell
