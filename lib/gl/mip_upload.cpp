#include "gl/mip_upload.h"

namespace viewcell {
namespace {

// An image's first row is the top, a texture's is v = 0.
std::vector<Rgba8> rows_upwards(const ImageRgba8& image) {
  std::vector<Rgba8> texels;
  texels.reserve(image.pixels.size());
  for (int row = image.height_px; row-- > 0;) {
    const Rgba8* first = &image.at(0, row);
    texels.insert(texels.end(), first, first + image.width_px);
  }
  return texels;
}

GLint gl_wrap(Wrap wrap) {
  if (wrap == Wrap::clamp) return GL_CLAMP_TO_EDGE;
  return wrap == Wrap::mirror ? GL_MIRRORED_REPEAT : GL_REPEAT;
}

}  // namespace

GlTexture upload_mips(const Gl& gl, const MipTexture& texture) {
  const std::vector<ImageRgba8>& levels = *texture.levels;
  GlTexture out = GlTexture::make_levels(gl, GL_SRGB8_ALPHA8, levels[0].width_px,
                                         levels[0].height_px, static_cast<int>(levels.size()));
  for (std::size_t i = 0; i < levels.size(); ++i)
    out.write_level(static_cast<int>(i), levels[i].width_px, levels[i].height_px,
                    rows_upwards(levels[i]).data());
  gl.TextureParameteri(out.id(), GL_TEXTURE_WRAP_S, gl_wrap(texture.wrap_u));
  gl.TextureParameteri(out.id(), GL_TEXTURE_WRAP_T, gl_wrap(texture.wrap_v));
  check_gl(gl, "a picture with its mips");
  return out;
}

}  // namespace viewcell
