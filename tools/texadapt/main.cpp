// texadapt: a texture that follows the collapses of a progressive mesh, for levels of it.
#include <algorithm>
#include <cstdio>

#include "texadapt/advice.h"
#include "texadapt/levels.h"

namespace viewcell {
namespace {

Json make_report(const Tool& tool, const TexadaptArguments& a, const TexadaptInputs& in) {
  if (!a.onto.empty()) return rebake_onto(tool, a, in);
  return a.engine == AdaptEngine::rebake ? rebake_levels(tool, a, in) : adapt_levels(tool, a, in);
}

// Pieces that are missing in levels, said of the coarsest.
void count_vanished(const Tool& tool, const TexadaptArguments& a, const TexadaptInputs& in,
                    Json& report) {
  if (count_vanishing_pieces(in.record) == 0) return;
  ProgressiveMesh mesh = make_finest(in.record);
  std::size_t most = 0;
  for (std::size_t i = 0; i < a.levels.size(); ++i) {
    mesh.set_faces(a.levels[i]);
    report["levels"][i]["pieces_vanished"] = mesh.n_vanished();
    most = std::max(most, mesh.n_vanished());
  }
  Remarks remarks;
  add_remark(&remarks,
             "pieces have vanished whole at the coarsest level (pmesh build --keep-pieces)", most);
  tool.remark(a.pm, remarks);
}

int run(const Tool& tool, TexadaptArguments& a) {
  const TexadaptInputs in = read_inputs(tool, a);
  Json report = make_report(tool, a, in);
  if (a.onto.empty()) count_vanished(tool, a, in, report);
  tool.remark(a.texture, in.shown.remarks);
  if (!in.charts.empty()) tool.say(in.charts);
  tool.report(report);
  for (std::size_t i = 0; i < a.levels.size() && a.onto.empty(); ++i) {
    const auto n = report["levels"][i]["faces"].get<std::size_t>();
    if (n <= a.levels[i]) continue;
    const std::string why =
        report.contains("charts") ? explain_base(n, report["charts"].get<std::size_t>()) : "";
    std::fprintf(stderr, "texadapt: %s: %zu faces were asked for, its base has %zu%s\n",
                 a.pm.c_str(), a.levels[i], n, why.c_str());
    return kOverThreshold;
  }
  return 0;
}

}  // namespace
}  // namespace viewcell

int main(int argc, char** argv) {
  viewcell::Tool tool(
      "texadapt",
      "Makes a texture follow a progressive mesh: what it shows stays where it was on the surface, "
      "while the mesh gets coarser or finer.",
      "pmesh build head.obj --metric mapping -o head.pm\n"
      "  texadapt head.pm skin.png --faces 500 -o skin-500.png --mesh head-500.ply\n"
      "  texadapt head.pm skin.png --levels 8000,2000,500 -o head.glb");
  viewcell::TexadaptArguments arguments;
  viewcell::declare_arguments(tool, arguments);
  return tool.main(
      argc, argv, [&] { viewcell::finish_arguments(tool, arguments); },
      [&] { return viewcell::run(tool, arguments); });
}
