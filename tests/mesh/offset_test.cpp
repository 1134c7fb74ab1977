#include "mesh/offset.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "base/random.h"

namespace viewcell {
namespace {

Box box_about(const glm::dvec3& centre, double size) {
  return {centre - size / 2, centre + size / 2};
}

TEST(Offset, IsNoneNearTheOrigin) {
  for (const double size : {1e-30, 1e-3, 1.0, 3e7, 1e30})
    for (const double sizes_away : {0.0, 0.5, 2.0, 20.0})
      EXPECT_EQ(choose_offset(box_about(glm::dvec3(sizes_away * size, 0, 0), size)), glm::dvec3(0));
  EXPECT_EQ(choose_offset({}), glm::dvec3(0));
  for (const double x : {0.0, 1.0, double{0.1f}})
    EXPECT_EQ(choose_offset(box_about(glm::dvec3(x), 0)), glm::dvec3(0));
  // A point that text has in nine digits is the float that it was.
  glm::dvec3 written;
  for (int k = 0; k < 3; ++k) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.9g", double{1.8677330e25f / static_cast<float>(k + 1)});
    written[k] = std::strtod(digits, nullptr);
  }
  EXPECT_EQ(choose_offset(box_about(written, 0)), glm::dvec3(0));
}

// Metres of a map: half a metre from float to float, 500 and 4,649 km from its origin.
TEST(Offset, BringsAMapNear) {
  const glm::dvec3 centre(500012.3, 4649776.7, 98.6);
  const glm::dvec3 offset = choose_offset(box_about(centre, 10));
  for (int k = 0; k < 3; ++k) {
    EXPECT_LE(std::abs(offset[k] - centre[k]), 8);
    EXPECT_EQ(std::fmod(offset[k], 16), 0);
  }
  EXPECT_EQ(choose_offset(box_about({500012, 4649776, 20}, 10)).z, 0);  // floats do there
  EXPECT_EQ(choose_offset(box_about({500012, 4649776, 0}, 3e7)), glm::dvec3(0));
  EXPECT_LE(glm::distance(choose_offset(box_about(centre, 0)), centre), 1);  // one point
}

// Of any size and place: floats less the offset, and sums of both, round nothing.
TEST(Offset, LosesNoBit) {
  int n_offsets = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const double size = std::pow(10, random.uniform(-6, 6));
    glm::dvec3 centre;
    for (int k = 0; k < 3; ++k) centre[k] = size * std::pow(10, random.uniform(-1, 7));
    TriMesh mesh;
    Box box;
    for (int i = 0; i < 50; ++i) {
      glm::dvec3 p = centre;
      for (int k = 0; k < 3; ++k) p[k] += size * random.uniform(-0.5, 0.5);
      mesh.positions.emplace_back(p);
      box.add(glm::dvec3(mesh.positions.back()));
    }
    const TriMesh before = mesh;
    change_offset(mesh, choose_offset(box));
    n_offsets += mesh.offset != glm::dvec3(0);
    for (std::size_t v = 0; v < 50; ++v)
      EXPECT_EQ(place_of(mesh, v), glm::dvec3(before.positions[v]));
    EXPECT_TRUE(mesh.offset == glm::dvec3(0) || is_offset_near(box, mesh.offset));
    change_offset(mesh, glm::dvec3(0));
    EXPECT_EQ(mesh.positions, before.positions);
  }
  EXPECT_GT(n_offsets, 100);
}

TEST(Offset, OfDoublesIsAsFineAsFloatsOfTheSize) {
  std::vector<glm::dvec3> places;
  const glm::dvec3 centre(500000, 4649776, 200);
  for (int i = 0; i < 1000; ++i)
    places.push_back(centre + 5.0 * glm::dvec3(std::sin(i), std::cos(i), std::sin(0.1 * i)));
  TriMesh mesh;
  place_vertices(mesh, places, choose_offset(box_about(centre, 10)));
  for (std::size_t i = 0; i < places.size(); ++i)
    EXPECT_LT(glm::distance(place_of(mesh, i), places[i]), 2e-6);
}

}  // namespace
}  // namespace viewcell
