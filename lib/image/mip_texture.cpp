#include "image/mip_texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/srgb.h"
#include "image/shrink.h"

namespace viewcell {
namespace {

const std::array<float, 256>& decoding() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> out{};
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = srgb_decode(static_cast<float>(i) / 255);
    return out;
  }();
  return table;
}

std::uint8_t scaled(std::uint8_t alpha, double factor) {
  return static_cast<std::uint8_t>(std::lround(std::min(255.0, alpha * factor)));
}

std::array<std::size_t, 256> count_alphas(const ImageRgba8& image) {
  std::array<std::size_t, 256> out{};
  for (const Rgba8& p : image.pixels) ++out[p[3]];
  return out;
}

// Scales alpha so that `share` of the pixels reaches the cutoff, as near as 8 bits have it.
void keep_coverage(ImageRgba8& image, double share, double cutoff) {
  const auto counts = count_alphas(image);
  const double wanted = share * static_cast<double>(image.pixels.size());
  // The alpha down to which pixels are to be there: where their number comes nearest to `wanted`.
  std::size_t n = 0;
  int least = 256;
  double best = wanted;
  for (int alpha = 255; alpha > 0; --alpha) {
    n += counts[static_cast<std::size_t>(alpha)];
    if (counts[static_cast<std::size_t>(alpha)] == 0) continue;
    const double off = std::abs(static_cast<double>(n) - wanted);
    if (off < best) best = off, least = alpha;
  }
  const double code = std::ceil(255 * cutoff);  // the least alpha that is there
  const double factor = least > 255 ? (code - 1) / 255 : code / least;
  for (Rgba8& p : image.pixels) p[3] = scaled(p[3], factor);
}

// The same place within one or two of the picture's periods, so that texels have small numbers.
float reduce(float x, Wrap wrap) {
  if (!std::isfinite(x)) return 0;
  if (wrap == Wrap::clamp) return std::clamp(x, -1.0f, 2.0f);
  return wrap == Wrap::repeat ? x - std::floor(x) : x - 2 * std::floor(x / 2);
}

int wrapped(int i, int n, Wrap wrap) {
  if (wrap == Wrap::clamp) return std::clamp(i, 0, n - 1);
  const int period = wrap == Wrap::mirror ? 2 * n : n;
  const int at = ((i % period) + period) % period;
  return at < n ? at : period - 1 - at;
}

glm::vec4 decode(const Rgba8& p) {
  const auto& table = decoding();
  return {table[p[0]], table[p[1]], table[p[2]], static_cast<float>(p[3]) / 255};
}

// Bilinear.
glm::vec4 sample_level(const MipTexture& texture, std::size_t level, const glm::vec2& uv) {
  const ImageRgba8& image = (*texture.levels)[level];
  const float x = uv.x * static_cast<float>(image.width_px) - 0.5f;
  const float y = (1 - uv.y) * static_cast<float>(image.height_px) - 0.5f;
  const float left = std::floor(x), top = std::floor(y);
  const auto column = [&](int i) {
    return wrapped(static_cast<int>(left) + i, image.width_px, texture.wrap_u);
  };
  const auto row = [&](int i) {
    return wrapped(static_cast<int>(top) + i, image.height_px, texture.wrap_v);
  };
  const int x0 = column(0), x1 = column(1), y0 = row(0), y1 = row(1);
  return glm::mix(glm::mix(decode(image.at(x0, y0)), decode(image.at(x1, y0)), x - left),
                  glm::mix(decode(image.at(x0, y1)), decode(image.at(x1, y1)), x - left), y - top);
}

}  // namespace

std::vector<ImageRgba8> make_mips(ImageRgba8 picture, std::optional<float> cutoff, int n_threads) {
  VIEWCELL_CHECK(!picture.empty(), picture.width_px, picture.height_px);
  double share = 0;
  if (cutoff)
    for (const Rgba8& p : picture.pixels)
      share += p[3] >= 255 * double(*cutoff) ? 1.0 / double(picture.pixels.size()) : 0;
  std::vector<ImageRgba8> levels{std::move(picture)};
  while (levels.back().width_px > 1 || levels.back().height_px > 1) {
    const ImageRgba8& last = levels.back();
    ImageRgba8 next = shrink(last, std::max(1, last.width_px / 2), std::max(1, last.height_px / 2),
                             PixelKind::color, n_threads);
    levels.push_back(std::move(next));
  }
  if (cutoff && *cutoff > 0)
    for (std::size_t i = 1; i < levels.size(); ++i) keep_coverage(levels[i], share, *cutoff);
  return levels;
}

float mip_lod(const MipTexture& texture, const UvStep& step) {
  const ImageRgba8& picture = texture.levels->front();
  const glm::vec2 size(picture.width_px, picture.height_px);
  const glm::vec2 dx = step.dx * size, dy = step.dy * size;
  const float longest2 = std::max(glm::dot(dx, dx), glm::dot(dy, dy));
  const auto last = static_cast<float>(texture.levels->size() - 1);
  return longest2 > 1 ? std::min(0.5f * std::log2(longest2), last) : 0.0f;
}

glm::vec4 sample(const MipTexture& texture, const glm::vec2& uv, float lod) {
  const glm::vec2 at(reduce(uv.x, texture.wrap_u), reduce(uv.y, texture.wrap_v));
  const float floor = std::floor(lod);
  const auto level = static_cast<std::size_t>(floor);
  const glm::vec4 fine = sample_level(texture, level, at);
  if (!(lod > floor)) return fine;
  return glm::mix(fine, sample_level(texture, level + 1, at), lod - floor);
}

std::string sample_mips_glsl() {
  return R"(
vec4 sample_mips(sampler2D mips, vec2 uv) {
  vec2 size = vec2(textureSize(mips, 0));
  vec2 dx = dFdxFine(uv) * size, dy = dFdyFine(uv) * size;
  float last = float(textureQueryLevels(mips) - 1);
  float lod = clamp(0.5 * log2(max(max(dot(dx, dx), dot(dy, dy)), 1.0)), 0.0, last);
  float level = floor(lod);
  return mix(textureLod(mips, uv, level), textureLod(mips, uv, min(level + 1.0, last)), lod - level);
}
)";
}

}  // namespace viewcell
