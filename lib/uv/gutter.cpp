// Follows: P. Felzenszwalb, D. Huttenlocher, Distance transforms of sampled functions, Theory of
// Computing 8, 2012: columns first, then the lower envelope of parabolas in each row. Whole
// numbers only, so ties are exact.
#include "uv/gutter.h"

#include "base/error.h"
#include "base/parallel.h"

namespace viewcell {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

// Per texel the row of the nearest owned texel of its column, the upper of two; kNone without.
Image<std::uint32_t> nearest_in_columns(const Image<std::uint8_t>& is_owned, int n_threads) {
  Image<std::uint32_t> rows(is_owned.width_px, is_owned.height_px, kNone);
  parallel_for(static_cast<std::size_t>(is_owned.width_px), n_threads, [&](std::size_t column) {
    const int x = static_cast<int>(column);
    const auto height = static_cast<std::uint32_t>(is_owned.height_px);
    const auto is_owned_at = [&](std::uint32_t y) { return is_owned.at(x, static_cast<int>(y)); };
    std::uint32_t seen = kNone;
    for (std::uint32_t y = 0; y < height; ++y) {
      if (is_owned_at(y)) seen = y;
      rows.at(x, static_cast<int>(y)) = seen;
    }
    seen = kNone;
    for (std::uint32_t y = height; y-- > 0;) {
      if (is_owned_at(y)) seen = y;
      std::uint32_t& best = rows.at(x, static_cast<int>(y));
      if (seen != kNone && (best == kNone || seen - y < y - best)) best = seen;
    }
  });
  return rows;
}

// A column's owned texel as a row sees it: (x - column)^2 + height_squared.
struct Parabola {
  std::int64_t column, row, height_squared;

  std::int64_t at(std::int64_t x) const { return (x - column) * (x - column) + height_squared; }
};

// Whether b is nowhere below both a and c, whose columns are left and right of b's. Where all three
// meet in one point b stays, and does no harm.
bool is_hidden(const Parabola& a, const Parabola& b, const Parabola& c) {
  const auto key = [](const Parabola& p) { return p.height_squared + p.column * p.column; };
  return (key(c) - key(a)) * (b.column - a.column) < (key(b) - key(a)) * (c.column - a.column);
}

// Of two as near, the lower row wins, then the lower column.
bool is_nearer(const Parabola& a, const Parabola& b, std::int64_t x) {
  const std::int64_t here = a.at(x), there = b.at(x);
  return here < there || (here == there && a.row < b.row);
}

// Row y of the columns' nearest rows becomes that of the nearest texels' numbers: half the memory
// of two images.
void search_row(Image<std::uint32_t>& image, int y, std::int64_t reach,
                std::vector<Parabola>& envelope) {
  envelope.clear();
  for (int x = 0; x < image.width_px; ++x) {
    std::uint32_t& texel = image.at(x, y);
    const std::int64_t row = texel;
    const bool has_row = texel != kNone;
    texel = static_cast<std::uint32_t>(image.offset(x, y));
    if (!has_row) continue;
    const Parabola next{x, row, (row - y) * (row - y)};
    while (envelope.size() > 1 && is_hidden(envelope.end()[-2], envelope.back(), next))
      envelope.pop_back();
    envelope.push_back(next);
  }
  if (envelope.empty()) return;
  std::size_t k = 0;
  for (int x = 0; x < image.width_px; ++x) {
    // Along the envelope the values at x fall, then rise; equal ones are next to each other.
    while (k + 1 < envelope.size() && envelope[k + 1].at(x) < envelope[k].at(x)) ++k;
    std::size_t best = k;
    for (std::size_t i = k + 1; i < envelope.size() && envelope[i].at(x) == envelope[k].at(x); ++i)
      if (is_nearer(envelope[i], envelope[best], x)) best = i;
    const Parabola& found = envelope[best];
    if (found.at(x) <= reach * reach)
      image.at(x, y) = static_cast<std::uint32_t>(
          image.offset(static_cast<int>(found.column), static_cast<int>(found.row)));
  }
}

}  // namespace

Image<std::uint32_t> nearest_owned_texels(const Image<std::uint8_t>& is_owned, int reach_px,
                                          int n_threads) {
  VIEWCELL_CHECK(is_owned.pixels.size() < 0xffffffffu, is_owned.pixels.size());
  Image<std::uint32_t> out = nearest_in_columns(is_owned, n_threads);
  parallel_for(static_cast<std::size_t>(out.height_px), n_threads, [&](std::size_t y) {
    std::vector<Parabola> envelope;
    search_row(out, static_cast<int>(y), reach_px, envelope);
  });
  return out;
}

}  // namespace viewcell
