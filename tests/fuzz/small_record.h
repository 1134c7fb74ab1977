// A progressive mesh with texture coordinates, of which logs of adaptations are fuzzed.
#pragma once

#include "common/models.h"
#include "pm/build.h"

namespace viewcell {

inline ProgressiveRecord make_small_record() {
  BuildOptions options;
  options.metric = MetricKind::mapping;
  options.target_faces = 12;
  return build_progressive_mesh(make_gored_figure(4, 2), options).record;
}

}  // namespace viewcell
