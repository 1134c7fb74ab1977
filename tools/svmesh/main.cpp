// svmesh: meshes textured from one view, for objects whose self-occluding error is small.
#include "common/cell_mesh_tool.h"

int main(int argc, char** argv) {
  return viewcell::cell_mesh_tool_main(argc, argv, viewcell::Representation::single_view, "svmesh",
                                       "Derive the single-view textured LOD meshes of view cells.");
}
