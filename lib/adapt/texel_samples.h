// Kinds of texels, and samples between them. For inner loops.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <glm/glm.hpp>
#include <type_traits>

#include "adapt/texel_owners.h"
#include "adapt/texture_adapt.h"
#include "image/half.h"

namespace viewcell {

typedef float Float4 __attribute__((vector_size(16)));
typedef std::int32_t Int4 __attribute__((vector_size(16)));

inline Float4 load(const glm::vec2& t) {
  return Float4{t.x, t.y};
}
inline Float4 load(const Unorm16Texel& t) {
  return Float4{float(t.uv[0]), float(t.uv[1])} * (1 / 65535.0f);
}
inline Float4 load(const Unorm8Texel& t) {
  return Float4{float(t.uv[0]), float(t.uv[1])} * (1 / 255.0f);
}
inline Float4 load(const HalfTexel& t) {
  return Float4{float_from_half(t.uv[0]), float_from_half(t.uv[1])};
}
inline Float4 load(const Rgba8& t) {
  return Float4{float(t[0]), float(t[1]), float(t[2]), float(t[3])};
}

template <typename Whole>
Whole round_to(float x, float largest) {
  return static_cast<Whole>(std::clamp(x, 0.0f, largest) + 0.5f);
}
inline void store(Float4 v, glm::vec2& t) {
  t = {v[0], v[1]};
}
inline void store(Float4 v, Unorm16Texel& t) {
  for (std::size_t k = 0; k < 2; ++k) t.uv[k] = round_to<std::uint16_t>(65535 * v[k], 65535);
}
inline void store(Float4 v, Unorm8Texel& t) {
  for (std::size_t k = 0; k < 2; ++k) t.uv[k] = round_to<std::uint8_t>(255 * v[k], 255);
}
inline void store(Float4 v, HalfTexel& t) {
  for (std::size_t k = 0; k < 2; ++k) t.uv[k] = half_from_float(v[k]);
}
inline void store(Float4 v, Rgba8& t) {
  for (std::size_t k = 0; k < 4; ++k) t[k] = round_to<std::uint8_t>(v[k], 255);
}

template <typename Texel>
constexpr bool kIsIndex = !std::is_same_v<Texel, Rgba8>;

// Four texels and the weights between them. Points outside count as the nearest inside.
struct Footprint {
  int x, y;
  float s, t;
  int dx, dy;  // 0 where there is no next texel

  Footprint(const glm::vec2& at, int width_px, int height_px) {
    const float px = std::min(std::max(at.x, 0.0f), float(width_px - 1));
    const float py = std::min(std::max(at.y, 0.0f), float(height_px - 1));
    x = static_cast<int>(px), y = static_cast<int>(py);
    s = px - float(x), t = py - float(y);
    dx = x + 1 < width_px, dy = y + 1 < height_px;
  }
};

// The largest float below the last texel of a row or column of n > 1.
inline float before_last(int n) {
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(float(n - 1)) - 1);
}

// NaN becomes lo.
template <typename Vector>
Vector clamp(Vector v, Vector lo, Vector hi) {
  v = v > lo ? v : lo;
  return v < hi ? v : hi;
}

// Pixels of an image, row by row.
template <typename Texel>
struct View {
  const Texel* pixels;
  int width_px, height_px, pitch_px;
  std::size_t offset(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(pitch_px) +
           static_cast<std::size_t>(x);
  }
};

template <typename Texel>
Float4 sample(const View<Texel>& image, const glm::vec2& at) {
  const Footprint f(at, image.width_px, image.height_px);
  const Texel* texel = image.pixels + image.offset(f.x, f.y);
  const Texel* below = texel + f.dy * image.pitch_px;
  const Float4 a = load(texel[0]), b = load(texel[f.dx]), c = load(below[0]), d = load(below[f.dx]);
  const Float4 top = a + f.s * (b - a), bottom = c + f.s * (d - c);
  return top + f.t * (bottom - top);
}

// The points of the source that texels are sampled at, one after another.
struct SamplePoints {
  float *x, *y;
};

typedef float Float8 __attribute__((vector_size(32)));
typedef std::int32_t Int8 __attribute__((vector_size(32)));

// start + k * step for k in [0, n); up to seven more are written, too.
[[gnu::always_inline]] inline void fill_line(const glm::vec2& start, const glm::vec2& step, int n,
                                             const SamplePoints& out) {
  const Float8 count{0, 1, 2, 3, 4, 5, 6, 7};
  int k = 0;
  do {
    const Float8 at = float(k) + count, x = start.x + at * step.x, y = start.y + at * step.y;
    __builtin_memcpy(out.x + k, &x, sizeof x);
    __builtin_memcpy(out.y + k, &y, sizeof y);
    k += 8;
  } while (k < n);
}

template <typename Texel>
void sample_points(const View<Texel>& image, const SamplePoints& at, std::size_t n, Texel* out) {
  for (std::size_t k = 0; k < n; ++k) store(sample(image, glm::vec2(at.x[k], at.y[k])), out[k]);
}

// The same for pairs of floats, eight texels at once; up to seven beyond n are written, too.
inline void sample_points(const View<glm::vec2>& image, const SamplePoints& at, std::size_t n,
                          glm::vec2* out) {
  if (image.width_px < 2 || image.height_px < 2) {
    for (std::size_t k = 0; k < n; ++k) store(sample(image, glm::vec2(at.x[k], at.y[k])), out[k]);
    return;
  }
  // Up to the last texel but one, so that there is always a next.
  const Float8 zero{};
  const Float8 right = zero + before_last(image.width_px),
               bottom = zero + before_last(image.height_px);
  const auto* pixels = reinterpret_cast<const float*>(image.pixels);
  const std::size_t row = 2 * static_cast<std::size_t>(image.pitch_px);
  for (std::size_t k = 0; k < n; k += 8) {
    Float8 x, y;
    __builtin_memcpy(&x, at.x + k, sizeof x);
    __builtin_memcpy(&y, at.y + k, sizeof y);
    x = clamp(x, zero, right), y = clamp(y, zero, bottom);
    const Int8 ix = __builtin_convertvector(x, Int8), iy = __builtin_convertvector(y, Int8);
    const Float8 s = x - __builtin_convertvector(ix, Float8);
    const Float8 t = y - __builtin_convertvector(iy, Float8);
    const Int8 index = 2 * (iy * image.pitch_px + ix);
    const auto mixed_rows = [&](std::size_t j) __attribute__((always_inline)) {
      const float* texel = pixels + static_cast<std::uint32_t>(index[j]);
      Float4 a, b;
      __builtin_memcpy(&a, texel, sizeof a);
      __builtin_memcpy(&b, texel + row, sizeof b);
      return a + t[j] * (b - a);
    };
    for (std::size_t j = 0; j < 8; j += 2) {
      const Float4 a = mixed_rows(j), b = mixed_rows(j + 1);
      const Float4 left = __builtin_shufflevector(a, b, 0, 1, 4, 5);
      const Float4 next = __builtin_shufflevector(a, b, 2, 3, 6, 7);
      const Float4 mixed = left + Float4{s[j], s[j], s[j + 1], s[j + 1]} * (next - left);
      __builtin_memcpy(out + k + j, &mixed, sizeof mixed);
    }
  }
}

// Spans are short: a call, or what a compiler makes of a loop for long ones, costs more.
template <typename Texel>
void copy_texels(const Texel* from, int n, Texel* to) {
  if (n > 16) {
    std::copy_n(from, n, to);
    return;
  }
  for (int k = 0; k < n; ++k) {
    to[k] = from[k];
    asm volatile("" ::: "memory");  // no loop of vectors
  }
}

// The same from texels of one chart only; from all four where none of them is the chart's.
template <typename Texel>
Float4 sample_own(const View<Texel>& image, const std::uint16_t* owners, std::uint16_t name,
                  const glm::vec2& at) {
  const Footprint f(at, image.width_px, image.height_px);
  const std::size_t first = image.offset(f.x, f.y);
  const std::size_t down = f.dy ? static_cast<std::size_t>(image.pitch_px) : 0;
  const std::array<std::size_t, 4> texels{first, first + std::size_t(f.dx), first + down,
                                          first + down + std::size_t(f.dx)};
  const std::array<float, 4> weights{(1 - f.s) * (1 - f.t), f.s * (1 - f.t), (1 - f.s) * f.t,
                                     f.s * f.t};
  Float4 sum{};
  float weight = 0;
  for (std::size_t k = 0; k < 4; ++k)
    if ((owners[texels[k]] & ~kInsideChart) == name)
      sum += weights[k] * load(image.pixels[texels[k]]), weight += weights[k];
  return weight > 1e-3f ? sum / weight : sample(image, at);
}

}  // namespace viewcell
