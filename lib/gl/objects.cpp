#include "gl/objects.h"

#include <algorithm>
#include <array>
#include <bit>
#include <iterator>

#include "base/error.h"

namespace viewcell {
namespace {

template <typename Create>
GLuint create(Create function) {
  GLuint id = 0;
  function(1, &id);
  return id;
}

void delete_buffer(const Gl& gl, GLuint id) {
  gl.DeleteBuffers(1, &id);
}
void delete_texture(const Gl& gl, GLuint id) {
  gl.DeleteTextures(1, &id);
}
void delete_vertex_array(const Gl& gl, GLuint id) {
  gl.DeleteVertexArrays(1, &id);
}
void delete_program(const Gl& gl, GLuint id) {
  gl.DeleteProgram(id);
}

GLuint create_texture(const Gl& gl, GLenum target) {
  GLuint id = 0;
  gl.CreateTextures(target, 1, &id);
  return id;
}

// The size in words. Throws MachineError when a side is beyond the driver's limit.
std::string check_size(const Gl& gl, int width_px, int height_px) {
  std::string size = std::to_string(width_px) + " x " + std::to_string(height_px);
  GLint most_px = 0;
  gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &most_px);
  if (std::max(width_px, height_px) > most_px)
    throw MachineError("GL: a texture of " + size + " is beyond the driver's " +
                       std::to_string(most_px));
  return size;
}

// Appends the driver's log to the message, on one line.
std::string one_line(std::string log) {
  while (!log.empty() && (log.back() == '\n' || log.back() == '\0')) log.pop_back();
  std::replace(log.begin(), log.end(), '\n', ';');
  return log;
}

void attach_shader(const Gl& gl, GLuint program, const std::string& name, GLenum stage,
                   const std::string& source) {
  const GLuint shader = gl.CreateShader(stage);
  const std::array<const GLchar*, 1> text{source.c_str()};
  gl.ShaderSource(shader, 1, text.data(), nullptr);
  gl.CompileShader(shader);
  GLint compiled = 0, length = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  gl.GetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 0)), '\0');
  if (length > 0) gl.GetShaderInfoLog(shader, length, nullptr, log.data());
  if (compiled) gl.AttachShader(program, shader);
  gl.DeleteShader(shader);  // lives on as long as the program holds it
  if (!compiled)
    throw BugError("GL: program " + name + ": " +
                   (stage == GL_VERTEX_SHADER ? "vertex" : "fragment") +
                   " shader: " + one_line(std::move(log)));
}

void link_program(const Gl& gl, GLuint program, const std::string& name) {
  gl.LinkProgram(program);
  GLint linked = 0, length = 0;
  gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked) return;
  gl.GetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 0)), '\0');
  if (length > 0) gl.GetProgramInfoLog(program, length, nullptr, log.data());
  throw BugError("GL: program " + name + ": link: " + one_line(std::move(log)));
}

}  // namespace

GlBuffer::GlBuffer(const Gl& gl, std::size_t n_bytes, const void* data, GLbitfield flags)
    : GlObject(gl, delete_buffer, create(gl.CreateBuffers)), n_bytes_(n_bytes) {
  // GL refuses storage of no bytes; an empty one is still a buffer to bind.
  gl.NamedBufferStorage(id(), static_cast<GLsizeiptr>(std::max<std::size_t>(n_bytes, 1)),
                        n_bytes > 0 ? data : nullptr, flags);
  check_gl(gl, "a buffer of " + std::to_string(n_bytes) + " bytes");
}

void GlBuffer::write(std::size_t offset, std::size_t n_bytes, const void* data) {
  VIEWCELL_CHECK(offset <= n_bytes_ && n_bytes <= n_bytes_ - offset, "offset =", offset,
                 "n =", n_bytes, "of", n_bytes_);
  if (n_bytes == 0) return;
  gl().NamedBufferSubData(id(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(n_bytes),
                          data);
}

GlTexture::GlTexture(const Gl& gl, GLenum target)
    : GlObject(gl, delete_texture, create_texture(gl, target)), target_(target) {}

GlTexture GlTexture::make_2d(const Gl& gl, GLenum internal_format, int width_px, int height_px) {
  const std::string size = check_size(gl, width_px, height_px);
  GlTexture texture(gl, GL_TEXTURE_2D);
  gl.TextureStorage2D(texture.id(), 1, internal_format, width_px, height_px);
  texture.set_filter(GL_LINEAR);
  check_gl(gl, "a texture of " + size);
  return texture;
}

GlTexture GlTexture::make_2d_array(const Gl& gl, GLenum internal_format, int width_px,
                                   int height_px, int n_layers) {
  GlTexture texture(gl, GL_TEXTURE_2D_ARRAY);
  gl.TextureStorage3D(texture.id(), 1, internal_format, width_px, height_px, n_layers);
  texture.set_filter(GL_LINEAR);
  check_gl(gl, "a texture of " + std::to_string(width_px) + " x " + std::to_string(height_px) +
                   " x " + std::to_string(n_layers));
  return texture;
}

GlTexture GlTexture::make_levels(const Gl& gl, GLenum internal_format, int width_px, int height_px,
                                 int n_levels) {
  const std::string size = check_size(gl, width_px, height_px);
  GlTexture texture(gl, GL_TEXTURE_2D);
  gl.TextureStorage2D(texture.id(), n_levels, internal_format, width_px, height_px);
  gl.TextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl.TextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  check_gl(gl, "a texture of " + size);
  return texture;
}

GlTexture GlTexture::make_mipmapped(const Gl& gl, GLenum internal_format, int width_px,
                                    int height_px, const void* texels) {
  const int n_levels = std::bit_width(static_cast<unsigned>(std::max(width_px, height_px)));
  GlTexture texture = make_levels(gl, internal_format, width_px, height_px, n_levels);
  texture.write_level(0, width_px, height_px, texels);
  gl.GenerateTextureMipmap(texture.id());
  check_gl(gl, "averaging a texture");
  return texture;
}

void GlTexture::write_level(int level, int width_px, int height_px, const void* texels) {
  gl().TextureSubImage2D(id(), level, 0, 0, width_px, height_px, GL_RGBA, GL_UNSIGNED_BYTE, texels);
}

GlTexture GlTexture::make_buffer_texture(const Gl& gl, GLenum internal_format,
                                         const GlBuffer& buffer) {
  GlTexture texture(gl, GL_TEXTURE_BUFFER);
  gl.TextureBuffer(texture.id(), internal_format, buffer.id());
  check_gl(gl, "a buffer texture");
  return texture;
}

void GlTexture::set_filter(GLint filter) {
  gl().TextureParameteri(id(), GL_TEXTURE_MIN_FILTER, filter);
  gl().TextureParameteri(id(), GL_TEXTURE_MAG_FILTER, filter);
  gl().TextureParameteri(id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl().TextureParameteri(id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void GlTexture::write(int x, int y, int layer, int width_px, int height_px, GLenum format,
                      GLenum type, const void* texels) {
  if (target_ == GL_TEXTURE_2D_ARRAY)
    gl().TextureSubImage3D(id(), 0, x, y, layer, width_px, height_px, 1, format, type, texels);
  else
    gl().TextureSubImage2D(id(), 0, x, y, width_px, height_px, format, type, texels);
}

GlProgram::GlProgram(const Gl& gl, const std::string& name, const std::string& vertex_source,
                     const std::string& fragment_source)
    : GlObject(gl, delete_program, gl.CreateProgram()) {
  attach_shader(gl, id(), name, GL_VERTEX_SHADER, vertex_source);
  attach_shader(gl, id(), name, GL_FRAGMENT_SHADER, fragment_source);
  link_program(gl, id(), name);
}

GlVertexArray::GlVertexArray(const Gl& gl)
    : GlObject(gl, delete_vertex_array, create(gl.CreateVertexArrays)) {}

void GlVertexArray::set_attribute(GLuint place, GLint n, GLenum type, GLboolean normalised,
                                  std::size_t offset, GLuint binding) const {
  gl().EnableVertexArrayAttrib(id(), place);
  gl().VertexArrayAttribBinding(id(), place, binding);
  gl().VertexArrayAttribFormat(id(), place, n, type, normalised, static_cast<GLuint>(offset));
}

}  // namespace viewcell
