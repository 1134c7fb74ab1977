#include "image/texel_spans.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/random.h"
#include "image/index_map.h"

namespace viewcell {
namespace {

// The centre of texel (x, y) of the identity is that texel.
TEST(TexelSpans, CentresAreWholeNumbers) {
  EXPECT_EQ(to_texels({0, 1}, 8, 4), glm::dvec2(-0.5, -0.5));
  EXPECT_EQ(to_texels({1, 0}, 8, 4), glm::dvec2(7.5, 3.5));
  EXPECT_EQ(own_texcoords(0, 0, 8, 4), glm::vec2(0.0625f, 0.875f));
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 7; ++x)
      EXPECT_LT(glm::distance(to_texels(own_texcoords(x, y, 7, 5), 7, 5), glm::dvec2(x, y)), 1e-6);
}

// Texels whose centres are strictly inside are visited once, in rows, those outside are not,
// whatever the order of the corners, which changes no texel.
template <typename Real>
void expect_spans_inside() {
  constexpr int kWidth = 23, kHeight = 19;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    TexelTriangleOf<Real> p;
    for (auto& corner : p) {
      corner = {random.uniform(-6, kWidth + 6), random.uniform(-6, kHeight + 6)};
      // Corners and edges through centres, and level edges.
      if (seed % 3 == 0) corner = glm::round(corner);
      if (seed % 3 == 1 && random.below(2)) corner.y = p[0].y;
    }
    std::sort(p.begin(), p.end(), [](auto& a, auto& b) { return a.x < b.x; });
    Image<int> first(kWidth, kHeight);
    bool is_first = true;
    do {
      Image<int> n_times(kWidth, kHeight);
      for_each_span(p, kWidth, kHeight, [&](int x0, int x1, int y) {
        EXPECT_LT(x0, x1);
        ASSERT_TRUE(x0 >= 0 && x1 <= kWidth && y >= 0 && y < kHeight);
        for (int x = x0; x < x1; ++x) ++n_times.at(x, y);
      });
      if (is_first) first = n_times;
      is_first = false;
      EXPECT_EQ(first.pixels, n_times.pixels);
    } while (std::next_permutation(p.begin(), p.end(), [](auto& a, auto& b) { return a.x < b.x; }));
    const glm::dvec2 a(p[1] - p[0]), b(p[2] - p[0]);
    const double det = a.x * b.y - a.y * b.x;
    if (std::abs(det) < 1) continue;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const glm::dvec2 at = glm::dvec2(x, y) - glm::dvec2(p[0]);
        const double s = (at.x * b.y - at.y * b.x) / det, t = (a.x * at.y - a.y * at.x) / det;
        const double inside = std::min({s, t, 1 - s - t});
        if (std::abs(inside) < 1e-4) continue;
        ASSERT_EQ(first.at(x, y), inside > 0) << x << ' ' << y;
      }
  }
}

TEST(TexelSpans, AreTheCentresInside) {
  expect_spans_inside<float>();
  expect_spans_inside<double>();
}

// Two triangles at a random edge, of floats: texels of one or of the other, of none twice.
TEST(TexelSpans, ShareNoTexelAtAnEdge) {
  constexpr int kSize = 40;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const auto place = [&] { return glm::vec2(random.uniform(1, 38), random.uniform(1, 38)); };
    const glm::vec2 a = place(), b = place(), middle = 0.5f * (a + b);
    const glm::vec2 across(a.y - b.y, b.x - a.x);
    const glm::vec2 c = middle + float(random.uniform(0.2, 1)) * across;
    const glm::vec2 d = middle - float(random.uniform(0.2, 1)) * across;
    Image<int> n_times(kSize, kSize);
    for (const TexelTriangle& p : {TexelTriangle{a, b, c}, {b, a, d}})
      for_each_span(p, kSize, kSize, [&](int x0, int x1, int y) {
        for (int x = x0; x < x1; ++x) ++n_times.at(x, y);
      });
    // Along the edge no texel is left out: rows are whole from one outer side to the other.
    for (int y = 0; y < kSize; ++y) {
      int first = kSize, last = -1, n = 0;
      for (int x = 0; x < kSize; ++x) {
        ASSERT_LE(n_times.at(x, y), 1) << x << ' ' << y;
        if (n_times.at(x, y) == 0) continue;
        first = std::min(first, x), last = x, ++n;
      }
      ASSERT_TRUE(n == 0 || n == last - first + 1) << y;
    }
  }
}

// Bilinear values of a ramp are exact; beyond the rim the image goes on as it ends.
TEST(BilinearTexels, GiveBackARamp) {
  for (const auto& [width, height] : {std::pair(9, 6), {1, 5}, {4, 1}}) {
    Image<double> ramp(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) ramp.at(x, y) = 3 + 2 * x - 7 * y;
    Random random(4);
    for (int i = 0; i < 300; ++i) {
      const glm::dvec2 at(random.uniform(-2, width + 1), random.uniform(-2, height + 1));
      const BilinearTexels texels = bilinear_texels(ramp, at);
      double sum = 0, weight = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        sum += texels.weights[k] * ramp.pixels[texels.offsets[k]];
        weight += texels.weights[k];
      }
      const double x = std::clamp(at.x, 0.0, width - 1.0), y = std::clamp(at.y, 0.0, height - 1.0);
      EXPECT_NEAR(weight, 1, 1e-6);
      EXPECT_NEAR(sum, 3 + 2 * x - 7 * y, 1e-4) << at.x << ' ' << at.y;
    }
  }
}

}  // namespace
}  // namespace viewcell
