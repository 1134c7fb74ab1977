#include "scene/camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "common/expect_input_error.h"
#include "common/temporary_folder.h"

namespace viewcell {
namespace {

CameraPath make_bent_path() {
  return {{{0, {0, 0, 18}, {1, 0, 0}}, {2, {20, 0, 18}, {0, 1, 0}}, {3, {20, 10, 19}, {0, 1, 0}}}};
}

TEST(Camera, EyeSpaceLooksAlongMinusZ) {
  const Camera camera{.eye = {3, 4, 5}, .forward = {0, 1, 0}};
  const glm::dmat4 view = view_from_world(camera);
  const auto at = [&](const glm::dvec3& p) { return glm::dvec3(view * glm::dvec4(p, 1)); };
  EXPECT_LT(glm::length(at({3, 4, 5})), 1e-15);
  EXPECT_LT(glm::length(at({3, 14, 5}) - glm::dvec3(0, 0, -10)), 1e-15);  // ahead
  EXPECT_LT(glm::length(at({4, 4, 5}) - glm::dvec3(1, 0, 0)), 1e-15);     // to the right
  EXPECT_LT(glm::length(at({3, 4, 6}) - glm::dvec3(0, 1, 0)), 1e-15);     // above
}

TEST(Camera, ClipSpaceIsReversedAndInfinite) {
  const Camera camera;
  const glm::dmat4 clip = clip_from_world(camera);
  const auto depth = [&](double along) {
    const glm::dvec4 p = clip * glm::dvec4(along, 0, 0, 1);
    EXPECT_NEAR(p.w, along, 1e-12);
    return p.z / p.w;
  };
  EXPECT_NEAR(depth(camera.near), 1, 1e-12);
  EXPECT_NEAR(depth(4 * camera.near), 0.25, 1e-12);
  EXPECT_GT(depth(1e12), 0);
  // 30 degrees up is the frame's upper edge, 30 degrees left its left one.
  const double slope = std::tan(glm::radians(30.0));
  const glm::dvec4 edge = clip * glm::dvec4(10, 10 * slope, 10 * slope, 1);
  EXPECT_NEAR(edge.x / edge.w, -1, 1e-12);
  EXPECT_NEAR(edge.y / edge.w, 1, 1e-12);
}

// The near plane's corner is never farther than in a square frame of 60 degrees.
TEST(Camera, NearPlaneFollowsTheFrame) {
  const Camera camera;
  EXPECT_EQ(with_frame(camera, 60, 1).near, kNear);
  EXPECT_EQ(with_frame(camera, 40, 1).near, kNear);
  for (const auto& [fov, aspect] : {std::pair(60.0, 16.0 / 9), {75.0, 16.0 / 9}, {120.0, 1.0}}) {
    const Camera wide = with_frame(camera, fov, aspect);
    const double half = std::tan(glm::radians(fov) / 2);
    EXPECT_NEAR(wide.near * std::hypot(1, half, half * aspect), std::sqrt(1 + 2.0 / 3), 1e-12);
    EXPECT_EQ(wide.fov_y_deg, fov);
    EXPECT_EQ(wide.aspect, aspect);
  }
}

TEST(CameraPath, SamplesAtEqualTimesWithBothEnds) {
  const auto cameras = sample_path(make_bent_path(), 7);  // every half second
  ASSERT_EQ(cameras.size(), 7u);
  EXPECT_EQ(cameras[0].eye, glm::dvec3(0, 0, 18));
  EXPECT_EQ(cameras[6].eye, glm::dvec3(20, 10, 19));
  EXPECT_LT(glm::length(cameras[1].eye - glm::dvec3(5, 0, 18)), 1e-12);
  EXPECT_LT(glm::length(cameras[5].eye - glm::dvec3(20, 5, 18.5)), 1e-12);
  for (int i = 0; i <= 4; ++i) {  // a quarter turn in two seconds, evenly
    const double angle = std::atan2(cameras[static_cast<std::size_t>(i)].forward.y,
                                    cameras[static_cast<std::size_t>(i)].forward.x);
    EXPECT_NEAR(glm::degrees(angle), 22.5 * i, 1e-9);
  }
  EXPECT_EQ(sample_path(make_bent_path(), 1)[0].eye, glm::dvec3(0, 0, 18));
}

TEST(CameraPath, ReadsWhatItFormats) {
  TemporaryFolder folder;
  CameraPath path;
  Random random(5);
  for (int i = 0; i < 50; ++i) {
    const double angle = random.uniform(0, 6);
    path.samples.push_back({0.1 * i,
                            {random.uniform(-1e3, 1e3), random.uniform(), random.uniform()},
                            glm::normalize(glm::dvec3(std::cos(angle), std::sin(angle), 0.3))});
  }
  path.fov_y_deg = 72.5;
  const auto file = folder.add("path.json", format_json(format_path(path, {{"tool", "test"}})));
  const CameraPath read = read_path(file);
  EXPECT_EQ(read.fov_y_deg, 72.5);
  ASSERT_EQ(read.samples.size(), path.samples.size());
  for (std::size_t i = 0; i < path.samples.size(); ++i) {
    EXPECT_EQ(read.samples[i].time_s, path.samples[i].time_s);
    EXPECT_EQ(read.samples[i].eye, path.samples[i].eye);
    EXPECT_LT(glm::length(read.samples[i].forward - path.samples[i].forward), 1e-15);
  }
}

TEST(CameraPath, BadPathsAreRefused) {
  TemporaryFolder folder;
  const auto refuse = [&](const std::function<void(Json&)>& spoil, const char* message) {
    Json json = format_path(make_bent_path(), {{"tool", "test"}});
    spoil(json);
    EXPECT_INPUT_ERROR(read_path(folder.add("path.json", format_json(json))), message);
  };
  refuse([](Json& j) { j["format"] = "viewcell-scene"; }, "\"format\"");
  refuse([](Json& j) { j["samples"] = Json::array(); }, "is empty");
  refuse([](Json& j) { j["samples"][1]["time_s"] = 0; }, "samples[1].time_s: is not later");
  refuse([](Json& j) { j["samples"][2]["eye"] = {1, 2}; }, "samples[2].eye");
  refuse([](Json& j) { j["samples"][2]["eye"][0] = nullptr; }, "samples[2].eye[0]");
  refuse([](Json& j) { j["samples"][0]["forward"] = {0, 0, 0}; }, "has no length");
  refuse([](Json& j) { j["samples"][0]["forward"] = {0, 0, -1}; }, "is vertical");
  refuse([](Json& j) { j["samples"][0].erase("eye"); }, "has no \"eye\"");
  refuse([](Json& j) { j["fov_y_deg"] = 145; }, "fov_y_deg: 145 is not within 5.0 to 120.0");
}

TEST(CameraPath, UnknownKeysAreSaid) {
  TemporaryFolder folder;
  Json json = format_path(make_bent_path(), {{"tool", "test"}});
  Remarks remarks;
  read_path(folder.add("path.json", format_json(json)), &remarks);
  EXPECT_TRUE(remarks.empty());
  for (Json& sample : json["samples"]) sample["froward"] = sample["forward"];
  read_path(folder.add("path.json", format_json(json)), &remarks);
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_EQ(remarks[0].what,
            "key 'froward' of a sample is unknown and passed over; is 'forward' meant?");
  EXPECT_EQ(remarks[0].count, json["samples"].size());
}

// Right-handed, unit, at right angles: of any camera's view, and of nothing else.
TEST(ViewFrame, IsThatOfAView) {
  Random random(8);
  for (int k = 0; k < 200; ++k) {
    const glm::dvec3 forward = glm::normalize(
        glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-0.9, 0.9)));
    const auto [right, up] = picture_axes(forward);
    ASSERT_TRUE(is_view_frame(right, up, forward)) << k;
    EXPECT_FALSE(is_view_frame(-right, up, forward));
    EXPECT_FALSE(is_view_frame(up, right, forward));
    EXPECT_FALSE(is_view_frame(right, up, 1.001 * forward));
    EXPECT_FALSE(is_view_frame(glm::normalize(right + 0.001 * up), up, forward));
    EXPECT_FALSE(is_view_frame(right, up, glm::dvec3(std::nan(""))));
    EXPECT_FALSE(is_view_frame(right * HUGE_VAL, up, forward));
  }
  EXPECT_FALSE(is_view_frame({}, {}, {}));
}

}  // namespace
}  // namespace viewcell
