// What is typed at meshdist.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>

#include "common/tool.h"
#include "report/distance_report.h"

namespace viewcell {

struct MeshdistArguments {
  std::string a, b, color;
  std::optional<std::string> range_text;
  std::optional<std::array<double, 2>> range;  ///< after finish_arguments
  double fail_above = std::numeric_limits<double>::infinity();
  DistanceOptions options;
};

void declare_arguments(Tool& tool, MeshdistArguments& arguments);

/// Sets range. Throws UsageError for what does not fit together.
void finish_arguments(MeshdistArguments& arguments);

}  // namespace viewcell
