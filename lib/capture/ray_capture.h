// The `embree` engine: captures by ray casting.
#pragma once

#include <memory>

#include "capture/tile.h"
#include "scene/scene.h"

namespace viewcell {

/// Bounding hierarchies of a scene's meshes, one a mesh, shared by its instances.
/// capture() may be called from many threads at once.
class RayCapture {
 public:
  /// The scene must outlive this. n_threads (0: all) build, in budget_bytes at most (0: as many as
  /// there are). Throws MachineError when that is not enough.
  RayCapture(const Scene& scene, int n_threads, std::size_t budget_bytes = 0);
  ~RayCapture();
  RayCapture(const RayCapture&) = delete;
  RayCapture& operator=(const RayCapture&) = delete;

  /// One ray a pixel centre; the nearest front-facing (or double-sided) triangle of that object
  /// alone. Colour and depth outside the object are left zero (push_pull_fill fills them).
  CaptureTile capture(ObjectId object, const CaptureView& view, const Crop& crop) const;

 private:
  struct Scenes;
  const Scene& scene_;
  std::unique_ptr<Scenes> scenes_;
};

}  // namespace viewcell
