#include "bake/vertex_weights.h"

#include <gtest/gtest.h>

#include "bake/small_bake.h"
#include "visibility/regional.h"

namespace viewcell {
namespace {

constexpr CaptureDensity kDensity{.resolution_px = 512};

ViewVertices vertices_of(const TriMesh& mesh) {
  ViewVertices v;
  v.positions = mesh.positions, v.normals = mesh.normals;
  return v;
}

// Weighs the mesh as seen from the eyes; view k is the k-th.
ViewVertices weigh(const TriMesh& mesh, const std::vector<glm::dvec3>& eyes,
                   const WeightOptions& options = {}) {
  const Scene scene = make_scene_of(mesh);
  const RayCapture rays(scene, 1);
  std::vector<ClassifiedView> views;
  for (std::size_t k = 0; k < eyes.size(); ++k)
    views.push_back(
        *classify_view(scene, rays, ObjectId(0), eyes[k], kDensity, static_cast<int>(k)));
  ViewVertices v = vertices_of(mesh);
  weigh_vertices(mesh.triangles,
                 {find_regional_back_faces(mesh.positions, mesh.triangles, eyes), {}}, views,
                 options, v);
  return v;
}

TriMesh joined(TriMesh a, const TriMesh& b, const glm::vec3& move) {
  const auto first = static_cast<std::uint32_t>(a.positions.size());
  for (const glm::vec3& p : b.positions) a.positions.push_back(p + move);
  a.normals.insert(a.normals.end(), b.normals.begin(), b.normals.end());
  for (const Triangle& t : b.triangles)
    a.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  return a;
}

TEST(VertexWeights, OfABallSeenFromOneEye) {
  const TriMesh ball = make_sphere(6, 120, 61);
  const glm::dvec3 eye(60, 0, 0);
  const ViewVertices v = weigh(ball, {eye});
  const double rim_cosine = 6.0 / 60;  // between a rim point's direction and the eye's
  int n_facing = 0, n_rim = 0, n_rim_shown = 0, n_back = 0;
  for (std::size_t i = 0; i < v.positions.size(); ++i) {
    const double cosine = v.positions[i].x / 6;
    if (cosine > 0.45) {
      EXPECT_EQ(v.weights[i], 0.125f) << i;
      EXPECT_EQ(v.views[i], 1) << i;
      ++n_facing;
    } else if (cosine > rim_cosine + 0.005 && cosine < rim_cosine + 0.03) {
      EXPECT_TRUE(v.weights[i] == 0.5f || v.weights[i] == 0.05f) << i << " " << v.weights[i];
      EXPECT_EQ(v.views[i], v.weights[i] == 0.5f ? 1 : 0) << i;
      n_rim_shown += v.weights[i] == 0.5f;
      ++n_rim;
    } else if (cosine < rim_cosine - 0.06) {
      EXPECT_EQ(v.weights[i], 0.5f) << i;  // back-facing
      EXPECT_EQ(v.views[i], 0) << i;
      ++n_back;
    }
  }
  EXPECT_GT(n_facing, 1000);
  EXPECT_GT(n_rim, 50);
  EXPECT_GT(n_rim_shown, 0.8 * n_rim);
  EXPECT_GT(n_back, 1000);
}

// A small ball before a large one, of one object: what it hides is invisible until another eye
// sees it.
TEST(VertexWeights, BehindALobeVerticesAreInvisible) {
  const TriMesh mesh = joined(make_sphere(6, 80, 41), make_sphere(2, 40, 21), {12, 0, 0});
  const glm::dvec3 ahead(60, 0, 0), aside(40, 44, 0);
  const ViewVertices one = weigh(mesh, {ahead}), two = weigh(mesh, {ahead, aside});
  int n_hidden = 0;
  for (std::size_t i = 0; i < 80 * 40 + 2; ++i) {
    const glm::vec3& p = mesh.positions[i];
    if (p.x < 5 || std::hypot(p.y, p.z) > 1.5) continue;
    EXPECT_EQ(one.weights[i], 0.05f) << i;
    EXPECT_EQ(one.views[i], 0) << i;
    EXPECT_EQ(two.weights[i], 0.125f) << i;
    EXPECT_EQ(two.views[i], 2) << i;
    ++n_hidden;
  }
  EXPECT_GT(n_hidden, 10);
  for (std::size_t i = 0; i < one.views.size(); ++i) {
    EXPECT_EQ(two.views[i] & 1, one.views[i]) << i;  // another view takes nothing away
    if (one.views[i] != 0) {
      EXPECT_GE(two.weights[i], one.weights[i]) << i;
    }
  }
}

TEST(VertexWeights, OptionsAreUsed) {
  const TriMesh mesh = joined(make_sphere(6, 60, 31), make_sphere(2, 30, 15), {12, 0, 0});
  const WeightOptions options{7, 6, 5, 4, 3, 9};
  const ViewVertices v = weigh(mesh, {{60, 0, 0}}, options);
  std::set<float> found(v.weights.begin(), v.weights.end());
  for (const float w : {7.f, 6.f, 4.f, 3.f, 9.f}) EXPECT_TRUE(found.contains(w)) << w;
  found.erase(5.f);
  EXPECT_EQ(found.size(), 5u);
}

TEST(VertexWeights, NoViewMeansInvisibleOrBackFacing) {
  const TriMesh mesh = make_sphere(6, 12, 7);
  ViewVertices v = vertices_of(mesh);
  weigh_vertices(mesh.triangles, {std::vector<bool>(mesh.triangles.size(), false), {}}, {}, {}, v);
  EXPECT_EQ(v.weights, std::vector<float>(mesh.positions.size(), 0.05f));
  weigh_vertices(mesh.triangles, {std::vector<bool>(mesh.triangles.size(), true), {}}, {}, {}, v);
  EXPECT_EQ(v.weights, std::vector<float>(mesh.positions.size(), 0.5f));
  EXPECT_EQ(v.views, std::vector<std::uint8_t>(mesh.positions.size(), 0));
}

// Every point of the visible cap is shown, but for few at its rim; a point a tenth of a radius
// under it, or behind the eye, is not.
TEST(CategoryAt, ShowsTheSurfaceAndHidesWhatLiesUnderIt) {
  const Scene scene = make_scene_of(make_sphere(6, 120, 61));
  const RayCapture rays(scene, 1);
  const glm::dvec3 eye(60, 0, 0);
  const auto view = classify_view(scene, rays, ObjectId(0), eye, kDensity);
  Random random(8);
  int n_missed = 0;  // at the rim, where depth falls within a pixel
  for (int k = 0; k < 2000; ++k) {
    const double x = random.uniform(0.15, 1), a = random.uniform(0, glm::two_pi<double>());
    const double r = std::sqrt(1 - x * x);
    const glm::dvec3 p = 5.998 * glm::dvec3(x, r * std::cos(a), r * std::sin(a));
    const bool is_shown = category_at(*view, p) != PixelCategory::background;
    n_missed += !is_shown;
    ASSERT_TRUE(is_shown || x < 0.25) << "case " << k << " " << x;
    if (x > 0.3) {
      ASSERT_EQ(category_at(*view, 0.9 * p), PixelCategory::background) << "case " << k;
    }
    ASSERT_EQ(category_at(*view, eye + (eye - p)), PixelCategory::background) << "case " << k;
  }
  EXPECT_LT(n_missed, 40);
  EXPECT_EQ(category_at(*view, {0, 30, 0}), PixelCategory::background);
  EXPECT_EQ(category_at(*view, eye), PixelCategory::background);
}

}  // namespace
}  // namespace viewcell
