// Texture adaptation by drawing: the texture and who owns its texels stay with GL.
#pragma once

#include <memory>
#include <optional>

#include "adapt/texture_adapt.h"
#include "gl/objects.h"

namespace viewcell {

struct GlAdaptOptions {
  /// Disjoint collapses in one change of the target; false: a change each.
  bool pack = true;
  /// What a pack wrote is brought along by glCopyImageSubData, a call a collapse, and not by
  /// drawing. Unset: where GL runs on the processor.
  std::optional<bool> copies_boxes = {};
  std::size_t batch_bytes = 4 << 20;  ///< vertices uploaded at once; at least one pack
};

struct GlAdaptCounts {
  std::size_t n_adaptations = 0;
  std::size_t n_packs = 0;  ///< changes of the target
  std::size_t n_draws = 0;
  std::size_t n_bytes = 0;  ///< uploaded: vertices
};

/// What TextureAdapter does, drawn into textures: texels on edges between cells may fall to the
/// cell beside, and texture coordinates are interpolated, so values differ by the rounding of
/// single precision, and on such edges by what the map bends there. Texel: as there; kept as
/// GL_RG32F, GL_RG16, GL_RG8, GL_RG16F or GL_RGBA8, which rounds at every step as the driver does.
///
/// A texture and its twin change roles with every pack: the one that is read is whole, and what a
/// pack writes into the other is brought along with the next pack. Follows: [Chen06 3.2.3, 3.3].
/// Differs: as TextureAdapter, and no second pass that copies back.
template <typename Texel>
class GlTextureAdapter {
 public:
  /// As for TextureAdapter. gl and log are kept by reference and must outlive it. Throws
  /// MachineError when a side is beyond the driver's limit, or the texels take 2 GiB. Leaves GL's
  /// state as gl/context.h says.
  GlTextureAdapter(const Gl& gl, const AdaptationLog& log, const Image<Texel>& image,
                   const LevelCharts& charts, std::size_t n_collapsed = 0,
                   const GlAdaptOptions& options = {});
  ~GlTextureAdapter();
  GlTextureAdapter(GlTextureAdapter&&) noexcept;

  /// Collapses or splits until just the first n_collapsed collapses are made. Does not wait for
  /// the drawing to end.
  void go_to(std::size_t n_collapsed);

  std::size_t n_collapsed() const;
  Image<Texel> image() const;  ///< read back; waits
  /// Row 0 is v = 0. Another one after each go_to().
  const GlTexture& texture() const;
  /// Per texel, in the image's order: 0 for none, else a chart's (adapt/texel_owners.h). Waits.
  Image<std::uint16_t> owners() const;
  const GlAdaptCounts& counts() const;

 private:
  class Engine;
  std::unique_ptr<Engine> engine_;
};

}  // namespace viewcell
