#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <numbers>

#include "base/random.h"
#include "park/walk_gaze.h"

namespace viewcell {
namespace {

std::vector<Prospect> make_prospects(std::size_t n,
                                     const std::function<double(std::size_t, int)>& interest) {
  std::vector<Prospect> prospects(n);
  for (std::size_t t = 0; t < n; ++t)
    for (int d = 0; d < 72; ++d) prospects[t].interest.push_back(interest(t, d));
  return prospects;
}

TEST(Gaze, LooksAheadWhenThereIsNothingToSee) {
  auto prospects = make_prospects(20, [](std::size_t, int) { return 0.0; });
  for (Prospect& p : prospects) p.heading_rad = glm::radians(40.0);
  for (const double yaw : choose_gaze(prospects))
    EXPECT_NEAR(std::remainder(glm::degrees(yaw) - 40, 360), 0, 1e-9);
}

TEST(Gaze, TurnsToASight) {
  const auto prospects = make_prospects(40, [](std::size_t t, int d) {
    return t > 25 && std::abs(d - 9) <= 1 ? 3.0 : 0.0;  // 45 degrees to the left, late
  });
  const std::vector<double> yaw = choose_gaze(prospects);
  EXPECT_NEAR(glm::degrees(yaw[5]), 0, 1e-6);
  EXPECT_NEAR(glm::degrees(yaw[35]), 45, 6);
}

TEST(Gaze, NeverTurnsFasterThanAllowed) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    auto prospects = make_prospects(60, [&](std::size_t, int) { return 5 * random.uniform(); });
    for (Prospect& p : prospects)
      p.heading_rad = random.uniform(-std::numbers::pi, std::numbers::pi);
    const std::vector<double> yaw = choose_gaze(prospects, {.step_s = 0.5, .max_turn_deg_s = 35});
    for (std::size_t t = 1; t < yaw.size(); ++t)
      EXPECT_LE(std::abs(glm::degrees(yaw[t] - yaw[t - 1])), 0.5 * 35 + 1e-9);
  }
}

TEST(Gaze, FollowsASightAcrossTheSeam) {  // from 170 to 190 degrees, not the long way round
  auto prospects =
      make_prospects(30, [](std::size_t t, int d) { return d == (t < 15 ? 34 : 38) ? 4.0 : 0.0; });
  for (Prospect& p : prospects) p.heading_rad = std::numbers::pi;
  const std::vector<double> yaw = choose_gaze(prospects);
  EXPECT_NEAR(glm::degrees(yaw.back() - yaw.front()), 20, 1e-6);
}

}  // namespace
}  // namespace viewcell
