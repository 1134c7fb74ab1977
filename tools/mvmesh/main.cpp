// mvmesh: meshes textured from up to seven views, for near objects.
#include "common/mesh_tool.h"

int main(int argc, char** argv) {
  return viewcell::mesh_tool_main(argc, argv, viewcell::Representation::multi_view, "mvmesh",
                                  "Derive the multi-view textured LOD meshes of view cells.");
}
