#include "walk/walk.h"

#include <gtest/gtest.h>

#include <cmath>

#include "capture/shapes.h"
#include "common/expect_input_error.h"

namespace viewcell {
namespace {

void add(Scene& scene, const glm::dvec3& lo, const glm::dvec3& hi) {
  scene.meshes.push_back(make_scene_mesh(make_box(lo, hi), "box"));
  SceneObject object;
  object.mesh = MeshId(scene.meshes.size() - 1);
  scene.objects.push_back(object);
}

// A room of 400 x 200 with walls 100 high around it and one across, with a door from y = 140 to
// 180. The floor is 1 thick.
Scene make_rooms() {
  Scene scene;
  scene.area = {{0, 0}, {400, 200}};
  scene.materials.resize(1);
  scene.ground_z = -50;
  add(scene, {0, 0, -1}, {400, 200, 0});
  add(scene, {0, 0, -1}, {5, 200, 100});
  add(scene, {395, 0, -1}, {400, 200, 100});
  add(scene, {0, 0, -1}, {400, 5, 100});
  add(scene, {0, 195, -1}, {400, 200, 100});
  add(scene, {195, 0, -1}, {205, 140, 100});
  add(scene, {195, 180, -1}, {205, 200, 100});
  return scene;
}

struct Rooms {
  explicit Rooms(Scene scene_in) : scene(std::move(scene_in)), cells(make_cells(scene, 50, {})) {
    room = find_standing_room(scene, cells, walker_of(18), 1);
  }
  Scene scene;
  CellSet cells;
  StandingRoom room;
};

bool is_in_wall(const glm::dvec2& p, double margin) {
  if (p.x < 5 + margin || p.x > 395 - margin || p.y < 5 + margin || p.y > 195 - margin) return true;
  return p.x > 195 - margin && p.x < 205 + margin && (p.y < 140 + margin || p.y > 180 - margin);
}

TEST(StandingRoom, IsWhereNothingIsNear) {
  const Rooms rooms(make_rooms());
  std::size_t n_free = 0;
  for (std::size_t p = 0; p < rooms.room.is_free.size(); ++p) {
    const glm::dvec2 place = rooms.room.place(p);
    if (rooms.room.is_free[p]) {
      ++n_free;
      EXPECT_FALSE(is_in_wall(place, 2.4)) << place.x << ' ' << place.y;
      EXPECT_NEAR(rooms.room.floor_z[p], 0, 1e-4);
    } else {
      EXPECT_TRUE(is_in_wall(place, 4.1)) << place.x << ' ' << place.y;
    }
  }
  EXPECT_GT(n_free, 8000u);
  const StandingRoom again = find_standing_room(rooms.scene, rooms.cells, walker_of(18), 3);
  EXPECT_EQ(again.is_free, rooms.room.is_free);
  EXPECT_EQ(again.floor_z, rooms.room.floor_z);
  EXPECT_EQ(again.sight, rooms.room.sight);
}

// A step of 1 is taken, a table of 8 is not: the eye above it would leave the baked heights.
TEST(StandingRoom, FloorsLieBelowTheBakedHeights) {
  Scene scene = make_rooms();
  add(scene, {50, 50, 0}, {100, 100, 1});
  add(scene, {50, 120, 0}, {100, 170, 8});
  const Rooms rooms(std::move(scene));
  const std::size_t step = *rooms.room.nearest({75, 75}), table = *rooms.room.nearest({75, 145});
  EXPECT_NEAR(rooms.room.floor_z[step], 1, 1e-4);
  EXPECT_LT(glm::distance(rooms.room.place(step), {75, 75}), 3);
  EXPECT_GT(glm::distance(rooms.room.place(table), {75, 145}), 20);
}

// Without --through it leads from one end to the other, through the door, and keeps off walls.
TEST(Walk, LeadsThroughTheDoor) {
  const Rooms rooms(make_rooms());
  const Walk walk = make_walk(rooms.room, {}, "scene.json");
  const auto& samples = walk.path.samples;
  ASSERT_GT(samples.size(), 100u);
  EXPECT_GT(walk.length, 400);
  EXPECT_GT(std::abs(samples.front().eye.x - samples.back().eye.x), 300);
  EXPECT_NEAR(samples.back().time_s, walk.length / 14, 1e-9);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_FALSE(is_in_wall(glm::dvec2(samples[i].eye), 1.5)) << i;
    EXPECT_NEAR(samples[i].eye.z, 18, 1e-4);
    EXPECT_NEAR(glm::length(samples[i].forward), 1, 1e-9);
    EXPECT_EQ(samples[i].forward.z, 0);
    if (i == 0) continue;
    EXPECT_LT(glm::distance(samples[i - 1].eye, samples[i].eye), 0.2 * 14 + 1e-6);
    // Smooth: no more than 30 degrees in a fifth of a second.
    EXPECT_GT(glm::dot(samples[i - 1].forward, samples[i].forward), std::cos(0.53)) << i;
  }
}

// A pavement beside hollow houses: one walks on it, not on the bare ground under their roofs.
TEST(StandingRoom, BareGroundIsNoFloorWhereThereIsPavement) {
  Scene scene;
  scene.area = {{0, 0}, {400, 300}};
  scene.materials.resize(1);
  add(scene, {0, 0, -1}, {400, 80, 0});       // the pavement
  add(scene, {20, 100, 60}, {380, 290, 62});  // a roof
  const Rooms paved(scene);
  EXPECT_GT(paved.room.is_free[*paved.room.nearest({200, 40})], 0);
  EXPECT_LT(paved.room.place(*paved.room.nearest({200, 200})).y, 82);
  scene.objects.erase(scene.objects.begin());
  const Rooms bare(std::move(scene));
  EXPECT_LT(glm::distance(bare.room.place(*bare.room.nearest({200, 200})), {200, 200}), 4);
}

// Of a roofed room and a smaller yard beside it, with a wall between, the yard comes first.
TEST(StandingRoom, OpenSkyComesFirst) {
  Scene scene = make_rooms();
  add(scene, {195, 130, -1}, {205, 190, 100});  // no door
  add(scene, {-5, -5, 60}, {203, 205, 62});     // a roof over the left room
  add(scene, {300, 100, 0}, {390, 190, 90});    // and less room in the right one
  const Rooms rooms(std::move(scene));
  const std::vector<int> parts = connect_parts(rooms.room);
  EXPECT_EQ(parts[*rooms.room.nearest({250, 50})], 0);
  EXPECT_EQ(parts[*rooms.room.nearest({100, 100})], 1);
  EXPECT_GT(std::count(parts.begin(), parts.end(), 1), std::count(parts.begin(), parts.end(), 0));
}

// A village in a corner of wide open ground: the walk is there, not along the ground's far rim.
TEST(Walk, StaysWhereThereIsMuchToSee) {
  Scene scene;
  scene.area = {{0, 0}, {1600, 800}};
  scene.materials.resize(1);
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 3; ++y)
      add(scene, {200 + 80 * x, 300 + 80 * y, 0}, {220 + 80 * x, 320 + 80 * y, 60});
  const Rooms rooms(std::move(scene));
  EXPECT_GT(rooms.room.sight_at(*rooms.room.nearest({270, 370})), 0.2f);
  EXPECT_EQ(rooms.room.sight_at(*rooms.room.nearest({1500, 100})), 0.0f);
  for (const double seconds : {0.0, 15.0}) {
    const Walk walk = make_walk(rooms.room, {.through = {}, .seconds = seconds}, "scene.json");
    EXPECT_GT(walk.length, 200);
    for (const PathSample& sample : walk.path.samples)
      EXPECT_LT(glm::distance(glm::dvec2(sample.eye), {330, 390}), 350) << seconds;
  }
}

TEST(Walk, PassesThePlacesInOrder) {
  const Rooms rooms(make_rooms());
  const std::vector<glm::dvec2> places{{350, 50}, {50, 50}, {50, 150}};
  const Walk walk = make_walk(rooms.room, {.through = places}, "scene.json");
  std::size_t at = 0;
  for (const PathSample& sample : walk.path.samples)
    if (at < places.size() && glm::distance(glm::dvec2(sample.eye), places[at]) < 8) ++at;
  EXPECT_EQ(at, places.size());
  const Walk brief = make_walk(rooms.room, {.through = places, .seconds = 5}, "scene.json");
  EXPECT_NEAR(brief.path.samples.back().time_s, 5, 1e-9);
}

TEST(Walk, ImpossibleWalksAreRefused) {
  Scene closed = make_rooms();
  add(closed, {195, 130, -1}, {205, 190, 100});
  const Rooms rooms(std::move(closed));
  EXPECT_INPUT_ERROR(make_walk(rooms.room, {.through = {{50, 50}, {350, 50}}}, "scene.json"),
                     "no way leads");
  const Walk walk = make_walk(rooms.room, {}, "scene.json");
  const auto& samples = walk.path.samples;
  EXPECT_EQ(samples.front().eye.x < 200, samples.back().eye.x < 200);
  Scene high = make_rooms();
  for (SceneObject& object : high.objects) object.translation.z = 30;
  const Rooms nowhere(std::move(high));
  EXPECT_INPUT_ERROR(make_walk(nowhere.room, {}, "scene.json"), "nobody can stand");
}

}  // namespace
}  // namespace viewcell
