// The `gl` engine: captures by rasterising one object at a time.
#pragma once

#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "capture/tile.h"
#include "gl/framebuffer.h"
#include "gl/objects.h"
#include "scene/scene.h"
#include "scene/surface.h"

namespace viewcell {

/// A twin of RayCapture with the same pixel centres and the same lighting; they differ at pixels
/// whose centre is within a rasteriser's sub-pixel step of an edge.
/// Only the thread on which the context is current may use it. Relies on, and leaves, the state of
/// GlContext.
class RasterCapture {
 public:
  /// gl and scene must outlive this; its pictures must be loaded (scene/pictures.h). Meshes are
  /// uploaded when first captured (24 bytes a vertex, 44 with pictures or colours, 12 a triangle),
  /// as pictures are, and stay.
  RasterCapture(const Gl& gl, const Scene& scene);

  /// The nearest front-facing (or double-sided) triangle of that object alone at every pixel
  /// centre. Colour and depth outside the object are left zero (push_pull_fill fills them). All of
  /// the object must be before the view's eye, as choose_view sees to. Throws MachineError when GL
  /// memory runs out.
  CaptureTile capture(ObjectId object, const CaptureView& view, const Crop& crop);

 private:
  struct GpuMesh {
    GlBuffer vertices, dressed, indices;
    GlVertexArray array;
    std::vector<SlotRange> slots;
  };

  const GpuMesh& upload(MeshId mesh);
  const GlProgram& program_for(const SurfaceKind& kind);
  const GlTexture& texture_for(const Material& material);
  void use(const SceneObject& object, const Material& material, const glm::mat4& clip_from_model);
  void draw_block(CaptureTile& tile, const Crop& block);

  const Gl& gl_;
  const Scene& scene_;
  std::map<SurfaceKind, GlProgram> programs_;
  std::map<std::tuple<int, Wrap, Wrap>, GlTexture> textures_;  // by picture and wraps
  std::vector<std::optional<GpuMesh>> meshes_;                 // by MeshId
};

/// Clip space from the world for one block of a view's image: clip w is the depth along the view's
/// axis, clip z a constant (reversed infinite depth), x and y fill the block. Image y runs down.
glm::dmat4 clip_from_world(const CaptureView& view, const Crop& block);

}  // namespace viewcell
