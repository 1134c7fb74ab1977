// Follows: P. Felzenszwalb, D. Huttenlocher, Distance transforms of sampled functions, Theory of
// Computing 8, 2012: columns first, then the lower envelope of parabolas in each row. Whole
// numbers only, so ties are exact.
#include "bake/gutter.h"

#include "base/error.h"
#include "base/parallel.h"

namespace viewcell {
namespace {

constexpr std::int32_t kNone = -1;

// Per texel the row of the nearest owned texel of its column, the upper of two; kNone without.
Image<std::int32_t> nearest_in_columns(const Image<std::uint8_t>& is_owned, int n_threads) {
  Image<std::int32_t> rows(is_owned.width_px, is_owned.height_px, kNone);
  parallel_for(static_cast<std::size_t>(is_owned.width_px), n_threads, [&](std::size_t column) {
    const int x = static_cast<int>(column), height = is_owned.height_px;
    std::int32_t seen = kNone;
    for (int y = 0; y < height; ++y) {
      if (is_owned.at(x, y)) seen = y;
      rows.at(x, y) = seen;
    }
    seen = kNone;
    for (int y = height; y-- > 0;) {
      if (is_owned.at(x, y)) seen = y;
      std::int32_t& best = rows.at(x, y);
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

void search_row(const Image<std::int32_t>& rows, int y, std::int64_t reach,
                std::vector<Parabola>& envelope, Image<std::uint32_t>& out) {
  envelope.clear();
  for (int x = 0; x < rows.width_px; ++x) {
    const std::int64_t row = rows.at(x, y);
    if (row == kNone) continue;
    const Parabola next{x, row, (row - y) * (row - y)};
    while (envelope.size() > 1 && is_hidden(envelope.end()[-2], envelope.back(), next))
      envelope.pop_back();
    envelope.push_back(next);
  }
  if (envelope.empty()) return;
  std::size_t k = 0;
  for (int x = 0; x < rows.width_px; ++x) {
    // Along the envelope the values at x fall, then rise; equal ones are next to each other.
    while (k + 1 < envelope.size() && envelope[k + 1].at(x) < envelope[k].at(x)) ++k;
    std::size_t best = k;
    for (std::size_t i = k + 1; i < envelope.size() && envelope[i].at(x) == envelope[k].at(x); ++i)
      if (is_nearer(envelope[i], envelope[best], x)) best = i;
    const Parabola& found = envelope[best];
    if (found.at(x) <= reach * reach)
      out.at(x, y) = static_cast<std::uint32_t>(
          rows.offset(static_cast<int>(found.column), static_cast<int>(found.row)));
  }
}

}  // namespace

Image<std::uint32_t> nearest_owned_texels(const Image<std::uint8_t>& is_owned, int reach_px,
                                          int n_threads) {
  VIEWCELL_CHECK(is_owned.pixels.size() < 0xffffffffu, is_owned.pixels.size());
  Image<std::uint32_t> out(is_owned.width_px, is_owned.height_px);
  for (std::size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] = static_cast<std::uint32_t>(i);
  const Image<std::int32_t> rows = nearest_in_columns(is_owned, n_threads);
  parallel_for(static_cast<std::size_t>(out.height_px), n_threads, [&](std::size_t y) {
    std::vector<Parabola> envelope;
    search_row(rows, static_cast<int>(y), reach_px, envelope, out);
  });
  return out;
}

}  // namespace viewcell
