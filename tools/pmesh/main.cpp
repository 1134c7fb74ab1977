// pmesh: progressive meshes, built under a choice of metrics, and meshes taken from them.
#include "pmesh/commands.h"

int main(int argc, char** argv) {
  viewcell::Tool tool("pmesh",
                      "Builds progressive meshes (a base mesh and the vertex splits back to the "
                      "input), and takes meshes of any size out of them.",
                      "pmesh build bunny.ply --metric lt -o bunny.pm\n"
                      "  pmesh extract bunny.pm --faces 1000 -o bunny-1000.ply\n"
                      "  pmesh build bunny.ply --bounded 0.01 -o near.pm\n"
                      "  pmesh extract near.pm --within 0.001 -o near.obj\n"
                      "  pmesh info bunny.pm");
  viewcell::PmeshArguments arguments;
  viewcell::declare_arguments(tool, arguments);
  const auto prepare = [&] { viewcell::finish_arguments(tool, arguments); };
  return tool.main(argc, argv, prepare, [&] {
    if (tool.command("build").is_given()) return viewcell::build(tool, arguments);
    if (tool.command("extract").is_given()) return viewcell::extract(tool, arguments);
    return viewcell::info(tool, arguments);
  });
}
