#include "rays/ray_scene.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <set>
#include <vector>

#include "base/error.h"

namespace viewcell {
namespace {

//  2 . . .       An upright strip of n squares in the plane x = distance, z from 0 to 1, y from
//  | \   \       -n/2 to n/2; it faces -x. Square i is triangles 2 i and 2 i + 1.
//  0---1---
struct Strip {
  std::vector<glm::vec3> positions;
  std::vector<RayScene::Corners> triangles;
  explicit Strip(std::uint32_t n, float distance = 5) {
    for (std::uint32_t i = 0; i <= n; ++i)
      for (const float z : {0.0f, 1.0f})
        positions.emplace_back(distance, static_cast<float>(i) - static_cast<float>(n) / 2, z);
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t v = 2 * i;
      triangles.push_back({v, v + 1, v + 3});
      triangles.push_back({v, v + 3, v + 2});
    }
  }
  RayScene build(const RayDevice& device, const RaySceneOptions& options = {}) const {
    return RayScene(device, positions, triangles, options);
  }
};

// Ray i runs toward origin + (sign * 5, i - 7.5, 0.25); ray 3 takes no part.
RayPacket cast(const RayScene& scene, float sign = 1, const glm::vec3& origin = glm::vec3(0)) {
  RayPacket packet;
  RayMask mask;
  packet.start(origin, 0);
  for (int i = 0; i < RayPacket::kSize; ++i) {
    mask.set(i, i != 3);
    packet.set_direction(i, {sign * 5, static_cast<float>(i) - 7.5f, 0.25f});
  }
  scene.intersect(mask, packet);
  return packet;
}

TEST(RayScene, PacketsHitWhatStandsBeforeThem) {
  const RayScene scene = Strip(16).build(RayDevice());
  const RayPacket packet = cast(scene);
  for (int i = 0; i < RayPacket::kSize; ++i) {
    SCOPED_TRACE(i);
    const auto lane = static_cast<std::size_t>(i);
    ASSERT_EQ(packet.has_hit(i), i != 3);
    if (i == 3) continue;
    EXPECT_NEAR(packet.far[lane], 1, 1e-6);
    EXPECT_EQ(packet.triangle[lane] / 2, lane);
    EXPECT_LT(packet.normal(i).x, 0);
    EXPECT_FALSE(packet.hits_back(i));
  }
}

TEST(RayScene, BacksAreHitUnlessFrontsAreAskedFor) {
  const RayDevice device;
  const Strip strip(16);
  const glm::vec3 behind(10, 0, 0);
  const RayPacket both = cast(strip.build(device), -1, behind);
  EXPECT_TRUE(both.has_hit(8));
  EXPECT_TRUE(both.hits_back(8));
  const RayScene fronts = strip.build(device, {.fronts_only = true});
  EXPECT_FALSE(cast(fronts, -1, behind).has_hit(8));
  EXPECT_TRUE(cast(fronts).has_hit(8));
}

TEST(RayScene, InstancesOutliveTheirMeshes) {
  RayScene top;
  EXPECT_FALSE(top);
  {
    const RayDevice device;
    const RayScene strip = Strip(16).build(device);
    const std::vector<RayScene::Instance> instances{
        {&strip, glm::translate(glm::mat4(1), glm::vec3(2, 0, 0))},
        {&strip, glm::translate(glm::mat4(1), glm::vec3(1, 0, 0))}};
    top = RayScene(device, instances);
  }
  ASSERT_TRUE(top);
  RayPacket packet = cast(top);
  EXPECT_EQ(packet.instance[8], 1u);
  EXPECT_NEAR(packet.far[8], 1.2, 1e-6);
  packet.pass_hit(8);
  EXPECT_FALSE(packet.has_hit(8));
  EXPECT_GT(packet.near[8], 1.19f);
  RayMask again;
  again.set(8, true);
  top.intersect(again, packet);
  EXPECT_EQ(packet.instance[8], 0u);
  EXPECT_NEAR(packet.far[8], 1.4, 1e-6);
}

TEST(RayScene, VisitsEveryTriangleWithinTheRadius) {
  const RayScene scene = Strip(200).build(RayDevice({.n_threads = 1}), {.robust = false});
  std::set<std::uint32_t> visited;
  const auto visit = [](RTCPointQueryFunctionArguments* arguments) {
    const NearTriangle& near = NearTriangle::of(arguments);
    static_cast<std::set<std::uint32_t>*>(near.user)->insert(near.triangle);
    return false;
  };
  scene.visit_near({5, 0.5f, 0.5f}, 10.1f, visit, &visited);
  for (std::uint32_t square = 90; square <= 110; ++square) {
    EXPECT_TRUE(visited.contains(2 * square)) << square;
    EXPECT_TRUE(visited.contains(2 * square + 1)) << square;
  }
  EXPECT_LT(visited.size(), 200u);  // of 400
}

TEST(RayScene, NothingIsHitInAnEmptyMesh) {
  const RayDevice device;
  const RayScene empty(device, std::span<const glm::vec3>(), {});
  EXPECT_FALSE(cast(empty).has_hit(0));
  const RayScene no_instances(device, std::span<const RayScene::Instance>());
  EXPECT_FALSE(cast(no_instances).has_hit(0));
}

// From a budget that not even a scene fits into to one that holds all: each time the build throws
// or is whole.
TEST(RayScene, EveryFailedAllocationThrows) {
  const Strip strip(4000);
  int n_threw = 0, n_built = 0;
  for (std::size_t budget = 1; budget < 1u << 26; budget += budget / 3 + 1) {
    SCOPED_TRACE(budget);
    try {
      const RayDevice device({.n_threads = 2, .budget_bytes = budget});
      const RayScene mesh = strip.build(device);
      const std::vector<RayScene::Instance> instances{{&mesh, glm::mat4(1)}};
      const RayScene top(device, instances);
      ++n_built;
      EXPECT_TRUE(cast(mesh).has_hit(8));
      EXPECT_TRUE(cast(top).has_hit(8));
    } catch (const MachineError& error) {
      ++n_threw;
      EXPECT_STREQ(error.what(), "Embree: out of memory");
    }
  }
  EXPECT_GT(n_threw, 20);
  EXPECT_GT(n_built, 2);
}

// What is not for want of memory is our fault: here, an instance of nothing.
TEST(RayScene, OtherErrorsAreBugs) {
  const RayDevice device;
  const RayScene nothing;
  const std::vector<RayScene::Instance> instances{{&nothing, glm::mat4(1)}};
  EXPECT_THROW(RayScene(device, instances), BugError);
  EXPECT_TRUE(cast(Strip(16).build(device)).has_hit(8));  // the error is not told twice
}

}  // namespace
}  // namespace viewcell
