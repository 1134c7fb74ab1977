#include "pm/pm_file.h"

#include <gtest/gtest.h>

#include <limits>

#include "base/file.h"
#include "common/expect_input_error.h"
#include "common/models.h"
#include "common/temporary_folder.h"
#include "pm/build.h"

namespace viewcell {
namespace {

TriMesh make_far_figure() {
  TriMesh mesh = make_lumpy_figure(8);
  mesh.offset = {500016, 4649776, 208};
  mesh.material_names = {"stone"};
  mesh.materials.assign(mesh.triangles.size(), 0);
  mesh.material_libraries = {"a b.mtl", "/elsewhere/c.mtl"};
  return mesh;
}

TEST(PmFile, KeepsTheOffsetAndTheLibraries) {
  const TemporaryFolder folder;
  const TriMesh mesh = make_far_figure();
  for (const MetricKind metric : {MetricKind::qem3, MetricKind::lt}) {
    BuildOptions options;
    options.metric = metric;
    if (metric == MetricKind::lt) options.placement = Placement::full;
    write_pm(folder.path() / "a.pm", build_progressive_mesh(mesh, options).record);
    ProgressiveMesh levels(read_pm(folder.path() / "a.pm"));
    for (const std::size_t n : {std::size_t{50}, mesh.triangles.size()}) {
      levels.set_faces(n);
      const TriMesh level = levels.extract();
      EXPECT_EQ(level.offset, mesh.offset);
      EXPECT_EQ(level.material_libraries, mesh.material_libraries);
      if (n == mesh.triangles.size()) {
        EXPECT_EQ(level.positions, mesh.positions);
      }
    }
  }
}

TEST(PmFile, KeepsOffsetsAsFarAsFloatsReach) {
  const TemporaryFolder folder;
  TriMesh mesh = make_far_figure();
  mesh.offset = {0x1p128, -0x1p128, 1e30};
  write_pm(folder / "a.pm", build_progressive_mesh(mesh, {}).record);
  EXPECT_EQ(read_pm(folder / "a.pm").attributes.offset, mesh.offset);
  mesh.offset.x = 0x1p129;
  write_pm(folder / "a.pm", build_progressive_mesh(mesh, {}).record);
  EXPECT_INPUT_ERROR(read_pm(folder / "a.pm"), "offset[0]");
}

// Those near the origin have the same bytes as ever: nothing says that there is no offset.
TEST(PmFile, SaysNothingOfNoOffset) {
  const TemporaryFolder folder;
  write_pm(folder.path() / "a.pm", build_progressive_mesh(make_lumpy_figure(8), {}).record);
  const std::string bytes = read_file(folder.path() / "a.pm");
  EXPECT_EQ(bytes.find("offset"), std::string::npos);
  EXPECT_EQ(bytes.find("libraries"), std::string::npos);
}

// JSON is UTF-8; names in files need not be.
TEST(PmFile, NamesOfOtherEncodings) {
  const TemporaryFolder folder;
  TriMesh mesh = make_far_figure();
  mesh.material_names = {"gr\xfcn"};
  write_pm(folder.path() / "a.pm", build_progressive_mesh(mesh, {}).record);
  EXPECT_EQ(read_pm(folder.path() / "a.pm").attributes.material_names[0], "gr\xef\xbf\xbdn");
}

// What no mesh has, under hashes that are right.
TEST(PmFile, NumbersThatNoMeshHasAreRefused) {
  const TemporaryFolder folder;
  TriMesh mesh = make_far_figure();
  mesh.normals = make_vertex_normals(mesh);
  mesh.colors.assign(mesh.positions.size(), {0, 0.5f, 1});
  const ProgressiveRecord record = build_progressive_mesh(mesh, {}).record;
  const auto refused = [&](const char* message, const auto& change) {
    ProgressiveRecord changed = record;
    change(changed);
    write_pm(folder / "a.pm", changed);
    EXPECT_INPUT_ERROR(read_pm(folder / "a.pm"), message);
  };
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const float bad : {kNaN, kInfinity, 1e30f, -1e-3f, 1.001f})
    refused("section COLORS: has a colour", [&](auto& r) { r.attributes.colors[3].y = bad; });
  for (const float bad : {kNaN, kInfinity, 1e30f})
    refused("section NORMALS: has a normal", [&](auto& r) { r.attributes.normals[3].y = bad; });
  refused("section NORMALS", [](auto& r) { r.attributes.normals[0] = glm::vec3(0); });
  refused("section NORMALS", [](auto& r) { r.attributes.normals[0] *= 1.01f; });
  refused("section POSITION", [&](auto& r) { r.attributes.positions[3].z = -kInfinity; });
  refused("section SPLITS: has a cost", [&](auto& r) { r.splits[1].cost = kNaN; });
  refused("section SPLITS: has a cost", [&](auto& r) { r.splits[1].error = kNaN; });
  write_pm(folder / "a.pm", record);
  EXPECT_EQ(read_pm(folder / "a.pm").attributes.colors, mesh.colors);
}

}  // namespace
}  // namespace viewcell
