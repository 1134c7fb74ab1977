#include "bake/pack.h"

#include <gtest/gtest.h>

#include <csignal>
#include <map>

#include <sys/resource.h>

#include "bake/bundle_copy.h"
#include "bundle/bundle_writer.h"
#include "common/expect_input_error.h"
#include "common/same_every_time.h"

namespace viewcell {
namespace {
namespace fs = std::filesystem;

// Hashes of all files of a folder, by their paths; none where it is not there.
std::map<fs::path, std::string> contents_of(const fs::path& folder) {
  std::map<fs::path, std::string> out;
  if (!fs::exists(folder)) return out;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    out[fs::relative(entry.path(), folder)] =
        entry.is_regular_file() ? hash_file(entry.path()) : "folder";
  return out;
}

// The shared bake with meshes of its own, to be changed.
struct MeshesCopy {
  TemporaryFolder folder;
  PackInputs inputs = shared_bake().inputs;
  fs::path bundle = folder.path() / "bundle";
  MeshesCopy() {
    for (fs::path* part : {&inputs.svmesh, &inputs.mvmesh}) {
      fs::copy(*part, folder.path() / part->filename(), fs::copy_options::recursive);
      *part = folder.path() / part->filename();
    }
  }
  PackCounts pack() const { return shared_bake().pack(bundle, inputs, shared_bake().list); }
  // Reads, changes and writes the meshes of a cell; packing must then be refused, and the bundle
  // that was there be as it was.
  template <typename Change>
  void refused(const fs::path& from, const Change& change, const char* message) const {
    const CellId cell = shared_bake().list[4];
    const fs::path file = from / weighted_mesh_name(cell);
    const std::string before = read_file(file);
    WeightedMeshes meshes = read_weighted_meshes(file, shared_bake().scene);
    change(meshes);
    write_weighted_meshes(file, meshes, "test");
    const auto bundle_before = contents_of(bundle);
    EXPECT_INPUT_ERROR(pack(), message);
    EXPECT_EQ(contents_of(bundle), bundle_before);
    write_file(file, before);
  }
};

TEST(Pack, EveryOutsideObjectOnceAndInsideOnesNever) {
  const SmallBake& small = shared_bake();
  const TemporaryFolder folder;
  const PackCounts counts = small.pack(folder.path() / "bundle");
  const Bundle bundle(folder.path() / "bundle");
  EXPECT_EQ(counts.n_cells, small.list.size());
  EXPECT_EQ(bundle.manifest().cells, small.list);
  EXPECT_EQ(bundle.manifest().resolution_px, 256);
  std::size_t n_single = 0, n_triangles = 0, n_texels = 0, n_inside = 0;
  for (const CellId cell : small.list) {
    std::set<int> found;
    for (const BundleObject& o : bundle.read_cell(cell).objects) {
      EXPECT_TRUE(found.insert(o.object).second);
      EXPECT_FALSE(is_inside(small.cells, cell, ObjectId(o.object)));
      n_single += o.kind == static_cast<std::uint32_t>(Representation::single_view);
      n_triangles += o.n_triangles;
    }
    n_inside += small.cells.inside[index(cell)].size();
    EXPECT_EQ(found.size() + small.cells.inside[index(cell)].size(), small.scene.objects.size());
  }
  for (const CentreId centre : bundle.manifest().centres)
    n_texels += bundle.read_centre(centre).texels.size();
  EXPECT_EQ(counts.n_single_view, n_single);
  EXPECT_EQ(counts.n_inside, n_inside);
  EXPECT_EQ(counts.n_single_view + counts.n_multi_view + counts.n_inside, 5 * small.list.size());
  EXPECT_EQ(counts.n_triangles_outside, n_triangles);
  EXPECT_EQ(counts.texel_bytes, 4 * n_texels);
  EXPECT_EQ(counts.n_centres, bundle.manifest().centres.size());
}

// Offsets along the originals' normals give the derived positions back; triangles and their views
// are the same set.
TEST(Pack, GeometryIsTheDerivedMeshes) {
  const SmallBake& small = shared_bake();
  const Bundle bundle(shared_bundle());
  for (const CellId cell : small.list) {
    const CellGeometry g = bundle.read_cell(cell);
    std::vector<CellMesh> meshes;
    for (const fs::path& from : {small.inputs.svmesh, small.inputs.mvmesh})
      for (CellMesh& m : read_weighted_meshes(from / weighted_mesh_name(cell), small.scene).meshes)
        meshes.push_back(std::move(m));
    ASSERT_EQ(meshes.size(), g.objects.size());
    std::size_t v = 0, t = 0;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      const CellMesh& mesh = meshes[m];
      const BundleObject& o = g.objects[m];
      const SceneObject& object = small.scene.objects[static_cast<std::size_t>(o.object)];
      const TriMesh& original = small.scene.mesh_of(object).mesh;
      ASSERT_EQ(mesh.object, ObjectId(o.object));
      ASSERT_EQ(mesh.source_vertex.size(), o.n_vertices);
      ASSERT_EQ(mesh.triangles.size(), o.n_triangles);
      std::map<std::uint32_t, glm::dvec3> position_of;
      for (std::size_t i = 0; i < o.n_vertices; ++i)
        position_of[mesh.source_vertex[i]] = mesh.vertices.positions[i];
      for (std::size_t i = 0; i < o.n_vertices; ++i) {
        const std::uint32_t source = g.source_vertices[v + i];
        const glm::dvec3 n = object.rotation * glm::dvec3(original.normals[source]);
        const glm::dvec3 p = object.world_from_model(glm::dvec3(original.positions[source])) +
                             kOffsetUnit * g.offsets[v + i] * n;
        ASSERT_LT(glm::distance(p, position_of.at(source)), kOffsetUnit);
        for (int k = 0; k < 3; ++k) {
          ASSERT_GE(position_of.at(source)[k], static_cast<double>(o.lo[k]));
          ASSERT_LE(position_of.at(source)[k], static_cast<double>(o.hi[k]));
        }
      }
      // By original vertices, the least first: turning a triangle keeps its winding.
      using Face = std::pair<Triangle, std::uint8_t>;
      const auto face = [](Triangle f, std::uint8_t views) {
        std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
        return Face{f, views};
      };
      std::multiset<Face> packed, derived;
      for (std::size_t i = 0; i < o.n_triangles; ++i) {
        Triangle a{}, b{};
        for (std::size_t k = 0; k < 3; ++k) {
          a[k] = g.source_vertices[v + g.indices[3 * (t + i) + k]];
          b[k] = mesh.source_vertex[mesh.triangles[i][k]];
        }
        packed.insert(face(a, g.views[t + i]));
        derived.insert(face(b, mesh.views[i]));
      }
      ASSERT_EQ(packed, derived);
      v += o.n_vertices, t += o.n_triangles;
    }
  }
}

// A single view is the cell's own centre; several are whatever its seven centres hold.
TEST(Pack, EveryCentreHoldsTheTilesThatItsCellsNeed) {
  const SmallBake& small = shared_bake();
  const Bundle bundle(shared_bundle());
  for (const CellId cell : small.list) {
    const auto views = views_of(small.cells.grid, cell);
    for (const BundleObject& o : bundle.read_cell(cell).objects)
      for (std::size_t k = 0; k < (o.kind == 1 ? 1u : views.size()); ++k) {
        ASSERT_TRUE(bundle.has(views[k]));
        CentreCaptures captures(capture_file_of(small.inputs.captures, views[k]), small.settings);
        const CentreTextures textures = bundle.read_centre(views[k]);
        const auto has = std::any_of(textures.tiles.begin(), textures.tiles.end(),
                                     [&](const BundleTile& t) { return t.object == o.object; });
        EXPECT_EQ(has, captures.has(ObjectId(o.object)));
      }
  }
}

TEST(Pack, SameBytesForAnyNumberOfThreads) {
  const SmallBake& small = shared_bake();
  const auto hashes = same_for_any_threads([&small](int n_threads) {
    const TemporaryFolder folder;
    pack_bundle(small.scene, small.cells, small.inputs, small.list, TextureFormat::rgba8,
                test_provenance(), folder.path(), n_threads, {});
    return contents_of(folder.path());
  });
  EXPECT_GT(hashes.size(), small.list.size());  // a file a cell, and more
}

TEST(Pack, RefusesMeshesThatDoNotBelongTogether) {
  const MeshesCopy copy;
  EXPECT_GT(copy.pack().n_multi_view, 0u);
  ASSERT_TRUE(fs::exists(copy.bundle / kManifestName));
  const auto drop = [](WeightedMeshes& m) { m.meshes.pop_back(); };
  copy.refused(copy.inputs.mvmesh, drop, "is in 0 of");
  copy.refused(
      copy.inputs.mvmesh, [](auto& m) { m.captures = "0000"; }, "other captures");
  copy.refused(
      copy.inputs.svmesh, [](auto& m) { m.captures = "0000"; }, "other captures");
  copy.refused(
      copy.inputs.mvmesh, [](auto& m) { m.made_from = "0000"; }, "other options");
  copy.refused(
      copy.inputs.svmesh, [](auto& m) { m.made_from = "0000"; }, "other options");
  copy.refused(
      copy.inputs.svmesh, [](auto& m) { m.cell = CellId(3); }, "another cell");
  copy.refused(
      copy.inputs.svmesh, [](auto& m) { m.kind = Representation::multi_view; }, "other kind");
  EXPECT_GT(copy.pack().n_multi_view, 0u);
}

TEST(Pack, RefusesAnObjectTwiceOrInside) {
  const MeshesCopy copy;
  const CellId cell = shared_bake().list[4];
  const auto meshes =
      read_weighted_meshes(copy.inputs.mvmesh / weighted_mesh_name(cell), shared_bake().scene);
  copy.refused(
      copy.inputs.svmesh, [&](WeightedMeshes& m) { m.meshes = {meshes.meshes.at(0)}; }, "is in ");
  ASSERT_FALSE(shared_bake().cells.inside[index(cell)].empty());
  const ObjectId inside = shared_bake().cells.inside[index(cell)][0];
  CellMesh empty;
  empty.object = inside;
  copy.refused(
      copy.inputs.svmesh,
      [&](WeightedMeshes& m) {
        std::erase_if(m.meshes, [&](const CellMesh& mesh) { return mesh.object >= inside; });
        m.meshes.push_back(empty);
      },
      "is in ");
}

TEST(Pack, RefusesAMissingFileOrOtherCells) {
  const MeshesCopy copy;
  PackInputs inputs = copy.inputs;
  inputs.captures = copy.folder.path() / "none";
  EXPECT_INPUT_ERROR(shared_bake().pack(copy.bundle, inputs, shared_bake().list), "none");
  inputs = copy.inputs;
  inputs.cells_file = copy.folder.add("cells.json", "{}");
  EXPECT_INPUT_ERROR(shared_bake().pack(copy.bundle, inputs, shared_bake().list),
                     "cells.json: changed while it was packed");
  EXPECT_FALSE(fs::exists(copy.bundle));
  fs::remove(copy.inputs.mvmesh / weighted_mesh_name(CellId(2)));
  EXPECT_INPUT_ERROR(copy.pack(), "cell-00002.ply: is not there; run mvmesh");
  EXPECT_FALSE(fs::exists(copy.bundle));
  EXPECT_EQ(shared_bake().pack(copy.bundle, copy.inputs, {CellId(4)}).n_cells, 1u);
}

TEST(Pack, ASceneWithoutObjectsIsRefused) {
  const MeshesCopy copy;
  Scene empty = shared_bake().scene;
  empty.objects.clear();
  EXPECT_INPUT_ERROR(pack_bundle(empty, shared_bake().cells, copy.inputs, {CellId(0)},
                                 TextureFormat::rgba8, test_provenance(), copy.bundle, 2, {}),
                     "scene.json: objects: is empty");
  EXPECT_INPUT_ERROR(
      read_weighted_meshes(copy.inputs.svmesh / weighted_mesh_name(CellId(0)), empty),
      "the scene has none");
}

// --- packing into a bundle that is there ---

fs::path only_bake(const fs::path& bundle) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(bundle))
    if (entry.is_directory()) found.push_back(entry.path());
  EXPECT_EQ(found.size(), 1u);
  return found.at(0);
}

TEST(Repack, TheNewBakeReplacesTheOld) {
  const MeshesCopy copy;
  copy.pack();
  const fs::path old = only_bake(copy.bundle);
  const auto before = contents_of(copy.bundle);
  shared_bake().pack(copy.bundle, copy.inputs, {CellId(4)});
  EXPECT_NE(only_bake(copy.bundle), old);
  EXPECT_EQ(Bundle(copy.bundle).manifest().cells, std::vector<CellId>{CellId(4)});
  copy.pack();
  EXPECT_EQ(contents_of(copy.bundle), before);
  // Over itself: what was damaged is whole again.
  put_bytes(old / "cells" / "cell-00001.geo", "damage");
  copy.pack();
  EXPECT_EQ(contents_of(copy.bundle), before);
}

TEST(Repack, AMissingInputLeavesTheOldBundleAsItIs) {
  const MeshesCopy copy;
  copy.pack();
  const auto before = contents_of(copy.bundle);
  const std::vector<CellId> few = {CellId(2), CellId(4)};
  PackInputs inputs = copy.inputs;
  inputs.captures = copy.folder / "captures";
  fs::copy(copy.inputs.captures, inputs.captures, fs::copy_options::recursive);
  for (const fs::path& missing :
       {copy.inputs.svmesh / "cell-00004.ply", copy.inputs.mvmesh / "cell-00002.ply",
        capture_file_of(inputs.captures, views_of(shared_bake().cells.grid, few[0])[0]),
        inputs.captures / kCapturesManifest}) {
    fs::rename(missing, copy.folder / "away");
    EXPECT_INPUT_ERROR(shared_bake().pack(copy.bundle, inputs, few), "is not there");
    EXPECT_INPUT_ERROR(shared_bake().pack(copy.folder / "new", inputs, few),
                       missing.filename().string());
    fs::rename(copy.folder / "away", missing);
    EXPECT_EQ(contents_of(copy.bundle), before);
    EXPECT_FALSE(fs::exists(copy.folder / "new"));
  }
}

// No file may grow beyond a size: the writes fail as on a full disk, wherever it fills up.
TEST(Repack, AFullDiskLeavesTheOldBundleAsItIs) {
  const MeshesCopy copy;
  copy.pack();
  const auto before = contents_of(copy.bundle);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit unlimited{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &unlimited), 0);
  for (const rlim_t most : {0u, 100u, 1000u, 3000u, 20000u}) {
    const rlimit limit{most, unlimited.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
    EXPECT_THROW(shared_bake().pack(copy.bundle, copy.inputs, {CellId(2), CellId(4)}), MachineError)
        << most;
    EXPECT_THROW(shared_bake().pack(copy.folder / "new", copy.inputs, {CellId(4)}), MachineError)
        << most;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &unlimited), 0);
    EXPECT_EQ(contents_of(copy.bundle), before) << most;
    EXPECT_FALSE(fs::exists(copy.folder / "new"));
  }
}

TEST(Repack, WhatAKilledRunLeftGoes) {
  const MeshesCopy copy;
  copy.pack();
  const auto before = contents_of(copy.bundle);
  fs::create_directories(copy.bundle / "bake-0123456789abcdef" / "cells");
  put_bytes(copy.bundle / "bake-0123456789abcdef" / "cells" / "cell-00000.geo", "half of i");
  put_bytes(copy.bundle / ".viewcell-lock", "cellpack 1");
  copy.pack();
  EXPECT_EQ(contents_of(copy.bundle), before);
}

TEST(Repack, APlayersBakeStaysUntilThePlayerIsGone) {
  const MeshesCopy copy;
  copy.pack();
  {
    const Bundle playing(copy.bundle);
    shared_bake().pack(copy.bundle, copy.inputs, {CellId(4)});
    for (const CellId cell : playing.manifest().cells) EXPECT_NO_THROW(playing.read_cell(cell));
    EXPECT_EQ(Bundle(copy.bundle).manifest().cells.size(), 1u);
  }
  shared_bake().pack(copy.bundle, copy.inputs, {CellId(4)});
  EXPECT_TRUE(only_bake(copy.bundle).filename().string().starts_with("bake-"));
}

TEST(Repack, OnePackerAtATime) {
  const MeshesCopy copy;
  copy.pack();
  const BundleWriter writer(copy.bundle, Bundle(copy.bundle).manifest());
  // The lock is of the process: another one is refused.
  EXPECT_EXIT(
      {
        try {
          FolderLock(copy.bundle, "cellpack", "0");
        } catch (const InputError&) {
          ::_exit(9);
        }
      },
      testing::ExitedWithCode(9), "");
}

// Files of a bundle of version 1 lay beside the manifest.
TEST(Repack, FilesOfVersion1Go) {
  const MeshesCopy copy;
  copy.pack();
  const auto before = contents_of(copy.bundle);
  const fs::path bake = only_bake(copy.bundle);
  for (const auto& entry : fs::directory_iterator(bake))
    fs::copy(entry.path(), copy.bundle / entry.path().filename(), fs::copy_options::recursive);
  put_bytes(copy.bundle / "cells" / "notes.txt", "mine");
  put_bytes(copy.bundle / kManifestName, R"({"format": "viewcell-bundle", "version": 1})");
  fs::remove_all(bake);
  copy.pack();
  auto after = contents_of(copy.bundle);
  EXPECT_EQ(after.erase("cells/notes.txt"), 1u);
  EXPECT_EQ(after.erase("cells"), 1u);
  EXPECT_EQ(after, before);
}

}  // namespace
}  // namespace viewcell
