// play: draws a bundle along a camera path in several modes, and says how long and how well.
#include <iostream>

#include "base/file.h"
#include "image/io.h"
#include "play/arguments.h"
#include "play/plots.h"
#include "play/statistics.h"

namespace viewcell {
namespace {

int run(const Tool& tool, const PlayArguments& o, const PlayerOptions& player_options) {
  const CameraPath path = read_path(o.path_file);
  const Bundle bundle(o.bundle, tool.common().n_threads);
  Player player(bundle, player_options);
  const Session session = run_session(player, bundle, path, o.session, tool.progress("frames"));
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
