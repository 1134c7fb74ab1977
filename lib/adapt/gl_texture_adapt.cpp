#include "adapt/gl_texture_adapt.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <type_traits>

#include "adapt/adapt_packs.h"
#include "adapt/gl_adapt_batch.h"
#include "adapt/gl_adapt_shaders.h"
#include "base/error.h"
#include "gl/context.h"
#include "gl/filter_precision.h"
#include "gl/framebuffer.h"

namespace viewcell {
namespace {

struct TexelFormat {
  GLenum internal_format, format, type;
};
template <typename Texel>
constexpr TexelFormat kTexelFormat{};
template <>
constexpr TexelFormat kTexelFormat<glm::vec2>{GL_RG32F, GL_RG, GL_FLOAT};
template <>
constexpr TexelFormat kTexelFormat<Unorm16Texel>{GL_RG16, GL_RG, GL_UNSIGNED_SHORT};
template <>
constexpr TexelFormat kTexelFormat<Unorm8Texel>{GL_RG8, GL_RG, GL_UNSIGNED_BYTE};
template <>
constexpr TexelFormat kTexelFormat<HalfTexel>{GL_RG16F, GL_RG, GL_HALF_FLOAT};
template <>
constexpr TexelFormat kTexelFormat<Rgba8>{GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE};
constexpr TexelFormat kOwnerFormat{GL_R16UI, GL_RED_INTEGER, GL_UNSIGNED_SHORT};

// GL's row 0 is the bottom; an Image's is the top.
template <typename Pixel>
Image<Pixel> flip_rows(const Image<Pixel>& image) {
  Image<Pixel> out(image.width_px, image.height_px);
  for (int y = 0; y < image.height_px; ++y)
    std::copy_n(&image.at(0, y), image.width_px, &out.at(0, image.height_px - 1 - y));
  return out;
}

template <typename Pixel>
void write_texture(const Gl& gl, const GlTexture& texture, const TexelFormat& format,
                   const Image<Pixel>& rows_up) {
  gl.TextureSubImage2D(texture.id(), 0, 0, 0, rows_up.width_px, rows_up.height_px, format.format,
                       format.type, rows_up.pixels.data());
}

template <typename Pixel>
Image<Pixel> read_texture(const Gl& gl, const GlTexture& texture, const TexelFormat& format,
                          int width_px, int height_px) {
  Image<Pixel> rows_up(width_px, height_px);
  gl.GetTextureImage(texture.id(), 0, format.format, format.type,
                     static_cast<GLsizei>(rows_up.pixels.size() * sizeof(Pixel)),
                     rows_up.pixels.data());
  check_gl(gl, "reading a texture back");
  return flip_rows(rows_up);
}

// GL counts what it reads back in 31 bits, and llvmpipe crashes on a texture that large.
void check_bytes(std::size_t n) {
  if (n > std::numeric_limits<GLsizei>::max())
    throw MachineError("GL: a texture of " + std::to_string(n) +
                       " bytes is beyond what GL reads back (2 GiB): take fewer texels, or "
                       "the engine cpu");
}

// While it lives, fragments are written whatever their depth and side.
class FlatDrawing {
 public:
  explicit FlatDrawing(const Gl& gl) : gl_(gl) {
    gl_.Disable(GL_DEPTH_TEST), gl_.Disable(GL_CULL_FACE);
  }
  ~FlatDrawing() {
    mask_owners(false);
    gl_.Enable(GL_DEPTH_TEST), gl_.Enable(GL_CULL_FACE);
  }
  FlatDrawing(const FlatDrawing&) = delete;
  FlatDrawing& operator=(const FlatDrawing&) = delete;

  void mask_owners(bool mask) {
    if (mask == masks_owners_) return;
    const GLboolean write = mask ? GL_FALSE : GL_TRUE;
    gl_.ColorMaski(1, write, write, write, write);
    masks_owners_ = mask;
  }

 private:
  const Gl& gl_;
  bool masks_owners_ = false;
};

}  // namespace

template <typename Texel>
class GlTextureAdapter<Texel>::Engine {
 public:
  static constexpr bool kIsIndex = !std::is_same_v<Texel, Rgba8>;

  Engine(const Gl& gl, const AdaptationLog& log, const Image<Texel>& image,
         const Image<std::uint16_t>& owners_up, std::size_t n_collapsed,
         const GlAdaptOptions& options)
      : gl_(gl),
        log_(log),
        width_px_(image.width_px),
        height_px_(image.height_px),
        options_(options),
        programs_(make_adapt_programs(
            gl, width_px_, height_px_,
            {.n_channels = kIsIndex ? 2 : 4,
             .rounds_to_half = std::is_same_v<Texel, HalfTexel>,
             .filters = filters_precisely(gl, kTexelFormat<Texel>.internal_format)})),
        array_(gl),
        owned_array_(gl),
        builder_(log, owners_up, kIsIndex, options.copies_boxes.value_or(is_software_renderer(gl))),
        n_collapsed_(n_collapsed) {
    check_bytes(image.pixels.size() * sizeof(Texel));
    const Image<Texel> rows_up = flip_rows(image);
    for (GlFramebuffer& target : targets_) {
      target = GlFramebuffer(gl, width_px_, height_px_,
                             {kTexelFormat<Texel>.internal_format, kOwnerFormat.internal_format});
      for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        gl.TextureParameteri(target.color(0).id(), filter, GL_LINEAR);
      write_texture(gl, target.color(0), kTexelFormat<Texel>, rows_up);
      write_texture(gl, target.color(1), kOwnerFormat, owners_up);
    }
    set_attributes();
    check_gl(gl, "making the texture adapter");
  }

  void go_to(std::size_t n_collapsed);
  Image<Texel> image() const {
    return read_texture<Texel>(gl_, current().color(0), kTexelFormat<Texel>, width_px_, height_px_);
  }
  Image<std::uint16_t> owners() const {
    return read_texture<std::uint16_t>(gl_, current().color(1), kOwnerFormat, width_px_,
                                       height_px_);
  }
  const GlFramebuffer& current() const { return targets_[current_]; }
  std::size_t n_collapsed() const { return n_collapsed_; }
  const GlAdaptCounts& counts() const { return counts_; }

 private:
  void set_attributes();
  void draw(const AdaptBatch& batch);
  void draw_pack(const PackDraws& draws, FlatDrawing& drawing);
  void copy_boxes(std::span<const TexelBox> boxes);
  void draw_elements(const GlProgram& program, const DrawRange& range);

  const Gl& gl_;
  const AdaptationLog& log_;
  int width_px_, height_px_;
  GlAdaptOptions options_;
  AdaptPrograms programs_;
  GlVertexArray array_, owned_array_;
  std::array<GlFramebuffer, 2> targets_;
  std::size_t current_ = 0;  // the one that is whole
  AdaptBatchBuilder builder_;
  std::size_t n_collapsed_;
  GlAdaptCounts counts_;
};

template <typename Texel>
void GlTextureAdapter<Texel>::Engine::set_attributes() {
  array_.set_attribute(0, 2, GL_FLOAT, GL_FALSE, offsetof(AdaptVertex, to));
  array_.set_attribute(1, 2, GL_FLOAT, GL_FALSE, offsetof(AdaptVertex, from));
  owned_array_.set_attribute(0, 2, GL_FLOAT, GL_FALSE, offsetof(OwnedVertex, to));
  owned_array_.set_attribute(1, 2, GL_FLOAT, GL_FALSE, offsetof(OwnedVertex, local));
  owned_array_.set_attribute(2, 4, GL_FLOAT, GL_FALSE, offsetof(OwnedVertex, origin));
  owned_array_.set_attribute(3, 4, GL_FLOAT, GL_FALSE, offsetof(OwnedVertex, lo));
  owned_array_.set_attribute(4, 1, GL_FLOAT, GL_FALSE, offsetof(OwnedVertex, side));
  gl_.EnableVertexArrayAttrib(owned_array_.id(), 5);
  gl_.VertexArrayAttribBinding(owned_array_.id(), 5, 0);
  gl_.VertexArrayAttribIFormat(owned_array_.id(), 5, 4, GL_UNSIGNED_INT,
                               offsetof(OwnedVertex, owner));
}

template <typename Texel>
void GlTextureAdapter<Texel>::Engine::go_to(std::size_t n_collapsed) {
  const bool is_collapse = n_collapsed > n_collapsed_;
  const AdaptPacks packs =
      pack_adaptations(log_, n_collapsed_ * log_.steps_per_collapse,
                       n_collapsed * log_.steps_per_collapse, width_px_, height_px_, options_.pack);
  for (std::size_t p = 0; p < packs.size(); ++p) {
    builder_.add_pack(
        std::span(packs.order).subspan(packs.first[p], packs.first[p + 1] - packs.first[p]),
        is_collapse);
    if (builder_.n_bytes() >= options_.batch_bytes) draw(builder_.take());
  }
  draw(builder_.take());
  n_collapsed_ = n_collapsed;
  counts_.n_adaptations += packs.order.size();
  counts_.n_packs += packs.size();
  check_gl(gl_, "adapting a texture");
}

template <typename Texel>
void GlTextureAdapter<Texel>::Engine::draw(const AdaptBatch& batch) {
  if (batch.packs.empty()) return;
  const GlBuffer vertices = make_buffer(gl_, batch.vertices);
  const GlBuffer indices = make_buffer(gl_, batch.indices);
  const GlBuffer owned = make_buffer(gl_, batch.owned);
  const GlBuffer corners = make_buffer(gl_, batch.star_corners);
  const GlTexture star = GlTexture::make_buffer_texture(gl_, GL_RG32F, corners);
  gl_.VertexArrayVertexBuffer(array_.id(), 0, vertices.id(), 0, sizeof(AdaptVertex));
  gl_.VertexArrayElementBuffer(array_.id(), indices.id());
  gl_.VertexArrayVertexBuffer(owned_array_.id(), 0, owned.id(), 0, sizeof(OwnedVertex));
  gl_.BindTextureUnit(2, star.id());
  FlatDrawing drawing(gl_);
  for (const PackDraws& draws : batch.packs) {
    copy_boxes(std::span(batch.boxes).subspan(draws.boxes.first, draws.boxes.n));
    draw_pack(draws, drawing);
  }
  counts_.n_bytes += batch.n_bytes();
}

// From the texture that is whole to the other.
template <typename Texel>
void GlTextureAdapter<Texel>::Engine::copy_boxes(std::span<const TexelBox> boxes) {
  const GlFramebuffer& source = targets_[current_];
  const GlFramebuffer& target = targets_[1 - current_];
  for (const TexelBox& box : boxes)
    for (std::size_t k = 0; k < (box.has_owners ? 2u : 1u); ++k)
      gl_.CopyImageSubData(source.color(k).id(), GL_TEXTURE_2D, 0, box.x, box.y, 0,
                           target.color(k).id(), GL_TEXTURE_2D, 0, box.x, box.y, 0, box.width_px,
                           box.height_px, 1);
}

template <typename Texel>
void GlTextureAdapter<Texel>::Engine::draw_pack(const PackDraws& draws, FlatDrawing& drawing) {
  const GlFramebuffer& source = targets_[current_];
  current_ = 1 - current_;
  targets_[current_].bind();
  gl_.BindTextureUnit(0, source.color(0).id());
  gl_.BindTextureUnit(1, source.color(1).id());
  if (draws.copy_owned.n + draws.copy_values.n + draws.sample.n > 0) array_.bind();
  if (draws.copy_owned.n > 0) {
    drawing.mask_owners(false);
    draw_elements(programs_.copy_owned, draws.copy_owned);
  }
  if (draws.copy_values.n + draws.sample.n > 0) drawing.mask_owners(true);
  draw_elements(programs_.copy_values, draws.copy_values);
  draw_elements(programs_.sample, draws.sample);
  if (draws.sample_owned.n == 0) return;
  drawing.mask_owners(false);
  programs_.sample_owned.use();
  owned_array_.bind();
  gl_.DrawArrays(GL_TRIANGLES, static_cast<GLint>(draws.sample_owned.first),
                 static_cast<GLsizei>(draws.sample_owned.n));
  ++counts_.n_draws;
}

template <typename Texel>
void GlTextureAdapter<Texel>::Engine::draw_elements(const GlProgram& program,
                                                    const DrawRange& range) {
  if (range.n == 0) return;
  program.use();
  gl_.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(range.n), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(range.first * sizeof(std::uint32_t)));
  ++counts_.n_draws;
}

template <typename Texel>
GlTextureAdapter<Texel>::GlTextureAdapter(const Gl& gl, const AdaptationLog& log,
                                          const Image<Texel>& image, const LevelCharts& charts,
                                          std::size_t n_collapsed, const GlAdaptOptions& options)
    : engine_(std::make_unique<Engine>(
          gl, log, image, flip_rows(make_texel_owners(charts, image.width_px, image.height_px)),
          n_collapsed, options)) {}

template <typename Texel>
GlTextureAdapter<Texel>::~GlTextureAdapter() = default;
template <typename Texel>
GlTextureAdapter<Texel>::GlTextureAdapter(GlTextureAdapter&&) noexcept = default;

template <typename Texel>
void GlTextureAdapter<Texel>::go_to(std::size_t n_collapsed) {
  engine_->go_to(n_collapsed);
}
template <typename Texel>
std::size_t GlTextureAdapter<Texel>::n_collapsed() const {
  return engine_->n_collapsed();
}
template <typename Texel>
Image<Texel> GlTextureAdapter<Texel>::image() const {
  return engine_->image();
}
template <typename Texel>
const GlTexture& GlTextureAdapter<Texel>::texture() const {
  return engine_->current().color(0);
}
template <typename Texel>
Image<std::uint16_t> GlTextureAdapter<Texel>::owners() const {
  return engine_->owners();
}
template <typename Texel>
const GlAdaptCounts& GlTextureAdapter<Texel>::counts() const {
  return engine_->counts();
}

template class GlTextureAdapter<glm::vec2>;
template class GlTextureAdapter<Unorm16Texel>;
template class GlTextureAdapter<Unorm8Texel>;
template class GlTextureAdapter<HalfTexel>;
template class GlTextureAdapter<Rgba8>;

}  // namespace viewcell
