// svmesh and mvmesh are one tool with two kinds of mesh.
#pragma once

#include <string>

#include "bake/cell_mesh.h"

namespace viewcell {

/// The whole of main.
int cell_mesh_tool_main(int argc, char** argv, Representation kind, const std::string& name,
                        const std::string& description);

}  // namespace viewcell
