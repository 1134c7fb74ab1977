#include "play/stand_in.h"

#include <gtest/gtest.h>

#include "bake/bundle_copy.h"
#include "common/expect_input_error.h"
#include "play/session.h"

namespace viewcell {
namespace {

constexpr int kFramePx = 128;

PlayerOptions small_player(bool with_lod = false) {
  PlayerOptions options;
  options.width_px = options.height_px = kFramePx;
  options.residency = {.pool_texels = 8u << 20, .prefetch = false};
  options.with_lod = with_lod;
  return options;
}

// In the middle of a cell, at a height, looking at an object.
Camera make_camera(const Bundle& bundle, CellId cell, double height, std::size_t object) {
  Camera camera;
  camera.eye = eye_of(bundle.cells(), cell);
  camera.eye.z = height;
  camera.forward = glm::normalize(bundle.scene().objects[object].translation - camera.eye);
  return camera;
}

struct Drawn {
  DrawnFrame frame;
  ImageRgba8 picture;
};
Drawn draw(Player& player, Mode mode, const Camera& camera) {
  const DrawnFrame frame = player.draw(mode, camera);
  return {frame, player.read(mode)};
}

CameraPath path_of(const std::vector<glm::dvec3>& eyes) {
  CameraPath path;
  for (const glm::dvec3& eye : eyes)
    path.samples.push_back({static_cast<double>(path.samples.size()), eye, {1, 0, 0}});
  return path;
}

Session play(const std::filesystem::path& folder, const CameraPath& path, SessionOptions options) {
  const Bundle bundle(folder);
  Player player(bundle, small_player());
  return run_session(player, bundle, path, options);
}

// Heights of 16 to 20 were baked.
TEST(StandIn, TheEyeMayBeWhereItWasBakedFor) {
  const Bundle bundle(shared_bundle());
  const auto at = [&](double height) {
    return find_off_bake(bundle, make_camera(bundle, CellId(4), height, 0));
  };
  for (const double height : {16.0, 18.0, 20.0, 20.0 + 1e-9, 16.0 - 1e-9})
    EXPECT_EQ(at(height), StandIn::none) << height;
  for (const double height : {20.01, 15.99, 0.0, 60.0, -5.0, 1e9})
    EXPECT_EQ(at(height), StandIn::off_height) << height;
  Camera away;
  away.eye = {-500, 0, 18};
  EXPECT_EQ(find_off_bake(bundle, away), StandIn::off_cells);
  const TemporaryFolder folder;
  shared_bake().pack(folder / "few", shared_bake().inputs, {CellId(4)});
  const Bundle few(folder / "few");
  EXPECT_EQ(find_off_bake(few, make_camera(bundle, CellId(5), 18, 0)), StandIn::off_cells);
  EXPECT_EQ(find_off_bake(few, make_camera(bundle, CellId(4), 18, 0)), StandIn::none);
}

// Off the bake the hybrid is the original, pixel for pixel, or with levels what mode lod draws.
TEST(StandIn, OffTheBakeThePictureIsThatOfTheOriginals) {
  const Bundle bundle(shared_bundle());
  for (const bool with_lod : {false, true}) {
    Player player(bundle, small_player(with_lod));
    for (std::size_t object = 0; object < 5; ++object)
      for (const double height : {3.0, 45.0}) {
        const Camera camera = make_camera(bundle, CellId(4), height, object);
        const Drawn expected = draw(player, with_lod ? Mode::lod : Mode::frustum, camera);
        const Drawn hybrid = draw(player, Mode::hybrid, camera);
        EXPECT_EQ(hybrid.picture.pixels, expected.picture.pixels);
        EXPECT_EQ(hybrid.frame.stand_in, StandIn::off_height);
        EXPECT_EQ(hybrid.frame.n_triangles, expected.frame.n_triangles);
      }
  }
}

TEST(StandIn, ADamagedCellIsDrawnFromTheOriginals) {
  const BundleCopy copy;
  put_bytes(copy.file(cell_name(CellId(4))), "damage");
  const Bundle bundle(copy.path());
  Player player(bundle, small_player());
  for (std::size_t object = 0; object < 5; ++object) {
    const Camera camera = make_camera(bundle, CellId(4), 18, object);
    const Drawn hybrid = draw(player, Mode::hybrid, camera);
    EXPECT_EQ(hybrid.picture.pixels, draw(player, Mode::frustum, camera).picture.pixels);
    EXPECT_EQ(hybrid.frame.stand_in, StandIn::damaged_cell);
  }
  EXPECT_EQ(draw(player, Mode::hybrid, make_camera(bundle, CellId(2), 18, 1)).frame.stand_in,
            StandIn::none);
}

// Without any textures everything is lit: alpha 254, where it was 255; the same pixels are covered.
TEST(StandIn, WithoutTexturesObjectsAreLit) {
  const BundleCopy copy;
  const Bundle whole(shared_bundle());
  for (const CentreId centre : views_of(whole.cells().grid, CellId(4)))
    put_bytes(copy.file(centre_name(centre)), "damage");
  std::vector<Drawn> expected;
  {
    Player player(whole, small_player());
    for (std::size_t object = 0; object < 5; ++object)
      expected.push_back(draw(player, Mode::hybrid, make_camera(whole, CellId(4), 18, object)));
  }
  const Bundle bundle(copy.path());
  Player player(bundle, small_player());
  int n_lit = 0;
  for (std::size_t object = 0; object < 5; ++object) {
    const Drawn drawn = draw(player, Mode::hybrid, make_camera(bundle, CellId(4), 18, object));
    EXPECT_EQ(drawn.frame.stand_in, StandIn::damaged_textures);
    EXPECT_EQ(drawn.frame.n_triangles, expected[object].frame.n_triangles);
    for (std::size_t i = 0; i < drawn.picture.pixels.size(); ++i) {
      const int alpha = drawn.picture.pixels[i][3], before = expected[object].picture.pixels[i][3];
      ASSERT_EQ(alpha == 0, before == 0);
      n_lit += alpha == 254 && before == 255;
      if (alpha == 255) {  // inside objects are no matter of textures
        ASSERT_EQ(drawn.picture.pixels[i], expected[object].picture.pixels[i]);
      }
    }
  }
  EXPECT_GT(n_lit, 500);
}

TEST(StandIn, ASessionCountsThem) {
  const BundleCopy copy;
  put_bytes(copy.file(cell_name(CellId(4))), "damage");
  const CellSet& cells = shared_bake().cells;
  const glm::dvec3 in_4 = eye_of(cells, CellId(4));
  SessionOptions options;
  options.modes = {Mode::frustum, Mode::hybrid};
  options.n_frames = 4;
  const Session session =
      play(copy.path(),
           path_of({in_4, in_4 + glm::dvec3(0, 0, 9), eye_of(cells, CellId(0)), {0, -900, 18}}),
           options);
  const Timeline& t = session.timeline;
  EXPECT_EQ(count_stand_ins(t, StandIn::damaged_cell), 1u);
  EXPECT_EQ(count_stand_ins(t, StandIn::off_height), 1u);
  EXPECT_EQ(count_stand_ins(t, StandIn::off_cells), 1u);
  EXPECT_EQ(count_stand_ins(t, StandIn::damaged_textures), 0u);
  EXPECT_EQ(count_stand_ins(t, StandIn::none), 1u);
  ASSERT_EQ(t.faults.size(), 1u);
}

// A path that never meets the bundle is another's; modes without a hybrid do not mind.
TEST(StandIn, APathThatNeverMeetsTheBundleIsRefused) {
  const TemporaryFolder folder;
  shared_bake().pack(folder / "few", shared_bake().inputs, {CellId(4)});
  const CellSet& cells = shared_bake().cells;
  SessionOptions options;
  options.modes = {Mode::frustum, Mode::hybrid};
  options.n_frames = 2;
  const CameraPath other = path_of({eye_of(cells, CellId(5)), eye_of(cells, CellId(8))});
  EXPECT_INPUT_ERROR(play(folder / "few", other, options), "the first is in cell 5");
  EXPECT_INPUT_ERROR(play(folder / "few", path_of({{-900, 0, 18}, {-800, 0, 18}}), options),
                     "leaves the grid");
  options.modes = {Mode::frustum};
  EXPECT_NO_THROW(play(folder / "few", other, options));
}

std::size_t count_pictures(const std::filesystem::path& folder) {
  std::size_t n = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    n += entry.path().extension() == ".png";
  return n;
}

// Frames are saved whether or not they are compared.
TEST(Session, SavesEveryFrameAskedFor) {
  const CellSet& cells = shared_bake().cells;
  const CameraPath path = path_of({eye_of(cells, CellId(4)), eye_of(cells, CellId(0))});
  for (const bool with_quality : {false, true}) {
    const TemporaryFolder folder;
    SessionOptions options;
    options.modes = {Mode::frustum, Mode::hybrid};
    options.n_frames = 5, options.save_every = 2, options.quality_every = 3;
    options.with_quality = with_quality, options.n_sheet_rows = 0;
    options.save = folder / "frames";
    play(shared_bundle(), path, options);
    EXPECT_EQ(count_pictures(folder / "frames"), 6u);  // frames 0, 2, 4 of two modes
    EXPECT_TRUE(std::filesystem::exists(folder / "frames/hybrid/frame-00002.png"));
  }
}

}  // namespace
}  // namespace viewcell
