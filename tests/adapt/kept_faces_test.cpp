// What collapses do to one of several pictures.
#include <gtest/gtest.h>

#include "adapt/adapt_levels.h"
#include "base/error.h"
#include "pm/build.h"
#include "pm/shapes.h"

namespace viewcell {
namespace {

constexpr int kSide = 96;
constexpr glm::vec2 kBeside(0.4f, 0);

// A relief of two materials, which meet at x = 4. They show pictures of their own, so that both
// may lie over the same texels (apart: 0), or a picture together.
struct TwoMaterials {
  ProgressiveRecord record;
  std::vector<std::int32_t> groups;  // of the faces
  ImageRgba8 texture{kSide, kSide};

  explicit TwoMaterials(const glm::vec2& apart) {
    TriMesh mesh = make_relief(7);
    mesh.material_names = {"left", "right"};
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      float middle = 0;
      for (const std::uint32_t v : mesh.triangles[t]) middle += mesh.positions[v].x / 3;
      mesh.materials.push_back(middle > 4 ? 1 : 0);
      for (std::size_t c = 3 * t; c < 3 * t + 3; ++c) {
        mesh.texcoords[c] = glm::vec2(0.4f, 0.8f) * mesh.texcoords[c] / 7.0f + 0.1f;
        if (middle > 4) mesh.texcoords[c] += apart;
      }
    }
    BuildOptions options;
    options.metric = MetricKind::mapping;
    record = build_progressive_mesh(mesh, options).record;
    groups = record.attributes.materials;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x)
        texture.at(x, y) = {static_cast<std::uint8_t>(2 * x), static_cast<std::uint8_t>(2 * y),
                            static_cast<std::uint8_t>((x / 6 + y / 6) % 2 * 200), 255};
  }
  std::vector<bool> faces_of(std::int32_t group) const {
    std::vector<bool> out;
    for (const std::int32_t g : groups) out.push_back(g == group);
    return out;
  }
};

TEST(KeptFaces, GroupsPartCharts) {
  const TwoMaterials two(glm::vec2(0));
  const AdaptationLog together = make_adaptation_log(two.record),
                      apart = make_adaptation_log(two.record, {}, two.groups);
  EXPECT_EQ(together.n_charts, 1u);
  EXPECT_EQ(apart.n_charts, 2u);
  for (std::size_t f = 0; f < two.groups.size(); ++f)
    EXPECT_EQ(apart.charts[f] == apart.charts[0], two.groups[f] == two.groups[0]) << f;
  EXPECT_EQ(
      make_adaptation_log(two.record, {}, std::vector<std::int32_t>(two.groups.size(), 5)).charts,
      together.charts);
}

TEST(KeptFaces, AllAreTheLogAndNoneAreNothing) {
  const TwoMaterials two(glm::vec2(0));
  const AdaptationLog log = make_adaptation_log(two.record, {}, two.groups);
  const std::size_t n = two.groups.size();
  const AdaptationLog all = keep_faces(log, std::vector<bool>(n, true)),
                      none = keep_faces(log, std::vector<bool>(n, false));
  EXPECT_EQ(all.charts, log.charts);
  EXPECT_EQ(all.first_triangle, log.first_triangle);
  EXPECT_EQ(all.triangles.size(), log.triangles.size());
  EXPECT_TRUE(none.triangles.empty());
  EXPECT_EQ(none.n_steps(), log.n_steps());
  EXPECT_TRUE(make_level_charts(make_finest(two.record), none).faces.empty());
  std::vector<bool> half_a_chart(n, true);
  half_a_chart[0] = false;
  EXPECT_THROW(keep_faces(log, half_a_chart), BugError);
}

// Each triangle of the log, and each face of a level, is one material's.
TEST(KeptFaces, EveryTriangleIsKeptOnce) {
  const TwoMaterials two(glm::vec2(0));
  const AdaptationLog log = make_adaptation_log(two.record, {}, two.groups);
  const AdaptationLog left = keep_faces(log, two.faces_of(0)),
                      right = keep_faces(log, two.faces_of(1));
  EXPECT_FALSE(left.triangles.empty());
  EXPECT_FALSE(right.triangles.empty());
  for (std::size_t step = 0; step < log.n_steps(); ++step) {
    EXPECT_EQ(left.of(step).triangles.size() + right.of(step).triangles.size(),
              log.of(step).triangles.size());
    EXPECT_EQ(left.of(step).points.size(), log.of(step).points.size());
  }
  ProgressiveMesh level(two.record);
  level.set_faces(40);
  std::size_t n_left = 0;
  for (std::size_t f = 0; f < two.groups.size(); ++f)
    n_left += level.has_face(f) && two.groups[f] == 0;
  EXPECT_EQ(make_level_charts(level, left).faces.size(), n_left);
  EXPECT_EQ(make_level_charts(level, right).faces.size(), level.n_faces() - n_left);
  EXPECT_GT(n_left, 0u);
}

// The map of a level for some of the faces.
IndexMap map_of(const TwoMaterials& two, const AdaptationLog& log, std::size_t n_faces) {
  AdaptLevels levels(two.record, log, two.texture);
  levels.set_faces(n_faces);
  return levels.map();
}

// Where two materials show one picture, side by side, what each does to its half is what both do
// together; the other half stays as it was.
TEST(KeptFaces, EachDoesToItsTexelsWhatBothDo) {
  const TwoMaterials two(kBeside);
  const AdaptationLog log = make_adaptation_log(two.record, {}, two.groups);
  const IndexMap before = map_of(two, log, 1000), both = map_of(two, log, 40),
                 left = map_of(two, keep_faces(log, two.faces_of(0)), 40),
                 right = map_of(two, keep_faces(log, two.faces_of(1)), 40);
  constexpr float kRounding = 1e-6f;  // texels are sampled eight at a time, with others
  std::size_t n_left = 0, n_right = 0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const bool is_left = x < kSide / 2;
      ASSERT_LT(glm::distance(left.at(x, y), is_left ? both.at(x, y) : before.at(x, y)), kRounding)
          << x << " " << y;
      ASSERT_LT(glm::distance(right.at(x, y), is_left ? before.at(x, y) : both.at(x, y)), kRounding)
          << x << " " << y;
      n_left += left.at(x, y) != before.at(x, y), n_right += right.at(x, y) != before.at(x, y);
    }
  EXPECT_GT(n_left, 300u);
  EXPECT_GT(n_right, 200u);
}

// What another material has over the same texels of another picture changes nothing.
TEST(KeptFaces, OtherPicturesMayHaveTheSameTexels) {
  TwoMaterials two(kBeside);
  const AdaptationLog beside = make_adaptation_log(two.record, {}, two.groups);
  const IndexMap expected = map_of(two, keep_faces(beside, two.faces_of(0)), 40);
  std::vector<glm::vec2> by;
  for (const std::int32_t group : two.groups)
    by.push_back(group == 1 ? -kBeside - glm::vec2(0.2f, 0) : glm::vec2(0));
  move_texcoords(two.record, by);
  const AdaptationLog over = make_adaptation_log(two.record, {}, two.groups);
  EXPECT_EQ(map_of(two, keep_faces(over, two.faces_of(0)), 40).pixels, expected.pixels);
}

}  // namespace
}  // namespace viewcell
