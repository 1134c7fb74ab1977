// Which objects an eye in a cell may see, by rays.
#pragma once

#include <memory>
#include <vector>

#include "cells/cells.h"
#include "scene/scene.h"

namespace viewcell {

struct SeenOptions {
  int n_eyes = 48;  ///< in each cell: the prism's corners and middle, then at random
  /// What of an object shows in a patch of so many pixels, at the captures' density, from all of
  /// the cell is found with 95 %.
  double patch_px = 16;
  int resolution_px = 1024;  ///< per width of a side face, as CaptureDensity has it
  int most_rays = 4096;      ///< aimed at one object from one cell
};

/// What a cell sees, but for what is inside it: that is drawn anyway.
struct SeenFromCell {
  std::vector<ObjectId> unseen;  ///< outside the cell, ascending
  std::size_t n_rays = 0;
};

/// Casts rays from eyes in a cell: around each eye first, then at points spread over the surface of
/// each object that none has met yet, more of them the larger it looks. Not conservative: what
/// shows in few pixels, or from few eyes alone, may be missed. Objects with masks hide nothing, and
/// backs of single-sided materials neither hide nor are seen. The scene's meshes must be there, and
/// it must outlive this.
class SeenFinder {
 public:
  /// n_threads (0: all) build. Throws MachineError when memory runs out.
  SeenFinder(const Scene& scene, const CellSet& cells, const SeenOptions& options, int n_threads);
  ~SeenFinder();
  SeenFinder(const SeenFinder&) = delete;
  SeenFinder& operator=(const SeenFinder&) = delete;

  /// The same for the same cell, whatever else was asked. May be called from many threads at once.
  SeenFromCell find(CellId cell) const;

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

}  // namespace viewcell
