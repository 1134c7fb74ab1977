// What is typed at meshdist.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "common/length.h"
#include "common/tool.h"
#include "report/distance_report.h"

namespace viewcell {

struct MeshdistArguments {
  std::string a, b, color;
  std::optional<std::string> range_text;
  std::optional<std::array<double, 2>> range;  ///< after finish_arguments
  std::optional<std::string> fail_above;       ///< a Length
  DistanceOptions options;
};

void declare_arguments(Tool& tool, MeshdistArguments& arguments);

/// Sets range. Throws UsageError for what does not fit together.
void finish_arguments(MeshdistArguments& arguments);

}  // namespace viewcell
