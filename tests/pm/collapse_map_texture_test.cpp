// Where the map of a collapse puts its two apexes in the texture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "mesh/closest_on_segment.h"
#include "mesh/closest_point.h"
#include "pm/collapse_map.h"
#include "pm/parts.h"

namespace viewcell {
namespace {

constexpr double kInside =
    1.0 / 16384;  // least weight of a corner, before they are made to sum to 1

// A fan around vertex 0 in relief; open: without its last triangle.
struct Fan {
  TriMesh mesh;
  std::uint32_t n;  // of the rim
  bool is_open;
  Parts parts;
  CollapseMap map;

  Fan(std::uint64_t seed, bool open, double height)
      : mesh(make(seed, open, height)),
        n(static_cast<std::uint32_t>(mesh.positions.size()) - 1),
        is_open(open),
        parts(mesh),
        map(parts.mesh, parts.table, parts.wedges.positions, parts.wedges.texcoords,
            Matching::nearest, {.texture = true}) {}
  static TriMesh make(std::uint64_t seed, bool open, double height) {
    Random random(seed);
    TriMesh fan = make_fan(3 + random.below(6), 0.2, height, random);
    if (open) fan.triangles.pop_back(), fan.texcoords.resize(3 * fan.triangles.size());
    return fan;
  }
  glm::dvec3 at(std::uint32_t vertex) const { return glm::dvec3(mesh.positions[vertex]); }
  glm::dvec2 uv(std::uint32_t vertex) const {
    for (std::size_t c = 0; c < mesh.texcoords.size(); ++c)
      if (mesh.triangles[c / 3][c % 3] == vertex) return glm::dvec2(mesh.texcoords[c]);
    return glm::dvec2(0);
  }
  std::uint32_t rim(std::uint32_t i) const { return 1 + i % n; }
  // The only point of either kind.
  TexturePoint apex(bool TexturePoint::*is_apex) const {
    std::optional<TexturePoint> found;
    for (const TexturePoint& point : map.overlay().texture_points())
      if (point.*is_apex) {
        EXPECT_FALSE(found);
        found = point;
      }
    return found.value_or(TexturePoint{glm::dvec2(NAN), glm::dvec2(NAN)});
  }
};

struct Corner {
  glm::dvec3 at;
  glm::dvec2 uv;
};

// The point of some triangles that is nearest to p, the first of several, as it lies in the
// texture.
struct Nearest {
  std::size_t triangle = 0;
  double distance = 1e30, margin = 1e30;  // to p; of the next triangle's
  glm::dvec2 uv{0};

  Nearest(const glm::dvec3& p, const std::vector<std::array<Corner, 3>>& triangles) {
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const auto& [a, b, c] = triangles[i];
      const glm::dvec3 q = closest_point_on_triangle(p, a.at, b.at, c.at);
      const double away = glm::distance(p, q);
      margin = std::min(margin, std::abs(away - distance));
      if (!(away < distance)) continue;
      glm::dvec3 w = corner_weights(q, a.at, b.at, c.at);
      w = (w + kInside) / (1 + 3 * kInside);
      triangle = i, distance = away, uv = w.x * a.uv + w.y * b.uv + w.z * c.uv;
    }
  }
};

TEST(CollapseMapTexture, TheOldApexKeepsInsideItsNewFace) {
  std::size_t n_laid = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Fan fan(seed, false, 1);
    const std::uint32_t first = Random(seed + 9).below(fan.n);
    const std::uint32_t v = fan.rim(first);
    if (!fan.map.build(0, v)) continue;
    ++n_laid;
    std::vector<std::array<Corner, 3>> faces;
    const auto corner = [&](std::uint32_t i) { return Corner{fan.at(i), fan.uv(i)}; };
    for (std::uint32_t j = 1; j + 1 < fan.n; ++j)
      faces.push_back({corner(v), corner(fan.rim(first + j)), corner(fan.rim(first + j + 1))});
    const Nearest nearest(fan.at(0), faces);
    const TexturePoint apex = fan.apex(&TexturePoint::is_old_apex);
    EXPECT_LT(glm::distance(apex.before, fan.uv(0)), 1e-7);
    // A point on an edge has two faces, and rounding says which comes first.
    if (nearest.margin < 1e-9) continue;
    EXPECT_LT(glm::distance(apex.after, nearest.uv), 1e-6);
  }
  EXPECT_EQ(n_laid, 200u);
}

// Of two faces that are as near, the first one from v on.
TEST(CollapseMapTexture, TheFirstOfTwoFacesAsNear) {
  TriMesh mesh;  // u over the middle of a square; v is one of its corners
  mesh.positions = {{0, 0, 1}, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  for (std::uint32_t i = 0; i < 4; ++i) mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % 4});
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) mesh.texcoords.emplace_back(mesh.positions[v]);
  Parts parts(mesh);
  CollapseMap map(parts.mesh, parts.table, parts.wedges.positions, parts.wedges.texcoords,
                  Matching::nearest, {.texture = true});
  for (std::uint32_t v = 1; v < 5; ++v) {
    ASSERT_TRUE(map.build(0, v));
    std::vector<std::uint32_t> taken;
    map.for_each_location(
        [&](std::uint32_t face, const auto&) { taken.push_back(map.faces()[face]); });
    EXPECT_EQ(taken,
              std::vector<std::uint32_t>{v % 4});  // from the next corner to the one opposite
  }
}

TEST(CollapseMapTexture, OpenFansGoToTheNewBorder) {
  std::size_t n_ends = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Fan fan(seed, true, 1);
    const bool is_first = seed % 2;
    const std::uint32_t v = is_first ? 1 : fan.n, far = is_first ? fan.n : 1;
    ASSERT_TRUE(fan.map.build(0, v));
    const double t = closest_on_segment(fan.at(0), fan.at(v), fan.at(far));
    n_ends += t == 0 || t == 1;
    const TexturePoint apex = fan.apex(&TexturePoint::is_old_apex);
    EXPECT_LT(glm::distance(apex.before, fan.uv(0)), 1e-7);
    EXPECT_LT(glm::distance(apex.after,
                            glm::mix(fan.uv(v), fan.uv(far), std::clamp(t, kInside, 1 - kInside))),
              1e-6);
    // Only its ends are on the border.
    for (std::uint32_t i = 2; i < fan.n; ++i) EXPECT_FALSE(fan.map.build(0, i)) << i;
  }
  EXPECT_GT(n_ends, 5u);
}

// The vertex moves: where it comes to it has the texture coordinates that were asked for; there the
// old surface has the nearest point, and the other way round in another face.
TEST(CollapseMapTexture, MovedApexes) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Fan fan(seed, false, 0.6);
    Random random(seed + 5);
    const auto off = [&] { return random.uniform(-0.5, 0.5); };
    const glm::dvec3 to = fan.at(0) + glm::dvec3(off(), off(), 2 * off());
    const glm::vec2 uv_to(off(), off());
    ASSERT_TRUE(fan.map.build_move(0, to, std::vector<WedgeMove>{{0, uv_to}}));
    std::vector<std::array<Corner, 3>> old_faces, new_faces;
    for (std::uint32_t i = 0; i < fan.n; ++i) {
      const Corner b{fan.at(fan.rim(i)), fan.uv(fan.rim(i))};
      const Corner c{fan.at(fan.rim(i + 1)), fan.uv(fan.rim(i + 1))};
      old_faces.push_back({Corner{fan.at(0), fan.uv(0)}, b, c});
      new_faces.push_back({Corner{to, glm::dvec2(uv_to)}, b, c});
    }
    const Nearest before(to, old_faces);
    const TexturePoint new_apex = fan.apex(&TexturePoint::is_new_apex);
    EXPECT_LT(glm::distance(new_apex.after, glm::dvec2(uv_to)), 1e-6);
    if (before.margin < 1e-9) continue;
    EXPECT_LT(glm::distance(new_apex.before, before.uv), 1e-6);
    new_faces.erase(new_faces.begin() + static_cast<std::ptrdiff_t>(before.triangle));
    const Nearest after(fan.at(0), new_faces);
    const TexturePoint old_apex = fan.apex(&TexturePoint::is_old_apex);
    EXPECT_LT(glm::distance(old_apex.before, fan.uv(0)), 1e-6);
    if (after.margin < 1e-9) continue;
    EXPECT_LT(glm::distance(old_apex.after, after.uv), 1e-6);
  }
}

TEST(CollapseMapTexture, MovedApexesOfBorders) {
  std::size_t n_first = 0, n_last = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Fan fan(seed, true, 0.6);
    Random random(seed + 5);
    const auto off = [&] { return random.uniform(-0.5, 0.5); };
    const glm::dvec3 to = fan.at(0) + glm::dvec3(off(), off(), off());
    const glm::vec2 uv_to(off(), off());
    ASSERT_TRUE(fan.map.build_move(0, to, std::vector<WedgeMove>{{0, uv_to}}));
    // The two edges of the old border; the new apex goes to the nearer, the old one to the other's.
    const std::array<std::uint32_t, 2> ends{1, fan.n};
    std::array<double, 2> s, away;
    for (std::size_t k = 0; k < 2; ++k) {
      s[k] = closest_on_segment(to, fan.at(0), fan.at(ends[k]));
      away[k] = glm::distance(to, glm::mix(fan.at(0), fan.at(ends[k]), s[k]));
    }
    const std::size_t near = away[0] <= away[1] ? 0 : 1;
    ++(near == 0 ? n_first : n_last);
    const auto inside = [](double t) { return std::clamp(t, kInside, 1 - kInside); };
    const TexturePoint new_apex = fan.apex(&TexturePoint::is_new_apex);
    EXPECT_LT(
        glm::distance(new_apex.before, glm::mix(fan.uv(0), fan.uv(ends[near]), inside(s[near]))),
        1e-6);
    EXPECT_LT(glm::distance(new_apex.after, glm::dvec2(uv_to)), 1e-6);
    const double t = closest_on_segment(fan.at(0), to, fan.at(ends[1 - near]));
    const TexturePoint old_apex = fan.apex(&TexturePoint::is_old_apex);
    EXPECT_LT(glm::distance(old_apex.after,
                            glm::mix(glm::dvec2(uv_to), fan.uv(ends[1 - near]), inside(t))),
              1e-6);
  }
  EXPECT_GT(std::min(n_first, n_last), 40u);
}

// One triangle alone stays one: a corner of it moves.
TEST(CollapseMapTexture, ALoneTriangleMoves) {
  TriMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.texcoords = {{0.5f, 0.5f}, {1, 0.5f}, {0.5f, 1}};
  Parts parts(mesh);
  CollapseMap map(parts.mesh, parts.table, parts.wedges.positions, parts.wedges.texcoords,
                  Matching::nearest, {.texture = true});
  for (std::uint32_t v = 0; v < 3; ++v) {
    const glm::vec2 uv(0.4f, 0.3f);
    const std::uint32_t wedge = parts.wedges.faces[0][v];
    ASSERT_TRUE(map.build_move(v, {-0.2, -0.3, 0.1}, std::vector<WedgeMove>{{wedge, uv}}));
    ASSERT_EQ(map.overlay().cells().size(), 1u);
    std::vector<std::uint32_t> corners;  // the cell's, which are three
    for (const std::uint32_t corner : map.overlay().textures()[0])
      if (corners.empty() || corner != corners.back()) corners.push_back(corner);
    ASSERT_EQ(corners.size(), 3u);
    std::vector<glm::dvec2> before;
    for (const std::uint32_t corner : corners) {
      const TexturePoint& point = map.overlay().texture_points()[corner];
      const bool is_moved = glm::distance(point.before, glm::dvec2(mesh.texcoords[v])) < 1e-9;
      EXPECT_LT(glm::distance(point.after, is_moved ? glm::dvec2(uv) : point.before), 1e-7);
      before.push_back(point.before);
    }
    const glm::dvec2 a = before[1] - before[0], b = before[2] - before[0];
    EXPECT_NEAR(a.x * b.y - a.y * b.x, 0.25, 1e-9);  // the triangle's own way to turn
  }
}

// A map that has been asked about other edges says what a new one says.
TEST(CollapseMapTexture, RemembersNothingOfOtherStars) {
  const TriMesh mesh = make_relief(4);
  Parts parts(mesh);
  const auto make = [&] {
    return CollapseMap(parts.mesh, parts.table, parts.wedges.positions, parts.wedges.texcoords,
                       Matching::nearest, {.texture = true});
  };
  CollapseMap used = make();
  Random random(1);
  std::size_t n_laid = 0;
  for (int i = 0; i < 400; ++i) {
    const Triangle& t = parts.triangles[random.below(98)];
    const std::uint32_t k = random.below(3), u = t[k], v = t[(k + 1) % 3];
    used.locate(u, t[(k + 2) % 3]);
    CollapseMap fresh = make();
    const bool is_laid = fresh.build(u, v);
    ASSERT_EQ(used.build(u, v), is_laid);
    if (!is_laid) continue;
    ++n_laid;
    const auto &a = used.overlay().texture_points(), &b = fresh.overlay().texture_points();
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t p = 0; p < a.size(); ++p)
      ASSERT_TRUE(a[p].before == b[p].before && a[p].after == b[p].after);
  }
  EXPECT_GT(n_laid, 200u);
}

}  // namespace
}  // namespace viewcell
