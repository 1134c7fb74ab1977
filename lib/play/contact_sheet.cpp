#include "play/contact_sheet.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "play/label.h"

namespace viewcell {
namespace {

constexpr int kGap = 8;  // pixels between tiles
constexpr int kTextScale = 2;
constexpr int kLine = kGlyphHeight * kTextScale + 4;
constexpr Rgba8 kPaper{250, 250, 248, 255}, kInk{40, 40, 40, 255};

// The share of source pixel i that [lo, hi) covers.
double overlap(int i, double lo, double hi) {
  return std::max(0.0, std::min(hi, i + 1.0) - std::max(lo, static_cast<double>(i)));
}

Rgba8 average(const ImageRgba8& image, double x0, double x1, double y0, double y1) {
  double sum[4] = {}, area = 0;
  for (int y = static_cast<int>(y0); y < std::min(static_cast<int>(std::ceil(y1)), image.height_px);
       ++y)
    for (int x = static_cast<int>(x0);
         x < std::min(static_cast<int>(std::ceil(x1)), image.width_px); ++x) {
      const double w = overlap(x, x0, x1) * overlap(y, y0, y1);
      area += w;
      for (std::size_t c = 0; c < 4; ++c) sum[c] += w * image.at(x, y)[c];
    }
  Rgba8 out;
  for (std::size_t c = 0; c < 4; ++c) out[c] = static_cast<std::uint8_t>(sum[c] / area + 0.5);
  return out;
}

void paste(const ImageRgba8& tile, int x0, int y0, ImageRgba8& sheet) {
  for (int y = 0; y < tile.height_px; ++y)
    for (int x = 0; x < tile.width_px; ++x) {
      sheet.at(x0 + x, y0 + y) = tile.at(x, y);
      sheet.at(x0 + x, y0 + y)[3] = 255;  // alpha says what is an object, not what shows through
    }
}

struct TileSize {
  int width_px = 0, height_px = 0;
};

TileSize find_tile_size(const std::vector<SheetRow>& rows, int tile_px) {
  for (const SheetRow& row : rows)
    for (const ImageRgba8& picture : row.pictures) {
      if (picture.empty()) continue;
      const ImageRgba8 tile = shrink_to_width(picture, tile_px);
      return {tile.width_px, tile.height_px};
    }
  return {tile_px, tile_px};
}

}  // namespace

ImageRgba8 shrink_to_width(const ImageRgba8& image, int width_px) {
  VIEWCELL_CHECK(!image.empty() && width_px > 0, width_px);
  if (image.width_px <= width_px) return image;
  const double step = static_cast<double>(image.width_px) / width_px;
  const int height_px = std::max(1, static_cast<int>(std::lround(image.height_px / step)));
  const double step_y = static_cast<double>(image.height_px) / height_px;
  ImageRgba8 out(width_px, height_px);
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x)
      out.at(x, y) = average(image, x * step, (x + 1) * step, y * step_y, (y + 1) * step_y);
  return out;
}

ImageRgba8 make_contact_sheet(const std::vector<std::string>& columns,
                              const std::vector<SheetRow>& rows, const SheetOptions& options) {
  const TileSize tile = find_tile_size(rows, options.tile_px);
  const int n_columns = static_cast<int>(columns.size()), n_rows = static_cast<int>(rows.size());
  // A row: its label, the pictures, the notes.
  const int row_height = kLine + tile.height_px + kLine + kGap;
  ImageRgba8 sheet(kGap + n_columns * (tile.width_px + kGap),
                   2 * kGap + kLine + n_rows * row_height, kPaper);
  const auto column_x = [&](std::size_t i) {
    return kGap + static_cast<int>(i) * (tile.width_px + kGap);
  };
  for (std::size_t i = 0; i < columns.size(); ++i)
    draw_label(sheet, column_x(i), kGap, columns[i], kInk, kTextScale);
  int y = 2 * kGap + kLine;
  for (const SheetRow& row : rows) {
    VIEWCELL_CHECK(row.pictures.size() <= columns.size(), row.pictures.size(), columns.size());
    draw_label(sheet, kGap, y, row.label, kInk, kTextScale);
    for (std::size_t i = 0; i < row.pictures.size(); ++i) {
      if (row.pictures[i].empty()) continue;
      const ImageRgba8 picture = shrink_to_width(row.pictures[i], options.tile_px);
      VIEWCELL_CHECK(picture.width_px == tile.width_px && picture.height_px == tile.height_px,
                     row.label, picture.width_px, picture.height_px);
      paste(picture, column_x(i), y + kLine, sheet);
    }
    for (std::size_t i = 0; i < std::min(row.notes.size(), columns.size()); ++i)
      draw_label(sheet, column_x(i), y + kLine + tile.height_px + 2, row.notes[i], kInk,
                 kTextScale);
    y += row_height;
  }
  return sheet;
}

}  // namespace viewcell
