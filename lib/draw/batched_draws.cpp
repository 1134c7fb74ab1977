#include "draw/batched_draws.h"

#include <cstddef>

#include "scene/surface.h"

namespace viewcell {
namespace {

constexpr GLuint kPlacingBinding = 2;  // of the array; 0 and 1 are the vertices'

// Into a buffer that is made larger where it must be.
template <typename T>
void put(const Gl& gl, const std::vector<T>& values, GlBuffer& buffer) {
  const std::size_t n_bytes = values.size() * sizeof(T);
  if (buffer.n_bytes() < n_bytes)
    buffer = GlBuffer(gl, 2 * n_bytes, nullptr, GL_DYNAMIC_STORAGE_BIT);
  if (n_bytes > 0) buffer.write(0, n_bytes, values.data());
}

}  // namespace

BatchedDraws::BatchedDraws(const Gl& gl, const GlVertexArray& array) : gl_(gl), array_(array) {
  static_assert(sizeof(Command) == 20);
  for (GLuint k = 0; k < 4; ++k)
    array.set_attribute(kClipPlace + k, 4, GL_FLOAT, GL_FALSE,
                        offsetof(Placing, clip_from_model) + k * sizeof(glm::vec4),
                        kPlacingBinding);
  for (GLuint k = 0; k < 3; ++k)
    array.set_attribute(kNormalPlace + k, 3, GL_FLOAT, GL_FALSE,
                        offsetof(Placing, normal_matrix) + k * sizeof(glm::vec4), kPlacingBinding);
  gl.VertexArrayBindingDivisor(array.id(), kPlacingBinding, 1);
}

void BatchedDraws::clear() {
  placings_.clear(), runs_.clear(), first_command_.clear();
  n_triangles_ = 0;
}

std::uint32_t BatchedDraws::add_object(const glm::mat4& clip_from_model,
                                       const glm::mat3& normal_matrix) {
  placings_.push_back({clip_from_model, glm::mat3x4(normal_matrix)});
  return static_cast<std::uint32_t>(placings_.size() - 1);
}

void BatchedDraws::add_run(std::size_t batch, std::uint32_t object, std::uint32_t first_index,
                           std::uint32_t n_indices, std::int32_t first_vertex) {
  if (runs_.size() <= batch) runs_.resize(batch + 1);
  runs_[batch].push_back({n_indices, 1, first_index, first_vertex, object});
  n_triangles_ += n_indices / 3;
}

void BatchedDraws::upload() {
  std::vector<Command> all;
  for (const std::vector<Command>& runs : runs_) {
    first_command_.push_back(all.size());
    all.insert(all.end(), runs.begin(), runs.end());
  }
  put(gl_, placings_, placing_buffer_);
  put(gl_, all, command_buffer_);
  if (!placings_.empty())
    gl_.VertexArrayVertexBuffer(array_.id(), kPlacingBinding, placing_buffer_.id(), 0,
                                sizeof(Placing));
}

void BatchedDraws::draw(std::size_t batch) const {
  gl_.BindBuffer(GL_DRAW_INDIRECT_BUFFER, command_buffer_.id());
  gl_.MultiDrawElementsIndirect(
      GL_TRIANGLES, GL_UNSIGNED_INT,
      reinterpret_cast<const void*>(first_command_[batch] * sizeof(Command)),
      static_cast<GLsizei>(runs_[batch].size()), 0);
}

}  // namespace viewcell
