// Reads models and holds their counts against what is known of them: of those made by formula, in
// every format, and of the real ones by the table that came with them.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <tuple>

#include "common/models.h"
#include "common/temporary_folder.h"
#include "formats/mesh_bytes.h"
#include "formats/mesh_file.h"
#include "formats/write_glb.h"
#include "mesh/topology.h"

namespace viewcell {
namespace {

struct Expected {
  const char* file;
  std::size_t n_triangles, n_vertices;  // vertices at one position counted once
  std::size_t n_boundary_edges, n_nonmanifold_edges, n_nonmanifold_vertices, n_components;
  std::int64_t euler_characteristic;
  std::size_t n_opposed_edges;
};

constexpr Expected kModels[] = {
    {"dragon-202k/dragon_vrip_res2.ply.gz", 202520, 100207, 0, 2534, 3723, 7, 1520, 0},
    {"dragon-11k/dragon_vrip_res4.ply.gz", 11102, 5203, 0, 803, 978, 1, 509, 0},
    {"bunny-69k/bunny70k.ply", 69451, 34834, 223, 0, 0, 1, -3, 0},
    {"horse-97k/horse.ply", 96966, 48485, 0, 0, 0, 1, 2, 0},
    {"moai-20k/moaimoai.off", 20000, 10002, 0, 0, 0, 1, 2, 0},
    {"venus-1k/venus.off", 1418, 711, 0, 0, 0, 1, 2, 0},
    {"camel-20k/camel.off", 19536, 9770, 0, 0, 0, 1, 2, 0},
    {"bull-12k/bull.off", 12396, 6200, 0, 0, 0, 1, 2, 0},
    {"cow-6k/cow.off", 5804, 2903, 0, 0, 1, 1, 1, 0},
    {"fandisk-13k/fandisk.off", 12946, 6475, 0, 0, 0, 1, 2, 0},
    {"elephant-holes-4k/elephant-with-holes.off", 4463, 2733, 1353, 0, 65, 1, -175, 0},
    {"cat-14k/cat.3ds", 14348, 7340, 330, 0, 0, 3, 1, 0},
    {"horse-7k/horse.3ds", 7172, 3582, 0, 24, 24, 1, 8, 2},
    {"lionstatue-63k/lionstatue.obj", 63338, 31825, 322, 0, 0, 1, -5, 4},
    {"rocker-arm-20k/rocker-arm.obj", 20088, 10044, 0, 0, 0, 1, 0, 0},
    {"snowden-bust-38k/snowden_lo.obj", 37629, 18743, 39, 88, 83, 4, -3, 0},
    {"cyberhead-josie/josie.obj", 3042, 1600, 156, 0, 0, 1, 1, 0},
    {"gaspra-32k/951gaspra_21_MLfix.obj", 32040, 16022, 0, 0, 0, 1, 2, 0},
    {"texturedknot-3k/texturedknot.obj", 2880, 1440, 0, 0, 0, 1, 0, 0},
    {"spot-6k/spot_triangulated.obj", 5856, 2930, 0, 0, 0, 1, 2, 0},
    {"blub-14k/blub_triangulated.obj", 14208, 7106, 0, 0, 0, 1, 2, 0},
    {"head-leeperrysmith-18k/LeePerrySmith.glb", 17684, 8844, 0, 0, 0, 1, 2, 0},
    {"egyptian-cat-5k/cat.glb", 4622, 2309, 0, 0, 0, 1, -2, 0},
    {"damagedhelmet-15k/DamagedHelmet.glb", 15452, 8661, 1820, 7, 15, 55, 30, 0},
    {"horse-textured-10k/horse.obj", 10184, 5094, 0, 0, 0, 1, 2, 0},
    {"fountain-11k/fountain.obj", 10631, 5375, 235, 0, 0, 6, 6, 0},
    {"dragon-textured-135k/DragonAttenuation.glb", 134995, 67806, 617, 6, 11, 2, 6, 0},
    {"scene-littlesttokyo-142k/LittlestTokyo.glb", 141802, 100942, 49584, 305, 412, 5965, 5842, 0},
    {"scene-sterngarten-72k/Sterngarten_Wien_innerArea.obj", 71673, 71772, 67823, 629, 1693, 2396,
     2360, 8},
};

// Vertices at one position become the first of them.
void weld(TriMesh& mesh) {
  std::map<std::tuple<float, float, float>, std::uint32_t> first;
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) {
      const glm::vec3& p = mesh.positions[v];
      v = first.try_emplace({p.x, p.y, p.z}, v).first->second;
    }
}

void expect_topology(const MeshTopology& topology, const MeshTopology& expected) {
  EXPECT_EQ(topology.n_edges, expected.n_edges);
  EXPECT_EQ(topology.n_boundary_edges, expected.n_boundary_edges);
  EXPECT_EQ(topology.n_nonmanifold_edges, expected.n_nonmanifold_edges);
  EXPECT_EQ(topology.n_nonmanifold_vertices, expected.n_nonmanifold_vertices);
  EXPECT_EQ(topology.n_components, expected.n_components);
  EXPECT_EQ(topology.euler_characteristic, expected.euler_characteristic);
  EXPECT_EQ(topology.n_opposed_edges, expected.n_opposed_edges);
}

// The model in every format, read and counted.
void expect_in_every_format(const TriMesh& model, const MeshTopology& expected) {
  const TemporaryFolder folder;
  const auto file = [&folder](const char* name) { return folder.path() / name; };
  folder.add("m.off", off_bytes(model));
  folder.add("m.stl", stl_bytes(model));
  folder.add("m.3ds", three_ds_bytes(model));
  write_ply(file("m.ply"), model);
  folder.add("m.ply.gz", gzipped(read_file(file("m.ply"))));
  write_obj(file("m.obj"), model);
  write_glb(file("m.glb"), model);
  for (const char* name : {"m.off", "m.stl", "m.3ds", "m.ply", "m.ply.gz", "m.obj", "m.glb"}) {
    SCOPED_TRACE(name);
    const TriMesh mesh = read_mesh(file(name));
    EXPECT_EQ(mesh.triangles.size(), model.triangles.size());
    const MeshTopology topology = measure_topology(mesh);
    expect_topology(topology, expected);
    EXPECT_EQ(mesh.positions.size() - topology.n_unreferenced_vertices,
              model.positions.size() - expected.n_unreferenced_vertices);
  }
}

TEST(Models, AClosedFigureInEveryFormat) {
  MeshTopology expected;
  expected.n_edges = 6 * 40 * 39;  // three for two triangles
  expected.n_components = 1;
  expected.euler_characteristic = 2;
  expect_in_every_format(make_lumpy_figure(40), expected);
}

TEST(Models, ARoughScanInEveryFormat) {
  const Scan scan = make_rough_scan(53);
  EXPECT_EQ(scan.topology.n_nonmanifold_edges, 36u);
  EXPECT_EQ(scan.topology.n_boundary_edges, 144u);
  expect_in_every_format(scan.mesh, scan.topology);
}

TEST(OutsideModels, HaveTheCountsOfTheirTable) {
  const std::filesystem::path folder = VIEWCELL_SHARED_DATA;
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
  for (const Expected& expected : kModels) {
    SCOPED_TRACE(expected.file);
    TriMesh mesh = read_mesh(folder / expected.file);
    EXPECT_EQ(mesh.triangles.size(), expected.n_triangles);
    weld(mesh);
    const MeshTopology topology = measure_topology(mesh);
    EXPECT_EQ(mesh.positions.size() - topology.n_unreferenced_vertices, expected.n_vertices);
    EXPECT_EQ(topology.n_boundary_edges, expected.n_boundary_edges);
    EXPECT_EQ(topology.n_nonmanifold_edges, expected.n_nonmanifold_edges);
    EXPECT_EQ(topology.n_nonmanifold_vertices, expected.n_nonmanifold_vertices);
    EXPECT_EQ(topology.n_components, expected.n_components);
    EXPECT_EQ(topology.euler_characteristic, expected.euler_characteristic);
    EXPECT_EQ(topology.n_opposed_edges, expected.n_opposed_edges);
  }
}

}  // namespace
}  // namespace viewcell
