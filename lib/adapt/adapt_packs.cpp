#include "adapt/adapt_packs.h"

#include <algorithm>
#include <utility>

#include "base/buckets.h"
#include "image/chart_reach.h"
#include "image/image.h"
#include "image/texel_spans.h"

namespace viewcell {
namespace {

constexpr int kPackTile = 8;  // texels a side

// What an adaptation reads; of that it may write all but the outermost texels.
struct Region {
  glm::vec2 lo{1e30f}, hi{-1e30f};
  bool has_border = false;
};

Region region_of(const Adaptation& adaptation, int width_px, int height_px) {
  Region region;
  glm::vec2 lo(1e30f), hi(-1e30f);
  for (const AdaptationPoint& point : adaptation.points)
    for (const glm::vec2& uv : {point.before, point.after})
      lo = glm::min(lo, uv), hi = glm::max(hi, uv);
  // Rows run down.
  region.lo = to_texels(glm::vec2(lo.x, hi.y), width_px, height_px);
  region.hi = to_texels(glm::vec2(hi.x, lo.y), width_px, height_px);
  for (const AdaptationTriangle& t : adaptation.triangles)
    region.has_border = region.has_border || t.has_border();
  return region;
}

// The last packs that read and wrote each tile; packs count from 1.
class Tiles {
 public:
  Tiles(int width_px, int height_px)
      : n_x_((width_px + kPackTile - 1) / kPackTile),
        n_y_((height_px + kPackTile - 1) / kPackTile) {
    tiles_.resize(static_cast<std::size_t>(n_x_) * static_cast<std::size_t>(n_y_));
  }

  std::uint32_t add(const Region& region) {
    const float write = region.has_border ? kGutter + 1 : 0, read = write + kFetchReach;
    std::uint32_t pack = 0;
    for_each_tile(region, read, [&](Tile& t) { pack = std::max(pack, t.written); });
    for_each_tile(region, write, [&](Tile& t) { pack = std::max(pack, t.read); });
    ++pack;
    for_each_tile(region, read, [&](Tile& t) { t.read = std::max(t.read, pack); });
    for_each_tile(region, write, [&](Tile& t) { t.written = std::max(t.written, pack); });
    return pack;
  }

 private:
  struct Tile {
    std::uint32_t read = 0, written = 0;
  };
  template <typename Visit>
  void for_each_tile(const Region& region, float margin, Visit&& visit) {
    const auto tile = [&](float at, int n) {
      return std::clamp(static_cast<int>(std::floor(std::clamp(at, -1e6f, 1e6f) / kPackTile)), 0,
                        n - 1);
    };
    const int x1 = tile(region.hi.x + margin, n_x_), y1 = tile(region.hi.y + margin, n_y_);
    for (int y = tile(region.lo.y - margin, n_y_); y <= y1; ++y)
      for (int x = tile(region.lo.x - margin, n_x_); x <= x1; ++x)
        visit(tiles_[static_cast<std::size_t>(y) * static_cast<std::size_t>(n_x_) +
                     static_cast<std::size_t>(x)]);
  }
  int n_x_, n_y_;
  std::vector<Tile> tiles_;
};

}  // namespace

AdaptPacks pack_adaptations(const AdaptationLog& log, std::size_t from, std::size_t to,
                            int width_px, int height_px, bool pack) {
  Tiles tiles(width_px, height_px);
  std::vector<std::uint32_t> collapses, pack_of;
  std::uint32_t n_packs = 0;
  const std::size_t n = from < to ? to - from : from - to;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = from < to ? from + k : from - 1 - k;
    const Adaptation adaptation = log.of(i);
    if (adaptation.triangles.empty()) continue;
    collapses.push_back(static_cast<std::uint32_t>(i));
    pack_of.push_back(pack ? tiles.add(region_of(adaptation, width_px, height_px)) : n_packs + 1);
    n_packs = std::max(n_packs, pack_of.back());
  }
  Buckets<std::uint32_t> packs = fill_buckets<std::uint32_t>(n_packs, [&](const auto& emit) {
    for (std::size_t k = 0; k < collapses.size(); ++k) emit(pack_of[k] - 1, collapses[k]);
  });
  return {std::move(packs.items), {packs.starts.begin(), packs.starts.end()}};
}

}  // namespace viewcell
