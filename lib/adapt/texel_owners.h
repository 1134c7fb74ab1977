// Which chart has which texel of a texture: charts and the gutters around them.
#pragma once

#include <cstdint>

#include "adapt/adaptation.h"
#include "image/image.h"

namespace viewcell {

/// The owner of a texel: 0 for none, else a chart's name; with this bit inside the chart, without
/// it in the chart's gutter.
inline constexpr std::uint16_t kInsideChart = 0x8000;

/// 1 to 0x7ffe; past so many charts names repeat.
std::uint16_t owner_name(std::uint32_t chart);

/// Texels whose centres lie in a face, and kGutter texels around them. Where charts meet, the
/// first one has the inside and the one of the greater name the gutter. Rows down.
Image<std::uint16_t> make_texel_owners(const LevelCharts& charts, int width_px, int height_px);

/// Per texel 1 where its centre lies in a face, or within reach_px of such a texel in both
/// directions, else 0.
Image<std::uint8_t> make_chart_mask(const LevelCharts& charts, int width_px, int height_px,
                                    int reach_px = 0);

/// Coarse parts of a texture that belong to one chart, mostly: whether a sample may meet another
/// chart's texel. Never says no where the answer is yes.
class OwnerTiles {
 public:
  /// All coordinates are texels of this image, rows as here.
  explicit OwnerTiles(const Image<std::uint16_t>& owners);
  void mark(const glm::vec2& lo, const glm::vec2& hi, std::uint16_t name);
  bool has_others(const glm::vec2& lo, const glm::vec2& hi, std::uint16_t name) const;

 private:
  void mark_tile(int x, int y, std::uint16_t name);
  Image<std::uint16_t> tiles_;  // a name, or kSeveral
};

}  // namespace viewcell
