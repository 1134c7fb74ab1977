#include "scene/surface.h"

#include <algorithm>

namespace viewcell {
namespace {

template <typename Value>
Value mix(const std::vector<Value>& of, const Triangle& t, const SurfacePoint& at) {
  return (1 - at.u - at.v) * of[t[0]] + at.u * of[t[1]] + at.v * of[t[2]];
}

// Where rays meet a triangle's plane, as weights of its corners 1 and 2.
class PlaneWeights {
 public:
  PlaneWeights(const std::vector<glm::vec3>& positions, const Triangle& t, const glm::vec3& origin)
      : b_(positions[t[1]] - positions[t[0]]),
        c_(positions[t[2]] - positions[t[0]]),
        from_(origin - positions[t[0]]),
        normal_(glm::cross(b_, c_)) {}
  glm::vec2 of(const glm::vec3& direction) const {
    const float t = -glm::dot(normal_, from_) / glm::dot(normal_, direction);
    const glm::vec3 p = from_ + t * direction;
    return glm::vec2(glm::dot(glm::cross(p, c_), normal_), glm::dot(glm::cross(b_, p), normal_)) /
           glm::dot(normal_, normal_);
  }

 private:
  glm::vec3 b_, c_, from_, normal_;
};

// Not a number where a ray runs along the plane: a picture is then seen from afar.
UvStep uv_step(const SceneMesh& mesh, const Triangle& t, const PixelRays& rays) {
  const PlaneWeights plane(mesh.mesh.positions, t, rays.origin);
  const glm::vec2 here = plane.of(rays.direction);
  const glm::vec2 dx = plane.of(rays.beside) - here, dy = plane.of(rays.above) - here;
  const auto& uv = mesh.looks.texcoords;
  const glm::vec2 along_b = uv[t[1]] - uv[t[0]], along_c = uv[t[2]] - uv[t[0]];
  return {dx.x * along_b + dx.y * along_c, dy.x * along_b + dy.y * along_c};
}

}  // namespace

ObjectSurface::ObjectSurface(const Scene& scene, const SceneObject& object)
    : scene_(&scene),
      object_(&object),
      mesh_(&scene.mesh_of(object)),
      world_from_model_(glm::mat3_cast(object.rotation)),
      is_double_sided_(scene.is_double_sided(object)) {
  for (const int m : object.materials) {
    const Material& material = scene.materials[static_cast<std::size_t>(m)];
    has_pictures_ |= material.picture >= 0 && !mesh_->looks.texcoords.empty();
    needs_passing_ |=
        material.alpha != AlphaMode::opaque || material.double_sided != is_double_sided_;
  }
}

const Material& ObjectSurface::material_at(const Triangle& t) const {
  return scene_->material_of(*object_, static_cast<std::size_t>(mesh_->looks.slot_of(t)));
}

glm::vec4 ObjectSurface::picture_at(const Material& material, const SurfacePoint& at,
                                    const PixelRays& rays) const {
  const MipTexture texture = scene_->texture_of(material);
  if (texture.levels == nullptr || mesh_->looks.texcoords.empty()) return glm::vec4(1);
  const Triangle& t = mesh_->mesh.triangles[at.triangle];
  return sample(texture, mix(mesh_->looks.texcoords, t, at),
                mip_lod(texture, uv_step(*mesh_, t, rays)));
}

glm::vec4 ObjectSurface::base_color(const Material& material, const SurfacePoint& at,
                                    const PixelRays& rays) const {
  glm::vec4 out = glm::vec4(material.base_color, material.opacity) * picture_at(material, at, rays);
  if (material.has_vertex_colors && !mesh_->mesh.colors.empty())
    out *= glm::vec4(mix(mesh_->mesh.colors, mesh_->mesh.triangles[at.triangle], at), 1);
  return out;
}

bool ObjectSurface::is_passed(const SurfacePoint& at, bool is_back, const PixelRays& rays) const {
  const Material& material = material_at(mesh_->mesh.triangles[at.triangle]);
  if (is_back && !material.double_sided) return true;
  return material.alpha == AlphaMode::mask &&
         material.opacity * picture_at(material, at, rays).w < material.alpha_cutoff;
}

glm::vec3 ObjectSurface::color(const SurfacePoint& at, bool is_back, const PixelRays& rays) const {
  const Triangle& t = mesh_->mesh.triangles[at.triangle];
  const Material& material = material_at(t);
  const glm::vec3 base(base_color(material, at, rays));
  if (material.is_unlit) return base + material.emissive;
  const glm::vec3 normal = glm::normalize(world_from_model_ * mix(mesh_->mesh.normals, t, at));
  return shade(scene_->lighting, base, is_back ? -normal : normal) + material.emissive;
}

glm::vec3 mean_color(const Scene& scene, const Material& material) {
  const MipTexture texture = scene.texture_of(material);
  if (texture.levels == nullptr || texture.levels->empty()) return material.base_color;
  return material.base_color *
         glm::vec3(sample(texture, {0.5f, 0.5f}, static_cast<float>(texture.levels->size() - 1)));
}

SurfaceKind surface_kind(const Material& material, const SceneMesh& mesh) {
  return {.has_picture = material.picture >= 0 && !mesh.looks.texcoords.empty(),
          .has_colors = material.has_vertex_colors && !mesh.mesh.colors.empty(),
          .is_masked = material.alpha == AlphaMode::mask,
          .is_unlit = material.is_unlit,
          .is_emissive = material.emissive != glm::vec3(0),
          .is_double_sided = material.double_sided};
}

std::string surface_vertex_glsl(const SurfaceKind& kind, Placing placing) {
  std::string inputs, outputs, sets;
  inputs = placing == Placing::uniforms ? "uniform mat4 clip_from_model;\n"
                                          "uniform mat3 normal_matrix;\n"
                                        : "layout(location = 4) in mat4 clip_from_model;\n"
                                          "layout(location = 8) in mat3 normal_matrix;\n";
  if (kind.has_picture) {
    inputs += "layout(location = 2) in vec2 texcoord;\n";
    outputs += "layout(location = 1) out vec2 uv;\n";
    sets += "  uv = texcoord;\n";
  }
  if (kind.has_colors) {
    inputs += "layout(location = 3) in vec3 color_in;\n";
    outputs += "layout(location = 2) out vec3 vertex_color;\n";
    sets += "  vertex_color = color_in;\n";
  }
  return "#version 450 core\n"
         "layout(location = 0) in vec3 position;\n"
         "layout(location = 1) in vec3 normal;\n" +
         inputs + "layout(location = 0) out vec3 normal_world;\n" + outputs +
         "void main() {\n  normal_world = normal_matrix * normal;\n" + sets +
         "  gl_Position = clip_from_model * vec4(position, 1);\n}\n";
}

std::string surface_fragment_glsl(const SurfaceKind& kind) {
  std::string out =
      "layout(location = 0) in vec3 normal_world;\n"
      "uniform vec3 base_color;\n";
  if (kind.is_emissive) out += "uniform vec3 emissive;\n";
  if (kind.is_masked) out += "uniform float opacity, alpha_cutoff;\n";
  std::string body = "  vec3 base = base_color;\n";
  std::string alpha = "opacity";
  if (kind.has_picture) {
    out += "layout(location = 1) in vec2 uv;\nlayout(binding = 0) uniform sampler2D picture;\n" +
           sample_mips_glsl();
    body += "  vec4 seen = sample_mips(picture, uv);\n  base *= seen.rgb;\n";
    alpha += " * seen.a";
  }
  if (kind.has_colors) {
    out += "layout(location = 2) in vec3 vertex_color;\n";
    body += "  base *= vertex_color;\n";
  }
  if (kind.is_masked) body += "  if (" + alpha + " < alpha_cutoff) discard;\n";
  if (!kind.is_unlit) {
    body += "  vec3 n = normalize(normal_world);\n";
    if (kind.is_double_sided) body += "  if (!gl_FrontFacing) n = -n;\n";
    body += "  base = shade(base, n);\n";
  }
  return out + "vec3 surface_color() {\n" + body + "  return base" +
         (kind.is_emissive ? " + emissive" : "") + ";\n}\n";
}

}  // namespace viewcell
