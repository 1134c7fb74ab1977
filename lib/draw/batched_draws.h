// Runs of triangles of many objects, drawn by one call each that they share.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "gl/objects.h"

namespace viewcell {

/// Collects what a frame draws, by batch, and draws it by glMultiDrawElementsIndirect: commands in
/// a buffer, and where objects stand as attributes that go by object (surface_vertex_glsl with
/// Placing::attributes). Drawing thread only.
class BatchedDraws {
 public:
  /// Attributes of placings are set on the array, which must outlive this.
  BatchedDraws(const Gl& gl, const GlVertexArray& array);

  /// Forgets what was collected.
  void clear();
  /// The object's number.
  std::uint32_t add_object(const glm::mat4& clip_from_model, const glm::mat3& normal_matrix);
  /// Batches are numbered from 0 by the caller; indices and vertices as in the array's buffers.
  void add_run(std::size_t batch, std::uint32_t object, std::uint32_t first_index,
               std::uint32_t n_indices, std::int32_t first_vertex);
  /// Once all is collected, before draw(): one upload each of objects and commands.
  void upload();
  /// The batch's runs, in the order in which they came. The array must be bound, and a program.
  void draw(std::size_t batch) const;

  std::size_t n_batches() const { return runs_.size(); }
  std::size_t n_triangles() const { return n_triangles_; }

 private:
  struct Placing {
    glm::mat4 clip_from_model;
    glm::mat3x4 normal_matrix;  // three columns, each padded
  };
  // As GL reads it.
  struct Command {
    std::uint32_t n_indices, n_instances, first_index;
    std::int32_t first_vertex;
    std::uint32_t object;
  };

  const Gl& gl_;
  const GlVertexArray& array_;
  std::vector<Placing> placings_;
  std::vector<std::vector<Command>> runs_;  // by batch
  std::vector<std::size_t> first_command_;  // by batch, in the buffer
  std::size_t n_triangles_ = 0;
  GlBuffer placing_buffer_, command_buffer_;
};

}  // namespace viewcell
