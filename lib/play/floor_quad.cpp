#include "play/floor_quad.h"

#include <cstdint>
#include <vector>

#include "base/random.h"

namespace viewcell {
namespace {

constexpr const char* kVertex = R"(#version 450 core
layout(location = 0) out vec2 at;
void main() {
  at = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(2.0 * at - 1.0, 0.5, 1.0);
}
)";

constexpr const char* kFragment = R"(#version 450 core
layout(location = 0) in vec2 at;
layout(location = 0) out vec4 color;
layout(binding = 0) uniform sampler2D picture;
void main() { color = textureLod(picture, 0.95 * at + 0.02, 0.0); }
)";

}  // namespace

FloorQuad::FloorQuad(const Gl& gl, int width_px, int height_px)
    : gl_(gl),
      program_(gl, "floor", kVertex, kFragment),
      array_(gl),
      texture_(GlTexture::make_2d(gl, GL_RGBA8, width_px, height_px)) {
  std::vector<std::uint32_t> texels(static_cast<std::size_t>(width_px) *
                                    static_cast<std::size_t>(height_px));
  Random random(1);
  for (std::uint32_t& texel : texels) texel = static_cast<std::uint32_t>(random.next());
  texture_.write(0, 0, 0, width_px, height_px, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
}

void FloorQuad::draw(const GlFramebuffer& target) const {
  target.bind();
  target.clear({0, 0, 0, 0});
  gl_.BindTextureUnit(0, texture_.id());
  program_.use();
  array_.bind();
  gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

}  // namespace viewcell
