#include <gtest/gtest.h>

#include "bake/bundle_copy.h"
#include "common/expect_input_error.h"
#include "image/metrics.h"
#include "play/player.h"
#include "visibility/seen_objects.h"

namespace viewcell {
namespace {

namespace fs = std::filesystem;
constexpr int kSize = 256;

struct Stage {
  explicit Stage(const std::filesystem::path& folder = shared_bundle()) : bundle(folder) {}
  Bundle bundle;
  Player player{bundle, make_options()};
  static PlayerOptions make_options() {
    PlayerOptions options;
    options.width_px = options.height_px = kSize;
    options.residency.pool_texels = 16u << 20;
    return options;
  }
  ImageRgba8 draw(Mode mode, const Camera& camera) {
    player.draw(mode, camera);
    return player.read(mode);
  }
  // Eyes all over the cells, looking at an object.
  Camera random_camera(Random& random) const {
    const CellSet& cells = bundle.cells();
    const auto objects = static_cast<std::uint32_t>(bundle.scene().objects.size());
    for (;;) {
      Camera camera;
      camera.eye = {random.uniform(0, 120), random.uniform(0, 120), random.uniform(16, 20)};
      const glm::dvec3 to = bundle.scene().objects[random.below(objects)].translation - camera.eye;
      const auto cell = cell_at(cells.grid, coord_at(cells.grid, glm::dvec2(camera.eye)));
      if (!cell || glm::length(to) < 45) continue;
      camera.forward = glm::normalize(to);
      return camera;
    }
  }
};

std::size_t count_alpha(const ImageRgba8& image, int alpha) {
  return static_cast<std::size_t>(std::count_if(image.pixels.begin(), image.pixels.end(),
                                                [&](const Rgba8& p) { return p[3] == alpha; }));
}

// No pixel that frustum covers lies more than 2 px away from one that hybrid covers, nor the other
// way round.
int count_uncovered(const ImageRgba8& a, const ImageRgba8& b) {
  int n = 0;
  for (int y = 2; y < a.height_px - 2; ++y)
    for (int x = 2; x < a.width_px - 2; ++x) {
      if (a.at(x, y)[3] == 0) continue;
      bool covered = false;
      for (int j = -2; j <= 2; ++j)
        for (int i = -2; i <= 2; ++i) covered |= b.at(x + i, y + j)[3] != 0;
      n += !covered;
    }
  return n;
}

TEST(HybridFrame, LooksLikeTheOriginals) {
  Stage stage;
  Random random(31);
  double mean_db = 0;
  int n_differ = 0;
  std::size_t n_textured = 0, n_lit = 0;
  constexpr int kFrames = 24;
  for (int k = 0; k < kFrames; ++k) {
    SCOPED_TRACE(k);
    const Camera camera = stage.random_camera(random);
    const ImageRgba8 original = stage.draw(Mode::frustum, camera);
    const ImageRgba8 hybrid = stage.draw(Mode::hybrid, camera);
    const ImageDistance distance = compare_images(original, hybrid, {false});
    EXPECT_GT(distance.n_covered, 200u);
    EXPECT_GT(distance.psnr_covered_db, 24);
    EXPECT_GT(distance.psnr_db, 38);
    EXPECT_EQ(count_uncovered(original, hybrid), 0);
    EXPECT_EQ(count_uncovered(hybrid, original), 0);
    EXPECT_EQ(count_alpha(hybrid, 0) + count_alpha(hybrid, 254) + count_alpha(hybrid, 255),
              hybrid.pixels.size());
    n_textured += count_alpha(hybrid, 255), n_lit += count_alpha(hybrid, 254);
    if (distance.mse == 0) continue;  // all that shows is inside the cell
    mean_db += distance.psnr_covered_db;
    ++n_differ;
  }
  EXPECT_GT(n_differ, 12);
  EXPECT_GT(mean_db / n_differ, 31);
  EXPECT_LT(n_lit, 0.02 * static_cast<double>(n_textured));
}

// In wide frames nothing is missing at the sides.
TEST(HybridFrame, WideFramesLackNothing) {
  const Bundle bundle(shared_bundle());
  PlayerOptions options = Stage::make_options();
  options.width_px = 2 * kSize;
  Player player(bundle, options);
  Random random(40);
  const CellSet& cells = bundle.cells();
  int n_seen = 0;
  for (int k = 0; k < 12; ++k) {
    Camera camera;
    camera.eye = {random.uniform(0, 120), random.uniform(0, 120), 18};
    const double angle = random.uniform(0, 6.28);
    camera.forward = {std::cos(angle), std::sin(angle), 0};
    if (!cell_at(cells.grid, coord_at(cells.grid, glm::dvec2(camera.eye)))) continue;
    camera = with_frame(camera, 75, 2);
    player.draw(Mode::frustum, camera);
    const ImageRgba8 original = player.read(Mode::frustum);
    player.draw(Mode::hybrid, camera);
    const ImageRgba8 hybrid = player.read(Mode::hybrid);
    EXPECT_EQ(original.width_px, 2 * kSize);
    EXPECT_EQ(count_uncovered(original, hybrid), 0) << k;
    EXPECT_EQ(count_uncovered(hybrid, original), 0) << k;
    n_seen += count_alpha(original, 255) > 200;
  }
  EXPECT_GT(n_seen, 6);
}

// Through a fence of leaves one sees what stands behind it, from both sides and from anywhere in
// the cells; packed as bytes and as BC3.
TEST(HybridFrame, MasksAreSeenThrough) {
  const SmallBake fence(make_fence_scene());
  for (const TextureFormat format : {TextureFormat::rgba8, TextureFormat::bc3}) {
    const TemporaryFolder folder;
    fence.pack(folder.path() / "bundle", fence.inputs, fence.list, format);
    Stage stage(folder.path() / "bundle");
    Random random(37);
    double mean_db = 0;
    std::size_t n_one = 0, n_both = 0, n_filled = 0;
    constexpr int kFrames = 12;
    for (int k = 0; k < kFrames; ++k) {
      Camera camera;
      camera.eye = {random.uniform(10, 110), 60 + (k % 2 ? 1 : -1) * random.uniform(42, 56), 18};
      camera.forward = glm::normalize(glm::dvec3(60, 60, 18) - camera.eye);
      const ImageRgba8 original = stage.draw(Mode::frustum, camera);
      const ImageRgba8 hybrid = stage.draw(Mode::hybrid, camera);
      mean_db += compare_images(original, hybrid, {false}).psnr_covered_db / kFrames;
      for (std::size_t i = 0; i < hybrid.pixels.size(); ++i) {
        const bool was = original.pixels[i][3] != 0, is = hybrid.pixels[i][3] != 0;
        n_one += was != is, n_both += was && is, n_filled += is && !was;
      }
    }
    EXPECT_GT(mean_db, 23) << int(format);
    EXPECT_GT(n_both, 60000u);
    EXPECT_LT(double(n_one), 0.09 * double(n_both));  // rims of leaves
    EXPECT_LT(double(n_filled), 0.05 * double(n_both));
  }
  // One that was packed before tiles told of holes would have some where there are none.
  const TemporaryFolder folder;
  const fs::path old = folder.path() / "bundle";
  fence.pack(old);
  BundleManifest manifest = Bundle(old).manifest();
  const fs::path bake = bake_folder(old, manifest);
  manifest.has_masks = false;
  fs::rename(bake, bake_folder(old, manifest));
  write_file(old / kManifestName, format_json(format_manifest(manifest)));
  EXPECT_INPUT_ERROR(Bundle{old}, "pack it again");
}

// A wall across the area hides balls. Without what each cell never sees the frames are the same,
// for fewer texels and draws.
TEST(HybridFrame, WhatIsNeverSeenIsNotMissed) {
  Scene scene = make_bake_scene();
  SceneMesh wall = make_scene_mesh(make_box({58, -60, -40}, {62, 180, 90}), "wall");
  wall.file = "wall.ply";
  scene.meshes.push_back(wall);
  SceneObject object;
  object.name = "wall", object.mesh = MeshId(2);
  scene.objects.push_back(object);
  const SmallBake all(scene);
  const SmallBake tested(scene, [](const Scene& s, CellSet& cells) {
    const SeenFinder finder(s, cells, {}, 2);
    mark_unseen(s, cells, [&](CellId cell, ObjectId o) {
      const auto unseen = finder.find(cell).unseen;
      return std::find(unseen.begin(), unseen.end(), o) != unseen.end();
    });
  });
  std::size_t n_unseen = 0;
  for (const auto& unseen : tested.cells.unseen) n_unseen += unseen.size();
  EXPECT_GT(n_unseen, 6u);
  const TemporaryFolder folder;
  const PackCounts packed = all.pack(folder.path() / "all");
  const PackCounts packed_less = tested.pack(folder.path() / "tested");
  EXPECT_EQ(packed_less.n_unseen, n_unseen);
  EXPECT_LT(packed_less.texel_bytes, packed.texel_bytes);
  std::vector<Camera> cameras;
  std::vector<ImageRgba8> pictures;
  {
    Stage stage(folder.path() / "all");
    Random random(38);
    for (int k = 0; k < 20; ++k) {
      cameras.push_back(stage.random_camera(random));
      pictures.push_back(stage.draw(Mode::hybrid, cameras.back()));
    }
  }
  Stage stage(folder.path() / "tested");
  for (std::size_t k = 0; k < cameras.size(); ++k)
    EXPECT_EQ(stage.draw(Mode::hybrid, cameras[k]).pixels, pictures[k].pixels) << k;
}

// Cells that are wrong about everything: what should show is there, coarse, and nothing is a hole.
TEST(HybridFrame, WhatWasThoughtUnseenLeavesNoHole) {
  const SmallBake wrong(make_bake_scene(), [](const Scene& s, CellSet& cells) {
    mark_unseen(s, cells, [](CellId, ObjectId) { return true; });
  });
  const TemporaryFolder folder;
  EXPECT_EQ(wrong.pack(folder.path() / "bundle").texel_bytes, 0u);
  Stage stage(folder.path() / "bundle");
  Random random(39);
  std::size_t n_drawn = 0, n_originals = 0;
  for (int k = 0; k < 12; ++k) {
    const Camera camera = stage.random_camera(random);
    const ImageRgba8 original = stage.draw(Mode::frustum, camera);
    const std::size_t n_frustum = stage.player.draw(Mode::frustum, camera).n_triangles;
    const ImageRgba8 hybrid = stage.draw(Mode::hybrid, camera);
    const DrawnFrame frame = stage.player.draw(Mode::hybrid, camera);
    EXPECT_EQ(count_uncovered(original, hybrid), 0) << k;
    EXPECT_EQ(count_uncovered(hybrid, original), 0) << k;
    EXPECT_GT(count_alpha(hybrid, 254) + count_alpha(hybrid, 255), 200u) << k;
    n_drawn += frame.n_triangles, n_originals += n_frustum;
  }
  EXPECT_LT(2 * n_drawn, n_originals);
}

// Two points on a line of sight of the view, as far apart as the tolerance allows, are seen from
// the eye within a texel of each other; where they are farther apart the least tolerance rules.
TEST(DepthTolerance, IsATexelOfParallax) {
  Random random(35);
  HybridOptions options;
  int n_by_shift = 0;
  for (int k = 0; k < 400; ++k) {
    ViewProjection view;
    view.eye = {random.uniform(-80, 80), random.uniform(-80, 80), random.uniform(-3, 3)};
    view.focal_px = static_cast<float>(random.uniform(400, 2000));
    const glm::vec3 eye(random.uniform(-40, 40), random.uniform(-40, 40), random.uniform(-3, 3));
    const float angle = static_cast<float>(random.uniform(0, 6.28)), distance = 600;
    const glm::vec3 along(std::cos(angle), std::sin(angle), 0);
    const float size = static_cast<float>(random.uniform(5, 40));  // of the object, in depth
    view.code_scale = 1 / (1 / (distance - size) - 1 / (distance + size));
    const glm::vec3 middle = view.eye + distance * along;
    options.shift_px = random.below(2) == 0 ? 1.0f : 3.0f;
    const float tolerance = depth_tolerance(view, eye, middle, options);
    EXPECT_GE(tolerance, options.depth_tolerance);
    if (tolerance == options.depth_tolerance) continue;
    ++n_by_shift;
    const float depth = 1 / (1 / distance + tolerance / view.code_scale);
    const glm::dvec3 a = glm::normalize(glm::dvec3(middle - eye));
    const glm::dvec3 b = glm::normalize(glm::dvec3(view.eye + depth * along - eye));
    const double shift_px = view.focal_px * glm::length(glm::cross(a, b));
    EXPECT_NEAR(shift_px, options.shift_px, 0.2 * options.shift_px) << k;
  }
  EXPECT_GT(n_by_shift, 100);
}

TEST(HybridFrame, DrawsFewerTriangles) {
  Stage stage;
  Random random(32);
  std::size_t n_hybrid = 0, n_frustum = 0;
  for (int k = 0; k < 10; ++k) {
    const Camera camera = stage.random_camera(random);
    n_frustum += stage.player.draw(Mode::frustum, camera).n_triangles;
    n_hybrid += stage.player.draw(Mode::hybrid, camera).n_triangles;
  }
  EXPECT_LT(2 * n_hybrid, n_frustum);
}

// Whatever was drawn before, and by a player of its own.
TEST(HybridFrame, SameBytesWhenDrawnAgain) {
  Random random(33);
  std::vector<Camera> cameras;
  std::vector<ImageRgba8> first;
  for (int pass = 0; pass < 2; ++pass) {
    Stage stage;  // one at a time: a context is current only until the next is made
    for (int k = 0; k < 8 && pass == 0; ++k) {
      cameras.push_back(stage.random_camera(random));
      first.push_back(stage.draw(Mode::hybrid, cameras.back()));
    }
    for (std::size_t k = 8; k-- > 0;)
      EXPECT_TRUE(stage.draw(Mode::hybrid, cameras[k]).pixels == first[k].pixels) << k;
  }
}

// At the centre of a cell each pixel is fetched from where it was captured: nearly the original.
TEST(HybridFrame, AtACentreTheCaptureComesBack) {
  Stage stage;
  const CellSet& cells = stage.bundle.cells();
  for (const CellId cell : shared_bake().list) {
    Camera camera;
    camera.eye = eye_of(cells, cell);
    for (const SceneObject& object : stage.bundle.scene().objects) {
      const glm::dvec3 to = object.translation - camera.eye;
      if (glm::length(to) < 60) continue;
      camera.forward = glm::normalize(to);
      const ImageRgba8 original = stage.draw(Mode::frustum, camera);
      const ImageRgba8 hybrid = stage.draw(Mode::hybrid, camera);
      EXPECT_GT(compare_images(original, hybrid, {false}).psnr_covered_db, 26) << int(cell);
    }
  }
}

TEST(HybridFrame, KindsAndWireframesDrawTheSamePixels) {
  Stage stage;
  Random random(34);
  for (int k = 0; k < 5; ++k) {
    const Camera camera = stage.random_camera(random);
    const ImageRgba8 hybrid = stage.draw(Mode::hybrid, camera);
    const ImageRgba8 kinds = stage.player.draw_kinds(camera, HybridStyle::kinds);
    const ImageRgba8 wires = stage.player.draw_kinds(camera, HybridStyle::wireframe);
    std::size_t n_dark = 0, n_differ = 0;
    for (std::size_t i = 0; i < hybrid.pixels.size(); ++i) {
      ASSERT_EQ(hybrid.pixels[i][3] == 0, kinds.pixels[i][3] == 0);
      n_differ += hybrid.pixels[i] != kinds.pixels[i];
      n_dark += kinds.pixels[i] != wires.pixels[i];
    }
    EXPECT_GT(n_differ, 100u);
    EXPECT_GT(n_dark, 20u);
  }
  // State is left as it was found.
  const Camera camera = stage.random_camera(random);
  const ImageRgba8 before = stage.draw(Mode::frustum, camera);
  stage.player.draw_kinds(camera, HybridStyle::wireframe);
  EXPECT_EQ(stage.draw(Mode::frustum, camera).pixels, before.pixels);
}

// Mean dB over covered pixels, of the same cameras, of the bake with another start level.
double mean_covered_db(double start_error_px) {
  const SmallBake& small = shared_bake();
  const TemporaryFolder folder;
  BakeOptions options = small.options;
  options.start_error_px = start_error_px;
  PackInputs inputs = small.inputs;
  inputs.svmesh = folder.path() / "svmesh", inputs.mvmesh = folder.path() / "mvmesh";
  make_folder(inputs.svmesh), make_folder(inputs.mvmesh);
  small.derive(Representation::single_view, inputs.svmesh, options);
  small.derive(Representation::multi_view, inputs.mvmesh, options);
  small.pack(folder.path() / "bundle", inputs, small.list);
  Stage stage(folder.path() / "bundle");
  Random random(36);
  double sum = 0;
  int n = 0;
  while (n < 40) {
    const Camera camera = stage.random_camera(random);
    const ImageRgba8 original = stage.draw(Mode::frustum, camera);
    const ImageDistance d = compare_images(original, stage.draw(Mode::hybrid, camera), {false});
    if (d.mse > 0) sum += d.psnr_covered_db, ++n;  // else all that shows is inside the cell
  }
  return sum / n;
}

TEST(HybridFrame, StartLevelsCostATenthOfADecibelAtMost) {
  const double from_originals = mean_covered_db(0);
  EXPECT_GT(mean_covered_db(BakeOptions{}.start_error_px), from_originals - 0.1);
  EXPECT_LT(mean_covered_db(1), from_originals - 0.3);  // coarse levels do cost
}

// Own centres' texels black, all others' white: a pixel's grey says how much of it each view made.
TEST(HybridFrame, ViewsAreMixedByTheirWeights) {
  const BundleCopy copy;
  const CellSet& cells = shared_bake().cells;
  const CellId cell = shared_bake().list.at(shared_bake().list.size() / 2);
  const auto centres = views_of(cells.grid, cell);
  {
    const Bundle bundle(shared_bundle());
    for (const CentreId centre : bundle.manifest().centres) {
      CentreTextures textures = bundle.read_centre(centre);
      const auto grey = static_cast<std::uint8_t>(centre == centres[0] ? 0 : 200);
      for (Rgba8& texel : textures.texels) texel = {grey, grey, grey, texel[3]};
      copy.write(centre, textures);
    }
  }
  Stage stage(copy.path());
  const ReadyCell ready =
      make_ready_cell(stage.bundle.scene(), cells, cell, stage.bundle.read_cell(cell));
  std::array<glm::dvec3, kViews> eyes;
  for (std::size_t k = 0; k < kViews; ++k) eyes[k] = eye_of(cells, centres[k]);
  int n_mixed = 0;
  for (const ReadyObject& object : ready.objects)
    for (const double step : {0.1, 0.2, 0.3, 0.4}) {
      if (object.kind != Representation::multi_view || object.n_indices == 0) continue;
      const glm::dvec3 middle = 0.5 * (glm::dvec3(object.lo) + glm::dvec3(object.hi));
      Camera camera;
      // Across the line of sight, towards the centre that is most aside.
      const glm::dvec3 aside = glm::normalize(glm::cross(middle - eyes[0], glm::dvec3(0, 0, 1)));
      std::size_t most = 1;
      for (std::size_t k = 2; k < kViews; ++k)
        if (glm::dot(eyes[k] - eyes[0], aside) > glm::dot(eyes[most] - eyes[0], aside)) most = k;
      camera.eye = glm::mix(eyes[0], eyes[most], step);
      camera.forward = glm::normalize(middle - camera.eye);
      const ViewChoice choice = choose_views(camera.eye, middle, eyes, 0x7f);
      if (choice.view[0] != 0 && choice.view[1] != 0) continue;
      const double others = choice.view[0] == 0 ? choice.weight[1] : choice.weight[0];
      const ImageRgba8 picture = stage.draw(Mode::hybrid, camera);
      int n_textured = 0, n_as_weighted = 0;  // a view may not show a pixel
      for (int y = kSize / 2 - 12; y < kSize / 2 + 12; ++y)
        for (int x = kSize / 2 - 12; x < kSize / 2 + 12; ++x)
          if (picture.at(x, y)[3] == 255) {
            ++n_textured;
            n_as_weighted += std::abs(picture.at(x, y)[1] - 200 * others) < 8;
          }
      if (n_textured < 200) continue;
      EXPECT_GT(n_as_weighted, 0.4 * n_textured) << step;
      n_mixed += others > 0.1 && others < 0.4;
    }
  EXPECT_GT(n_mixed, 0);
}

}  // namespace
}  // namespace viewcell
