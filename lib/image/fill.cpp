#include "image/fill.h"

#include <algorithm>
#include <array>
#include <vector>

#include "base/error.h"

// Follows: [Gortler96 3.4.1], "pull" and "push" over a pyramid, with weights that saturate at once:
// a coarse pixel is the mean of its masked children and as good as masked itself.
//
// Not OpenImageIO's fillholes_pushpull (2.4.7): over 80 crops of the demo's captures (2.1 million
// pixels, 51 % seen), on one thread, that takes 0.42 us a pixel and this 0.016, where writing a
// capture takes 0.16. Its filters are wider: seen pixels that are taken away in blocks of 8 x 8
// come back at 26.9 dB, here at 25.2 (1/z: 0.8 and 1.2 % off). Both keep seen pixels to the bit and
// stay within their range, whatever the size; there the holes themselves have to be cleared first.

namespace viewcell {
namespace {

// One level of the pyramid; the finest lies in the caller's arrays.
struct Level {
  int width_px, height_px, n_channels;
  float* samples;
  const std::uint8_t* is_set;

  std::size_t pixel(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) +
           static_cast<std::size_t>(x);
  }
  float* at(std::size_t pixel) const {
    return samples + pixel * static_cast<std::size_t>(n_channels);
  }
};

struct OwnedLevel {
  std::vector<float> samples;
  std::vector<std::uint8_t> is_set;
  Level level;

  OwnedLevel(int width_px, int height_px, int n_channels)
      : samples(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) *
                static_cast<std::size_t>(n_channels)),
        is_set(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)),
        level{width_px, height_px, n_channels, samples.data(), is_set.data()} {}
  OwnedLevel(OwnedLevel&&) = default;  // the arrays stay where they are, so level stays valid
};

// The coarse pixel (x, y) from its up to four children.
void pull_pixel(const Level& fine, OwnedLevel& coarse, int x, int y) {
  const std::size_t to = coarse.level.pixel(x, y);
  float* sum = coarse.level.at(to);
  int n = 0;
  for (int j = 2 * y; j < std::min(2 * y + 2, fine.height_px); ++j)
    for (int i = 2 * x; i < std::min(2 * x + 2, fine.width_px); ++i) {
      const std::size_t from = fine.pixel(i, j);
      if (!fine.is_set[from]) continue;
      const float* child = fine.at(from);
      for (int c = 0; c < fine.n_channels; ++c) sum[c] += child[c];
      ++n;
    }
  if (n == 0) return;
  const float scale = 1.f / static_cast<float>(n);
  for (int c = 0; c < fine.n_channels; ++c) sum[c] *= scale;
  coarse.is_set[to] = 1;
}

OwnedLevel pull(const Level& fine) {
  OwnedLevel coarse((fine.width_px + 1) / 2, (fine.height_px + 1) / 2, fine.n_channels);
  for (int y = 0; y < coarse.level.height_px; ++y)
    for (int x = 0; x < coarse.level.width_px; ++x) pull_pixel(fine, coarse, x, y);
  return coarse;
}

// A fine pixel's centre lies a quarter of a coarse pixel from that of its parent, towards the
// neighbour on its side: the parent counts 3/4, the neighbour 1/4, in x as in y.
void push_pixel(const Level& coarse, const Level& fine, int x, int y) {
  const int parent_x = x / 2, parent_y = y / 2;
  const int beside_x = std::clamp(parent_x + (x % 2 ? 1 : -1), 0, coarse.width_px - 1);
  const int beside_y = std::clamp(parent_y + (y % 2 ? 1 : -1), 0, coarse.height_px - 1);
  const float* a = coarse.at(coarse.pixel(parent_x, parent_y));
  const float* b = coarse.at(coarse.pixel(beside_x, parent_y));
  const float* c = coarse.at(coarse.pixel(parent_x, beside_y));
  const float* d = coarse.at(coarse.pixel(beside_x, beside_y));
  float* to = fine.at(fine.pixel(x, y));
  for (int i = 0; i < fine.n_channels; ++i)
    to[i] = 0.5625f * a[i] + 0.1875f * (b[i] + c[i]) + 0.0625f * d[i];
}

void push(const Level& coarse, const Level& fine) {
  for (int y = 0; y < fine.height_px; ++y)
    for (int x = 0; x < fine.width_px; ++x)
      if (!fine.is_set[fine.pixel(x, y)]) push_pixel(coarse, fine, x, y);
}

bool is_full(const Level& level) {
  const std::size_t n = level.pixel(0, level.height_px);
  return std::all_of(level.is_set, level.is_set + n, [](std::uint8_t set) { return set != 0; });
}

}  // namespace

void push_pull_fill(std::span<float> samples, int width_px, int height_px, int n_channels,
                    std::span<const std::uint8_t> mask) {
  const auto n = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  VIEWCELL_CHECK(mask.size() == n && samples.size() == n * static_cast<std::size_t>(n_channels),
                 width_px, height_px, n_channels, samples.size(), mask.size());
  if (std::all_of(mask.begin(), mask.end(), [](std::uint8_t m) { return m == 0; })) return;
  const Level finest{width_px, height_px, n_channels, samples.data(), mask.data()};
  std::vector<OwnedLevel> coarser;
  for (Level fine = finest; !is_full(fine); fine = coarser.back().level)
    coarser.push_back(pull(fine));
  for (std::size_t i = coarser.size(); i-- > 0;)
    push(coarser[i].level, i > 0 ? coarser[i - 1].level : finest);
}

void push_pull_fill(ImageRgbaFloat& color, Image<float>& inverse_depth) {
  const std::size_t n = color.pixels.size();
  VIEWCELL_CHECK(inverse_depth.width_px == color.width_px && inverse_depth.pixels.size() == n,
                 color.width_px, inverse_depth.width_px);
  std::vector<float> samples(4 * n);
  std::vector<std::uint8_t> mask(n);
  for (std::size_t p = 0; p < n; ++p) {
    std::copy_n(color.pixels[p].begin(), 3, &samples[4 * p]);
    samples[4 * p + 3] = inverse_depth.pixels[p];
    mask[p] = color.pixels[p][3] > 0.5f;
  }
  push_pull_fill(samples, color.width_px, color.height_px, 4, mask);
  for (std::size_t p = 0; p < n; ++p) {
    std::copy_n(&samples[4 * p], 3, color.pixels[p].begin());
    inverse_depth.pixels[p] = samples[4 * p + 3];
  }
}

}  // namespace viewcell
