#include "play/residency.h"

#include <gtest/gtest.h>

#include <chrono>

#include "bake/bundle_copy.h"
#include "common/expect_input_error.h"
#include "draw/gl_fixture.h"

namespace viewcell {
namespace {

Camera camera_at(const CellSet& cells, CellId cell) {
  Camera camera;
  camera.eye = eye_of(cells, cell);
  return camera;
}

std::size_t count_texels(const Bundle& bundle, CellId cell) {
  std::size_t n = 0;
  for (const CentreId centre : views_of(bundle.cells().grid, cell))
    if (bundle.has(centre)) n += bundle.read_centre(centre).texels.size();
  return n;
}

const ResidencyOptions kOnDemand{.pool_texels = 8u << 20, .prefetch = false};

TEST(Residency, EnteredCellsAreWhole) {
  const Bundle bundle(shared_bundle());
  Residency residency(shared_context().gl(), bundle, kOnDemand);
  for (const CellId cell : shared_bake().list) {
    const ResidentCell& entered = residency.enter(camera_at(bundle.cells(), cell));
    EXPECT_EQ(entered.ready->cell, cell);
    ASSERT_EQ(entered.views.size(), entered.ready->objects.size());
    ASSERT_EQ(entered.projections.size(), kViews * entered.views.size());
    for (std::size_t slot = 0; slot < entered.views.size(); ++slot) {
      if (entered.ready->objects[slot].kind == Representation::single_view) {
        EXPECT_TRUE(entered.views[slot] & 1);
      }
      for (std::size_t k = 0; k < kViews; ++k)
        EXPECT_EQ(entered.projections[slot * kViews + k].width_px > 0,
                  (entered.views[slot] >> k & 1) != 0);
    }
  }
  EXPECT_EQ(residency.n_stalls(), shared_bake().list.size());
  check_gl(shared_context().gl(), "residency");
}

// s / q and t / q are the texels of the crop that the tile's own view projects the point to; the
// code is that of its depth.
TEST(Residency, ProjectionsAreTheViews) {
  const Bundle bundle(shared_bundle());
  Residency residency(shared_context().gl(), bundle, kOnDemand);
  const CellId cell{4};
  const ResidentCell& entered = residency.enter(camera_at(bundle.cells(), cell));
  const auto views = views_of(bundle.cells().grid, cell);
  int n_tested = 0;
  for (std::size_t k = 0; k < views.size(); ++k) {
    const CentreTextures textures = bundle.read_centre(views[k]);
    for (std::size_t slot = 0; slot < entered.views.size(); ++slot) {
      const ReadyObject& o = entered.ready->objects[slot];
      const auto tile =
          std::find_if(textures.tiles.begin(), textures.tiles.end(),
                       [&](const BundleTile& t) { return ObjectId(t.object) == o.object; });
      ASSERT_EQ(tile != textures.tiles.end(), (entered.views[slot] >> k & 1) != 0);
      if (tile == textures.tiles.end()) continue;
      CaptureView view;
      for (int c = 0; c < 3; ++c) {
        view.eye[c] = tile->eye[c], view.right[c] = tile->right[c];
        view.up[c] = tile->up[c], view.forward[c] = tile->forward[c];
      }
      view.focal_px = tile->focal_px, view.source_px = tile->source_px;
      const ViewProjection& p = entered.projections[slot * kViews + k];
      for (std::uint32_t i = 0; i < o.n_indices; i += 17) {
        const glm::vec3 local =
            entered.ready->vertices[entered.ready->indices[o.first_index + i]].position;
        const glm::dvec3 expected = view.project(entered.ready->origin + glm::dvec3(local));
        const glm::vec4 at(local, 1);
        const double q = glm::dot(p.row_q, at);
        ASSERT_NEAR(q, expected.z, 1e-4 * expected.z);
        ASSERT_NEAR(glm::dot(p.row_s, at) / q, expected.x - tile->x, 0.01);
        ASSERT_NEAR(glm::dot(p.row_t, at) / q, expected.y - tile->y, 0.01);
        const double code = (tile->code_scale / expected.z + tile->code_bias) / 255;
        ASSERT_NEAR(static_cast<double>(p.code_scale) / q + static_cast<double>(p.code_bias), code,
                    2e-3);
        ++n_tested;
      }
    }
  }
  EXPECT_GT(n_tested, 100);
}

TEST(Residency, CellsThatAreNotThereAreRefused) {
  const SmallBake& small = shared_bake();
  const TemporaryFolder folder;
  small.pack(folder.path() / "bundle", small.inputs, {CellId(4)});
  const Bundle bundle(folder.path() / "bundle");
  Residency residency(shared_context().gl(), bundle, {8u << 20});
  EXPECT_EQ(residency.enter(camera_at(bundle.cells(), CellId(4))).ready->cell, CellId(4));
  EXPECT_INPUT_ERROR(residency.enter(camera_at(bundle.cells(), CellId(5))), "cell 5");
  Camera away;
  away.eye = {-500, 0, 18};
  EXPECT_INPUT_ERROR(residency.enter(away), "leaves the grid");
  EXPECT_EQ(residency.enter(camera_at(bundle.cells(), CellId(4))).ready->cell, CellId(4));
}

TEST(Residency, APoolTooSmallForOneCellIsTheMachinesFault) {
  const Bundle bundle(shared_bundle());
  const auto n = static_cast<std::uint32_t>(count_texels(bundle, CellId(4)));
  for (const bool prefetch : {false, true}) {
    ResidencyOptions options;
    options.pool_texels = n - 1, options.prefetch = prefetch;
    Residency small(shared_context().gl(), bundle, options);
    EXPECT_THROW(small.enter(camera_at(bundle.cells(), CellId(4))), MachineError);
    options.pool_texels = n;
    Residency enough(shared_context().gl(), bundle, options);
    EXPECT_EQ(enough.enter(camera_at(bundle.cells(), CellId(4))).ready->cell, CellId(4));
    EXPECT_EQ(enough.texture_bytes(), 4 * std::size_t{n});
  }
}

// Neighbours come while the eye dwells; then crossing the border waits for nothing.
TEST(Residency, WalkingSlowlyStallsOnce) {
  const Bundle bundle(shared_bundle());
  Residency residency(shared_context().gl(), bundle, {16u << 20});
  const CellSet& cells = bundle.cells();
  const glm::dvec3 from = camera_at(cells, CellId(4)).eye;
  const CellId to = *cell_at(cells.grid, neighbour(coord_of(cells.grid, CellId(4)), 0));
  std::set<CellId> entered;
  for (int k = 0; k <= 60; ++k) {
    Camera camera;
    camera.eye = glm::mix(from, camera_at(cells, to).eye, k / 60.0);
    entered.insert(residency.enter(camera).ready->cell);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_EQ(entered.size(), 2u);
  EXPECT_EQ(residency.n_stalls(), 1u);
}

TEST(Loader, ReadsIntoWhatIsTakenBack) {
  const Bundle bundle(shared_bundle());
  Loader loader(bundle);
  for (int round = 0; round < 2; ++round)
    for (const CentreId centre : bundle.manifest().centres) {
      Loaded loaded = loader.read(centre);
      EXPECT_EQ(loaded.textures.texels, bundle.read_centre(centre).texels);
      const Rgba8* memory = loaded.textures.texels.data();
      loaded.textures.texels.resize(1);
      loader.recycle(std::move(loaded.textures.texels));
      loaded = loader.read(centre);  // as long as before: it fits
      EXPECT_EQ(loaded.textures.texels.data(), memory);
      loader.recycle(std::move(loaded.textures.texels));
    }
}

// A file at fault is a fault of its cell or centre, named once, and only when it is needed.
TEST(Residency, DamagedFilesAreFaultsOfTheirCells) {
  const BundleCopy copy;
  const CellId damaged{4};
  const CellSet& cells = shared_bake().cells;
  put_bytes(copy.file(cell_name(damaged)), "damage");
  const CentreId centre = views_of(cells.grid, CellId(2))[0];
  std::filesystem::remove(copy.file(centre_name(centre)));
  for (const bool prefetch : {false, true}) {
    const Bundle bundle(copy.path());
    Residency residency(shared_context().gl(), bundle,
                        {.pool_texels = 8u << 20, .prefetch = prefetch});
    EXPECT_TRUE(residency.faults().empty());
    for (int round = 0; round < 3; ++round) {
      const ResidentCell& cell = residency.enter(camera_at(cells, damaged));
      EXPECT_EQ(cell.stand_in, StandIn::damaged_cell);
      EXPECT_EQ(cell.ready, nullptr);
      const ResidentCell& other = residency.enter(camera_at(cells, CellId(2)));
      EXPECT_EQ(other.stand_in, StandIn::damaged_textures);
      ASSERT_NE(other.ready, nullptr);
      for (const std::uint8_t views : other.views) EXPECT_EQ(views & 1, 0);  // none of that centre
    }
    ASSERT_EQ(residency.faults().size(), 2u);
    EXPECT_EQ(residency.faults()[0].stand_in, StandIn::damaged_cell);
    EXPECT_NE(residency.faults()[0].what.find("cell-00004.geo: "), std::string::npos);
    EXPECT_EQ(residency.faults()[1].stand_in, StandIn::damaged_textures);
    EXPECT_NE(residency.faults()[1].what.find("centre-"), std::string::npos);
  }
}

// A centre that shows nothing takes no room, and leaves that of others alone.
TEST(Residency, CentresWithoutTexelsAreWhole) {
  const BundleCopy copy;
  const CellSet& cells = shared_bake().cells;
  for (const CentreId centre : views_of(cells.grid, CellId(4)))
    copy.write(centre, CentreTextures{});
  const Bundle bundle(copy.path());
  Residency residency(shared_context().gl(), bundle, kOnDemand);
  for (const int id : {0, 4, 8, 4, 0}) {
    const ResidentCell& cell = residency.enter(camera_at(cells, CellId(id)));
    EXPECT_EQ(cell.stand_in, StandIn::none);
    for (const std::uint8_t views : cell.views) EXPECT_EQ(id == 4 ? views : 0, 0);
  }
}

// Walking to and fro with room for one cell and a little more must end in whole cells still.
TEST(Residency, EvictsInsteadOfFailing) {
  const Bundle bundle(shared_bundle());
  std::size_t most = 0;
  for (const CellId cell : shared_bake().list) most = std::max(most, count_texels(bundle, cell));
  ResidencyOptions options;
  options.pool_texels = static_cast<std::uint32_t>(2 * most);
  options.prefetch = false;
  options.n_cells = 2;
  Residency residency(shared_context().gl(), bundle, options);
  Random random(2);
  for (int k = 0; k < 40; ++k) {
    const CellId cell =
        shared_bake().list[random.below(static_cast<std::uint32_t>(shared_bake().list.size()))];
    ASSERT_EQ(residency.enter(camera_at(bundle.cells(), cell)).ready->cell, cell);
    ASSERT_LE(residency.texture_bytes(), 4 * std::size_t{options.pool_texels});
  }
}

}  // namespace
}  // namespace viewcell
