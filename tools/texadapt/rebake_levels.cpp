#include "adapt/rebake.h"
#include "common/stopwatch.h"
#include "texadapt/level_writer.h"
#include "texadapt/levels.h"

namespace viewcell {

Json rebake_levels(const Tool& tool, const TexadaptArguments& a, const TexadaptInputs& in) {
  const LevelWriter writer(tool, a, in);
  ProgressiveMesh mesh(in.record);
  mesh.set_level(mesh.n_splits());
  Json rows = Json::array();
  Stopwatch watch;
  double bake_s = 0;
  for (const std::size_t level : a.levels) {
    mesh.set_faces(level);
    const TriMesh coarse = mesh.extract();
    watch.lap_s();
    writer.write(level, coarse, nullptr, nullptr, [&](const ImageRgba8& texture) {
      return rebake_texture(coarse, in.finest, texture,
                            {.width_px = a.options.width_px,
                             .height_px = a.options.height_px,
                             .n_threads = tool.common().n_threads,
                             .progress = tool.progress("rows")});
    });
    bake_s += watch.lap_s();
    rows.push_back({{"faces", mesh.n_faces()}});
  }
  return {{"faces", rows.back()["faces"]}, {"levels", rows}, {"timing", {{"bake_s", bake_s}}}};
}

}  // namespace viewcell
