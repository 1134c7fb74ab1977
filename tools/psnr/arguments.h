// What is typed at psnr.
#pragma once

#include <limits>
#include <string>

#include "common/tool.h"
#include "report/compare_files.h"

namespace viewcell {

struct PsnrArguments {
  std::string reference, tested, inside, judge = "luminance";
  bool index_maps = false;
  double fail_below_db = -std::numeric_limits<double>::infinity();
  CompareFilesOptions options;
};

void declare_arguments(Tool& tool, PsnrArguments& arguments);

/// Throws UsageError for what the command line alone shows to be wrong, and registers --diff.
void check_arguments(Tool& tool, const PsnrArguments& arguments);

}  // namespace viewcell
