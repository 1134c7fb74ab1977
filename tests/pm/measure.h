// What is asked of simplified meshes and of records, by several tests.
#pragma once

#include <gtest/gtest.h>

#include "mesh/surface_distance.h"
#include "pm/progressive_mesh.h"

namespace viewcell {

/// The symmetric maximum of so many samples each way.
inline double measure_farthest(const TriMesh& a, const TriMesh& b, std::size_t n_samples = 2000) {
  DistanceOptions options;
  options.n_samples = n_samples;
  options.n_threads = 1;
  return measure_surface_distance(a, b, options).symmetric().max;
}

/// Whether a record is refused; otherwise it must lead to the input without a fault.
inline bool is_refused(const ProgressiveRecord& record) {
  if (!check_record(record).empty()) return true;
  ProgressiveMesh pm(record);
  pm.set_level(pm.n_splits());
  EXPECT_EQ(pm.n_vanished(), 0u);
  pm.extract();
  return false;
}

}  // namespace viewcell
