#include "uv/parameterize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "common/expect_input_error.h"
#include "mesh/knot.h"
#include "mesh/surfaces.h"
#include "uv/distort.h"
#include "uv/patch.h"
#include "uv/textured_patch.h"
#include "uv/uv_stretch.h"

namespace viewcell {
namespace {

std::vector<glm::dvec2> plane_of(const TriMesh& mesh) {
  std::vector<glm::dvec2> out;
  for (const glm::vec3& p : mesh.positions) out.emplace_back(p.x, p.y);
  return out;
}

// A planar mesh whose boundary is in place comes back, however its inner vertices lie.
TEST(SolveInterior, MeanValuesReproduceThePlane) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    TriMesh grid = make_grid(8, 0.24, seed);
    const std::vector<glm::dvec2> plane = plane_of(grid);
    const std::vector<std::uint32_t> loop = find_boundary_loop(grid);
    std::vector<glm::dvec2> places;
    for (const std::uint32_t v : loop) places.push_back(plane[v]);
    double worst_uniform = 0;
    // In the plane itself, and turned out of it; there floats round at 1e-7.
    for (const bool is_turned : {false, true}) {
      for (glm::vec3& p : grid.positions)
        if (is_turned) p = glm::vec3(0.6f * p.x, p.y, 0.8f * p.x);
      const std::vector<glm::dvec2> uv = solve_interior(grid, loop, places);
      const std::vector<glm::dvec2> uniform =
          solve_interior(grid, loop, places, {UvWeights::uniform});
      for (std::size_t v = 0; v < uv.size(); ++v) {
        EXPECT_LT(glm::distance(uv[v], plane[v]), is_turned ? 1e-5 : 1e-12) << v;
        worst_uniform = std::max(worst_uniform, glm::distance(uniform[v], plane[v]));
      }
    }
    EXPECT_GT(worst_uniform, 0.01);
  }
}

//     2         A pyramid, one inner vertex: 4, above the corners of a kite.
//    /|\        Its weights by angles from their cosines.
//   3-4-1
//    \|/
//     0
TEST(SolveInterior, WeightsOfOneVertex) {
  TriMesh mesh;
  mesh.positions = {{0, -2, 0}, {1, 0, 0.5}, {0, 1, 0}, {-3, 0, 0}, {0, 0, 1}};
  mesh.triangles = {{4, 0, 1}, {4, 1, 2}, {4, 2, 3}, {4, 3, 0}};
  const std::vector<std::uint32_t> loop = find_boundary_loop(mesh);
  ASSERT_EQ(loop, (std::vector<std::uint32_t>{0, 1, 2, 3}));
  const std::vector<glm::dvec2> places = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const auto edge = [&](std::size_t j) {
    return glm::dvec3(mesh.positions[j % 4]) - glm::dvec3(mesh.positions[4]);
  };
  const auto tan_half = [&](std::size_t j) {  // of the angle between edges j and j + 1
    return std::tan(0.5 *
                    std::acos(glm::dot(glm::normalize(edge(j)), glm::normalize(edge(j + 1)))));
  };
  glm::dvec2 sum(0);
  double weights = 0;
  for (std::size_t j = 0; j < 4; ++j) {
    const double weight = (tan_half(j + 3) + tan_half(j)) / glm::length(edge(j));
    sum += weight * places[j];
    weights += weight;
  }
  EXPECT_LT(glm::distance(solve_interior(mesh, loop, places)[4], sum / weights), 1e-12);
  EXPECT_LT(
      glm::distance(solve_interior(mesh, loop, places, {UvWeights::uniform})[4], glm::dvec2(0.5)),
      1e-12);
}

// Lengths 3, 4, 5: the corners stand at 0, 3/12 and 7/12 of the way around.
TEST(PlaceBoundary, ByLength) {
  TriMesh mesh;
  mesh.positions = {{0, 0, 0}, {3, 0, 0}, {3, 4, 0}};
  mesh.triangles = {{0, 1, 2}};
  const std::vector<glm::dvec2> at = place_boundary(mesh, {0, 1, 2}, UvBoundary::circle);
  const double angle = 6.283185307179586 * 7 / 12;
  EXPECT_LT(glm::distance(at[0], {1, 0}), 1e-12);
  EXPECT_LT(glm::distance(at[1], {0, 1}), 1e-12);
  EXPECT_LT(glm::distance(at[2], {std::cos(angle), std::sin(angle)}), 1e-12);
  const std::vector<glm::dvec2> uv = parameterize_disk(mesh, {0, 1, 2});  // no inner vertex
  EXPECT_LT(glm::distance(uv[0], {0.99, 0.5}), 1e-12);
  const std::vector<glm::dvec2> square = place_boundary(mesh, {0, 1, 2}, UvBoundary::square);
  EXPECT_LT(glm::distance(square[0], {-0.98, -0.98}), 1e-12);
  EXPECT_LT(glm::distance(square[1], {0.98, -0.98}), 1e-12);
}

// Also where edges are as short as floats have them.
TEST(PlaceBoundary, IsStrictlyConvex) {
  TriMesh mesh = make_grid(12);
  mesh.positions[4] = glm::vec3(glm::dvec3(mesh.positions[3]) + glm::dvec3(1e-7, 0, 0));
  const std::vector<std::uint32_t> loop = find_boundary_loop(mesh);
  for (const UvBoundary boundary : {UvBoundary::circle, UvBoundary::square}) {
    const std::vector<glm::dvec2> at = place_boundary(mesh, loop, boundary);
    for (std::size_t i = 0; i < at.size(); ++i) {
      EXPECT_GT(twice_area(at[i], at[(i + 1) % at.size()], at[(i + 2) % at.size()]), 1e-7) << i;
      EXPECT_LE(std::abs(at[i].x), 1);
      EXPECT_LE(std::abs(at[i].y), 1);
    }
  }
}

// Random patches of three surfaces: whatever is asked for, no triangle turns over.
TEST(TexturedPatch, IsOneToOne) {
  const TriMesh surfaces[] = {make_ball(16), make_bumpy_torus(16, 40), make_grid(20, 0.2, 7)};
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const TriMesh& surface = surfaces[seed % 3];
    TexturedPatchOptions options;
    options.around = random.below(static_cast<std::uint32_t>(surface.positions.size()));
    options.n_faces = 1 + random.below(400);
    options.boundary = static_cast<UvBoundary>(random.below(2));
    options.relax_steps = static_cast<int>(random.below(3));
    for (const UvDistort distort :
         {UvDistort::none, UvDistort::swirl, UvDistort::stretch, UvDistort::uniform}) {
      options.distort = distort;
      const TexturedPatch patch = make_textured_patch(surface, options, "surface");
      EXPECT_EQ(patch.patch.mesh.triangles.size(), options.n_faces);
      EXPECT_EQ(patch.topology.euler_characteristic, 1);
      EXPECT_EQ(patch.stretch.n_flipped, 0u);
      EXPECT_GE(patch.stretch.l2, 1 - 1e-6);
      for (std::size_t c = 0; c < patch.patch.mesh.texcoords.size(); ++c) {
        const glm::vec2& uv = patch.patch.mesh.texcoords[c];
        EXPECT_TRUE(uv.x > 0.0099 && uv.x < 0.9901 && uv.y > 0.0099 && uv.y < 0.9901) << c;
      }
      const bool is_distorted = distort == UvDistort::swirl || distort == UvDistort::stretch;
      EXPECT_EQ(patch.strength > 0, is_distorted);
      const TexturedPatch again = make_textured_patch(surface, options, "surface");
      EXPECT_EQ(patch.patch.mesh.texcoords, again.patch.mesh.texcoords);
    }
  }
}

// All vertices on one line: edges say what is next to what, shapes say nothing.
TEST(TexturedPatch, TrianglesWithoutArea) {
  TriMesh line = make_grid(6);
  for (std::uint32_t v = 0; v < line.positions.size(); ++v)
    line.positions[v] = glm::vec3(v * v, 0, 0);
  for (const UvDistort distort : {UvDistort::none, UvDistort::swirl, UvDistort::uniform}) {
    TexturedPatchOptions options;
    options.distort = distort;
    const TexturedPatch patch = make_textured_patch(line, options, "line");
    EXPECT_EQ(patch.patch.mesh.triangles, line.triangles);
    EXPECT_EQ(patch.stretch.n_flipped, 0u);
  }
}

TEST(TexturedPatch, RelaxingLowersStretch) {
  const TriMesh ball = make_ball(20);
  TexturedPatchOptions options;
  options.n_faces = 1300;
  double last = 1e300;
  for (const int steps : {0, 1, 3}) {
    options.relax_steps = steps;
    const double l2 = make_textured_patch(ball, options, "ball").stretch.l2;
    EXPECT_LT(l2, last - 0.01) << steps;
    last = l2;
  }
  options.relax_steps = 200;  // it ends at the best
  EXPECT_LE(make_textured_patch(ball, options, "ball").stretch.l2, last);
}

// The distortions are worse than what they distort, and Tutte's weights worse than mean values.
TEST(TexturedPatch, DistortionsStretch) {
  const TriMesh grid = make_grid(20, 0.24, 3);
  TexturedPatchOptions options;
  options.relax_steps = 0;
  const double plain = make_textured_patch(grid, options, "grid").stretch.l2;
  for (const UvDistort distort : {UvDistort::swirl, UvDistort::stretch, UvDistort::uniform}) {
    options.distort = distort;
    EXPECT_GT(make_textured_patch(grid, options, "grid").stretch.l2, plain + 0.02);
  }
}

TEST(TexturedPatch, SaysWhatItCannotDo) {
  const TriMesh torus = make_bumpy_torus(8, 12);
  TexturedPatchOptions options;
  EXPECT_INPUT_ERROR(make_textured_patch(torus, options, "t.ply"), "the component is no disk");
  options.n_faces = 192;
  EXPECT_INPUT_ERROR(make_textured_patch(torus, options, "t.ply"), "192 were asked for: ");
  options.around = 96;
  EXPECT_INPUT_ERROR(make_textured_patch(torus, options, "t.ply"),
                     "t.ply: vertex 96: does not exist; there are 96");
  TriMesh lines = make_grid(1);
  lines.triangles = {{0, 0, 1}};
  options.around = 0;
  EXPECT_INPUT_ERROR(make_textured_patch(lines, options, "l.ply"), "vertex 0: is no corner");
  options.around.reset();
  EXPECT_INPUT_ERROR(make_textured_patch(lines, options, "l.ply"), "has no triangle");
  for (glm::vec3& p : lines.positions) p = glm::vec3(1);
  lines.triangles = {{0, 1, 2}};
  EXPECT_INPUT_ERROR(make_textured_patch(lines, options, "l.ply"), "has no triangle");
}

// A spindle of length 120 and circumference 6: its far end shrinks below what floats tell apart.
// Relaxed, it does not.
TEST(TexturedPatch, CountsWhatFloatsCannotTellApart) {
  TriMesh spindle = make_ball(40);
  for (glm::vec3& p : spindle.positions) p.z *= 60;
  TexturedPatchOptions options;
  options.n_faces = spindle.triangles.size() - 80;
  options.relax_steps = 0;
  EXPECT_INPUT_ERROR(make_textured_patch(spindle, options, "spindle"), "no positive area");
  options.relax_steps = 20;
  EXPECT_EQ(make_textured_patch(spindle, options, "spindle").stretch.n_flipped, 0u);
}

// Longer still: there even doubles cannot tell apart, and stretch is infinite. Relaxing mends it;
// what rounding makes of the longest is no law, but it does not break down, nor get worse.
TEST(TexturedPatch, RelaxesFromInfiniteStretch) {
  for (const bool is_longest : {false, true}) {
    SCOPED_TRACE(is_longest);
    const float length = is_longest ? 50000 : 1000;
    TriMesh spindle = make_ball(40);
    for (glm::vec3& p : spindle.positions) p.z *= length;
    spindle.triangles.resize(spindle.triangles.size() - 80);  // open below
    const std::vector<std::uint32_t> loop = find_boundary_loop(spindle);
    const auto count_flipped = [&](int relax_steps) {
      ParameterizeOptions options;
      options.relax_steps = relax_steps;
      const std::vector<glm::dvec2> uv = parameterize_disk(spindle, loop, options);
      return std::count_if(
          spindle.triangles.begin(), spindle.triangles.end(),
          [&](const Triangle& t) { return !(twice_area(uv[t[0]], uv[t[1]], uv[t[2]]) > 0); });
    };
    const auto n_before = count_flipped(0), n_after = count_flipped(20);
    EXPECT_GT(n_before, 500);
    EXPECT_LE(n_after, is_longest ? n_before : 0);
  }
}

// A square of side 1 seen at twice its width and half its height.
TEST(UvStretch, ByHand) {
  TriMesh mesh = make_grid(1);
  set_texcoords(mesh, plane_of(mesh));
  UvStretch stretch = measure_uv_stretch(mesh);
  EXPECT_NEAR(stretch.l2, 1, 1e-12);
  EXPECT_NEAR(stretch.max, 1, 1e-12);
  for (glm::vec2& uv : mesh.texcoords) uv = {3 * 0.5f * uv.x, 3 * 2 * uv.y};  // 3: does not count
  stretch = measure_uv_stretch(mesh);
  EXPECT_NEAR(stretch.l2, std::sqrt((4 + 0.25) / 2), 1e-6);
  EXPECT_NEAR(stretch.max, 2, 1e-6);
  EXPECT_EQ(stretch.n_flipped, 0u);
  // Sheared by one: the golden ratio.
  set_texcoords(mesh, {{0, 0}, {1, 0}, {1, 1}, {2, 1}});
  stretch = measure_uv_stretch(mesh);
  EXPECT_NEAR(stretch.l2, std::sqrt(1.5), 1e-6);
  EXPECT_NEAR(stretch.max, (1 + std::sqrt(5)) / 2, 1e-6);
  std::swap(mesh.texcoords[0], mesh.texcoords[1]);
  EXPECT_EQ(measure_uv_stretch(mesh).n_flipped, 1u);
  mesh.texcoords.assign(6, glm::vec2(0.5));
  EXPECT_EQ(measure_uv_stretch(mesh).n_flipped, 2u);
}

TEST(Distort, Points) {
  for (const UvDistortion distortion : {UvDistortion::swirl, UvDistortion::stretch})
    EXPECT_EQ(distort_point({0.3, 0.8}, distortion, 0), glm::dvec2(0.3, 0.8));
  // Half way out, a quarter of the turns: 4 turns are one.
  const double rim = 1 - kUvMargin, half = 0.5 + (rim - 0.5) / 2;
  const auto swirl = [](glm::dvec2 p, double turns) {
    return distort_point(p, UvDistortion::swirl, turns);
  };
  EXPECT_LT(glm::distance(swirl({half, 0.5}, 4), {half, 0.5}), 1e-12);
  EXPECT_LT(glm::distance(swirl({half, 0.5}, 1), {0.5, half}), 1e-12);
  EXPECT_LT(glm::distance(swirl({half, 0.5}, -1), {0.5, 1 - half}), 1e-12);
  EXPECT_LT(glm::distance(swirl({0.5, half}, 1), {1 - half, 0.5}), 1e-12);
  EXPECT_LT(glm::distance(swirl({rim, 0.5}, 1), {rim, 0.5}), 1e-12);
  EXPECT_LT(glm::distance(swirl({rim, rim}, 1), {rim, rim}), 1e-12);
  const auto stretch = [](glm::dvec2 p) { return distort_point(p, UvDistortion::stretch, 3); };
  EXPECT_LT(glm::distance(stretch({1 - rim, 0.9}), {1 - rim, 0.9}), 1e-12);
  EXPECT_LT(glm::distance(stretch({rim, 0.9}), {rim, 0.9}), 1e-12);
  const double h = 1e-6;
  EXPECT_NEAR((rim - stretch({rim - h, 0}).x) / (stretch({1 - rim + h, 0}).x - (1 - rim)),
              std::exp(3), 1e-3);
}

// The grid's vertices where a parameterised patch may have them.
std::vector<glm::dvec2> inside_margin(const TriMesh& grid) {
  std::vector<glm::dvec2> out = plane_of(grid);
  for (glm::dvec2& p : out) p = 0.5 + (p - 0.5) * (1 - 2 * kUvMargin);
  return out;
}

TEST(Distort, LowersAStrengthThatTurnsTrianglesOver) {
  const TriMesh coarse = make_grid(6), fine = make_grid(60);
  const DistortedUv swirled = distort_uv(coarse, inside_margin(coarse), UvDistortion::swirl, 5);
  EXPECT_GT(swirled.strength, 0.05);
  EXPECT_LT(swirled.strength, 1);
  TriMesh mesh = coarse;
  set_texcoords(mesh, swirled.uv);
  EXPECT_EQ(measure_uv_stretch(mesh).n_flipped, 0u);
  // A bit more turns one over.
  std::vector<glm::dvec2> more;
  for (const glm::dvec2& p : inside_margin(coarse))
    more.push_back(distort_point(p, UvDistortion::swirl, swirled.strength * 1.02));
  double least = 1;
  for (const Triangle& t : coarse.triangles)
    least = std::min(least, twice_area(more[t[0]], more[t[1]], more[t[2]]) * 36);
  EXPECT_LT(least, 0.01);
  // Fine enough for what is asked for; shrinking is what stretch is for.
  EXPECT_EQ(distort_uv(fine, inside_margin(fine), UvDistortion::swirl, 0.5).strength, 0.5);
  EXPECT_EQ(distort_uv(fine, inside_margin(fine), UvDistortion::stretch, 8).strength, 8);
  EXPECT_EQ(distort_uv(fine, inside_margin(fine), UvDistortion::stretch, -8).strength, -8);
  std::vector<glm::dvec2> flipped = inside_margin(coarse);
  std::swap(flipped[8], flipped[9]);
  EXPECT_THROW(distort_uv(coarse, flipped, UvDistortion::swirl, 1), BugError);
}

}  // namespace
}  // namespace viewcell
