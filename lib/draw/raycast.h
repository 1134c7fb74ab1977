// Mode `raycast`: primary rays with Embree, the baseline that software rasterisers are compared
// with.
#pragma once

#include <memory>

#include "image/image.h"
#include "scene/camera.h"
#include "scene/scene.h"

namespace viewcell {

/// One bounding hierarchy a mesh, instanced by the objects; packets of 16 rays, one ray a pixel
/// centre, tiles distributed over all threads. Shades as the rasteriser does: interpolated vertex
/// normals, back faces of single-sided materials not seen, objects before ground, alpha 255 on
/// objects and 0 elsewhere.
class RayCaster {
 public:
  /// scene must outlive this. n_threads (0: all) build and draw; building takes budget_bytes at
  /// most (0: as many as there are). Throws MachineError when that is not enough. Cost: about a
  /// second a million triangles.
  explicit RayCaster(const Scene& scene, int n_threads = 0, std::size_t budget_bytes = 0);
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  /// Fills the image, whose size is the frame's. The same bytes for any number of threads.
  void draw(const Camera& camera, ImageRgba8& image) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace viewcell
