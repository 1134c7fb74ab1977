#include "gl/filter_precision.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "gl/framebuffer.h"
#include "gl/objects.h"

namespace viewcell {
namespace {

constexpr int kSamples = 61;               // odd: places are no multiples of 1/256
constexpr float kTolerance = 1 / 2048.0f;  // 8 bits are up to 1/256 off

// A triangle over all.
constexpr const char* kVertex = R"(#version 450 core
void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0.5, 1);
}
)";

// Sample k lies k / kSamples of the way from texel (0, 0) to (1, 1), of 2 x 2.
constexpr const char* kFragment = R"(#version 450 core
layout(binding = 0) uniform sampler2D values;
layout(location = 0) out vec4 value_out;
void main() {
  float part = (gl_FragCoord.x - 0.5) / 61;
  value_out = textureLod(values, vec2(0.25 + 0.5 * part), 0);
}
)";

}  // namespace

bool filters_precisely(const Gl& gl, GLenum internal_format) {
  const GlTexture source = GlTexture::make_2d(gl, internal_format, 2, 2);
  const std::array<float, 4> corner{0, 0, 0, 1};
  gl.TextureSubImage2D(source.id(), 0, 0, 0, 2, 2, GL_RED, GL_FLOAT, corner.data());
  const GlFramebuffer target(gl, kSamples, 1, {internal_format});
  const GlProgram program(gl, "precision of filters", kVertex, kFragment);
  const GlVertexArray array(gl);
  target.bind(), program.use(), array.bind();
  target.clear({0, 0, 0, 0});
  gl.BindTextureUnit(0, source.id());
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  const ImageRgbaFloat drawn = target.read_rgba_float(0);
  float worst = 0;
  for (int k = 0; k < kSamples; ++k) {
    const float part = static_cast<float>(k) / kSamples;
    worst = std::max(worst, std::abs(drawn.at(k, 0)[0] - part * part));
  }
  return worst < kTolerance;
}

}  // namespace viewcell
