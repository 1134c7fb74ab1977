// Images as plain arrays; row 0 is the top, pixel centres at +0.5.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace viewcell {

/// width_px x height_px pixels of type Pixel, row by row from the top.
template <typename Pixel>
struct Image {
  int width_px = 0;
  int height_px = 0;
  std::vector<Pixel> pixels;

  Image() = default;
  Image(int width, int height, Pixel fill = {})
      : width_px(width),
        height_px(height),
        pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill) {}
  Pixel& at(int x, int y) { return pixels[offset(x, y)]; }
  const Pixel& at(int x, int y) const { return pixels[offset(x, y)]; }
  std::size_t offset(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) +
           static_cast<std::size_t>(x);
  }
  bool empty() const { return pixels.empty(); }
};

/// 8-bit sRGB with alpha. In frames alpha is 255 where an object is drawn, 0 on ground and sky.
using Rgba8 = std::array<std::uint8_t, 4>;
using ImageRgba8 = Image<Rgba8>;
/// Linear.
using RgbaFloat = std::array<float, 4>;
using ImageRgbaFloat = Image<RgbaFloat>;

}  // namespace viewcell
