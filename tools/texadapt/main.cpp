// texadapt: a texture that has followed the collapses of a progressive mesh, for a level of it.
#include <cstdio>

#include "bake/texture_adapt.h"
#include "base/error.h"
#include "common/files.h"
#include "common/provenance.h"
#include "common/stopwatch.h"
#include "common/tool.h"
#include "image/io.h"
#include "mesh/io.h"
#include "pm/pm_file.h"

namespace viewcell {
namespace {

constexpr int kOverThreshold = 5;

struct Arguments {
  std::string pm, texture, mesh;
  std::size_t n_faces = 0;
};

void declare(Tool& tool, Arguments& a) {
  CLI::App& app = tool.app();
  app.add_option("PM", a.pm, "progressive mesh of half-edge collapses, with texture coordinates")
      ->required();
  app.add_option("TEXTURE", a.texture, "its texture; row 0 is v = 1")->required();
  app.add_option("--faces", a.n_faces, "the finest level of at most so many faces")
      ->required()
      ->check(CLI::Range(1, 2000000000));
  app.add_option("--mesh", a.mesh, "write the mesh of that level, too: .ply");
  tool.add_output("the texture for that level: .png (-: standard output)");
}

void check_record(const ProgressiveRecord& record, const std::string& file) {
  if (record.texcoords.empty())
    throw InputError(file, "", "has no texture coordinates, so no texture can follow it");
  for (const glm::vec2& uv : record.texcoords)
    if (!(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1))
      throw InputError(file, "",
                       "has texture coordinates outside [0, 1]: a texture that repeats cannot "
                       "follow a mesh");
}

int run(const Tool& tool, const Arguments& a) {
  const CommonOptions& common = tool.common();
  check_files(
      {{"the progressive mesh that is read", a.pm}, {"the texture that is read", a.texture}},
      {{"-o", common.output}, {"--mesh", a.mesh}, {"--json", common.json_file}});
  check_ending({"-o", common.output}, {".png"}, "a PNG");
  if (!a.mesh.empty()) check_ending({"--mesh", a.mesh}, {".ply"}, "a PLY");
  const ProgressiveRecord record = read_pm(a.pm);
  check_record(record, a.pm);
  const ImageRgba8 texture = read_image_rgba8(a.texture);
  Stopwatch watch;
  const AdaptationLog log = make_adaptation_log(record, tool.progress("collapses"));
  const double log_s = watch.lap_s();
  ProgressiveMesh mesh(record);
  mesh.set_level(mesh.n_splits());
  const LevelCharts charts = make_level_charts(mesh, log);
  mesh.set_faces(a.n_faces);
  const std::size_t n = mesh.n_splits() - mesh.level();
  watch.lap_s();
  TextureAdapter<glm::vec2> adapter(log,
                                    make_index_map<glm::vec2>(texture.width_px, texture.height_px),
                                    charts, 0, {.n_threads = common.n_threads});
  adapter.go_to(n);
  const IndexMap map = adapter.image();
  const double adapt_s = watch.lap_s();
  const ImageRgba8 baked = bake_texture(map, texture);
  if (!a.mesh.empty())
    write_ply(a.mesh, mesh.extract(), {std::string("made by texadapt ") + version()});
  write_png(tool.common().output, baked);
  const std::size_t n_faces = mesh.n_faces();
  tool.say(std::to_string(n_faces) + " faces, " + std::to_string(adapter.counts().n_adaptations) +
           " adaptations; of the whole mesh's " + std::to_string(log.n_collapses()) +
           " collapses " + std::to_string(log.n_folded) + " fold and adapt nothing");
  tool.report({{"faces", n_faces},
               {"collapses", n},
               {"adaptations", adapter.counts().n_adaptations},
               {"packs", adapter.counts().n_packs},
               {"texels", adapter.counts().n_texels},
               {"refused", {{"fold", log.n_folded}, {"unmapped", log.n_unmapped}}},
               {"timing", {{"log_s", log_s}, {"adapt_s", adapt_s}}}});
  if (n_faces <= a.n_faces) return 0;
  std::fprintf(stderr, "texadapt: %s: %zu faces were asked for, its base has %zu\n", a.pm.c_str(),
               a.n_faces, n_faces);
  return kOverThreshold;
}

}  // namespace
}  // namespace viewcell

int main(int argc, char** argv) {
  viewcell::Tool tool(
      "texadapt",
      "Adapts a texture to a level of a progressive mesh: what the texture shows "
      "stays where it was on the surface, while the mesh gets coarser.",
      "pmesh build head.obj --metric mapping -o head.pm\n"
      "  texadapt head.pm skin.png --faces 500 -o skin-500.png --mesh head-500.ply");
  viewcell::Arguments arguments;
  viewcell::declare(tool, arguments);
  return tool.main(argc, argv, [&] { return viewcell::run(tool, arguments); });
}
