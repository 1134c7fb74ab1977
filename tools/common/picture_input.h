// Pictures that a tool reads: how large they may be, and what their reader did on the side is said.
#pragma once

#include <optional>
#include <string>

#include "common/tool.h"
#include "formats/texture_file.h"
#include "image/header.h"

namespace viewcell {

inline void declare_max_pixels(Command& command, std::optional<std::size_t>* max_pixels) {
  command
      .add_option(
          "--max-pixels", max_pixels,
          "read pictures of at most so many pixels (default: " + std::to_string(kMaxImagePixels) +
              ", and no more than is likely in a file of its size)")
      .check(whole_within(1, static_cast<std::uint64_t>(kMostImagePixels)));
}

/// read_texture (formats/texture_file.h); its remarks go to the tool. hash: of the file's bytes, if
/// wanted.
inline ImageRgba8 read_texture_input(const Tool& tool, const std::string& name,
                                     const std::optional<std::size_t>& max_pixels,
                                     std::string* hash = nullptr, int* lossy_quality = nullptr) {
  Remarks remarks;
  ImageRgba8 image = read_texture(name, hash, {{max_pixels}, &remarks}, lossy_quality);
  tool.remark(name, remarks);
  return image;
}

/// The same of one of a model's pictures.
inline ImageRgba8 decode_picture_input(const Tool& tool, const ModelPicture& picture,
                                       const std::optional<std::size_t>& max_pixels,
                                       int* lossy_quality = nullptr) {
  Remarks remarks;
  ImageRgba8 image = decode_texture(picture, {{max_pixels}, &remarks}, lossy_quality);
  tool.remark(picture.name, remarks);
  return image;
}

}  // namespace viewcell
