// A polygon as rings of steps, for the sweep that triangulates it. Private to this room.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace viewcell {

/// A corner as a ring passes it: what is inside lies left of the ring.
struct RingStep {
  glm::dvec2 at{0};
  std::uint32_t corner = 0;          ///< of the polygon
  std::uint32_t prev = 0, next = 0;  ///< steps
};

/// The rings that bound what a polygon covers, which runs counter-clockwise. Edges that are run
/// along both ways bound nothing and are dropped: a way to a hole and back is gone, and the hole
/// has a ring of its own. Where a point is passed several times, each step turns from its edge to
/// the next one across the inside. Empty where edges cross at such a point. O(n log n).
std::vector<RingStep> make_rings(const std::vector<glm::dvec2>& points);

}  // namespace viewcell
