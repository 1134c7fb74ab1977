#include "report/contact_sheet.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "report/label.h"

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

// Columns are so wide that no note runs into the next.
int find_column_width(const std::vector<SheetRow>& rows, const TileSize& tile) {
  int width = tile.width_px;
  for (const SheetRow& row : rows)
    for (const std::string& note : row.notes)
      width = std::max(width, label_width(note, kTextScale));
  return width;
}

TileSize find_tile_size(const std::vector<SheetRow>& rows, int tile_px) {
  for (const SheetRow& row : rows)
    for (const ImageRgba8& picture : row.pictures) {
      if (picture.empty()) continue;
      const ImageRgba8 tile = shrink_to_width(picture, tile_px);
      return {tile.width_px, tile.height_px};
    }
  return {tile_px, tile_px};
}

constexpr int kTrimMargin_px = 4;

// In pixels, the upper ends excluded.
struct PixelBox {
  int x0 = 1 << 30, y0 = 1 << 30, x1 = 0, y1 = 0;
  bool is_empty() const { return x0 >= x1; }
};

void add_covered(const ImageRgba8& picture, PixelBox& box) {
  for (int y = 0; y < picture.height_px; ++y)
    for (int x = 0; x < picture.width_px; ++x) {
      if (picture.at(x, y)[3] == 0) continue;
      box.x0 = std::min(box.x0, x), box.x1 = std::max(box.x1, x + 1);
      box.y0 = std::min(box.y0, y), box.y1 = std::max(box.y1, y + 1);
    }
}

ImageRgba8 cut(const ImageRgba8& picture, const PixelBox& box) {
  ImageRgba8 out(box.x1 - box.x0, box.y1 - box.y0);
  for (int y = 0; y < out.height_px; ++y)
    for (int x = 0; x < out.width_px; ++x) out.at(x, y) = picture.at(box.x0 + x, box.y0 + y);
  return out;
}

// --- the key of colours ---

constexpr int kSwatch = kGlyphHeight * kTextScale;

int key_width(const SheetKey& key) {
  return kSwatch + kGap / 2 + label_width(key.words, kTextScale) + 2 * kGap;
}

// Swatches and words from y on, in as many lines as they need; the height that they take. sheet
// null: only measured.
int draw_key(const std::vector<SheetKey>& keys, int y, int width, ImageRgba8* sheet,
             Remarks* remarks) {
  if (keys.empty()) return 0;
  int x = kGap, line = 0;
  for (const SheetKey& key : keys) {
    if (x > kGap && x + key_width(key) > width) x = kGap, ++line;
    if (sheet != nullptr) {
      const int top = y + line * (kLine + kGap / 2);
      for (int j = 0; j < kSwatch; ++j)
        for (int i = 0; i < kSwatch; ++i) sheet->at(x + i, top + j) = key.color;
      draw_label(*sheet, x + kSwatch + kGap / 2, top, key.words, kInk, kTextScale, remarks);
    }
    x += key_width(key);
  }
  return (line + 1) * (kLine + kGap / 2) + kGap;
}

}  // namespace

void trim_alike(std::vector<ImageRgba8>& pictures) {
  PixelBox box;
  const ImageRgba8* first = nullptr;
  for (const ImageRgba8& picture : pictures) {
    if (picture.empty()) continue;
    if (first == nullptr) first = &picture;
    VIEWCELL_CHECK(picture.width_px == first->width_px && picture.height_px == first->height_px,
                   picture.width_px, picture.height_px);
    add_covered(picture, box);
  }
  if (box.is_empty()) return;
  box.x0 = std::max(box.x0 - kTrimMargin_px, 0), box.y0 = std::max(box.y0 - kTrimMargin_px, 0);
  box.x1 = std::min(box.x1 + kTrimMargin_px, first->width_px);
  box.y1 = std::min(box.y1 + kTrimMargin_px, first->height_px);
  for (ImageRgba8& picture : pictures)
    if (!picture.empty()) picture = cut(picture, box);
}

void lay_on_paper(ImageRgba8& picture) {
  for (Rgba8& pixel : picture.pixels)
    if (pixel[3] == 0) pixel = kPaper;
}

void round_channels(ImageRgba8& image, int n_bits) {
  VIEWCELL_CHECK(n_bits >= 1 && n_bits <= 8, n_bits);
  const int most = (1 << n_bits) - 1;
  for (Rgba8& pixel : image.pixels)
    for (std::size_t c = 0; c < 3; ++c) {
      const int level = (pixel[c] * most + 127) / 255;
      pixel[c] = static_cast<std::uint8_t>((level * 255 + most / 2) / most);
    }
}

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
  const int column_width = find_column_width(rows, tile);
  const int n_rows = static_cast<int>(rows.size());
  const bool has_labels =
      std::any_of(rows.begin(), rows.end(), [](const SheetRow& row) { return !row.label.empty(); });
  const int label_height = has_labels ? kLine : 0;
  // A row: its label, the pictures, the notes.
  const int row_height = label_height + tile.height_px + kLine + kGap;
  const auto column_x = [&](std::size_t i) {
    return kGap + static_cast<int>(i) * (column_width + kGap);
  };
  int width = column_x(columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i)
    width = std::max(width, column_x(i) + label_width(columns[i], kTextScale) + kGap);
  for (const SheetKey& key : options.key) width = std::max(width, kGap + key_width(key));
  const int key_height = draw_key(options.key, 0, width, nullptr, nullptr);
  ImageRgba8 sheet(width, 2 * kGap + kLine + n_rows * row_height + key_height, kPaper);
  const auto write = [&](int x, int y, const std::string& text) {
    draw_label(sheet, x, y, text, kInk, kTextScale, options.remarks);
  };
  for (std::size_t i = 0; i < columns.size(); ++i) write(column_x(i), kGap, columns[i]);
  int y = 2 * kGap + kLine;
  for (const SheetRow& row : rows) {
    VIEWCELL_CHECK(row.pictures.size() <= columns.size(), row.pictures.size(), columns.size());
    write(kGap, y, row.label);
    for (std::size_t i = 0; i < row.pictures.size(); ++i) {
      if (row.pictures[i].empty()) continue;
      const ImageRgba8 picture = shrink_to_width(row.pictures[i], options.tile_px);
      VIEWCELL_CHECK(picture.width_px == tile.width_px && picture.height_px == tile.height_px,
                     row.label, picture.width_px, picture.height_px);
      paste(picture, column_x(i), y + label_height, sheet);
    }
    for (std::size_t i = 0; i < std::min(row.notes.size(), columns.size()); ++i)
      write(column_x(i), y + label_height + tile.height_px + 2, row.notes[i]);
    y += row_height;
  }
  draw_key(options.key, y, width, &sheet, options.remarks);
  return sheet;
}

}  // namespace viewcell
