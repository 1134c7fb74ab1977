// What stands in for the hybrid's picture where the bake does not reach.
#pragma once

#include <span>
#include <string>

#include "bundle/bundle.h"
#include "scene/camera.h"

namespace viewcell {

/// Why a frame of mode hybrid is not drawn from the bake, or not from all of it. Of all but the
/// last the whole frame is drawn as mode lod draws it: levels where they were built, originals
/// otherwise.
enum class StandIn {
  none,
  off_height,        ///< the eye is above or below the heights that were baked
  off_cells,         ///< the eye is in no cell that the bundle holds
  damaged_cell,      ///< the cell's geometry could not be read
  damaged_textures,  ///< textures of a centre could not be read: what they would show is lit
};

/// All but none.
std::span<const StandIn> stand_ins();
/// As in statistics; none: "".
const char* stand_in_name(StandIn stand_in);

/// Whether the eye is where the bundle was baked for: none, off_height or off_cells.
StandIn find_off_bake(const Bundle& bundle, const Camera& camera);

/// A file of the bundle that could not be read.
struct BundleFault {
  std::string what;  ///< one line that begins with the file
  StandIn stand_in = StandIn::damaged_cell;
};

}  // namespace viewcell
