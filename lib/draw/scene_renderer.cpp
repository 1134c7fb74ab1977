#include "draw/scene_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "base/error.h"
#include "draw/ground.h"
#include "draw/lit_vertex.h"
#include "draw/shading.h"
#include "gl/mip_upload.h"

namespace viewcell {
namespace {

// What vertices have besides, where some mesh has pictures or colours.
struct DressedVertex {
  glm::vec2 texcoord{0};
  std::array<std::uint16_t, 4> color{65535, 65535, 65535, 0};  // linear; the fourth is padding
};
static_assert(sizeof(DressedVertex) == 16);

DressedVertex make_dressed_vertex(const MeshLevel& level, std::size_t v) {
  DressedVertex out;
  if (!level.texcoords.empty()) out.texcoord = level.texcoords[v];
  if (!level.mesh.colors.empty())
    for (int c = 0; c < 3; ++c)
      out.color[static_cast<std::size_t>(c)] = static_cast<std::uint16_t>(
          std::lround(65535 * std::clamp(level.mesh.colors[v][c], 0.0f, 1.0f)));
  return out;
}

constexpr const char* kGroundVertex = R"(#version 450 core
layout(location = 0) in vec2 position;
uniform mat4 clip_from_ground;
void main() { gl_Position = clip_from_ground * vec4(position, 0, 1); }
)";

std::string object_fragment(const Lighting& lighting, const SurfaceKind& kind) {
  return "#version 450 core\nlayout(location = 0) out vec4 color;\n" + make_shading_glsl(lighting) +
         surface_fragment_glsl(kind) +
         "void main() { color = vec4(srgb_encode(surface_color()), 1); }\n";
}

std::string ground_fragment(const Lighting& lighting) {
  return "#version 450 core\nlayout(location = 0) out vec4 color;\n"
         "void main() { color = vec4(" +
         glsl_vec3(srgb_encode(lighting.ground_color)) + ", 0); }\n";
}

}  // namespace

SceneRenderer::SceneRenderer(const Gl& gl, const Scene& scene,
                             const std::vector<MeshLevels>& levels)
    : gl_(gl), array_(gl), batched_draws_(gl, array_), ground_array_(gl) {
  VIEWCELL_CHECK(levels.size() == scene.meshes.size(), levels.size(), scene.meshes.size());
  for (const SceneObject& object : scene.objects) add_object(scene, object);
  upload(levels);
  ground_program_ = GlProgram(gl, "ground", kGroundVertex, ground_fragment(scene.lighting));
  const std::array<glm::vec2, 4> corners{
      glm::vec2(-kGroundReach, -kGroundReach), glm::vec2(kGroundReach, -kGroundReach),
      glm::vec2(-kGroundReach, kGroundReach), glm::vec2(kGroundReach, kGroundReach)};
  ground_vertices_ = make_buffer(gl, corners);
  gl.VertexArrayVertexBuffer(ground_array_.id(), 0, ground_vertices_.id(), 0, sizeof(glm::vec2));
  ground_array_.set_attribute(0, 2, GL_FLOAT, GL_FALSE, 0);
  ground_centre_ = ground_centre(scene);
  const glm::vec3 sky = srgb_encode(scene.lighting.sky_color);
  sky_ = {sky.x, sky.y, sky.z, 0};
  check_gl(gl, "making the scene renderer");
}

void SceneRenderer::add_object(const Scene& scene, const SceneObject& object) {
  scene_objects_.push_back(&object);
  Object& out = objects_.emplace_back();
  out.world_from_model = object.matrix_world_from_model();
  out.rotation = glm::mat3(glm::mat3_cast(object.rotation));
  out.mesh = object.mesh;
  const SceneMesh& mesh = scene.mesh_of(object);
  for (std::size_t slot = 0; slot < mesh.n_slots; ++slot) {
    const Material& material = scene.material_of(object, slot);
    const SurfaceKind kind = surface_kind(material, mesh);
    const SurfaceKind plain{.is_double_sided = kind.is_double_sided};
    const auto program = [&](const SurfaceKind& of, Placing placing) {
      return &program_for(scene.lighting, of, placing);
    };
    out.looks.push_back({&material, program(kind, Placing::uniforms),
                         program(plain, Placing::uniforms), program(kind, Placing::attributes),
                         program(plain, Placing::attributes),
                         kind.has_picture ? texture_for(scene, material) : 0});
  }
}

GLuint SceneRenderer::texture_for(const Scene& scene, const Material& material) {
  const auto [at, is_new] =
      textures_.try_emplace({material.picture, material.wrap_u, material.wrap_v});
  if (is_new) at->second = upload_mips(gl_, scene.texture_of(material));
  return at->second.id();
}

const SceneRenderer::Program& SceneRenderer::program_for(const Lighting& lighting,
                                                         const SurfaceKind& kind, Placing placing) {
  const auto [at, is_new] = programs_.try_emplace({kind, placing});
  if (!is_new) return at->second;
  Program& out = at->second;
  out.program = GlProgram(gl_, "surface", surface_vertex_glsl(kind, placing),
                          object_fragment(lighting, kind));
  out.is_double_sided = kind.is_double_sided;
  out.clip_from_model = out.program.uniform("clip_from_model");
  out.normal_matrix = out.program.uniform("normal_matrix");
  out.base_color = out.program.uniform("base_color");
  out.emissive = out.program.uniform("emissive");
  out.opacity = out.program.uniform("opacity");
  out.alpha_cutoff = out.program.uniform("alpha_cutoff");
  return out;
}

void SceneRenderer::upload(const std::vector<MeshLevels>& levels) {
  const bool are_dressed = std::any_of(programs_.begin(), programs_.end(), [](const auto& program) {
    const SurfaceKind& kind = program.first.first;
    return kind.has_picture || kind.has_colors;
  });
  std::vector<LitVertex> vertices;
  std::vector<DressedVertex> dressed;
  std::vector<Triangle> triangles;
  const auto range_at = [&](const SlotRange& slot, GLint first_vertex) {
    return Range{slot.slot, static_cast<GLsizei>(3 * slot.n_triangles),
                 (triangles.size() + slot.first_triangle) * sizeof(Triangle), first_vertex};
  };
  for (const MeshLevels& of_mesh : levels) {
    auto& ranges = ranges_.emplace_back();
    const auto first_of_mesh = static_cast<GLint>(vertices.size());
    for (const MeshLevel& level : of_mesh) {
      const TriMesh& mesh = level.mesh;
      const auto first = static_cast<GLint>(vertices.size());
      auto& by_slot = ranges.emplace_back();
      for (const SlotRange& slot : level.slots) by_slot.push_back(range_at(slot, first));
      for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        vertices.push_back(make_lit_vertex(mesh.positions[v], mesh.normals[v]));
        if (are_dressed) dressed.push_back(make_dressed_vertex(level, v));
      }
      triangles.insert(triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
    }
    auto& clusters = clusters_.emplace_back();
    for (const SlotRange& slot : of_mesh[0].slots) {
      TriMesh part;
      part.positions = of_mesh[0].mesh.positions;
      const auto first =
          of_mesh[0].mesh.triangles.begin() + static_cast<std::ptrdiff_t>(slot.first_triangle);
      part.triangles.assign(first, first + static_cast<std::ptrdiff_t>(slot.n_triangles));
      ClusteredMesh clustered = build_clusters(part);
      clusters.push_back({range_at({slot.slot, 0, slot.n_triangles}, first_of_mesh),
                          std::move(clustered.clusters)});
      triangles.insert(triangles.end(), clustered.triangles.begin(), clustered.triangles.end());
    }
  }
  vertices_ = make_buffer(gl_, vertices);
  dressed_ = make_buffer(gl_, dressed);
  indices_ = make_buffer(gl_, triangles);
  gl_.VertexArrayVertexBuffer(array_.id(), 0, vertices_.id(), 0, sizeof(LitVertex));
  gl_.VertexArrayElementBuffer(array_.id(), indices_.id());
  array_.set_attribute(0, 3, GL_FLOAT, GL_FALSE, offsetof(LitVertex, position));
  array_.set_attribute(1, 3, GL_SHORT, GL_TRUE, offsetof(LitVertex, normal));
  if (!are_dressed) return;
  gl_.VertexArrayVertexBuffer(array_.id(), 1, dressed_.id(), 0, sizeof(DressedVertex));
  array_.set_attribute(kTexcoordPlace, 2, GL_FLOAT, GL_FALSE, offsetof(DressedVertex, texcoord), 1);
  array_.set_attribute(kColorPlace, 3, GL_UNSIGNED_SHORT, GL_TRUE, offsetof(DressedVertex, color),
                       1);
}

void SceneRenderer::draw_background(const GlFramebuffer& target,
                                    const glm::dmat4& clip_from_world) const {
  target.bind();
  target.clear(sky_);
  const glm::mat4 clip_from_ground(glm::translate(clip_from_world, ground_centre_));
  gl_.ProgramUniformMatrix4fv(ground_program_.id(), ground_program_.uniform("clip_from_ground"), 1,
                              GL_FALSE, glm::value_ptr(clip_from_ground));
  gl_.Disable(GL_DEPTH_TEST);  // and so the writing of depth
  ground_program_.use();
  ground_array_.bind();
  gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  gl_.Enable(GL_DEPTH_TEST);
}

void SceneRenderer::use(const Look& look, const Program& program, const DrawStyle& style,
                        DrawState& state) const {
  if (state.program != &program) {
    program.program.use();
    (style.cull_back_faces && !program.is_double_sided ? gl_.Enable : gl_.Disable)(GL_CULL_FACE);
    state.program = &program;
  }
  if (!style.base_color && look.texture != 0 && look.texture != state.texture) {
    gl_.BindTextureUnit(0, look.texture);
    state.texture = look.texture;
  }
  const GLuint id = program.program.id();
  const glm::vec3 base_color = style.base_color.value_or(look.material->base_color);
  const glm::vec3 emissive = style.base_color ? glm::vec3(0) : look.material->emissive;
  gl_.ProgramUniform3fv(id, program.base_color, 1, glm::value_ptr(base_color));
  gl_.ProgramUniform3fv(id, program.emissive, 1, glm::value_ptr(emissive));
  gl_.ProgramUniform1f(id, program.opacity, look.material->opacity);
  gl_.ProgramUniform1f(id, program.alpha_cutoff, look.material->alpha_cutoff);
}

void SceneRenderer::place(const Object& object, const Program& program,
                          const glm::dmat4& clip_from_world) const {
  // The product in double: near an eye far from the origin, float would lose what cancels.
  const glm::mat4 clip_from_model(clip_from_world * object.world_from_model);
  const GLuint id = program.program.id();
  gl_.ProgramUniformMatrix4fv(id, program.clip_from_model, 1, GL_FALSE,
                              glm::value_ptr(clip_from_model));
  gl_.ProgramUniformMatrix3fv(id, program.normal_matrix, 1, GL_FALSE,
                              glm::value_ptr(object.rotation));
}

void SceneRenderer::draw_range(const Range& range, std::uint32_t first_triangle,
                               std::uint32_t n) const {
  gl_.DrawElementsBaseVertex(
      GL_TRIANGLES, static_cast<GLsizei>(3 * n), GL_UNSIGNED_INT,
      reinterpret_cast<const void*>(range.index_offset + first_triangle * sizeof(Triangle)),
      range.first_vertex);
}

void SceneRenderer::draw_objects(const glm::dmat4& clip_from_world,
                                 std::span<const ObjectDraw> draws, const DrawStyle& style) const {
  array_.bind();
  DrawState state;
  for (const ObjectDraw& draw : draws) {
    const Object& object = objects_[index(draw.object)];
    const auto& ranges = ranges_[index(object.mesh)][static_cast<std::size_t>(draw.level)];
    for (const Range& range : ranges) {
      const Look& look = object.looks[static_cast<std::size_t>(range.slot)];
      const Program& program = style.base_color ? *look.plain : *look.program;
      use(look, program, style, state);
      place(object, program, clip_from_world);
      draw_range(range, 0, static_cast<std::uint32_t>(range.n_indices / 3));
    }
  }
  gl_.Enable(GL_CULL_FACE);
}

// The runs of clusters that may show, in the batches of their looks; a new look is a new batch.
void SceneRenderer::collect_clusters(const Camera& camera, const Frustum& frustum, ObjectId id,
                                     std::vector<const Look*>& batches) {
  const Object& object = objects_[index(id)];
  const SceneObject& placed = *scene_objects_[index(id)];
  const glm::dvec3 eye_model = placed.model_from_world(camera.eye);
  std::optional<std::uint32_t> number;  // once something is drawn
  for (const auto& [range, clusters] : clusters_[index(object.mesh)]) {
    const Look& look = object.looks[static_cast<std::size_t>(range.slot)];
    std::uint32_t first = 0, n = 0;  // a run of clusters to draw, in triangles
    const auto add_run = [&] {
      if (n == 0) return;
      if (!number)
        number = batched_draws_.add_object(
            glm::mat4(clip_from_world(camera) * object.world_from_model), object.rotation);
      auto batch = std::find_if(batches.begin(), batches.end(), [&](const Look* other) {
        return other->material == look.material && other->batched == look.batched;
      });
      if (batch == batches.end()) batch = batches.insert(batch, &look);
      const auto first_index = static_cast<std::uint32_t>(range.index_offset / 4 + 3 * first);
      batched_draws_.add_run(static_cast<std::size_t>(batch - batches.begin()), *number,
                             first_index, 3 * n, range.first_vertex);
      n = 0;
    };
    for (const Cluster& cluster : clusters) {
      const bool hidden = (!look.material->double_sided && is_back_facing(cluster, eye_model)) ||
                          !may_meet(frustum, placed.world_from_model(cluster.centre),
                                    cluster.radius * placed.scale);
      if (hidden) {
        add_run();
      } else {
        if (n == 0) first = cluster.first_triangle;
        n += cluster.n_triangles;
      }
    }
    add_run();
  }
}

SceneRenderer::Drawn SceneRenderer::draw_clusters(const Camera& camera,
                                                  std::span<const ObjectId> objects,
                                                  const DrawStyle& style) {
  const Frustum frustum = make_frustum(camera);
  std::vector<const Look*> batches;
  batched_draws_.clear();
  for (const ObjectId id : objects) collect_clusters(camera, frustum, id, batches);
  batched_draws_.upload();
  array_.bind();
  DrawState state;
  for (std::size_t i = 0; i < batches.size(); ++i) {
    const Look& look = *batches[i];
    use(look, style.base_color ? *look.batched_plain : *look.batched, style, state);
    batched_draws_.draw(i);
  }
  gl_.Enable(GL_CULL_FACE);
  return {batched_draws_.n_triangles(), batches.size()};
}

glm::dmat4 shift_pixels(const glm::dmat4& clip_from_world, const glm::dvec2& shift_px, int width_px,
                        int height_px) {
  glm::dmat4 shift(1);
  // clip.x += dx * clip.w; y grows upward in clip space.
  shift[3] = glm::dvec4(2 * shift_px.x / width_px, -2 * shift_px.y / height_px, 0, 1);
  return shift * clip_from_world;
}

}  // namespace viewcell
