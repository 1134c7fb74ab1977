#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "base/error.h"
#include "gl/context.h"
#include "gl/filter_precision.h"
#include "gl/framebuffer.h"
#include "gl/objects.h"

namespace viewcell {
namespace {

constexpr const char* kVertex = R"(#version 450 core
layout(location = 0) in vec3 position;
void main() { gl_Position = vec4(position, 1); }
)";
constexpr const char* kFragment = R"(#version 450 core
uniform vec4 color;
layout(location = 0) out vec4 result;
void main() { result = color; }
)";

// One context for the whole program: making one costs more than all tests.
GlContext& shared_context() {
  static GlContext context(GlEngine::kOsmesa);
  context.make_current();
  return context;
}

const Gl& gl() {
  return shared_context().gl();
}

struct Drawing {
  explicit Drawing(const Gl& table)
      : gl(table), program(table, "flat", kVertex, kFragment), array(table) {}

  // Corners in clip space, z the reversed depth.
  void draw(const std::vector<std::array<float, 3>>& corners, const std::array<float, 4>& color) {
    const GlBuffer buffer = make_buffer(gl, corners);
    gl.VertexArrayVertexBuffer(array.id(), 0, buffer.id(), 0, sizeof corners[0]);
    gl.EnableVertexArrayAttrib(array.id(), 0);
    gl.VertexArrayAttribFormat(array.id(), 0, 3, GL_FLOAT, GL_FALSE, 0);
    gl.VertexArrayAttribBinding(array.id(), 0, 0);
    gl.ProgramUniform4fv(program.id(), program.uniform("color"), 1, color.data());
    program.use();
    array.bind();
    gl.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners.size()));
    gl.Finish();
  }

  const Gl& gl;
  GlProgram program;
  GlVertexArray array;
};

constexpr std::array<float, 4> kRed{1, 0, 0, 1};
constexpr std::array<float, 4> kGreen{0, 1, 0, 1};
constexpr Rgba8 kRed8{255, 0, 0, 255};
constexpr Rgba8 kGreen8{0, 255, 0, 255};
constexpr Rgba8 kNothing8{0, 0, 0, 0};

// Clip-space corners of pixel coordinates from the top left of a 16 x 16 frame.
std::array<float, 3> at_pixel(float x, float y, float depth) {
  return {x / 8 - 1, 1 - y / 8, depth};
}

// One triangle over the whole frame.
void draw_everywhere(const GlProgram& program) {
  const GlBuffer corners = make_buffer(
      gl(), std::vector{at_pixel(0, 0, 0.5f), at_pixel(0, 32, 0.5f), at_pixel(32, 0, 0.5f)});
  GlVertexArray array(gl());
  gl().VertexArrayVertexBuffer(array.id(), 0, corners.id(), 0, 12);
  gl().EnableVertexArrayAttrib(array.id(), 0);
  gl().VertexArrayAttribFormat(array.id(), 0, 3, GL_FLOAT, GL_FALSE, 0);
  program.use();
  array.bind();
  gl().DrawArrays(GL_TRIANGLES, 0, 3);
}

TEST(GlContext, NamesItsEngines) {
  EXPECT_EQ(parse_gl_engine("osmesa"), GlEngine::kOsmesa);
  EXPECT_EQ(parse_gl_engine("egl"), GlEngine::kEgl);
  EXPECT_THROW(parse_gl_engine("glx"), UsageError);
  EXPECT_THROW(parse_gl_engine(""), UsageError);
}

TEST(GlContext, KnowsItsRenderer) {
  EXPECT_NE(shared_context().renderer(), "");
  if (shared_context().renderer().find("llvmpipe") != std::string::npos) {
    EXPECT_GE(shared_context().n_threads(), 1);
  }
}

TEST(GlLoad, MissingFunctionIsNamed) {
  try {
    load_gl([](const char*) -> void (*)() { return nullptr; });
    FAIL() << "loaded nothing";
  } catch (const MachineError& error) {
    EXPECT_STREQ(error.what(), "GL: the driver has no function glGetString");
  }
}

TEST(GlFramebuffer, ClearColourReadsBack) {
  const GlFramebuffer target(gl(), 7, 5);
  target.bind();
  target.clear({1, 0.5f, 0, 0.2f});
  const ImageRgba8 image = target.read_rgba8();
  ASSERT_EQ(image.width_px, 7);
  ASSERT_EQ(image.height_px, 5);
  for (const Rgba8& pixel : image.pixels) EXPECT_EQ(pixel, (Rgba8{255, 128, 0, 51}));
  for (const float depth : target.read_depth().pixels) EXPECT_EQ(depth, 0);
}

// A triangle covers exactly the pixels whose centres lie inside. With corners (0,0) (16,0) (0,16)
// in pixels from the top left, those are x + y + 1 < 16; centres on the slanted edge may go either
// way, so the edge is moved off them by a quarter.
TEST(GlFramebuffer, TriangleCoversPixelCentresWithTopRowFirst) {
  const GlFramebuffer target(gl(), 16, 16);
  target.bind();
  target.clear({0, 0, 0, 0});
  Drawing(gl()).draw({at_pixel(0, 0, 0.5f), at_pixel(0, 15.75f, 0.5f), at_pixel(15.75f, 0, 0.5f)},
                     kRed);
  const ImageRgba8 image = target.read_rgba8();
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x)
      EXPECT_EQ(image.at(x, y), x + y + 1 < 15.75 ? kRed8 : kNothing8) << x << "," << y;
}

TEST(GlContext, KnowsThatItsRendererIsTheProcessor) {
  EXPECT_EQ(is_software_renderer(gl()), shared_context().n_threads() > 0);
}

// llvmpipe filters floats in single precision; whole numbers of 8 bits cannot show so much.
TEST(FiltersPrecisely, FloatsButNotBytes) {
  EXPECT_TRUE(filters_precisely(gl(), GL_RG32F));
  EXPECT_TRUE(filters_precisely(gl(), GL_RG16));
  EXPECT_FALSE(filters_precisely(gl(), GL_RG8));
  EXPECT_FALSE(filters_precisely(gl(), GL_RGBA8));
}

TEST(GlFramebuffer, NearerIsGreaterInAnyOrder) {
  const std::vector<std::array<float, 3>> near{at_pixel(0, 0, 0.8f), at_pixel(0, 16, 0.8f),
                                               at_pixel(16, 16, 0.8f)};
  const std::vector<std::array<float, 3>> far{at_pixel(0, 0, 0.3f), at_pixel(0, 32, 0.3f),
                                              at_pixel(32, 0, 0.3f)};
  const GlFramebuffer target(gl(), 16, 16);
  Drawing drawing(gl());
  for (const bool near_first : {true, false}) {
    target.bind();
    target.clear({0, 0, 0, 0});
    drawing.draw(near_first ? near : far, near_first ? kRed : kGreen);
    drawing.draw(near_first ? far : near, near_first ? kGreen : kRed);
    const ImageRgba8 image = target.read_rgba8();
    const Image<float> depth = target.read_depth();
    EXPECT_EQ(image.at(2, 12), kRed8);
    EXPECT_EQ(image.at(12, 2), kGreen8);
    EXPECT_FLOAT_EQ(depth.at(2, 12), 0.8f);
    EXPECT_FLOAT_EQ(depth.at(12, 2), 0.3f);
  }
}

TEST(GlFramebuffer, ClockwiseFacesAreCulled) {
  const GlFramebuffer target(gl(), 16, 16);
  target.bind();
  target.clear({0, 0, 0, 0});
  Drawing(gl()).draw({at_pixel(0, 0, 0.5f), at_pixel(32, 0, 0.5f), at_pixel(0, 32, 0.5f)}, kRed);
  for (const Rgba8& pixel : target.read_rgba8().pixels) EXPECT_EQ(pixel, kNothing8);
}

TEST(GlFramebuffer, IntegerAndFloatAttachments) {
  const GlFramebuffer target(gl(), 16, 16, {GL_RGBA32F, GL_R32UI});
  const GlProgram program(gl(), "ids", kVertex, R"(#version 450 core
layout(location = 0) out vec4 color;
layout(location = 1) out uint id;
void main() { color = vec4(-3.5, 1e6, gl_FragCoord.xy); id = 4000000000u; }
)");
  target.bind();
  target.clear({0, 0, 0, 0});
  draw_everywhere(program);
  EXPECT_EQ(target.read_uint(1).at(3, 4), 4000000000u);
  EXPECT_EQ(target.read_rgba_float(0).at(3, 4), (RgbaFloat{-3.5f, 1e6f, 3.5f, 11.5f}));
}

TEST(GlProgram, CompileErrorIsABugWithTheLog) {
  try {
    GlProgram(gl(), "broken", kVertex, "#version 450 core\nvoid main() { nonsense; }\n");
    FAIL() << "compiled";
  } catch (const BugError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("broken"), std::string::npos);
    EXPECT_NE(text.find("nonsense"), std::string::npos);
    EXPECT_EQ(text.find('\n'), std::string::npos);
  }
}

TEST(GlProgram, LinkErrorIsABug) {
  EXPECT_THROW(GlProgram(gl(), "unlinked", kVertex, R"(#version 450 core
in vec3 absent;
out vec4 result;
void main() { result = vec4(absent, 1); }
)"),
               BugError);
}

TEST(GlBuffer, WritesInsideOnly) {
  GlBuffer buffer(gl(), 8, nullptr, GL_DYNAMIC_STORAGE_BIT);
  const std::array<std::uint32_t, 2> values{7, 9};
  buffer.write(0, 8, values.data());
  EXPECT_THROW(buffer.write(4, 5, values.data()), BugError);
  EXPECT_THROW(buffer.write(9, 0, values.data()), BugError);
  std::uint32_t second = 0;
  gl().GetNamedBufferSubData(buffer.id(), 4, 4, &second);
  EXPECT_EQ(second, 9u);
}

TEST(GlBuffer, MoveKeepsOneOwner) {
  GlBuffer a(gl(), 4, nullptr);
  const GLuint id = a.id();
  GlBuffer b = std::move(a);
  EXPECT_EQ(b.id(), id);
  EXPECT_FALSE(a);
  {
    GlBuffer c;
    c = std::move(b);
    EXPECT_EQ(c.id(), id);
  }
  // The name was given back: reading it is an error now.
  std::uint32_t value = 0;
  gl().GetNamedBufferSubData(id, 0, 4, &value);
  EXPECT_EQ(gl().GetError(), static_cast<GLenum>(GL_INVALID_OPERATION));
}

TEST(GlTexture, WritesLayersAndReadsThemInAShader) {
  GlTexture texture = GlTexture::make_2d_array(gl(), GL_RGBA8, 2, 2, 3);
  texture.set_filter(GL_NEAREST);
  const std::vector<Rgba8> green(4, kGreen8);
  texture.write(0, 0, 2, 2, 2, GL_RGBA, GL_UNSIGNED_BYTE, green.data());
  const GlProgram program(gl(), "layer", kVertex, R"(#version 450 core
layout(binding = 0) uniform sampler2DArray layers;
layout(location = 0) out vec4 result;
void main() { result = texture(layers, vec3(0.5, 0.5, 2)); }
)");
  const GlFramebuffer target(gl(), 16, 16);
  target.bind();
  target.clear({0, 0, 0, 0});
  gl().BindTextureUnit(0, texture.id());
  draw_everywhere(program);
  for (const Rgba8& pixel : target.read_rgba8().pixels) EXPECT_EQ(pixel, kGreen8);
}

TEST(CheckGl, TellsThePlaceAndClearsTheError) {
  gl().Enable(0xffff);
  try {
    check_gl(gl(), "a test");
    FAIL() << "no error seen";
  } catch (const BugError& error) {
    EXPECT_STREQ(error.what(), "GL: error 0x0500: a test");
  }
  EXPECT_NO_THROW(check_gl(gl(), "a test"));
}

TEST(OutsideGlContext, BothEnginesDrawTheSame) {
  std::vector<ImageRgba8> images;
  std::vector<std::string> renderers;
  for (const GlEngine engine : {GlEngine::kOsmesa, GlEngine::kEgl}) {
    try {
      const GlContext context(engine);
      const GlFramebuffer target(context.gl(), 64, 64);
      target.bind();
      target.clear({0.1f, 0.2f, 0.3f, 0});
      Drawing(context.gl())
          .draw({{-0.9f, -0.7f, 0.5f}, {0.8f, -0.9f, 0.2f}, {0.1f, 0.9f, 0.7f}}, kRed);
      images.push_back(target.read_rgba8());
      renderers.push_back(context.renderer());
    } catch (const MachineError& error) {
      GTEST_SKIP() << error.what();
    }
  }
  if (renderers[0] != renderers[1]) GTEST_SKIP() << "another renderer: " << renderers[1];
  EXPECT_EQ(images[0].pixels, images[1].pixels);
}

}  // namespace
}  // namespace viewcell
