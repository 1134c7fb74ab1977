#include "cells/cells.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "cells/small_scene.h"
#include "common/expect_input_error.h"
#include "common/mutate.h"
#include "common/temporary_folder.h"

namespace viewcell {
namespace {

const Area kArea{{0, 0}, {400, 400}};
constexpr EyeHeight kHeight{16, 20};

// The near plane's corner: near * sqrt(1 + 2 tan^2 30 deg) = sqrt(5 / 3).
const double kMargin = std::sqrt(5.0 / 3);

// The hexagon around the origin reaches to y = sqrt(3)/2 c above and to x = c at its corner.
TEST(MakeCells, InsideReachesTheNearPlanesCornerBeyondTheCell) {
  const double top = std::sqrt(3.0) / 2 * 50, corner = 50;
  const std::vector<glm::dvec3> centres{{0, top + kMargin + 1 - 1e-6, 0},
                                        {0, top + kMargin + 1 + 1e-6, 0},
                                        {corner + kMargin + 1 - 1e-6, 0, 0},
                                        {corner + kMargin + 1 + 1e-6, 0, 0},
                                        {0, 0, 0}};
  const CellSet cells = make_cells(make_box_scene(kArea, centres), 50, kHeight);
  EXPECT_EQ(cells.inside[0], (std::vector<ObjectId>{ObjectId(0), ObjectId(2), ObjectId(4)}));
  EXPECT_TRUE(is_inside(cells, CellId(0), ObjectId(2)));
  EXPECT_FALSE(is_inside(cells, CellId(0), ObjectId(3)));
}

// A box turned by 45 degrees about z reaches sqrt 2; height does not matter.
TEST(MakeCells, FootprintIsTheProjectionOfThePlacedMesh) {
  const double top = std::sqrt(3.0) / 2 * 50;
  for (const double off : {-1e-4, 1e-4}) {
    Scene scene = make_box_scene(kArea, {{0, top + kMargin + 3 * std::sqrt(2.0) + off, 1000}});
    scene.objects[0].rotation = glm::angleAxis(glm::radians(45.0), glm::dvec3(0, 0, 1));
    scene.objects[0].scale = 3;
    const CellSet cells = make_cells(scene, 50, kHeight);
    EXPECT_EQ(is_inside(cells, CellId(0), ObjectId(0)), off < 0);
  }
}

// An eye at an object's footprint is in a cell that has the object inside.
TEST(MakeCells, PointsOfFootprintsAreInCellsThatListThem) {
  Random random(1);
  std::vector<glm::dvec3> centres;
  for (int i = 0; i < 40; ++i)
    centres.emplace_back(random.uniform(0, 400), random.uniform(0, 400), 0);
  Scene scene = make_box_scene(kArea, centres);
  for (SceneObject& object : scene.objects) object.scale = random.uniform(1, 40);
  const CellSet cells = make_cells(scene, 30, kHeight);
  std::size_t n_checked = 0;
  for (std::size_t o = 0; o < scene.objects.size(); ++o)
    for (int i = 0; i < 50; ++i) {
      const glm::dvec3 p =
          scene.objects[o].world_from_model({random.uniform(-1, 1), random.uniform(-1, 1), 0});
      const auto cell = cell_at(cells.grid, coord_at(cells.grid, glm::dvec2(p)));
      if (!cell) continue;
      ++n_checked;
      EXPECT_TRUE(is_inside(cells, *cell, ObjectId(o)));
    }
  EXPECT_GT(n_checked, 1000u);
}

TEST(Prism, HasTwelveCornersAtBothHeights) {
  const CellSet cells = make_cells(make_box_scene(kArea, {}), 50, kHeight);
  const CellId cell{7};
  const auto corners = prism_of(cells, cell);
  ASSERT_EQ(corners.size(), 12u);
  const ConvexPolygon hexagon = corners_of(cells.grid, coord_of(cells.grid, cell));
  for (std::size_t k = 0; k < 12; ++k) {
    EXPECT_EQ(glm::dvec2(corners[k]), hexagon[k % 6]);
    EXPECT_EQ(corners[k].z, k < 6 ? 16 : 20);
  }
  const glm::dvec3 eye = eye_of(cells, cell);
  EXPECT_EQ(eye, glm::dvec3(centre_of(cells.grid, coord_of(cells.grid, cell)), 18));
}

TEST(CentresOf, AreTheClosedNeighbourhoodsOnce) {
  const CellSet cells = make_cells(make_box_scene(kArea, {}), 50, kHeight);
  EXPECT_EQ(centres_of(cells, {CellId(0)}).size(), 7u);
  EXPECT_EQ(centres_of(cells, {CellId(0), CellId(cells.grid.columns)}).size(), 10u);
  std::vector<CellId> all;
  for (int i = 0; i < cells.grid.n_cells(); ++i) all.push_back(CellId(i));
  const auto centres = centres_of(cells, all);
  EXPECT_TRUE(std::is_sorted(centres.begin(), centres.end()));
  EXPECT_GT(centres.size(), all.size());
  EXPECT_LE(centres.size(), static_cast<std::size_t>(cells.grid.n_centres()));
}

CellSet make_some_cells() {
  return make_cells(make_box_scene(kArea, {{10, 10, 0}, {300, 200, 0}, {12, 9, 0}}), 77.7, kHeight);
}

TEST(CellsFile, ReadsBackTheSame) {
  const TemporaryFolder folder;
  const CellSet cells = make_some_cells();
  const auto file = folder.add("cells.json", format_json(format_cells(cells, {})));
  const CellSet back = read_cells(file);
  EXPECT_EQ(back.grid.origin, cells.grid.origin);
  EXPECT_EQ(back.grid.size, cells.grid.size);
  EXPECT_EQ(back.grid.columns, cells.grid.columns);
  EXPECT_EQ(back.grid.rows, cells.grid.rows);
  EXPECT_EQ(back.eye_height.lo, 16);
  EXPECT_EQ(back.eye_height.hi, 20);
  EXPECT_EQ(back.near, cells.near);
  EXPECT_EQ(back.scene_hash, cells.scene_hash);
  EXPECT_EQ(back.n_objects, 3u);
  EXPECT_EQ(back.inside, cells.inside);
  EXPECT_EQ(format_json(format_cells(back, {})), format_json(format_cells(cells, {})));
}

CellSet make_tested_cells() {
  CellSet cells = make_some_cells();
  const auto n = static_cast<std::size_t>(cells.grid.n_cells());
  cells.is_tested.assign(n, false), cells.unseen.assign(n, {});
  cells.is_tested[2] = cells.is_tested[5] = true;
  for (std::uint32_t o = 0; o < 3; ++o)
    if (!is_inside(cells, CellId(2), ObjectId(o))) cells.unseen[2].push_back(ObjectId(o));
  cells.seen_by = {{"method", "rays"}};
  cells.own.resize(n);
  for (std::uint32_t o = 0; o < 3; ++o)
    if (!is_inside(cells, CellId(5), ObjectId(o))) cells.own[5].push_back(ObjectId(o));
  cells.own[2] = cells.unseen[2];
  return cells;
}

TEST(CellsFile, KeepsWhatCellsSee) {
  const TemporaryFolder folder;
  const CellSet cells = make_tested_cells();
  ASSERT_FALSE(cells.unseen[2].empty());
  const CellSet back = read_cells(folder.add("cells.json", format_json(format_cells(cells, {}))));
  EXPECT_EQ(back.is_tested, cells.is_tested);
  EXPECT_EQ(back.unseen, cells.unseen);
  EXPECT_EQ(back.seen_by, cells.seen_by);
  EXPECT_EQ(back.own, cells.own);
  // Drawn as it is: what is inside, and what is its own unless it is unseen.
  EXPECT_EQ(originals_of(back, CellId(2)), back.inside[2]);
  EXPECT_EQ(originals_of(back, CellId(5)).size(), 3u);
  for (std::uint32_t o = 0; o < 3; ++o) {
    EXPECT_EQ(is_original(back, CellId(2), ObjectId(o)), is_inside(back, CellId(2), ObjectId(o)));
    EXPECT_TRUE(is_original(back, CellId(5), ObjectId(o)));
  }
  EXPECT_TRUE(is_unseen(back, CellId(2), cells.unseen[2][0]));
  EXPECT_FALSE(is_unseen(back, CellId(5), cells.unseen[2][0]));
  EXPECT_FALSE(is_unseen(make_some_cells(), CellId(2), ObjectId(0)));
  EXPECT_NO_THROW(check_tested(back, {CellId(2), CellId(5)}, "cells.json"));
  EXPECT_NO_THROW(check_tested(make_some_cells(), {CellId(3)}, "cells.json"));
  EXPECT_INPUT_ERROR(check_tested(back, {CellId(2), CellId(3)}, "cells.json"),
                     "cells[3]: was not tested");
}

TEST(CellsFile, UnseenObjectsAreOutside) {
  const TemporaryFolder folder;
  Json bad = format_cells(make_tested_cells(), {});
  const auto is_full = [](const Json& cell) { return !cell["inside"].empty(); };
  auto& cell = *std::find_if(bad["cells"].begin(), bad["cells"].end(), is_full);
  cell["unseen"] = {cell["inside"][0]};
  EXPECT_INPUT_ERROR(read_cells(folder.add("cells.json", format_json(bad))), "is inside the cell");
  cell.erase("unseen");
  cell["own"] = {cell["inside"][0]};
  EXPECT_INPUT_ERROR(read_cells(folder.add("cells.json", format_json(bad))), "own[0]: is inside");
}

TEST(CellsFile, OfAnotherSceneIsRefused) {
  Scene scene = make_box_scene(kArea, {});
  const CellSet cells = make_cells(scene, 50, kHeight);
  EXPECT_NO_THROW(check_cells_of_scene(cells, scene, "cells.json"));
  scene.hash = "00000000000000bb";
  EXPECT_INPUT_ERROR(check_cells_of_scene(cells, scene, "cells.json"),
                     "cells.json: scene_hash: was made for another scene");
}

TEST(CellsFile, MalformedIsRefusedWithItsPlace) {
  const TemporaryFolder folder;
  const Json good = format_cells(make_some_cells(), {});
  const auto expect = [&](const char* place, const auto& damage) {
    SCOPED_TRACE(place);
    Json bad = good;
    damage(bad);
    EXPECT_INPUT_ERROR(read_cells(folder.add("cells.json", format_json(bad))), place);
  };
  expect("format", [](Json& j) { j["format"] = "viewcell-scene"; });
  expect("version", [](Json& j) { j["version"] = 3; });
  for (const char* key : {"scene_hash", "objects", "size", "origin", "columns", "rows",
                          "eye_height", "near", "cells"}) {
    expect(key, [&](Json& j) { j.erase(key); });
    expect(key, [&](Json& j) { j[key] = Json::object(); });
  }
  expect("columns", [](Json& j) { j["columns"] = 0; });
  expect("columns", [](Json& j) { j["columns"] = 2.5; });
  expect("rows", [](Json& j) { j["rows"] = 1e9; });
  expect("cells: has", [](Json& j) { j["rows"] = 9999; });
  expect("size", [](Json& j) { j["size"] = 0; });
  expect("size", [](Json& j) { j["size"] = -50; });
  expect("origin", [](Json& j) { j["origin"] = {1}; });
  expect("near", [](Json& j) { j["near"] = 0; });
  expect("eye_height: is not LO, HI", [](Json& j) { j["eye_height"] = {20, 16}; });
  expect("eye_height", [](Json& j) { j["eye_height"] = {16, 20, 24}; });
  expect("cells: has", [](Json& j) { j["cells"].erase(0); });
  expect("cells[1].id", [](Json& j) { j["cells"][1]["id"] = 0; });
  expect("cells[0]: has no", [](Json& j) { j["cells"][0].erase("inside"); });
  expect("cells[0].inside[0]", [](Json& j) { j["cells"][0]["inside"] = {3}; });
  expect("cells[0].inside[0]", [](Json& j) { j["cells"][0]["inside"] = {-1}; });
  expect("cells[0].inside[1]", [](Json& j) { j["cells"][0]["inside"] = {1, 1}; });
  expect("cells[0].inside[1]", [](Json& j) { j["cells"][0]["inside"] = {2, 0}; });
  expect("cells[0].inside", [](Json& j) { j["cells"][0]["inside"] = {0, 1, 2, 2}; });
}

TEST(CellsFile, DamagedCopiesNeverDoWorse) {
  const TemporaryFolder folder;
  const std::string text = format_json(format_cells(make_some_cells(), {}));
  int n = 0;
  read_damaged_copies(text, 200, 3, [&](const std::string& damaged) {
    read_cells(folder.add(std::to_string(n++) + ".json", damaged));
  });
}

}  // namespace
}  // namespace viewcell
