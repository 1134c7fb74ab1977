// The ways to build a progressive mesh.
#pragma once

#include "pm/build.h"

namespace viewcell {

struct Way {
  MetricKind metric;
  Placement placement;
};
// The first three need no texture coordinates.
inline constexpr Way kWays[] = {
    {MetricKind::qem3, Placement::half},    {MetricKind::qem3, Placement::full},
    {MetricKind::lt, Placement::full},      {MetricKind::qem5, Placement::half},
    {MetricKind::qem5, Placement::full},    {MetricKind::aps, Placement::half},
    {MetricKind::mapping, Placement::half}, {MetricKind::mapping, Placement::full}};

inline BuildOptions options_of(const Way& way) {
  BuildOptions options;
  options.metric = way.metric;
  options.placement = way.placement;
  return options;
}

}  // namespace viewcell
