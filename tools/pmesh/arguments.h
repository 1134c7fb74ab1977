// What is typed at pmesh.
#pragma once

#include <optional>
#include <string>

#include "common/length.h"
#include "common/tool.h"
#include "pm/build.h"

namespace viewcell {

struct PmeshArguments {
  std::string model, metric = "qem3", placement, error = "total", measure = "max", pm;
  std::optional<std::string> stop_at, ignored;
  bool unweighted = false, mean = false, exact = false, no_texture = false, flip_v = false;
  std::optional<std::size_t> n_faces;        ///< of extract
  std::optional<std::string> within;         ///< of extract: a Length
  std::optional<std::string> bounded, weld;  ///< of build: a Length
  bool stops_at_faces = false;               ///< after finish_arguments
  BuildOptions build;                        ///< after finish_arguments
};

void declare_arguments(Tool& tool, PmeshArguments& arguments);

/// Sets arguments.build from the words typed at build. Throws UsageError for what does not fit
/// together.
void finish_arguments(const Tool& tool, PmeshArguments& arguments);

}  // namespace viewcell
