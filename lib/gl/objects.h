// GL objects that delete themselves. Move-only; a moved-from object holds nothing. Each must die
// before its context, on the thread on which that is current.
#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "gl/gl.h"

namespace viewcell {

/// One GL name and how it is deleted; the base of the types below.
class GlObject {
 public:
  GlObject(GlObject&& other) noexcept { *this = std::move(other); }
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(gl_, other.gl_), std::swap(delete_, other.delete_), std::swap(id_, other.id_);
    return *this;
  }
  GlObject(const GlObject&) = delete;
  GlObject& operator=(const GlObject&) = delete;
  ~GlObject() {
    if (id_) delete_(*gl_, id_);
  }
  GLuint id() const { return id_; }
  explicit operator bool() const { return id_ != 0; }

 protected:
  using Delete = void (*)(const Gl&, GLuint);
  GlObject() = default;
  GlObject(const Gl& gl, Delete how, GLuint id) : gl_(&gl), delete_(how), id_(id) {}
  const Gl& gl() const { return *gl_; }

 private:
  const Gl* gl_ = nullptr;
  Delete delete_ = nullptr;
  GLuint id_ = 0;
};

/// Immutable storage of n_bytes (at least 1 is kept). data may be null: undefined contents.
class GlBuffer : public GlObject {
 public:
  GlBuffer() = default;
  /// flags: of glNamedBufferStorage; 0 = written once, here.
  GlBuffer(const Gl& gl, std::size_t n_bytes, const void* data, GLbitfield flags = 0);
  /// Needs GL_DYNAMIC_STORAGE_BIT. [offset, offset + n_bytes) must lie inside.
  void write(std::size_t offset, std::size_t n_bytes, const void* data);
  std::size_t n_bytes() const { return n_bytes_; }

 private:
  std::size_t n_bytes_ = 0;
};

/// A buffer that holds a contiguous range (std::vector, std::array, std::span) of plain values.
template <typename Range>
GlBuffer make_buffer(const Gl& gl, const Range& range, GLbitfield flags = 0) {
  return GlBuffer(gl, std::size(range) * sizeof(*std::data(range)), std::data(range), flags);
}

/// Immutable 2D textures, 2D arrays and buffer textures. 2D ones start bilinear, clamped to the
/// edge and without mipmaps.
class GlTexture : public GlObject {
 public:
  GlTexture() = default;
  /// Throws MachineError when a side is beyond the driver's limit, as make_mipmapped does.
  static GlTexture make_2d(const Gl& gl, GLenum internal_format, int width_px, int height_px);
  static GlTexture make_2d_array(const Gl& gl, GLenum internal_format, int width_px, int height_px,
                                 int n_layers);
  /// A whole RGBA8 picture, rows from v = 0 up, repeated in both directions, filtered linearly
  /// within and between mipmaps, which the driver averages (in linear light, with a format of
  /// sRGB). Throws MachineError when a side is beyond the driver's limit.
  static GlTexture make_mipmapped(const Gl& gl, GLenum internal_format, int width_px, int height_px,
                                  const void* texels);
  /// Room for a whole RGBA8 picture and n_levels - 1 smaller ones (write_level), repeated in both
  /// directions, filtered linearly within and between them. Throws MachineError as above.
  static GlTexture make_levels(const Gl& gl, GLenum internal_format, int width_px, int height_px,
                               int n_levels);
  /// Texels are the buffer's contents, which must outlive the texture.
  static GlTexture make_buffer_texture(const Gl& gl, GLenum internal_format,
                                       const GlBuffer& buffer);
  /// GL_NEAREST or GL_LINEAR, for both magnification and minification.
  void set_filter(GLint filter);
  /// Rows from the texture's row 0 on; layer is 0 but for arrays.
  void write(int x, int y, int layer, int width_px, int height_px, GLenum format, GLenum type,
             const void* texels);
  /// A whole level of RGBA8, rows from v = 0 up.
  void write_level(int level, int width_px, int height_px, const void* texels);

 private:
  GlTexture(const Gl& gl, GLenum target);
  GLenum target_ = 0;
};

/// A linked program of a vertex and a fragment shader.
class GlProgram : public GlObject {
 public:
  GlProgram() = default;
  /// Sources begin with their #version line. Throws BugError with name and the driver's log.
  GlProgram(const Gl& gl, const std::string& name, const std::string& vertex_source,
            const std::string& fragment_source);
  void use() const { gl().UseProgram(id()); }
  /// -1 when the program does not use it; setting -1 is allowed and does nothing.
  GLint uniform(const char* name) const { return gl().GetUniformLocation(id(), name); }
};

/// A vertex array object; buffers are attached by the caller through glVertexArray*.
class GlVertexArray : public GlObject {
 public:
  GlVertexArray() = default;
  explicit GlVertexArray(const Gl& gl);
  void bind() const { gl().BindVertexArray(id()); }
  /// Attribute `place`: n values of a type from a buffer binding, `offset` bytes into each vertex.
  /// normalised: integers become [-1, 1] or [0, 1].
  void set_attribute(GLuint place, GLint n, GLenum type, GLboolean normalised, std::size_t offset,
                     GLuint binding = 0) const;
};

}  // namespace viewcell
