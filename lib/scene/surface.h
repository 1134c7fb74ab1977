// What a point of an object's surface shows: the one place that says so for the engines that cast
// rays, and beside it the same as shader text for those that rasterise.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace viewcell {

/// A hit: weights of the triangle's corners 1 and 2.
struct SurfacePoint {
  std::uint32_t triangle = 0;
  float u = 0, v = 0;
};

/// The ray of a pixel and those of the two beside it in its block of 2 x 2, from which graphics
/// hardware takes how far a picture moves from one pixel to the next. In the mesh's space,
/// directions of any length; of a surface without pictures, anything.
struct PixelRays {
  glm::vec3 origin{0}, direction{0}, beside{0}, above{0};
};

/// Which of two neighbours is in the same block of 2 x 2 as pixel x (or y): 1 or -1 away.
inline int step_in_block(int x) {
  return x % 2 == 0 ? 1 : -1;
}

/// One object as rays meet it. Cheap to make and to copy; the scene must outlive it.
class ObjectSurface {
 public:
  ObjectSurface(const Scene& scene, const SceneObject& object);

  /// Whether a ray that hits there goes on: backs of single-sided materials, holes of masks.
  bool is_passed(const SurfacePoint& at, bool is_back, const PixelRays& rays) const;
  /// Linear; what the light leaves of the base colour, and what shines of itself. is_back: seen
  /// from there; then the normal is turned round.
  glm::vec3 color(const SurfacePoint& at, bool is_back, const PixelRays& rays) const;

  /// Whether some point asks is_passed() for more than its side, or sides differ from one another.
  bool needs_passing() const { return needs_passing_; }
  bool is_double_sided() const { return is_double_sided_; }
  bool has_pictures() const { return has_pictures_; }

 private:
  const Material& material_at(const Triangle& t) const;
  glm::vec4 base_color(const Material& material, const SurfacePoint& at,
                       const PixelRays& rays) const;
  glm::vec4 picture_at(const Material& material, const SurfacePoint& at,
                       const PixelRays& rays) const;

  const Scene* scene_;
  const SceneObject* object_;
  const SceneMesh* mesh_;
  glm::mat3 world_from_model_;  // of normals
  bool needs_passing_ = false, is_double_sided_ = false, has_pictures_ = false;
};

/// The material's colour where there is nothing else to go by: its picture's mean.
glm::vec3 mean_color(const Scene& scene, const Material& material);

/// What a rasteriser's program must know of a material on a mesh.
struct SurfaceKind {
  bool has_picture = false, has_colors = false, is_masked = false, is_unlit = false;
  bool is_emissive = false, is_double_sided = false;
  auto operator<=>(const SurfaceKind&) const = default;
};
SurfaceKind surface_kind(const Material& material, const SceneMesh& mesh);

/// How a program is told where the object stands: by uniforms clip_from_model and normal_matrix, or
/// by attributes at kClipPlace and kNormalPlace, a column each.
enum class Placing { uniforms, attributes };

/// The vertex shader of surfaces: positions and normals at attributes 0 and 1, what `kind` asks for
/// at kTexcoordPlace and kColorPlace.
std::string surface_vertex_glsl(const SurfaceKind& kind, Placing placing = Placing::uniforms);
inline constexpr unsigned kTexcoordPlace = 2, kColorPlace = 3, kClipPlace = 4, kNormalPlace = 8;

/// After a line #version: declares what such a vertex shader hands over, uniforms base_color and,
/// as far as `kind` asks for them (software rasterisers pay for each that a fragment reads),
/// opacity, alpha_cutoff and emissive, the picture at texture unit 0, and
///   vec3 surface_color();
/// the fragment's linear colour, which discards the fragment where a mask has a hole. Calls
///   vec3 shade(vec3 base_color, vec3 normal);
std::string surface_fragment_glsl(const SurfaceKind& kind);

}  // namespace viewcell
