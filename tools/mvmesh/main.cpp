// mvmesh: meshes textured from up to seven views, for near objects.
#include "common/cell_mesh_tool.h"

int main(int argc, char** argv) {
  return viewcell::cell_mesh_tool_main(argc, argv, viewcell::Representation::multi_view, "mvmesh",
                                       "Derive the multi-view textured LOD meshes of view cells.");
}
