#include "adapt/texel_owners.h"

#include <algorithm>

#include "adapt/adapt_packs.h"
#include "image/texel_spans.h"

namespace viewcell {
namespace {

constexpr int kOwnerTile = 8;  // texels a side
constexpr std::uint16_t kSeveral = 0x7fff;

int tile_of(float at, int n) {
  return std::clamp(static_cast<int>(std::clamp(at, 0.0f, 1e6f)) / kOwnerTile, 0, n - 1);
}

void claim_faces(const LevelCharts& charts, Image<std::uint16_t>& owners) {
  for (std::size_t f = 0; f < charts.faces.size(); ++f) {
    const std::uint16_t owner = kInsideChart | owner_name(charts.charts[f]);
    TexelTriangle face;
    for (std::size_t k = 0; k < 3; ++k)
      face[k] = to_texels(charts.faces[f][k], owners.width_px, owners.height_px);
    for_each_span(face, owners.width_px, owners.height_px, [&](int x0, int x1, int y) {
      for (int x = x0; x < x1; ++x)
        if (owners.at(x, y) == 0) owners.at(x, y) = owner;
    });
  }
}

// One more texel around all charts.
void widen_gutters(Image<std::uint16_t>& owners) {
  const Image<std::uint16_t> last = owners;
  const int w = owners.width_px, h = owners.height_px;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      std::uint16_t& owner = owners.at(x, y);
      if (owner != 0) continue;
      for (int j = std::max(y - 1, 0); j <= std::min(y + 1, h - 1); ++j)
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, w - 1); ++i)
          owner = std::max<std::uint16_t>(owner, last.at(i, j) & ~kInsideChart);
    }
}

}  // namespace

std::uint16_t owner_name(std::uint32_t chart) {
  return static_cast<std::uint16_t>(chart % (kInsideChart - 2) + 1);
}

Image<std::uint16_t> make_texel_owners(const LevelCharts& charts, int width_px, int height_px) {
  Image<std::uint16_t> owners(width_px, height_px);
  claim_faces(charts, owners);
  for (int step = 0; step < static_cast<int>(kGutter); ++step) widen_gutters(owners);
  return owners;
}

OwnerTiles::OwnerTiles(const Image<std::uint16_t>& owners)
    : tiles_((owners.width_px + kOwnerTile - 1) / kOwnerTile,
             (owners.height_px + kOwnerTile - 1) / kOwnerTile) {
  for (int y = 0; y < owners.height_px; ++y)
    for (int x = 0; x < owners.width_px; ++x)
      mark_tile(x / kOwnerTile, y / kOwnerTile, owners.at(x, y) & ~kInsideChart);
}

void OwnerTiles::mark_tile(int x, int y, std::uint16_t name) {
  std::uint16_t& tile = tiles_.at(x, y);
  if (name != 0 && tile != name) tile = tile == 0 ? name : kSeveral;
}

void OwnerTiles::mark(const glm::vec2& lo, const glm::vec2& hi, std::uint16_t name) {
  const int x1 = tile_of(hi.x, tiles_.width_px), y1 = tile_of(hi.y, tiles_.height_px);
  for (int y = tile_of(lo.y, tiles_.height_px); y <= y1; ++y)
    for (int x = tile_of(lo.x, tiles_.width_px); x <= x1; ++x) mark_tile(x, y, name);
}

bool OwnerTiles::has_others(const glm::vec2& lo, const glm::vec2& hi, std::uint16_t name) const {
  const int x1 = tile_of(hi.x, tiles_.width_px), y1 = tile_of(hi.y, tiles_.height_px);
  for (int y = tile_of(lo.y, tiles_.height_px); y <= y1; ++y)
    for (int x = tile_of(lo.x, tiles_.width_px); x <= x1; ++x)
      if (tiles_.at(x, y) != 0 && tiles_.at(x, y) != name) return true;
  return false;
}

}  // namespace viewcell
