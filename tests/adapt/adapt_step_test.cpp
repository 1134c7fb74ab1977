// Single steps of logs that are written by hand, on textures whose values are known everywhere.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "adapt/hand_log.h"
#include "adapt/texel_affine.h"
#include "adapt/texel_samples.h"
#include "adapt/texture_adapt.h"
#include "base/random.h"
#include "image/texel_spans.h"

namespace viewcell {
namespace {

constexpr glm::dvec4 whole(int width_px, int height_px) {
  return {-0.5, -0.5, width_px - 0.5, height_px - 0.5};
}

// How far p lies inside of a box, in texels; below 0 outside.
double inside_box(const Place& p, const glm::dvec4& b) {
  return std::min(std::min(p.x - b.x, b.z - p.x), std::min(p.y - b.y, b.w - p.y));
}

// From box to box.
Place map_box(const Place& p, const glm::dvec4& from, const glm::dvec4& to) {
  return {to.x + (p.x - from.x) * (to.z - to.x) / (from.z - from.x),
          to.y + (p.y - from.y) * (to.w - to.y) / (from.w - from.y)};
}

// ---- Kinds of texels ---------------------------------------------------------------------------

// A ramp over the image: bilinear samples of it are exact but for rounding.
template <typename Texel>
Float4 ramp(const Place& p) {
  if constexpr (kIsIndex<Texel>)
    return Float4{float(0.1 + 0.010 * p.x + 0.002 * p.y), float(0.7 - 0.003 * p.x - 0.008 * p.y)};
  else
    return Float4{float(5.2 + 3.1 * p.x + 0.9 * p.y), float(240.3 - 0.8 * p.x - 3.3 * p.y),
                  float(9.7 + 1.7 * p.x + 2.3 * p.y), float(200.4 - 2.6 * p.x + 0.6 * p.y)};
}

template <typename Texel>
Image<Texel> make_ramp(int width_px, int height_px) {
  Image<Texel> out(width_px, height_px);
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x) store(ramp<Texel>({x, y}), out.at(x, y));
  return out;
}

template <typename Texel>
constexpr double kCode = 2e-5;  // what rounding may move a value by
template <>
constexpr double kCode<Unorm16Texel> = 1.0 / 65535;
template <>
constexpr double kCode<Unorm8Texel> = 1.0 / 255;
template <>
constexpr double kCode<HalfTexel> = 1.0 / 2048;
template <>
constexpr double kCode<Rgba8> = 1;

// Sums of the errors, in codes.
struct Errors {
  double sum = 0;
  std::size_t n = 0;

  template <typename Texel>
  void expect(const Texel& texel, const Place& source) {
    const Float4 is = load(texel), wanted = ramp<Texel>(source);
    for (int k = 0; k < (kIsIndex<Texel> ? 2 : 4); ++k, ++n) {
      const double error = (double(is[k]) - double(wanted[k])) / kCode<Texel>;
      EXPECT_LT(std::abs(error), 1.1) << k << " of " << source.x << ' ' << source.y;
      sum += error;
    }
  }
};

template <typename Texel>
class AdaptStep : public testing::Test {};
using Texels = testing::Types<glm::vec2, Unorm16Texel, Unorm8Texel, HalfTexel, Rgba8>;
TYPED_TEST_SUITE(AdaptStep, Texels);

// Triangles that go anywhere, also from beyond the image, whose rim goes on; thin ones, too.
TYPED_TEST(AdaptStep, MovesARampAffinely) {
  constexpr int kWidth = 37, kHeight = 29;
  Errors errors;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    HandLog hand(kWidth, kHeight, 1);
    hand.add_chart(whole(kWidth, kHeight), 0);
    const auto somewhere = [&](double beyond) {
      return Place(random.uniform(-beyond, kWidth - 1 + beyond),
                   random.uniform(-beyond, kHeight - 1 + beyond));
    };
    const TexelTriangleOf<double> from{somewhere(3), somewhere(3), somewhere(3)};
    TexelTriangleOf<double> to{somewhere(0), somewhere(0), somewhere(0)};
    if (seed % 3 == 0) to[1] = to[0] + Place(0.9, 0.01), to[2] = to[0] + Place(0.5, 17);
    const Place a = to[1] - to[0], b = to[2] - to[0];
    const double det = a.x * b.y - a.y * b.x;
    if (std::abs(det) < 8) continue;
    hand.add_step({from.begin(), from.end()}, {to.begin(), to.end()}, {{{0, 1, 2}, 0, 0}});
    const auto start = make_ramp<TypeParam>(kWidth, kHeight);
    TextureAdapter<TypeParam> adapter(hand.log, start, hand.charts);
    adapter.go_to(1);
    const auto image = adapter.image();
    std::size_t n_inside = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const Place p = Place(x, y) - to[0];
        const double s = (p.x * b.y - p.y * b.x) / det, t = (a.x * p.y - a.y * p.x) / det;
        const double inside = std::min({s, t, 1 - s - t});
        if (std::abs(inside) < 1e-3) continue;
        if (inside > 0) {
          const Place source = from[0] + s * (from[1] - from[0]) + t * (from[2] - from[0]);
          errors.expect(image.at(x, y),
                        glm::clamp(source, Place(0), Place(kWidth - 1, kHeight - 1)));
          ++n_inside;
        } else {
          const Float4 is = load(image.at(x, y)), was = load(start.at(x, y));
          ASSERT_TRUE(is[0] == was[0] && is[1] == was[1] && is[2] == was[2] && is[3] == was[3]);
        }
      }
    EXPECT_NEAR(double(adapter.counts().n_texels), double(n_inside), 15);
    EXPECT_EQ(adapter.counts().n_adaptations, 1u);
  }
  EXPECT_LT(std::abs(errors.sum / double(errors.n)), 0.1);  // of a code: rounded, not cut off
}

// Back again the cells are sampled the other way round; an original is not sampled.
TYPED_TEST(AdaptStep, GoesBack) {
  constexpr int kSize = 32;
  const glm::dvec4 before{3.3, 4.1, 20.4, 22.6}, after{6.2, 2.7, 28.3, 18.9};
  for (const bool is_original : {false, true}) {
    HandLog hand(kSize, kSize, 1);
    hand.add_chart(whole(kSize, kSize), 0);
    hand.add_box(before, after, 0, false);
    for (AdaptationTriangle& t : hand.log.triangles) t.flags = is_original ? 8 : 0;
    TextureAdapter<TypeParam> adapter(hand.log, make_ramp<TypeParam>(kSize, kSize), hand.charts);
    EXPECT_EQ(adapter.n_collapsed(), 0u);
    adapter.go_to(1);
    EXPECT_EQ(adapter.n_collapsed(), 1u);
    const auto there = adapter.image();
    adapter.go_to(0);
    const auto back = adapter.image();
    std::size_t n_inside = 0;
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const bool was_inside = inside_box({x, y}, before) > 0;
        const Float4 is = load(back.at(x, y)), last = load(there.at(x, y));
        if (!was_inside) {
          EXPECT_TRUE(is[0] == last[0] && is[1] == last[1]);
        } else if (is_original && kIsIndex<TypeParam>) {
          TypeParam own;
          store(load(own_texcoords(x, y, kSize, kSize)), own);
          EXPECT_TRUE(is[0] == load(own)[0] && is[1] == load(own)[1]);
        } else if (inside_box(map_box({x, y}, before, after), after) > 1.01) {
          const Float4 wanted = ramp<TypeParam>({x, y});
          for (int k = 0; k < 2; ++k) EXPECT_LT(std::abs(is[k] - wanted[k]), 2 * kCode<TypeParam>);
          ++n_inside;
        }
      }
    EXPECT_EQ(n_inside > 100, !(is_original && kIsIndex<TypeParam>));
  }
}

TEST(Texels, AreWholeNumbersOverTheLargest) {
  EXPECT_EQ(load(Unorm16Texel{{65535, 13107}})[0], 1);
  EXPECT_FLOAT_EQ(load(Unorm16Texel{{65535, 13107}})[1], 0.2f);
  EXPECT_EQ(load(Unorm8Texel{{255, 51}})[0], 1);
  EXPECT_FLOAT_EQ(load(Unorm8Texel{{255, 51}})[1], 0.2f);
  EXPECT_EQ(load(HalfTexel{{0x3c00, 0x3800}})[1], 0.5f);
  IndexMap map(2, 1);
  map.pixels = {{0.6f / 255, 0.4f / 255}, {-3, 9}};
  const Image<Unorm8Texel> codes = from_float<Unorm8Texel>(map);
  EXPECT_EQ(codes.pixels[0].uv, (std::array<std::uint8_t, 2>{1, 0}));
  EXPECT_EQ(codes.pixels[1].uv, (std::array<std::uint8_t, 2>{0, 255}));
  for (int i = 0; i < 65536; i += 251) {
    Image<Unorm16Texel> all(1, 1);
    all.pixels[0].uv = {static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(65535 - i)};
    EXPECT_EQ(from_float<Unorm16Texel>(float_from(all)).pixels[0].uv, all.pixels[0].uv);
  }
}

// ---- Several charts ----------------------------------------------------------------------------

constexpr glm::vec2 kJunk(100, -100);

glm::vec2 ramp_at(const Place& p) {
  const Float4 v = ramp<glm::vec2>(p);
  return {v[0], v[1]};
}

void expect_ramp(const glm::vec2& is, const Place& source, double within = 1e-5) {
  EXPECT_LT(glm::distance(is, ramp_at(source)), within) << source.x << ' ' << source.y;
}

// Chart 0 left of x = 15.5, the next texel is chart 1's and junk. Samples at the border take the
// last column that is the chart's own, however little of it they meet.
TEST(AdaptedCharts, SamplesTakeTheirOwnChart) {
  for (const double reach : {14.0, 15.5, 15.995}) {
    SCOPED_TRACE(reach);
    HandLog hand(48, 24, 2);
    hand.add_chart({-0.5, -0.5, 15.5, 23.5}, 0);
    hand.add_chart({15.5, -0.5, 47.5, 23.5}, 1);
    const glm::dvec4 before{2.2, 3.1, reach, 20.2}, after{1.4, 3.9, 14.0005, 21.3};
    hand.add_box(before, after, 0, false);
    IndexMap map(48, 24, kJunk);
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 16; ++x) map.at(x, y) = ramp_at({x, y});
    TextureAdapter<glm::vec2> adapter(hand.log, map, hand.charts);
    adapter.go_to(1);
    const IndexMap out = adapter.image();
    for (int y = 4; y < 22; ++y)
      for (int x = 2; x < 15; ++x) {
        const Place source = map_box({x, y}, after, before);
        expect_ramp(out.at(x, y), {std::min(source.x, 15.0), source.y});
      }
  }
}

// Where all four texels are another's there is nothing better than they.
TEST(AdaptedCharts, SamplesAmongOthersTakeWhatIsThere) {
  HandLog hand(48, 24, 2);
  hand.add_chart({-0.5, -0.5, 15.5, 23.5}, 0);
  hand.add_chart({15.5, -0.5, 47.5, 23.5}, 1);
  hand.add_box({30, 3, 40, 20}, {2, 3, 12, 20}, 0, false);
  TextureAdapter<glm::vec2> adapter(hand.log, make_ramp<glm::vec2>(48, 24), hand.charts);
  adapter.go_to(1);
  const IndexMap out = adapter.image();
  for (int y = 4; y < 20; ++y)
    for (int x = 3; x < 12; ++x) expect_ramp(out.at(x, y), {x + 28, y});
}

// A map of 64 x 48 whose one chart is a box with a ramp, that goes 3 texels on; junk around.
struct BoxChart {
  HandLog hand{64, 48, 1};
  IndexMap map{64, 48, kJunk};

  explicit BoxChart(const glm::dvec4& box) { add(box, 0); }
  void add(const glm::dvec4& box, std::uint32_t chart) {
    hand.add_chart(box, chart);
    for (int y = 0; y < map.height_px; ++y)
      for (int x = 0; x < map.width_px; ++x)
        if (inside_box({x, y}, box) > -3) map.at(x, y) = ramp_at({x, y});
  }
};

// The ramp goes on around the chart: 2 texels everywhere, at its corners, too, and no junk in the
// third. What lies farther off stays.
TEST(AdaptedCharts, GuttersContinueTheChart) {
  for (const bool is_turned : {false, true}) {
    const glm::dvec4 before{12.2, 14.4, 36.6, 33.1}, after{14.7, 11.6, 40.3, 31.9};
    BoxChart chart(before);
    chart.hand.add_box(before, after, 0, true);
    if (is_turned) {  // edges 0-2, 2-1, 1-0 and 0-3, 3-2, 2-0
      for (AdaptationTriangle& t : chart.hand.log.triangles) std::swap(t.corners[1], t.corners[2]);
      chart.hand.log.triangles[0].flags = 0b110;
      chart.hand.log.triangles[1].flags = 0b011;
    }
    TextureAdapter<glm::vec2> adapter(chart.hand.log, chart.map, chart.hand.charts);
    adapter.go_to(1);
    const IndexMap out = adapter.image();
    for (int y = 0; y < 48; ++y)
      for (int x = 0; x < 64; ++x) {
        const double inside = inside_box({x, y}, after);
        const Place source = map_box({x, y}, after, before);
        if (inside > -2) expect_ramp(out.at(x, y), source, inside > 0 ? 1e-5 : 0.02);
        if (inside > -1) expect_ramp(out.at(x, y), source, 1e-5);
        if (inside > -3) {
          EXPECT_LT(out.at(x, y).x, 1) << x << ' ' << y;
        } else if (inside_box({x, y}, before) < 0) {
          EXPECT_EQ(out.at(x, y), chart.map.at(x, y)) << x << ' ' << y;
        }
        EXPECT_EQ(adapter.is_inside(chart.map.offset(x, y)), inside > 0) << x << ' ' << y;
      }
    EXPECT_EQ(adapter.counts().n_texels, 26u * 20);
  }
}

// Of a chart that becomes a quarter as large gutters would come from 12 texels beyond: they go no
// farther than there are texels of the chart.
TEST(AdaptedCharts, GuttersStayAtTheChart) {
  const glm::dvec4 before{8.3, 7.2, 56.3, 39.2}, after{24.4, 20.4, 36.4, 28.4};
  BoxChart chart(before);
  chart.hand.add_box(before, after, 0, true);
  TextureAdapter<glm::vec2> adapter(chart.hand.log, chart.map, chart.hand.charts);
  adapter.go_to(1);
  const IndexMap out = adapter.image();
  for (int y = 18; y < 31; ++y)
    for (int x = 22; x < 39; ++x) {
      const Place source =
          glm::clamp(map_box({x, y}, after, before), Place(before.x - 3, before.y - 3),
                     Place(before.z + 3, before.w + 3));
      expect_ramp(out.at(x, y), source, inside_box({x, y}, after) > 0 ? 1e-5 : 0.016);
      EXPECT_EQ(adapter.is_inside(out.offset(x, y)), inside_box({x, y}, after) > 0);
    }
}

// Chart 0 grows over chart 1, and shrinks again: all that chart 1 holds stays its own.
TEST(AdaptedCharts, GrowsOverNoOther) {
  const glm::dvec4 before{8.2, 8.2, 24.6, 32.7}, after{8.2, 8.2, 35.4, 32.7};
  BoxChart chart(before);
  chart.hand.log.n_charts = 2;
  const glm::dvec4 other{29.5, 4.5, 50.5, 40.5};
  chart.hand.add_chart(other, 1);
  for (int y = 5; y <= 40; ++y)
    for (int x = 30; x <= 50; ++x) chart.map.at(x, y) = kJunk;
  chart.hand.add_box(before, after, 0, true);
  TextureAdapter<glm::vec2> adapter(chart.hand.log, chart.map, chart.hand.charts);
  for (const std::size_t to : {1u, 0u}) {
    adapter.go_to(to);
    const IndexMap out = adapter.image();
    for (int y = 5; y <= 40; ++y)
      for (int x = 30; x <= 50; ++x) {
        ASSERT_EQ(out.at(x, y), kJunk) << x << ' ' << y;
        ASSERT_TRUE(adapter.is_inside(out.offset(x, y)));
      }
    for (int y = 9; y <= 32; ++y)
      for (int x = 9; x < 30; ++x) {
        const bool is_own = x < (to == 1 ? 35 : 25);
        ASSERT_EQ(adapter.is_inside(out.offset(x, y)), is_own) << x << ' ' << y;
      }
    EXPECT_EQ(adapter.counts().n_conflicts, 6u * 24);  // columns 30 to 35
  }
}

// A chart comes near another where there was none: from now on that one's samples are guarded.
TEST(AdaptedCharts, ChartsThatComeNearAreNoticed) {
  const glm::dvec4 far{4.5, 8.5, 14.5, 32.5}, near{24.5, 8.5, 39.1, 32.5};
  const glm::dvec4 other{39.5, 8.5, 60.5, 32.5};
  BoxChart chart(other);
  chart.hand.charts.charts = {1, 1};
  chart.hand.log.n_charts = 2;
  chart.hand.add_chart(far, 0);  // of junk
  chart.hand.add_box(far, near, 0, true);
  chart.hand.add_box({39.2, 12, 50, 30}, {41.9, 12, 52, 30}, 1, false);
  TextureAdapter<glm::vec2> adapter(chart.hand.log, chart.map, chart.hand.charts);
  adapter.go_to(2);
  const IndexMap out = adapter.image();
  for (int y = 13; y < 30; ++y)
    for (int x = 42; x < 52; ++x) {
      const Place source = map_box({x, y}, {41.9, 12, 52, 30}, {39.2, 12, 50, 30});
      expect_ramp(out.at(x, y), {std::max(source.x, 40.0), source.y});
    }
}

// ---- Affine maps -------------------------------------------------------------------------------

TEST(TexelAffine, TakesCornersToCorners) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const auto place = [&] { return glm::vec2(random.uniform(0, 40), random.uniform(0, 40)); };
    const TexelTriangle from{place(), place(), place()}, to{place(), place(), place()};
    const glm::vec2 a = from[1] - from[0], b = from[2] - from[0];
    if (std::abs(a.x * b.y - a.y * b.x) < 20) continue;
    const TexelAffine map = make_affine(from, to);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_LT(glm::distance(map(from[k]), to[k]), 2e-3f) << k;
  }
}

// Triangles of little height: of 0.05 texels it counts, of 0.004 only the longest edge does,
// whichever corner comes first.
TEST(TexelAffine, LowTrianglesAreTheirLongestEdge) {
  const glm::vec2 far(20, 31), near(14, 30), begin(5, 7);
  for (std::size_t first = 0; first < 3; ++first)
    for (const bool is_below : {false, true}) {
      const auto make = [&](float height) {
        const std::array<glm::vec2, 3> p{
            {{3, 4}, {13, 4}, is_below ? glm::vec2(4, 4 + height) : glm::vec2(4, 4 - height)}};
        TexelTriangle out;
        for (std::size_t k = 0; k < 3; ++k) out[(k + first) % 3] = p[k];
        return out;
      };
      TexelTriangle to;
      const std::array<glm::vec2, 3> q{begin, far, near};
      for (std::size_t k = 0; k < 3; ++k) to[(k + first) % 3] = q[k];
      const TexelTriangle thin = make(0.05f);
      EXPECT_LT(glm::distance(make_affine(thin, to)(thin[(2 + first) % 3]), near), 0.01f);
      const TexelAffine along = make_affine(make(0.004f), to);
      EXPECT_LT(glm::distance(along({3, 4}), begin), 1e-4f);
      EXPECT_LT(glm::distance(along({13, 4}), far), 1e-4f);
      EXPECT_LT(glm::distance(along({8, 4}), 0.5f * (begin + far)), 1e-4f);
      EXPECT_LT(glm::distance(along({8, 9}), 0.5f * (begin + far)), 0.01f);
    }
  // Upright ones, and one without any extent.
  const TexelTriangle up{{{4, 3}, {4, 5}, {4, 13}}};
  const TexelAffine along = make_affine(up, {begin, near, far});
  EXPECT_LT(glm::distance(along({4, 8}), 0.5f * (begin + far)), 1e-4f);
  const TexelTriangle point{{{4, 3}, {4, 3}, {4, 3}}};
  EXPECT_EQ(make_affine(point, {begin, near, far})({9, 9}), begin);
}

}  // namespace
}  // namespace viewcell
