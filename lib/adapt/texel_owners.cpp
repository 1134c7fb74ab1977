#include "adapt/texel_owners.h"

#include <algorithm>

#include "image/chart_reach.h"
#include "image/owner_map.h"

namespace viewcell {
namespace {

constexpr int kOwnerTile = 8;  // texels a side
constexpr std::uint16_t kSeveral = 0x7fff;

int tile_of(float at, int n) {
  return std::clamp(static_cast<int>(std::clamp(at, 0.0f, 1e6f)) / kOwnerTile, 0, n - 1);
}

// owner_of(f): of a face.
template <typename Owner, typename OwnerOf>
Image<Owner> draw_faces(const LevelCharts& charts, int width_px, int height_px,
                        const OwnerOf& owner_of) {
  Image<Owner> owners(width_px, height_px);
  for (std::size_t f = 0; f < charts.faces.size(); ++f) {
    TexelTriangle face;
    for (std::size_t k = 0; k < 3; ++k)
      face[k] = to_texels(charts.faces[f][k], width_px, height_px);
    claim_texels(face, owner_of(f), owners);
  }
  return owners;
}

}  // namespace

std::uint16_t owner_name(std::uint32_t chart) {
  return static_cast<std::uint16_t>(chart % (kInsideChart - 2) + 1);
}

Image<std::uint16_t> make_texel_owners(const LevelCharts& charts, int width_px, int height_px) {
  Image<std::uint16_t> owners =
      draw_faces<std::uint16_t>(charts, width_px, height_px, [&](std::size_t f) {
        return static_cast<std::uint16_t>(kInsideChart | owner_name(charts.charts[f]));
      });
  widen_owners(owners, static_cast<int>(kGutter), kInsideChart);
  return owners;
}

Image<std::uint8_t> make_chart_mask(const LevelCharts& charts, int width_px, int height_px,
                                    int reach_px) {
  Image<std::uint8_t> mask = draw_faces<std::uint8_t>(charts, width_px, height_px,
                                                      [](std::size_t) { return std::uint8_t{1}; });
  widen_owners(mask, reach_px);
  return mask;
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
