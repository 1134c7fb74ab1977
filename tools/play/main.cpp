// play: draws a bundle along a camera path in several modes, and says how long and how well.
#include <iostream>

#include "base/file.h"
#include "common/mesh_input.h"
#include "image/io.h"
#include "play/arguments.h"
#include "play/plots.h"
#include "play/statistics.h"
#include "report/table.h"

namespace viewcell {
namespace {

// What was not drawn from the bake, and what was drawn instead.
void warn_of_stand_ins(const Tool& tool, const Timeline& timeline, const CellSet& cells,
                       bool with_lod) {
  const std::string instead =
      with_lod ? "drawn as mode lod draws them" : "drawn as they are, as in mode frustum";
  for (const BundleFault& fault : timeline.faults)
    tool.warn(fault.what + (fault.stand_in == StandIn::damaged_cell
                                ? "; in its place objects are " + instead
                                : "; what it would show is lit, without a texture"));
  const auto warn_of = [&](StandIn stand_in, const std::string& where) {
    const std::size_t n = count_stand_ins(timeline, stand_in);
    if (n > 0)
      tool.warn("hybrid: in " + std::to_string(n) + " of " +
                std::to_string(timeline.frames.size()) + " frames the eye is " + where +
                "; objects are " + instead);
  };
  warn_of(StandIn::off_height, "above or below the heights that were baked (" +
                                   format_fixed(cells.eye_height.lo, 2, "") + " to " +
                                   format_fixed(cells.eye_height.hi, 2, "") + ")");
  warn_of(StandIn::off_cells, "in no cell that the bundle holds");
}

int run(const Tool& tool, const PlayArguments& o, const PlayerOptions& player_options) {
  Remarks remarks;
  const CameraPath path = read_path(o.path_file, &remarks);
  tool.remark(o.path_file, remarks);
  const Bundle bundle(o.bundle,
                      {.n_threads = tool.common().n_threads, .limits = mesh_limits(tool)});
  Player player(bundle, player_options);
  const Session session = run_session(player, bundle, path, o.session, tool.progress("frames"));
  warn_of_stand_ins(tool, session.timeline, bundle.cells(), player_options.with_lod);
  const Json statistics = make_statistics(session.timeline);
  if (!o.plots_folder.empty()) write_plots(o.plots_folder, session.timeline);
  if (!o.sheet_file.empty() && !session.contact_sheet.empty())
    write_png(o.sheet_file, session.contact_sheet, PngAlpha::drop);
  if (!o.stats_file.empty()) write_file(o.stats_file, format_json(statistics));
  if (!o.table_file.empty()) write_file(o.table_file, format_markdown(session.timeline));
  tool.report(statistics);
  if (!tool.common().quiet) std::cerr << format_mode_table(session.timeline);
  return 0;
}

}  // namespace
}  // namespace viewcell

int main(int argc, char** argv) {
  viewcell::Tool tool("play", "Draw a bundle along a camera path, timed and compared.",
                      "play park.bundle/ --path park/path.json --modes geometry,frustum,hybrid "
                      "--stats stats.json --sheet sheet.png");
  viewcell::PlayArguments arguments;
  viewcell::declare_arguments(tool, arguments);
  viewcell::PlayerOptions options;
  return tool.main(
      argc, argv, [&] { options = viewcell::finish_arguments(tool, arguments); },
      [&] { return viewcell::run(tool, arguments, options); });
}
