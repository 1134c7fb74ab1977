#include "bake/texture_adapt.h"

#include <algorithm>
#include <cmath>

namespace viewcell {
namespace {

// Texture coordinates as places in an image: texel centres at whole numbers.
glm::dvec2 to_texels(const glm::vec2& uv, int width_px, int height_px) {
  return {uv.x * double(width_px) - 0.5, (1 - double(uv.y)) * height_px - 0.5};
}

// x where an edge crosses a row; the same for both triangles at the edge.
double cross_row(glm::dvec2 a, glm::dvec2 b, double y) {
  if (b.y < a.y || (b.y == a.y && b.x < a.x)) std::swap(a, b);
  return a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
}

// Calls visit(x0, x1, y) for the texels of each row whose centres lie in the triangle; triangles
// that share an edge share no texel and leave none out.
template <typename Visit>
void for_each_span(const std::array<glm::dvec2, 3>& p, int width_px, int height_px, Visit&& visit) {
  const double top = std::min({p[0].y, p[1].y, p[2].y}),
               bottom = std::max({p[0].y, p[1].y, p[2].y});
  const int first = std::max(0, static_cast<int>(std::ceil(top)));
  const int last = std::min<double>(height_px, std::ceil(bottom));
  for (int y = first; y < last; ++y) {
    double lo = 1e300, hi = -1e300;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec2 &a = p[k], &b = p[(k + 1) % 3];
      if ((a.y <= y) == (b.y <= y)) continue;
      const double x = cross_row(a, b, y);
      lo = std::min(lo, x), hi = std::max(hi, x);
    }
    const int x0 = std::max(0.0, std::ceil(lo)), x1 = std::min<double>(width_px, std::ceil(hi));
    if (x0 < x1) visit(x0, x1, y);
  }
}

// The affine map that takes one triangle to another: p -> linear * p + offset.
struct Affine {
  glm::dmat2 linear{1};
  glm::dvec2 offset{0};
  bool is_valid = false;
};

Affine make_affine(const std::array<glm::dvec2, 3>& from, const std::array<glm::dvec2, 3>& to) {
  const glm::dmat2 a(from[1] - from[0], from[2] - from[0]), b(to[1] - to[0], to[2] - to[0]);
  Affine out;
  const double det = glm::determinant(a);
  if (det == 0) return out;
  out.linear = b * glm::inverse(a);
  out.offset = to[0] - out.linear * from[0];
  out.is_valid = std::isfinite(out.offset.x + out.offset.y);
  return out;
}

template <typename Pixel, typename Mix>
auto bilinear(const Image<Pixel>& image, const glm::dvec2& at, Mix&& mix) {
  const double x = std::clamp(at.x, 0.0, image.width_px - 1.0);
  const double y = std::clamp(at.y, 0.0, image.height_px - 1.0);
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, image.width_px - 1), y1 = std::min(y0 + 1, image.height_px - 1);
  const auto s = static_cast<float>(x - x0), t = static_cast<float>(y - y0);
  return mix(image.at(x0, y0), image.at(x1, y0), image.at(x0, y1), image.at(x1, y1), s, t);
}

glm::vec2 sample(const IndexMap& map, const glm::dvec2& at) {
  return bilinear(map, at, [](auto& a, auto& b, auto& c, auto& d, float s, float t) {
    return glm::mix(glm::mix(a, b, s), glm::mix(c, d, s), t);
  });
}

}  // namespace

IndexMap make_index_map(int width_px, int height_px) {
  IndexMap map(width_px, height_px);
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x)
      map.at(x, y) = {(x + 0.5) / width_px, 1 - (y + 0.5) / height_px};
  return map;
}

void TextureAdapter::adapt(IndexMap& map, std::span<const TexturePair> pairs, bool is_collapse) {
  samples_.clear();
  for (const TexturePair& pair : pairs) {
    std::array<glm::dvec2, 3> from, to;
    for (std::size_t k = 0; k < 3; ++k) {
      from[k] =
          to_texels(is_collapse ? pair.before[k] : pair.after[k], map.width_px, map.height_px);
      to[k] = to_texels(is_collapse ? pair.after[k] : pair.before[k], map.width_px, map.height_px);
    }
    const Affine source = make_affine(to, from);
    if (!source.is_valid) continue;
    for_each_span(to, map.width_px, map.height_px, [&](int x0, int x1, int y) {
      glm::dvec2 at = source.linear * glm::dvec2(x0, y) + source.offset;
      for (int x = x0; x < x1; ++x, at += source.linear[0])
        samples_.push_back({map.offset(x, y), sample(map, at)});
    });
  }
  for (const Sample& s : samples_) map.pixels[s.texel] = s.value;
  ++counts_.n_adaptations;
  counts_.n_texels += samples_.size();
}

ImageRgba8 bake_texture(const IndexMap& map, const ImageRgba8& texture) {
  ImageRgba8 out(map.width_px, map.height_px);
  for (std::size_t i = 0; i < map.pixels.size(); ++i) {
    const glm::dvec2 at = to_texels(map.pixels[i], texture.width_px, texture.height_px);
    out.pixels[i] = bilinear(texture, at, [](auto& a, auto& b, auto& c, auto& d, float s, float t) {
      Rgba8 pixel;
      for (std::size_t k = 0; k < 4; ++k) {
        const float top = a[k] + s * (float(b[k]) - a[k]), low = c[k] + s * (float(d[k]) - c[k]);
        pixel[k] = static_cast<std::uint8_t>(top + t * (low - top) + 0.5f);
      }
      return pixel;
    });
  }
  return out;
}

}  // namespace viewcell
