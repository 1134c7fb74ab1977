#include "capture/captures.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include "base/random.h"
#include "capture/capture_centre.h"

#include "capture/ray_capture.h"
#include "capture/shapes.h"
#include "common/expect_input_error.h"
#include "common/same_every_time.h"
#include "common/temporary_folder.h"
#include "image/fill.h"

namespace viewcell {
namespace {

CaptureSettings make_settings() {
  return {"0123456789abcdef", "fedcba9876543210", {.resolution_px = 128}, "embree"};
}

// A torus seen twice, as objects 3 and 12.
std::vector<CaptureTile> make_tiles(int n_threads = 1) {
  const Scene scene = make_scene_of(make_noisy_torus(24, 12, 0.1, 1));
  const RayCapture rays(scene, n_threads);
  const glm::dvec3 eyes[] = {{60.1, 20.2, 8.3}, {-33.3, 70, 18}};
  std::vector<CaptureTile> tiles(2);
  parallel_for(tiles.size(), n_threads, [&](std::size_t i) {
    const auto viewed =
        choose_view(eyes[i], world_points(scene, scene.objects[0]), {.resolution_px = 128});
    tiles[i] = rays.capture(ObjectId(0), viewed->view, viewed->crop);
    tiles[i].object = ObjectId(i == 0 ? 3 : 12);
    push_pull_fill(tiles[i].color, tiles[i].inverse_depth);
  });
  return tiles;
}

void expect_same(const CaptureTile& a, const CaptureTile& b) {
  EXPECT_EQ(a.object, b.object);
  EXPECT_EQ(a.view.eye, b.view.eye);  // bit for bit: EXR's float matrices would not do
  EXPECT_EQ(a.view.right, b.view.right);
  EXPECT_EQ(a.view.up, b.view.up);
  EXPECT_EQ(a.view.forward, b.view.forward);
  EXPECT_EQ(a.view.focal_px, b.view.focal_px);
  EXPECT_EQ(a.view.source_px, b.view.source_px);
  EXPECT_EQ(a.crop.x, b.crop.x);
  EXPECT_EQ(a.crop.y, b.crop.y);
  ASSERT_EQ(a.color.pixels.size(), b.color.pixels.size());
  EXPECT_EQ(a.color.width_px, b.color.width_px);
  for (std::size_t i = 0; i < a.color.pixels.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(a.color.pixels[i][k], b.color.pixels[i][k], 1e-3f * a.color.pixels[i][k] + 1e-7f);
    EXPECT_EQ(a.color.pixels[i][3], b.color.pixels[i][3]);
    EXPECT_FLOAT_EQ(a.inverse_depth.pixels[i], b.inverse_depth.pixels[i]);
  }
}

TEST(Captures, ReadBackWhatWasWritten) {
  const TemporaryFolder folder;
  const auto file = capture_file_of(folder.path(), CentreId(12));
  EXPECT_EQ(file.filename(), "centre-00012.exr");
  const auto tiles = make_tiles();
  write_captures(file, tiles, make_settings());
  EXPECT_TRUE(is_captured(file, make_settings()));
  CentreCaptures captures(file, make_settings());
  for (const CaptureTile& tile : tiles) {
    EXPECT_TRUE(captures.has(tile.object));
    const auto found = captures.read(tile.object);
    ASSERT_TRUE(found);
    expect_same(tile, *found);
  }
  EXPECT_FALSE(captures.has(ObjectId(4)));
  EXPECT_FALSE(captures.read(ObjectId(4)));
}

TEST(Captures, ACentreMaySeeNothing) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.exr";
  write_captures(file, {}, make_settings());
  EXPECT_TRUE(is_captured(file, make_settings()));
  CentreCaptures captures(file, make_settings());
  EXPECT_FALSE(captures.read(ObjectId(0)));
}

TEST(Captures, SameBytesEveryTime) {
  const TemporaryFolder folder;
  const std::string bytes = same_for_any_threads([&folder](int n_threads) {
    write_captures(folder.path() / "a.exr", make_tiles(n_threads), make_settings());
    return read_file(folder.path() / "a.exr");
  });
  EXPECT_GT(bytes.size(), 10000u);
}

TEST(Captures, KeyTellsBakesApart) {
  std::set<std::string> keys;
  const auto add = [&](const auto& change) {
    CaptureSettings settings = make_settings();
    change(settings);
    keys.insert(settings.key());
  };
  add([](CaptureSettings&) {});
  add([](CaptureSettings& s) { s.scene_hash[0] = 'f'; });
  add([](CaptureSettings& s) { s.cells_hash[0] = '0'; });
  add([](CaptureSettings& s) { s.density.resolution_px = 129; });
  add([](CaptureSettings& s) { s.density.far_scale = 1; });
  add([](CaptureSettings& s) { s.density.far_distance = 301; });
  add([](CaptureSettings& s) { s.engine = "gl"; });
  EXPECT_EQ(keys.size(), 7u);
}

TEST(Captures, OfAnotherBakeAreRefused) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.exr";
  write_captures(file, make_tiles(), make_settings());
  CaptureSettings other = make_settings();
  other.density.resolution_px = 256;
  EXPECT_FALSE(is_captured(file, other));
  EXPECT_INPUT_ERROR(CentreCaptures(file, other), "a.exr: belongs to another bake");
}

TEST(Captures, MissingCutOrForeignFilesAreNotTakenForWhole) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.exr";
  EXPECT_FALSE(is_captured(file, make_settings()));
  EXPECT_INPUT_ERROR(CentreCaptures(file, make_settings()), "a.exr");
  write_captures(file, make_tiles(), make_settings());
  const std::string bytes = read_file(file);
  for (int i = 0; i < 64; ++i) {
    const std::size_t n = bytes.size() * static_cast<std::size_t>(i) / 64;
    const auto cut = folder.path() / ("cut" + std::to_string(i) + ".exr");
    std::ofstream(cut, std::ios::binary) << bytes.substr(0, n);
    EXPECT_FALSE(is_captured(cut, make_settings())) << n << " of " << bytes.size() << " bytes";
  }
  std::ofstream(folder.path() / "last.exr", std::ios::binary) << bytes.substr(0, bytes.size() - 1);
  EXPECT_FALSE(is_captured(folder.path() / "last.exr", make_settings()));
  EXPECT_FALSE(is_captured(folder.add("text.exr", "not an image"), make_settings()));
  EXPECT_FALSE(is_captured(folder.path(), make_settings()));
}

TEST(CaptureSettings, ReadBackAndHeldAgainstSceneAndCells) {
  const TemporaryFolder folder;
  const Scene scene = make_scene_of(make_box({0, 0, 0}, {1, 1, 1}));  // hash 0123456789abcdef
  CaptureSettings settings = make_settings();
  settings.density.far_scale = 1.5;
  Json json = format_settings(settings, {});
  const auto file = folder.add(kCapturesManifest, format_json(json));
  const CaptureSettings back = read_settings(folder.path(), scene, settings.cells_hash);
  EXPECT_EQ(back.key(), settings.key());
  EXPECT_EQ(back.density.far_scale, 1.5);
  EXPECT_INPUT_ERROR(read_settings(folder.path(), scene, "x"), "cells_hash: these are captures of");
  Scene other = scene;
  other.hash = "x";
  EXPECT_INPUT_ERROR(read_settings(folder.path(), other, settings.cells_hash),
                     "captures.json: scene_hash: these are captures of another scene");
  for (const char* key :
       {"scene_hash", "cells_hash", "resolution_px", "far_scale", "far_distance", "engine"}) {
    Json bad = json;
    bad.erase(key);
    write_file(file, format_json(bad));
    EXPECT_INPUT_ERROR(read_settings(folder.path(), scene, settings.cells_hash), key);
  }
  EXPECT_INPUT_ERROR(read_settings(folder.path() / "absent", scene, "x"), "captures.json");
}

// Object 0 is inside cell 5 only, object 1 nowhere, object 2 everywhere.
TEST(ObjectsSeenFrom, AreThoseOutsideSomeCellOfTheNeighbourhood) {
  CellSet cells;
  cells.grid = {{0, 0}, 50, 4, 3};
  cells.n_objects = 3;
  cells.inside.assign(12, {ObjectId(2)});
  cells.inside[5] = {ObjectId(0), ObjectId(2)};
  const auto seen = [&](int column, int row) {
    return objects_seen_from(cells, *centre_at(cells.grid, {column, row}));
  };
  // from cell 5's own centre its neighbours need object 0
  EXPECT_EQ(seen(1, 1), (std::vector<ObjectId>{ObjectId(0), ObjectId(1)}));
  EXPECT_EQ(seen(3, 1), (std::vector<ObjectId>{ObjectId(0), ObjectId(1)}));
  // a centre beyond the rim, next to cells alone that have object 2 inside
  EXPECT_EQ(seen(4, 0), (std::vector<ObjectId>{ObjectId(0), ObjectId(1)}));
  // with object 0 inside every cell, nobody captures it
  for (auto& inside : cells.inside) inside = {ObjectId(0), ObjectId(2)};
  EXPECT_EQ(seen(1, 1), (std::vector<ObjectId>{ObjectId(1)}));
  EXPECT_EQ(seen(-1, -1).size(), 1u);
}

// Of cells that were tested only what they see is captured, and of those that were not, nothing.
TEST(ObjectsSeenFrom, AreThoseThatTestedCellsSee) {
  CellSet cells;
  cells.grid = {{0, 0}, 50, 4, 3};
  cells.n_objects = 3;
  cells.inside.assign(12, {});
  cells.is_tested.assign(12, false), cells.unseen.assign(12, {});
  cells.own.assign(12, {});
  const auto seen = [&] {
    return objects_seen_from(cells, *centre_at(cells.grid, coord_of(cells.grid, CellId(5))));
  };
  EXPECT_EQ(seen(), (std::vector<ObjectId>{}));
  cells.is_tested[5] = true;
  EXPECT_EQ(seen(), (std::vector<ObjectId>{ObjectId(0), ObjectId(1), ObjectId(2)}));
  cells.unseen[5] = {ObjectId(1)};
  EXPECT_EQ(seen(), (std::vector<ObjectId>{ObjectId(0), ObjectId(2)}));
  cells.own[5] = {ObjectId(0)};  // drawn as it is
  EXPECT_EQ(seen(), (std::vector<ObjectId>{ObjectId(2)}));
  cells.is_tested[index(*cell_at(cells.grid, neighbour(coord_of(cells.grid, CellId(5)), 0)))] =
      true;
  EXPECT_EQ(seen().size(), 3u);  // that neighbour sees all
}

// What is said to be needed is what is captured.
TEST(LargestCell, CountsWhatIsCaptured) {
  Scene scene = make_scene_of(make_sphere(6, 12, 8));
  scene.area = {{0, 0}, {200, 150}};
  const SceneObject first = scene.objects[0];
  scene.objects.clear();
  Random random(4);
  for (int i = 0; i < 9; ++i) {
    scene.objects.push_back(first);
    scene.objects.back().translation = {random.uniform(0, 200), random.uniform(0, 150), 15};
  }
  const CellSet cells = make_cells(scene, 40, {16, 20});
  const CaptureDensity density{.resolution_px = 96};
  const auto points = object_points_world(scene);
  const RayCapture rays(scene, 1);
  const CaptureEngine engine = [&](ObjectId o, const CaptureView& v, const Crop& c) {
    return rays.capture(o, v, c);
  };
  std::vector<CellId> list;
  for (int i = 0; i < cells.grid.n_cells(); ++i) list.push_back(CellId(i));
  std::size_t most = 0;
  for (const CellId cell : list) {
    std::size_t n = 0;
    for (const CentreId centre : views_of(cells.grid, cell)) {
      std::size_t of_centre = 0;
      for (const CaptureTile& tile : capture_centre(cells, centre, points, density, engine).tiles)
        of_centre += tile.color.pixels.size();
      EXPECT_EQ(count_pixels(cells, centre, points, density), of_centre);
      n += of_centre;
    }
    most = std::max(most, n);
  }
  EXPECT_EQ(find_largest_cell(cells, list, points, density, 2).n_pixels, most);
  EXPECT_GT(most, 1000u);
}

}  // namespace
}  // namespace viewcell
