// Draws a scene's original geometry, and levels of it, lit.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "draw/frame_plan.h"
#include "draw/mesh_levels.h"
#include "gl/framebuffer.h"
#include "gl/objects.h"
#include "mesh/clusters.h"

namespace viewcell {

/// How objects look; the default is how the scene says.
struct DrawStyle {
  std::optional<glm::vec3> base_color;  ///< instead of the materials' (linear)
  bool cull_back_faces = true;          ///< but for materials that are double-sided
};

/// Every mesh once in GL memory (20 bytes a vertex, 12 a triangle), plain material colours, back
/// faces culled unless the material is double-sided. Frames are encoded sRGB (draw/shading.h);
/// alpha is 1 on objects, 0 on ground and sky. Relies on, and leaves, the state of GlContext.
class SceneRenderer {
 public:
  /// levels: by MeshId. gl and scene must outlive this. One thread.
  SceneRenderer(const Gl& gl, const Scene& scene, const std::vector<MeshLevels>& levels);

  /// Binds and clears the target and draws the ground. The ground neither tests nor writes depth:
  /// the eye is above it, so objects cover it, and the parts of objects that are below it look the
  /// same in every mode.
  void draw_background(const GlFramebuffer& target, const glm::dmat4& clip_from_world) const;
  /// Into the bound framebuffer.
  void draw_objects(const glm::dmat4& clip_from_world, std::span<const ObjectDraw> draws,
                    const DrawStyle& style = {}) const;
  /// The original of each object, front to back as given, without the clusters of triangles that
  /// lie outside the frustum or turn their backs on the eye [Chen06 5.2.2, run-time back-face
  /// culling]. Returns the triangles drawn.
  std::size_t draw_clusters(const Camera& camera, std::span<const ObjectId> objects,
                            const DrawStyle& style = {}) const;

 private:
  struct Range {
    GLsizei n_indices = 0;
    std::size_t index_offset = 0;  // bytes
    GLint first_vertex = 0;
  };
  struct Program {
    GlProgram program;
    GLint clip_from_model = -1, normal_matrix = -1, base_color = -1;
  };
  struct Object {
    glm::dmat4 world_from_model;
    glm::mat3 rotation;
    glm::vec3 base_color;
    MeshId mesh{};
    bool double_sided = false;
  };

  void upload(const std::vector<MeshLevels>& levels);
  const Program& use_program(const Object& object, const DrawStyle& style,
                             const Program* current) const;
  void set_object(const Program& program, const Object& object, const glm::dmat4& clip_from_world,
                  const DrawStyle& style) const;
  Program make_program(const Lighting& lighting, bool double_sided) const;

  const Gl& gl_;
  std::vector<Object> objects_;
  std::vector<std::vector<Range>> ranges_;         // by mesh, by level
  std::vector<Range> cluster_ranges_;              // by mesh: level 0 in the order of its clusters
  std::vector<std::vector<Cluster>> clusters_;     // by mesh, model space
  std::vector<const SceneObject*> scene_objects_;  // by object
  GlBuffer vertices_, indices_;
  GlVertexArray array_;
  Program single_sided_, double_sided_;
  GlProgram ground_program_;
  GlBuffer ground_vertices_;
  GlVertexArray ground_array_;
  glm::dvec3 ground_centre_;
  std::array<float, 4> sky_;
};

/// The same picture shifted by so many pixels (right, down): for the yardstick (play/timeline.h).
glm::dmat4 shift_pixels(const glm::dmat4& clip_from_world, const glm::dvec2& shift_px, int width_px,
                        int height_px);

}  // namespace viewcell
