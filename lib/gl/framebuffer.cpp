#include "gl/framebuffer.h"

#include <algorithm>

#include "base/error.h"

namespace viewcell {
namespace {

GLuint create_framebuffer(const Gl& gl) {
  GLuint id = 0;
  gl.CreateFramebuffers(1, &id);
  return id;
}

void delete_framebuffer(const Gl& gl, GLuint id) {
  gl.DeleteFramebuffers(1, &id);
}

// GL's row 0 is the bottom; an Image's is the top.
template <typename Pixel>
void flip_rows(Image<Pixel>& image) {
  for (int y = 0; y < image.height_px / 2; ++y)
    std::swap_ranges(&image.at(0, y), &image.at(0, y) + image.width_px,
                     &image.at(0, image.height_px - 1 - y));
}

}  // namespace

GlFramebuffer::GlFramebuffer(const Gl& gl, int width_px, int height_px,
                             const std::vector<GLenum>& color_formats)
    : GlObject(gl, delete_framebuffer, create_framebuffer(gl)),
      width_px_(width_px),
      height_px_(height_px) {
  std::vector<GLenum> attachments;
  for (const GLenum format : color_formats) {
    colors_.push_back(GlTexture::make_2d(gl, format, width_px, height_px));
    colors_.back().set_filter(GL_NEAREST);
    attachments.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachments.size()));
    gl.NamedFramebufferTexture(id(), attachments.back(), colors_.back().id(), 0);
  }
  gl.NamedFramebufferDrawBuffers(id(), static_cast<GLsizei>(attachments.size()),
                                 attachments.data());
  depth_ = GlTexture::make_2d(gl, GL_DEPTH_COMPONENT32F, width_px, height_px);
  depth_.set_filter(GL_NEAREST);
  gl.NamedFramebufferTexture(id(), GL_DEPTH_ATTACHMENT, depth_.id(), 0);
  const GLenum status = gl.CheckNamedFramebufferStatus(id(), GL_DRAW_FRAMEBUFFER);
  VIEWCELL_CHECK(status == GL_FRAMEBUFFER_COMPLETE, "status =", status, "size =", width_px, "x",
                 height_px);
}

void GlFramebuffer::bind() const {
  gl().BindFramebuffer(GL_DRAW_FRAMEBUFFER, id());
  gl().Viewport(0, 0, width_px_, height_px_);
}

void GlFramebuffer::clear(const std::array<float, 4>& color) const {
  const float farthest = 0;
  if (!colors_.empty()) gl().ClearNamedFramebufferfv(id(), GL_COLOR, 0, color.data());
  gl().ClearNamedFramebufferfv(id(), GL_DEPTH, 0, &farthest);
}

template <typename Pixel>
Image<Pixel> GlFramebuffer::read(GLenum source, GLenum format, GLenum type) const {
  Image<Pixel> image(width_px_, height_px_);
  gl().BindFramebuffer(GL_READ_FRAMEBUFFER, id());
  if (source != GL_NONE) gl().NamedFramebufferReadBuffer(id(), source);
  gl().ReadPixels(0, 0, width_px_, height_px_, format, type, image.pixels.data());
  check_gl(gl(), "reading a framebuffer back");
  flip_rows(image);
  return image;
}

ImageRgba8 GlFramebuffer::read_rgba8() const {
  return read<Rgba8>(GL_COLOR_ATTACHMENT0, GL_RGBA, GL_UNSIGNED_BYTE);
}

Image<float> GlFramebuffer::read_depth() const {
  return read<float>(GL_NONE, GL_DEPTH_COMPONENT, GL_FLOAT);
}

Image<std::uint32_t> GlFramebuffer::read_uint(std::size_t attachment) const {
  return read<std::uint32_t>(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachment), GL_RED_INTEGER,
                             GL_UNSIGNED_INT);
}

ImageRgbaFloat GlFramebuffer::read_rgba_float(std::size_t attachment) const {
  return read<RgbaFloat>(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachment), GL_RGBA, GL_FLOAT);
}

}  // namespace viewcell
