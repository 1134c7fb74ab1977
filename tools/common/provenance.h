// How an artefact was made: tool, version, options that change its bytes, hashes of its inputs. No
// dates, no paths.
#pragma once

#include "base/version.h"
#include "common/tool.h"

namespace viewcell {

inline Json make_provenance(const Tool& tool, const Json& options, const Json& inputs) {
  return {{"tool", tool.name()}, {"version", version()}, {"options", options}, {"inputs", inputs}};
}

}  // namespace viewcell
