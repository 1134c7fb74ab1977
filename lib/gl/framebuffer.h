// A framebuffer to draw into and read back: RGBA8 colour (or formats of the caller's) and 32-bit
// float depth.
#pragma once

#include <array>
#include <vector>

#include "gl/objects.h"
#include "image/image.h"

namespace viewcell {

class GlFramebuffer : public GlObject {
 public:
  GlFramebuffer() = default;
  /// color_formats: one attachment each, in order; every one is drawn to.
  /// Throws BugError when the driver cannot draw to these formats.
  GlFramebuffer(const Gl& gl, int width_px, int height_px,
                const std::vector<GLenum>& color_formats = {GL_RGBA8});

  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }
  /// Makes it the target of drawing, with a viewport that fills it.
  void bind() const;
  /// Clears colour 0 and the depth (to 0, the farthest). Binds nothing.
  void clear(const std::array<float, 4>& color) const;

  const GlTexture& color(std::size_t attachment = 0) const { return colors_[attachment]; }
  const GlTexture& depth() const { return depth_; }

  /// Colour attachment 0. Waits for drawing to end.
  ImageRgba8 read_rgba8() const;
  /// Reversed depth in [0, 1], as kept: 0 where nothing was drawn.
  Image<float> read_depth() const;
  /// Attachment of a one-channel unsigned format (GL_R32UI).
  Image<std::uint32_t> read_uint(std::size_t attachment) const;
  /// Attachment of any float or normalised format, as float.
  ImageRgbaFloat read_rgba_float(std::size_t attachment) const;

 private:
  template <typename Pixel>
  Image<Pixel> read(GLenum source, GLenum format, GLenum type) const;

  int width_px_ = 0;
  int height_px_ = 0;
  std::vector<GlTexture> colors_;
  GlTexture depth_;
};

}  // namespace viewcell
