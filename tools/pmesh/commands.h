// What pmesh does: each returns the exit code.
#pragma once

#include "pmesh/arguments.h"

namespace viewcell {

int build(const Tool& tool, const PmeshArguments& arguments);
int extract(const Tool& tool, const PmeshArguments& arguments);
int info(const Tool& tool, const PmeshArguments& arguments);

}  // namespace viewcell
