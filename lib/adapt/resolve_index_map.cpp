#include "adapt/resolve_index_map.h"

#include "adapt/texel_owners.h"
#include "base/parallel.h"
#include "image/chart_reach.h"
#include "image/texel_spans.h"
#include "uv/gutter.h"

namespace viewcell {
namespace {

Rgba8 fetch(const ImageRgba8& texture, const glm::vec2& uv) {
  const BilinearTexels at =
      bilinear_texels(texture, to_texels(uv, texture.width_px, texture.height_px));
  Rgba8 out;
  for (std::size_t k = 0; k < 4; ++k) {
    float sum = 0;
    for (std::size_t i = 0; i < 4; ++i) sum += at.weights[i] * texture.pixels[at.offsets[i]][k];
    out[k] = static_cast<std::uint8_t>(sum + 0.5f);
  }
  return out;
}

ImageRgba8 continue_charts(const ImageRgba8& texture, const LevelCharts& finest, int n_threads) {
  ImageRgba8 out = texture;
  copy_into_gutter(
      out, nearest_owned_texels(make_chart_mask(finest, texture.width_px, texture.height_px),
                                kContinuedReach, n_threads));
  return out;
}

// continued: the texture beyond its charts. Texels that hold their own texture
// coordinates keep the texture's.
ImageRgba8 look_up(const IndexMap& map, const ImageRgba8& texture, const ImageRgba8& continued,
                   int n_threads) {
  const int width_px = map.width_px, height_px = map.height_px;
  const bool is_same_size = width_px == texture.width_px && height_px == texture.height_px;
  ImageRgba8 out(width_px, height_px);
  parallel_for(static_cast<std::size_t>(height_px), n_threads, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < width_px; ++x) {
      const glm::vec2 uv = map.at(x, y);
      const bool is_own = uv == own_texcoords(x, y, width_px, height_px);
      out.at(x, y) = is_same_size && is_own ? texture.at(x, y) : fetch(continued, uv);
    }
  });
  return out;
}

// Texels that charts covered before and do not now get the nearest chart texel's colour; texels
// that none covered, before or now, keep the original's where it has the same size.
void fill_around(ImageRgba8& image, const ImageRgba8& original, const LevelCharts& finest,
                 const LevelCharts& level, int n_threads) {
  const Image<std::uint8_t> was = make_chart_mask(finest, image.width_px, image.height_px);
  const Image<std::uint8_t> is =
      make_chart_mask(level, image.width_px, image.height_px, kGutterReach);
  const bool is_same_size =
      image.width_px == original.width_px && image.height_px == original.height_px;
  Image<std::uint32_t> source = nearest_owned_texels(is, kWholeImage, n_threads);
  for (std::size_t i = 0; i < was.pixels.size(); ++i) {
    if (was.pixels[i]) continue;
    source.pixels[i] = static_cast<std::uint32_t>(i);
    if (is_same_size && !is.pixels[i]) image.pixels[i] = original.pixels[i];
  }
  copy_into_gutter(image, source);
}

}  // namespace

ImageRgba8 resolve_index_map(const IndexMap& map, const ImageRgba8& texture,
                             const LevelCharts& finest, const LevelCharts& level, int n_threads) {
  ImageRgba8 out = look_up(map, texture, continue_charts(texture, finest, n_threads), n_threads);
  fill_around(out, texture, finest, level, n_threads);
  return out;
}

}  // namespace viewcell
