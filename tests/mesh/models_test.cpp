// Reads every real model and holds its counts against the table that came with it.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <tuple>

#include "mesh/io.h"

namespace viewcell {
namespace {

struct Expected {
  const char* file;
  std::size_t n_triangles, n_distinct_positions;  // of the referenced vertices; 0: not compared
};

constexpr Expected kModels[] = {
    {"dragon-202k/dragon_vrip_res2.ply.gz", 202520, 100207},
    {"dragon-11k/dragon_vrip_res4.ply.gz", 11102, 5203},
    {"bunny-69k/bunny70k.ply", 69451, 34834},
    {"horse-97k/horse.ply", 96966, 48485},
    {"moai-20k/moaimoai.off", 20000, 10002},
    {"venus-1k/venus.off", 1418, 711},
    {"camel-20k/camel.off", 19536, 9770},
    {"bull-12k/bull.off", 12396, 6200},
    {"cow-6k/cow.off", 5804, 2903},
    {"fandisk-13k/fandisk.off", 12946, 6475},
    {"elephant-holes-4k/elephant-with-holes.off", 4463, 2733},
    {"cat-14k/cat.3ds", 14348, 7340},
    {"horse-7k/horse.3ds", 7172, 3582},
    {"lionstatue-63k/lionstatue.obj", 63338, 31825},
    {"rocker-arm-20k/rocker-arm.obj", 20088, 10044},
    {"snowden-bust-38k/snowden_lo.obj", 37629, 18743},
    {"cyberhead-josie/josie.obj", 3042, 1600},
    {"gaspra-32k/951gaspra_21_MLfix.obj", 32040, 16022},
    {"texturedknot-3k/texturedknot.obj", 2880, 1440},
    {"spot-6k/spot_triangulated.obj", 5856, 2930},
    {"blub-14k/blub_triangulated.obj", 14208, 7106},
    {"head-leeperrysmith-18k/LeePerrySmith.glb", 17684, 8844},
    {"egyptian-cat-5k/cat.glb", 4622, 2309},
    {"damagedhelmet-15k/DamagedHelmet.glb", 15452, 8661},
    {"horse-textured-10k/horse.obj", 10184, 5094},
    {"fountain-11k/fountain.obj", 10631, 5375},
    {"dragon-textured-135k/DragonAttenuation.glb", 134995, 67806},
    {"scene-littlesttokyo-142k/LittlestTokyo.glb", 141802, 100942},
    {"scene-sterngarten-72k/Sterngarten_Wien_innerArea.obj", 71673, 71772},
};

std::size_t count_distinct_positions(const TriMesh& mesh) {
  std::map<std::tuple<float, float, float>, int> seen;
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) {
      const glm::vec3& p = mesh.positions[v];
      seen[{p.x, p.y, p.z}] = 1;
    }
  return seen.size();
}

TEST(Models, HaveTheCountsOfTheirTable) {
  const std::filesystem::path folder = VIEWCELL_SHARED_DATA;
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
  for (const Expected& expected : kModels) {
    SCOPED_TRACE(expected.file);
    const TriMesh mesh = read_mesh(folder / expected.file);
    EXPECT_EQ(mesh.triangles.size(), expected.n_triangles);
    EXPECT_EQ(count_distinct_positions(mesh), expected.n_distinct_positions);
  }
}

}  // namespace
}  // namespace viewcell
