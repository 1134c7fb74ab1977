#include "image/compare_index_maps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace viewcell {
namespace {

IndexMap identity(int width_px, int height_px) {
  IndexMap map(width_px, height_px);
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x) map.at(x, y) = own_texcoords(x, y, width_px, height_px);
  return map;
}

// 8 x 4 texels; three of them moved: by (3, 0), by (0, -4) and by (0.5, 0.5) texels.
TEST(CompareIndexMaps, ByHand) {
  const IndexMap a = identity(8, 4);
  IndexMap b = a;
  b.at(1, 0).x += 3.f / 8;
  b.at(5, 2).y -= 4.f / 4;
  b.at(7, 3) += glm::vec2(0.5f / 8, 0.5f / 4);
  const IndexMapDistance d = compare_index_maps(a, b);
  EXPECT_EQ(d.n_texels, 32u);
  EXPECT_NEAR(d.rms_texels, std::sqrt((9 + 16 + 0.5) / 32), 1e-6);
  EXPECT_NEAR(d.max_texels, 4, 1e-6);
  EXPECT_DOUBLE_EQ(d.share_within, 30. / 32);
  EXPECT_DOUBLE_EQ(compare_index_maps(a, b, {3.5, {}}).share_within, 31. / 32);
  EXPECT_DOUBLE_EQ(compare_index_maps(a, b, {0, {}}).share_within, 29. / 32);
}

TEST(CompareIndexMaps, CountsWhereAsked) {
  const IndexMap a = identity(8, 4);
  IndexMap b = a;
  b.at(1, 0).x += 3.f / 8;
  b.at(5, 2).y -= 4.f / 4;
  CompareIndexMapsOptions options{.counted = Image<std::uint32_t>(8, 4)};
  EXPECT_EQ(compare_index_maps(a, b, options).n_texels, 0u);
  EXPECT_EQ(compare_index_maps(a, b, options).rms_texels, 0);
  EXPECT_EQ(compare_index_maps(a, b, options).share_within, 1);
  options.counted.at(5, 2) = 3, options.counted.at(6, 2) = 1;
  const IndexMapDistance d = compare_index_maps(a, b, options);
  EXPECT_EQ(d.n_texels, 2u);
  EXPECT_NEAR(d.rms_texels, std::sqrt(8), 1e-6);
  EXPECT_DOUBLE_EQ(d.share_within, 0.5);
}

// d(a, a) = 0; d(a, b) = d(b, a); a shift of all by (p, q) texels is hypot(p, q) of each.
TEST(CompareIndexMaps, Laws) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const int width = 1 + static_cast<int>(random.below(40));
    const int height = 1 + static_cast<int>(random.below(40));
    IndexMap a(width, height), shifted = a, b = a;
    const double p = 4 * random.uniform() - 2, q = 4 * random.uniform() - 2;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
      a.pixels[i] = {random.uniform(), random.uniform()};
      b.pixels[i] = {random.uniform(), random.uniform()};
      shifted.pixels[i] = a.pixels[i] + glm::vec2(p / width, q / height);
    }
    EXPECT_EQ(compare_index_maps(a, a).rms_texels, 0);
    EXPECT_EQ(compare_index_maps(a, a).max_texels, 0);
    EXPECT_EQ(compare_index_maps(a, b).rms_texels, compare_index_maps(b, a).rms_texels);
    const IndexMapDistance d = compare_index_maps(a, shifted);
    EXPECT_NEAR(d.rms_texels, std::hypot(p, q), 1e-4);
    EXPECT_NEAR(d.max_texels, std::hypot(p, q), 1e-4);
  }
}

}  // namespace
}  // namespace viewcell
