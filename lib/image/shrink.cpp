#include "image/shrink.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "base/srgb.h"

namespace viewcell {
namespace {

using Sum = std::array<double, 4>;
constexpr double kOpaque = 1 - 1e-9;  // all of a pixel's alpha, up to rounding

// The pixels that new pixel i of n covers of n_old, and how much of each.
struct Covered {
  int first = 0;
  std::vector<double> shares;  // add up to 1
};

Covered find_covered(int i, int n, int n_old) {
  const double lo = double(i) * n_old / n, hi = double(i + 1) * n_old / n;
  Covered out;
  out.first = static_cast<int>(lo);
  for (int at = out.first; at < n_old && at < hi; ++at)
    out.shares.push_back((std::min(hi, at + 1.0) - std::max(lo, double(at))) / (hi - lo));
  return out;
}

std::array<double, 256> make_decoding(PixelKind kind) {
  std::array<double, 256> out;
  for (int i = 0; i < 256; ++i)
    out[static_cast<std::size_t>(i)] =
        kind == PixelKind::color ? double(srgb_decode(static_cast<float>(i) / 255)) : i / 255.0;
  return out;
}

std::uint8_t encode_channel(double x, bool is_color) {
  if (is_color) return srgb8_from_linear(static_cast<float>(x));
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(x, 0.0, 1.0)));
}

}  // namespace

ImageRgba8 shrink(const ImageRgba8& image, int width_px, int height_px, PixelKind kind,
                  int n_threads) {
  VIEWCELL_CHECK(
      width_px >= 1 && height_px >= 1 && width_px <= image.width_px && height_px <= image.height_px,
      width_px, height_px, image.width_px, image.height_px);
  const std::array<double, 256> decoding = make_decoding(kind);
  std::vector<Covered> columns;
  for (int x = 0; x < width_px; ++x) columns.push_back(find_covered(x, width_px, image.width_px));
  ImageRgba8 out(width_px, height_px);
  parallel_for(static_cast<std::size_t>(height_px), n_threads, [&](std::size_t row) {
    const auto y = static_cast<int>(row);
    const Covered rows = find_covered(y, height_px, image.height_px);
    for (int x = 0; x < width_px; ++x) {
      const Covered& across = columns[static_cast<std::size_t>(x)];
      Sum sum{}, seen{};  // of all pixels; of each times its alpha
      for (std::size_t j = 0; j < rows.shares.size(); ++j)
        for (std::size_t i = 0; i < across.shares.size(); ++i) {
          const Rgba8& p =
              image.at(across.first + static_cast<int>(i), rows.first + static_cast<int>(j));
          const double share = rows.shares[j] * across.shares[i], alpha = p[3] / 255.0;
          for (std::size_t c = 0; c < 3; ++c) {
            sum[c] += share * decoding[p[c]];
            seen[c] += share * alpha * decoding[p[c]];
          }
          sum[3] += share * alpha;
        }
      const bool by_alpha = kind == PixelKind::color && sum[3] > 0 && sum[3] < kOpaque;
      for (std::size_t c = 0; c < 4; ++c)
        out.at(x, y)[c] = encode_channel(by_alpha && c < 3 ? seen[c] / sum[3] : sum[c],
                                         c < 3 && kind == PixelKind::color);
    }
  });
  return out;
}

ImageRgba8 shrink_to_side(const ImageRgba8& image, int max_side_px, PixelKind kind, int n_threads) {
  const int side = std::max(image.width_px, image.height_px);
  if (side <= max_side_px) return image;
  const auto scaled = [&](int px) {
    return std::max(1, static_cast<int>(std::lround(double(px) * max_side_px / side)));
  };
  return shrink(image, scaled(image.width_px), scaled(image.height_px), kind, n_threads);
}

}  // namespace viewcell
