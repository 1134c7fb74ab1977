#include "pm/fan_overlay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "mesh/closest_on_segment.h"

namespace viewcell {
namespace {

constexpr double kGap = 1.0 / 16384;  // of an edge, between neighbours on it and to its ends

// Rays 0 ... m + 1 of a side from the new apex, ray 0, on; the old apex goes between the last two.
struct Side {
  std::size_t m;
  std::vector<FanPoint> rays;
  FanPoint after;
  glm::dvec2 origin{0.3, 0.6};

  // A fan in space, and one in the texture that is off by up to `noise`.
  Side(Random& random, double noise, double height) : m(2 + random.below(6)) {
    for (std::size_t i = 0; i < m + 2; ++i) {
      const double angle = 5.5 * (double(i) + random.uniform(0, 0.3)) / double(m + 2);
      const glm::dvec3 at(std::cos(angle), std::sin(angle), random.uniform(-height, height));
      const auto off = [&] { return random.uniform(-noise, noise); };
      rays.push_back({random.uniform(0.6, 1.2) * at, {}});
      rays.back().texture = glm::dvec2(rays.back().at) + glm::dvec2(off(), off());
    }
    after = {(rays[0].at + rays[m].at + rays[m + 1].at) / 3.0,
             (rays[0].texture + rays[m].texture + rays[m + 1].texture) / 3.0};
  }
  FanOverlay lay(Matching matching) const {
    FanOverlay out(matching, {.texture = true});
    out.start(rays[0], origin);
    for (std::uint32_t i = 0; i < rays.size(); ++i) out.add_ray(rays[i], i);
    out.add_old_apex(m, after);
    out.add_side(0, true, m, rays[0], after);
    return out;
  }
  // Of the crossing of old edge i with new edge j.
  const TexturePoint& crossing(const FanOverlay& overlay, std::size_t i, std::size_t j) const {
    std::size_t k = rays.size() + 2;  // after the rays and the two apexes
    for (std::size_t row = 1; row < i; ++row) k += m - row;
    return overlay.texture_points()[k + j - i - 1];
  }
};

// Shares that rise by a gap each with the least squared change: the greatest mean from somewhere
// before of the least means to somewhere behind.
std::vector<double> spaced_out(const std::vector<double>& along) {
  const std::size_t n = along.size();
  const double gap = std::min(kGap, 0.5 / double(n + 1));
  std::vector<double> out;
  for (std::size_t k = 0; k < n; ++k) {
    double greatest = -1e30;
    for (std::size_t a = 0; a <= k; ++a) {
      double least = 1e30, sum = 0;
      for (std::size_t b = a; b < n; ++b) {
        sum += along[b] - double(b + 1) * gap;
        if (b >= k) least = std::min(least, sum / double(b - a + 1));
      }
      greatest = std::max(greatest, least);
    }
    out.push_back(std::clamp(greatest, 0.0, 1 - double(n + 1) * gap) + double(k + 1) * gap);
  }
  return out;
}

// Whether `moved` differs by more than rounding.
bool differ(const std::vector<double>& along, const std::vector<double>& moved) {
  for (std::size_t k = 0; k < along.size(); ++k)
    if (std::abs(along[k] - moved[k]) > 1e-12) return true;
  return false;
}

// Nearest points of edges, then their order along old edges, then along new ones.
TEST(FanOverlay, CrossingsAreSpacedOutAlongBothEdges) {
  std::size_t n_moved = 0, n_still = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Side side(random, 0.2, seed % 2 ? 1.5 : 0.1);
    const std::size_t m = side.m;
    const glm::dvec3 apex = side.rays[0].at;
    std::vector<std::vector<double>> s(m + 1, std::vector<double>(m + 1)), t = s;
    for (std::size_t i = 1; i < m; ++i)
      for (std::size_t j = i + 1; j <= m; ++j) {
        const glm::dvec3 a = side.rays[i].at, b = side.rays[j].at - apex;
        closest_on_segments({.aa = glm::dot(a, a),
                             .bb = glm::dot(b, b),
                             .ab = glm::dot(a, b),
                             .ar = -glm::dot(a, apex),
                             .br = -glm::dot(b, apex)},
                            s[i][j], t[i][j]);
      }
    std::size_t n_edges = 0;
    for (std::size_t i = 1; i < m; ++i) {
      std::vector<double> along;
      for (std::size_t j = m; j > i; --j) along.push_back(s[i][j]);
      const std::vector<double> moved = spaced_out(along);
      n_edges += differ(along, moved);
      for (std::size_t j = m; j > i; --j) {
        if (std::abs(s[i][j] - moved[m - j]) < 1e-12) continue;
        s[i][j] = moved[m - j];
        const glm::dvec3 b = side.rays[j].at - apex;
        t[i][j] =
            std::clamp(glm::dot(s[i][j] * side.rays[i].at - apex, b) / glm::dot(b, b), 0.0, 1.0);
      }
    }
    for (std::size_t j = 2; j <= m; ++j) {
      std::vector<double> along;
      for (std::size_t i = 1; i < j; ++i) along.push_back(t[i][j]);
      const std::vector<double> moved = spaced_out(along);
      n_edges += differ(along, moved);
      for (std::size_t i = 1; i < j; ++i) t[i][j] = moved[i - 1];
    }
    const FanOverlay overlay = side.lay(Matching::nearest);
    for (std::size_t i = 1; i < m; ++i)
      for (std::size_t j = i + 1; j <= m; ++j) {
        const TexturePoint& point = side.crossing(overlay, i, j);
        const glm::dvec2 apex_uv = side.rays[0].texture;
        EXPECT_LT(glm::distance(point.before, side.origin + s[i][j] * side.rays[i].texture), 1e-9);
        EXPECT_LT(glm::distance(point.after,
                                side.origin + apex_uv + t[i][j] * (side.rays[j].texture - apex_uv)),
                  1e-9);
      }
    EXPECT_EQ(overlay.n_moved_points(), n_edges);
    ++(n_edges > 0 ? n_moved : n_still);
  }
  EXPECT_GT(n_moved, 100u);
  EXPECT_GT(n_still, 20u);
}

// Along every edge the shares keep their order and a gap, to its ends as well.
TEST(FanOverlay, NoTwoPointsOfAnEdgeMeet) {
  for (std::uint64_t seed = 1000; seed < 1300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Side side(random, 0.2, 1.5);
    const FanOverlay overlay = side.lay(Matching::nearest);
    const auto share = [](const glm::dvec2& p, const glm::dvec2& from, const glm::dvec2& to) {
      return glm::dot(p - from, to - from) / glm::dot(to - from, to - from);
    };
    const double least = 0.999 * kGap;
    for (std::size_t i = 1; i < side.m; ++i) {
      double last = 0;
      for (std::size_t j = side.m; j > i; --j) {
        const double s = share(side.crossing(overlay, i, j).before, side.origin,
                               side.origin + side.rays[i].texture);
        EXPECT_GT(s - last, least);
        last = s;
      }
      EXPECT_GT(1 - last, least);
    }
    for (std::size_t j = 2; j <= side.m; ++j) {
      double last = 0;
      for (std::size_t i = 1; i < j; ++i) {
        const double t =
            share(side.crossing(overlay, i, j).after, side.origin + side.rays[0].texture,
                  side.origin + side.rays[j].texture);
        EXPECT_GT(t - last, least);
        last = t;
      }
      EXPECT_GT(1 - last, least);
    }
  }
}

// On a plane that the texture is a view of crossings are where edges cross, for either matching,
// and nothing is shifted.
TEST(FanOverlay, OnAPlaneEdgesJustCross) {
  for (const Matching matching : {Matching::nearest, Matching::texture}) {
    std::size_t n_crossings = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      SCOPED_TRACE(seed);
      Random random(seed);
      Side side(random, 0, 0);
      // A convex rim around the old apex: then all crossings are there.
      for (std::size_t i = 0; i < side.rays.size(); ++i) {
        const double angle = 3.0 * (double(i) + random.uniform(0, 0.5)) / double(side.m + 2) - 0.1;
        side.rays[i].at = {std::cos(angle), std::sin(angle), 0};
        side.rays[i].texture = glm::dvec2(side.rays[i].at);
      }
      side.after = {glm::dvec3(0), glm::dvec2(0)};
      bool cross_inside = true;
      for (std::size_t i = 1; i < side.m; ++i)
        for (std::size_t j = i + 1; j <= side.m; ++j) {
          const glm::dvec2 a = side.rays[i].texture, o = side.rays[0].texture,
                           b = side.rays[j].texture - o;
          const double det = a.x * b.y - a.y * b.x, s = (o.x * b.y - o.y * b.x) / det;
          const double t = (o.x * a.y - o.y * a.x) / det;
          cross_inside = cross_inside && std::min({s, t, 1 - s, 1 - t}) > 0.01;
        }
      if (!cross_inside) continue;
      const FanOverlay overlay = side.lay(matching);
      EXPECT_LT(overlay.largest_shift(), 1e-9);
      for (const TexturePoint& point : overlay.texture_points()) {
        if (point.is_new_apex) continue;  // put at ray 0
        EXPECT_LT(glm::distance(point.before, point.after), 1e-9);
        ++n_crossings;
      }
    }
    EXPECT_GT(n_crossings, 300u);
  }
}

}  // namespace
}  // namespace viewcell
