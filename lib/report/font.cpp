#include "report/font.h"

#include <array>
#include <memory>
#include <string>

#include "base/error.h"
#include "base/file.h"

#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#include <stb/stb_truetype.h>

namespace viewcell {
namespace {

constexpr std::array<const char*, 3> kFontFiles{
    "/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf",
    "/usr/share/fonts/TTF/DejaVuSansMono.ttf",
    "/usr/share/fonts/dejavu-sans-mono-fonts/DejaVuSansMono.ttf"};

struct Font {
  std::string bytes;  // info points into it
  stbtt_fontinfo info{};
};

bool load_font(const char* file, Font& font) {
  try {
    font.bytes = read_file(file, 1 << 24);
  } catch (const InputError&) {
    return false;
  }
  const auto* data = reinterpret_cast<const unsigned char*>(font.bytes.data());
  const int offset = stbtt_GetFontOffsetForIndex(data, 0);
  return offset >= 0 && stbtt_InitFont(&font.info, data, offset) != 0;
}

// Null when there is none. Never changed once it is there.
const Font* system_font() {
  static const std::unique_ptr<const Font> font = []() -> std::unique_ptr<const Font> {
    for (const char* file : kFontFiles) {
      auto out = std::make_unique<Font>();
      if (load_font(file, *out)) return out;
    }
    return nullptr;
  }();
  return font.get();
}

}  // namespace

bool has_font() {
  return system_font() != nullptr;
}

bool draw_glyph(char32_t letter, int advance_px, Glyph& out) {
  if (!has_font()) return false;
  const stbtt_fontinfo& info = system_font()->info;
  const int glyph = stbtt_FindGlyphIndex(&info, static_cast<int>(letter));
  if (glyph == 0) return false;
  int advance = 0, bearing = 0;
  stbtt_GetCodepointHMetrics(&info, '0', &advance, &bearing);
  const float scale = static_cast<float>(advance_px) / static_cast<float>(advance);
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  stbtt_GetGlyphBitmapBox(&info, glyph, scale, scale, &x0, &y0, &x1, &y1);
  out = {x1 - x0, y1 - y0, x0, y0, {}};
  out.coverage.assign(
      static_cast<std::size_t>(out.width_px) * static_cast<std::size_t>(out.height_px), 0);
  if (!out.coverage.empty())
    stbtt_MakeGlyphBitmap(&info, out.coverage.data(), out.width_px, out.height_px, out.width_px,
                          scale, scale, glyph);
  return true;
}

}  // namespace viewcell
