#include "bake/weighted_mesh_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "bake/small_bake.h"
#include "common/expect_input_error.h"
#include "common/mutate.h"

namespace viewcell {
namespace {

CellMesh make_mesh(int object, std::uint32_t n_vertices, std::uint32_t n_triangles) {
  Random random(static_cast<std::uint64_t>(object) + 1);
  CellMesh mesh;
  mesh.object = ObjectId(object);
  for (std::uint32_t v = 0; v < n_vertices; ++v) {
    mesh.vertices.positions.emplace_back(random.uniform(-1e3, 1e3), random.uniform(), 1e-20f);
    mesh.vertices.normals.emplace_back(0.6f, 0, -0.8f);
    mesh.vertices.weights.push_back(0.125f * static_cast<float>(1 + v % 4));
    mesh.vertices.views.push_back(static_cast<std::uint8_t>(random.below(128)));
    mesh.source_vertex.push_back(random.below(900));
  }
  // Fans that use every vertex, as all meshes that are written do.
  for (std::uint32_t t = 0; t < n_triangles; ++t) {
    mesh.triangles.push_back({0, t + 1, t + 2});
    mesh.views.push_back(static_cast<std::uint8_t>(random.below(128)));
  }
  return mesh;
}

// Objects 1 and 3 have faces, 0 and 4 none; the scene has five.
WeightedMeshes make_meshes() {
  WeightedMeshes out{Representation::multi_view, CellId(12), "00112233", "8899aabb", {}};
  out.meshes = {make_mesh(0, 0, 0), make_mesh(1, 7, 5), make_mesh(3, 4, 2), make_mesh(4, 0, 0)};
  return out;
}

void expect_same(const WeightedMeshes& a, const WeightedMeshes& b) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.cell, b.cell);
  EXPECT_EQ(a.captures, b.captures);
  EXPECT_EQ(a.made_from, b.made_from);
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  for (std::size_t m = 0; m < a.meshes.size(); ++m) {
    EXPECT_EQ(a.meshes[m].object, b.meshes[m].object);
    EXPECT_EQ(a.meshes[m].vertices.positions, b.meshes[m].vertices.positions);
    EXPECT_EQ(a.meshes[m].vertices.normals, b.meshes[m].vertices.normals);
    EXPECT_EQ(a.meshes[m].vertices.weights, b.meshes[m].vertices.weights);
    EXPECT_EQ(a.meshes[m].vertices.views, b.meshes[m].vertices.views);
    EXPECT_EQ(a.meshes[m].source_vertex, b.meshes[m].source_vertex);
    EXPECT_EQ(a.meshes[m].triangles, b.meshes[m].triangles);
    EXPECT_EQ(a.meshes[m].views, b.meshes[m].views);
  }
}

struct Folder {
  TemporaryFolder folder;
  Scene scene = make_bake_scene();
  std::filesystem::path file = folder.path() / "cell-00012.ply";
  WeightedMeshes write_and_read(const WeightedMeshes& meshes) const {
    write_weighted_meshes(file, meshes, "test");
    return read_weighted_meshes(file, scene);
  }
};

TEST(WeightedMeshFile, ReadsBackWhatWasWritten) {
  const Folder f;
  EXPECT_EQ(weighted_mesh_name(CellId(12)), "cell-00012.ply");
  WeightedMeshes meshes = make_meshes();
  expect_same(f.write_and_read(meshes), meshes);
  EXPECT_TRUE(is_derived(f.file, meshes.kind, meshes.cell, "8899aabb"));
  EXPECT_FALSE(is_derived(f.file, meshes.kind, meshes.cell, "8899aabc"));
  meshes.kind = Representation::single_view;
  expect_same(f.write_and_read(meshes), meshes);
  meshes.meshes.clear();
  expect_same(f.write_and_read(meshes), meshes);
  meshes.meshes = {make_mesh(2, 0, 0)};
  expect_same(f.write_and_read(meshes), meshes);
}

TEST(WeightedMeshFile, ReadsBackWhatWasDerived) {
  const SmallBake& small = shared_bake();
  for (const CellId cell : small.list) {
    DeriveCounts counts;
    WeightedMeshes made = derive_cell(small.bake, small.inputs.captures, small.settings, cell,
                                      Representation::multi_view, small.options, counts);
    made.made_from = "0123456789abcdef";
    expect_same(read_weighted_meshes(small.inputs.mvmesh / weighted_mesh_name(cell), small.scene),
                made);
    EXPECT_EQ(counts.n_meshes, made.meshes.size());
  }
}

TEST(WeightedMeshFile, ForeignIndicesAreRefused) {
  const Folder f;
  const auto refused = [&](const auto& change, const char* message) {
    WeightedMeshes meshes = make_meshes();
    change(meshes.meshes[1]);
    EXPECT_INPUT_ERROR(f.write_and_read(meshes), message);
  };
  const std::size_t n = f.scene.meshes[1].mesh.positions.size();
  refused([&](CellMesh& m) { m.source_vertex[3] = static_cast<std::uint32_t>(n); },
          "source_vertex");
  refused([](CellMesh& m) { m.source_vertex[6] = ~0u; }, "source_vertex");
  refused([](CellMesh& m) { m.object = ObjectId(5); }, "");
  refused([](CellMesh& m) { m.object = ObjectId(-1); }, "");
  refused([](CellMesh& m) { m.object = ObjectId(3); }, "");       // twice
  refused([](CellMesh& m) { m.object = ObjectId(4); }, "");       // out of order
  refused([](CellMesh& m) { m.triangles[4] = {0, 1, 11}; }, "");  // past the last vertex
  refused([](CellMesh& m) { m.triangles[4] = {0, 1, 9}; }, "another object");
  refused([](CellMesh& m) { m.views[0] = 0x80; }, "");
  refused([](CellMesh& m) { m.vertices.views[0] = 0x80; }, "");
}

TEST(WeightedMeshFile, TheListOfObjectsMustFitTheFaces) {
  const Folder f;
  write_weighted_meshes(f.file, make_meshes(), "test");
  const std::string bytes = read_file(f.file);
  const auto with = [&](const std::string& list) {
    std::string changed = bytes;
    const std::string old = "objects 0 1 3 4";
    changed.replace(changed.find(old), old.size(), list);
    return f.folder.add("changed.ply", changed);
  };
  EXPECT_EQ(read_weighted_meshes(with("objects 1 3"), f.scene).meshes.size(), 2u);
  for (const char* list : {"objects 0 3 4", "objects 0 1 1 3", "objects 4 3 1 0", "objects",
                           "objects 0 1 3 5", "objects -1 1 3", "object 0 1 3 4"})
    EXPECT_INPUT_ERROR(read_weighted_meshes(with(list), f.scene), "");
}

TEST(WeightedMeshFile, TheHeaderSaysAKindAndACell) {
  const Folder f;
  write_weighted_meshes(f.file, make_meshes(), "test");
  const std::string bytes = read_file(f.file);
  const auto changed = [&](const std::string& from, const std::string& to) {
    return f.folder.add("changed.ply", replaced(bytes, from, to));
  };
  for (const char* kind : {"mvmeshes", "Mvmesh", "svmesh mvmesh", ""}) {
    const auto file = changed("kind mvmesh", std::string("kind ") + kind);
    EXPECT_INPUT_ERROR(read_weighted_meshes(file, f.scene),
                       "changed.ply: header: its comment 'kind' says '" + std::string(kind) + "'");
    EXPECT_FALSE(is_derived(file, Representation::multi_view, CellId(12), "8899aabb")) << kind;
  }
  for (const char* cell : {"-12", "12a", "a", "", "1 2", "99999999999", "0x12", "+12"})
    EXPECT_INPUT_ERROR(
        read_weighted_meshes(changed("cell 12", std::string("cell ") + cell), f.scene),
        "changed.ply: header: its comment 'cell' says '" + std::string(cell) + "'");
}

// Neither is another's file read for the one asked for, nor is it written over.
TEST(WeightedMeshFile, OtherKindsAndCellsAreRefusedByName) {
  const Folder f;
  write_weighted_meshes(f.file, make_meshes(), "test");
  const auto kind = Representation::multi_view, other_kind = Representation::single_view;
  expect_same(read_weighted_meshes(f.file, f.scene, kind, CellId(12)), make_meshes());
  const char* kind_message =
      "cell-00012.ply: header: is of the other kind: its comment 'kind' says "
      "mvmesh, not svmesh";
  const char* cell_message =
      "cell-00012.ply: header: is of another cell: its comment 'cell' says "
      "12, not 13";
  EXPECT_INPUT_ERROR(read_weighted_meshes(f.file, f.scene, other_kind, CellId(12)), kind_message);
  EXPECT_INPUT_ERROR(read_weighted_meshes(f.file, f.scene, kind, CellId(13)), cell_message);
  for (const char* made_from : {"8899aabb", ""}) {
    EXPECT_INPUT_ERROR(is_derived(f.file, other_kind, CellId(12), made_from), kind_message);
    EXPECT_INPUT_ERROR(is_derived(f.file, kind, CellId(13), made_from), cell_message);
  }
}

TEST(WeightedMeshFile, DamagedFilesAreRefusedOrSound) {
  const Folder f;
  write_weighted_meshes(f.file, make_meshes(), "test");
  const std::string bytes = read_file(f.file);
  const auto file = f.folder.path() / "damaged.ply";
  const auto read = [&](const std::string& damaged) {
    std::filesystem::remove(file);  // some file systems flush one that is cut and rewritten
    std::ofstream(file, std::ios::binary) << damaged;
    const WeightedMeshes meshes = read_weighted_meshes(file, f.scene);
    for (const CellMesh& mesh : meshes.meshes) {
      ASSERT_LT(index(mesh.object), f.scene.objects.size());
      for (const Triangle& t : mesh.triangles)
        for (const std::uint32_t v : t) ASSERT_LT(v, mesh.source_vertex.size());
      for (const std::uint32_t v : mesh.source_vertex)
        ASSERT_LT(v, f.scene.mesh_of(f.scene.objects[index(mesh.object)]).mesh.positions.size());
    }
  };
  read_damaged_copies(bytes, 2000, 7, read);
  for (std::size_t n = 0; n < bytes.size(); n += 7)
    EXPECT_INPUT_ERROR(read(bytes.substr(0, n)), "");
}

TEST(WeightedMeshFile, MissingAndForeignFilesHaveNoOrigin) {
  const Folder f;
  const auto other = f.folder.add("other.ply", "ply\nformat ascii 1.0\nend_header\n");
  for (const auto& file : {f.file, other})
    EXPECT_FALSE(is_derived(file, Representation::multi_view, CellId(12), "")) << file;
  EXPECT_INPUT_ERROR(read_weighted_meshes(f.folder.path() / "other.ply", f.scene), "weighted");
  EXPECT_INPUT_ERROR(read_weighted_meshes(f.file, f.scene), "");
}

}  // namespace
}  // namespace viewcell
