// The levels that are asked for, one after another: adapted, or rebaked from nearest points.
#pragma once

#include "texadapt/inputs.h"

namespace viewcell {

/// Write the files of all levels and return the report.
Json adapt_levels(const Tool& tool, const TexadaptArguments& arguments,
                  const TexadaptInputs& inputs);
Json rebake_levels(const Tool& tool, const TexadaptArguments& arguments,
                   const TexadaptInputs& inputs);
/// Writes the files of the mesh of --onto.
Json rebake_onto(const Tool& tool, const TexadaptArguments& arguments,
                 const TexadaptInputs& inputs);

}  // namespace viewcell
