#include "pm/pm_file.h"

#include <gtest/gtest.h>

#include "base/file.h"
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

}  // namespace
}  // namespace viewcell
