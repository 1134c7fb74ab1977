// Draws a scene's original geometry, and levels of it, lit.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "draw/batched_draws.h"
#include "draw/frame_plan.h"
#include "draw/mesh_levels.h"
#include "gl/framebuffer.h"
#include "gl/objects.h"
#include "mesh/clusters.h"
#include "scene/surface.h"

namespace viewcell {

/// How objects look; the default is how the scene says.
struct DrawStyle {
  std::optional<glm::vec3> base_color;  ///< instead of the materials' (linear)
  bool cull_back_faces = true;          ///< but for materials that are double-sided
};

/// Every mesh once in GL memory (20 bytes a vertex, 36 where some mesh has pictures or colours, 12
/// a triangle), every picture once a wrap, materials as scene/surface.h has them, back faces culled
/// unless the material is double-sided. Frames are encoded sRGB (draw/shading.h);
/// alpha is 1 on objects, 0 on ground and sky. Relies on, and leaves, the state of GlContext.
class SceneRenderer {
 public:
  /// levels: by MeshId. The scene's pictures must be loaded (scene/pictures.h). gl and scene must
  /// outlive this. One thread.
  SceneRenderer(const Gl& gl, const Scene& scene, const std::vector<MeshLevels>& levels);

  /// Binds and clears the target and draws the ground. The ground neither tests nor writes depth:
  /// the eye is above it, so objects cover it, and the parts of objects that are below it look the
  /// same in every mode.
  void draw_background(const GlFramebuffer& target, const glm::dmat4& clip_from_world) const;
  /// Into the bound framebuffer.
  void draw_objects(const glm::dmat4& clip_from_world, std::span<const ObjectDraw> draws,
                    const DrawStyle& style = {}) const;
  struct Drawn {
    std::size_t n_triangles = 0;
    std::size_t n_calls = 0;  ///< one for each material
  };
  /// The original of each object, front to back as given, without the clusters of triangles that
  /// lie outside the frustum or turn their backs on the eye [Chen06 5.2.2, run-time back-face
  /// culling]; those of one material by one call. The same pixels as draw_objects.
  Drawn draw_clusters(const Camera& camera, std::span<const ObjectId> objects,
                      const DrawStyle& style = {});

 private:
  struct Range {
    std::int32_t slot = 0;
    GLsizei n_indices = 0;
    std::size_t index_offset = 0;  // bytes
    GLint first_vertex = 0;
  };
  struct Program {
    GlProgram program;
    bool is_double_sided = false;
    GLint clip_from_model = -1, normal_matrix = -1, base_color = -1, emissive = -1, opacity = -1,
          alpha_cutoff = -1;
  };
  // A material on a mesh.
  struct Look {
    const Material* material;
    const Program* program;
    const Program* plain;    // the same sides, without picture, colours and holes
    const Program* batched;  // as program, and as plain, with placings as attributes
    const Program* batched_plain;
    GLuint texture;  // 0: none
  };
  struct Object {
    glm::dmat4 world_from_model;
    glm::mat3 rotation;
    MeshId mesh{};
    std::vector<Look> looks;  // by slot of its mesh
  };
  // A run of clusters of one slot.
  struct ClusterRange {
    Range range;
    std::vector<Cluster> clusters;  // model space
  };
  struct DrawState {
    const Program* program = nullptr;
    GLuint texture = 0;
  };

  void upload(const std::vector<MeshLevels>& levels);
  void add_object(const Scene& scene, const SceneObject& object);
  GLuint texture_for(const Scene& scene, const Material& material);
  const Program& program_for(const Lighting& lighting, const SurfaceKind& kind, Placing placing);
  void use(const Look& look, const Program& program, const DrawStyle& style,
           DrawState& state) const;
  void place(const Object& object, const Program& program, const glm::dmat4& clip_from_world) const;
  void collect_clusters(const Camera& camera, const Frustum& frustum, ObjectId object,
                        std::vector<const Look*>& batches);
  void draw_range(const Range& range, std::uint32_t first_triangle, std::uint32_t n) const;

  const Gl& gl_;
  std::vector<Object> objects_;
  std::vector<std::vector<std::vector<Range>>> ranges_;  // by mesh, by level, by slot
  std::vector<std::vector<ClusterRange>> clusters_;      // by mesh, by slot
  std::vector<const SceneObject*> scene_objects_;        // by object
  GlBuffer vertices_, dressed_, indices_;
  GlVertexArray array_;
  BatchedDraws batched_draws_;
  std::map<std::pair<SurfaceKind, Placing>, Program> programs_;
  std::map<std::tuple<int, Wrap, Wrap>, GlTexture> textures_;  // by picture and wraps
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
