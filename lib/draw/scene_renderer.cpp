#include "draw/scene_renderer.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "base/error.h"
#include "draw/ground.h"
#include "draw/lit_vertex.h"
#include "draw/shading.h"

namespace viewcell {
namespace {

constexpr const char* kObjectVertex = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 clip_from_model;
uniform mat3 normal_matrix;
layout(location = 0) out vec3 normal_world;
void main() {
  normal_world = normal_matrix * normal;
  gl_Position = clip_from_model * vec4(position, 1);
}
)";

constexpr const char* kGroundVertex = R"(#version 450 core
layout(location = 0) in vec2 position;
uniform mat4 clip_from_ground;
void main() { gl_Position = clip_from_ground * vec4(position, 0, 1); }
)";

std::string object_fragment(const Lighting& lighting, bool double_sided) {
  return "#version 450 core\n"
         "layout(location = 0) in vec3 normal_world;\n"
         "layout(location = 0) out vec4 color;\n"
         "uniform vec3 base_color;\n" +
         make_shading_glsl(lighting) + "void main() {\n  vec3 n = normalize(normal_world);\n" +
         (double_sided ? "  if (!gl_FrontFacing) n = -n;\n" : "") +
         "  color = vec4(srgb_encode(shade(base_color, n)), 1);\n}\n";
}

std::string ground_fragment(const Lighting& lighting) {
  return "#version 450 core\nlayout(location = 0) out vec4 color;\n"
         "void main() { color = vec4(" +
         glsl_vec3(srgb_encode(lighting.ground_color)) + ", 0); }\n";
}

}  // namespace

SceneRenderer::SceneRenderer(const Gl& gl, const Scene& scene,
                             const std::vector<MeshLevels>& levels)
    : gl_(gl), array_(gl), ground_array_(gl) {
  VIEWCELL_CHECK(levels.size() == scene.meshes.size(), levels.size(), scene.meshes.size());
  for (const SceneObject& object : scene.objects) {
    const Material& material = scene.material_of(object);
    scene_objects_.push_back(&object);
    objects_.push_back({object.matrix_world_from_model(),
                        glm::mat3(glm::mat3_cast(object.rotation)), material.base_color,
                        object.mesh, material.double_sided});
  }
  upload(levels);
  single_sided_ = make_program(scene.lighting, false);
  double_sided_ = make_program(scene.lighting, true);
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

void SceneRenderer::upload(const std::vector<MeshLevels>& levels) {
  std::vector<LitVertex> vertices;
  std::vector<Triangle> triangles;
  for (const MeshLevels& of_mesh : levels) {
    std::vector<Range>& ranges = ranges_.emplace_back();
    for (const MeshLevel& level : of_mesh) {
      const TriMesh& mesh = level.mesh;
      ranges.push_back({static_cast<GLsizei>(3 * mesh.triangles.size()),
                        triangles.size() * sizeof(Triangle), static_cast<GLint>(vertices.size())});
      for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        vertices.push_back(make_lit_vertex(mesh.positions[v], mesh.normals[v]));
      triangles.insert(triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
    }
    ClusteredMesh clustered = build_clusters(of_mesh[0].mesh);
    cluster_ranges_.push_back({static_cast<GLsizei>(3 * clustered.triangles.size()),
                               triangles.size() * sizeof(Triangle), ranges[0].first_vertex});
    clusters_.push_back(std::move(clustered.clusters));
    triangles.insert(triangles.end(), clustered.triangles.begin(), clustered.triangles.end());
  }
  vertices_ = make_buffer(gl_, vertices);
  indices_ = make_buffer(gl_, triangles);
  gl_.VertexArrayVertexBuffer(array_.id(), 0, vertices_.id(), 0, sizeof(LitVertex));
  gl_.VertexArrayElementBuffer(array_.id(), indices_.id());
  array_.set_attribute(0, 3, GL_FLOAT, GL_FALSE, offsetof(LitVertex, position));
  array_.set_attribute(1, 3, GL_SHORT, GL_TRUE, offsetof(LitVertex, normal));
}

SceneRenderer::Program SceneRenderer::make_program(const Lighting& lighting,
                                                   bool double_sided) const {
  Program out;
  out.program =
      GlProgram(gl_, "lit object", kObjectVertex, object_fragment(lighting, double_sided));
  out.clip_from_model = out.program.uniform("clip_from_model");
  out.normal_matrix = out.program.uniform("normal_matrix");
  out.base_color = out.program.uniform("base_color");
  return out;
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

const SceneRenderer::Program& SceneRenderer::use_program(const Object& object,
                                                         const DrawStyle& style,
                                                         const Program* current) const {
  const Program& program = object.double_sided ? double_sided_ : single_sided_;
  if (&program == current) return program;
  program.program.use();
  (style.cull_back_faces && !object.double_sided ? gl_.Enable : gl_.Disable)(GL_CULL_FACE);
  return program;
}

void SceneRenderer::set_object(const Program& program, const Object& object,
                               const glm::dmat4& clip_from_world, const DrawStyle& style) const {
  const GLuint id = program.program.id();
  // The product in double: near an eye far from the origin, float would lose what cancels.
  const glm::mat4 clip_from_model(clip_from_world * object.world_from_model);
  const glm::vec3 base_color = style.base_color.value_or(object.base_color);
  gl_.ProgramUniformMatrix4fv(id, program.clip_from_model, 1, GL_FALSE,
                              glm::value_ptr(clip_from_model));
  gl_.ProgramUniformMatrix3fv(id, program.normal_matrix, 1, GL_FALSE,
                              glm::value_ptr(object.rotation));
  gl_.ProgramUniform3fv(id, program.base_color, 1, glm::value_ptr(base_color));
}

void SceneRenderer::draw_objects(const glm::dmat4& clip_from_world,
                                 std::span<const ObjectDraw> draws, const DrawStyle& style) const {
  array_.bind();
  const Program* current = nullptr;
  for (const ObjectDraw& draw : draws) {
    const Object& object = objects_[index(draw.object)];
    current = &use_program(object, style, current);
    set_object(*current, object, clip_from_world, style);
    const Range& range = ranges_[index(object.mesh)][static_cast<std::size_t>(draw.level)];
    gl_.DrawElementsBaseVertex(GL_TRIANGLES, range.n_indices, GL_UNSIGNED_INT,
                               reinterpret_cast<const void*>(range.index_offset),
                               range.first_vertex);
  }
  gl_.Enable(GL_CULL_FACE);
}

std::size_t SceneRenderer::draw_clusters(const Camera& camera, std::span<const ObjectId> objects,
                                         const DrawStyle& style) const {
  const glm::dmat4 clip = clip_from_world(camera);
  const Frustum frustum = make_frustum(camera);
  array_.bind();
  const Program* current = nullptr;
  std::size_t n_drawn = 0;
  for (const ObjectId id : objects) {
    const Object& object = objects_[index(id)];
    const SceneObject& placed = *scene_objects_[index(id)];
    current = &use_program(object, style, current);
    set_object(*current, object, clip, style);
    const glm::dvec3 eye_model = placed.model_from_world(camera.eye);
    const Range& range = cluster_ranges_[index(object.mesh)];
    std::uint32_t first = 0, n = 0;  // a run of clusters to draw, in triangles
    const auto draw_run = [&] {
      if (n > 0)
        gl_.DrawElementsBaseVertex(
            GL_TRIANGLES, static_cast<GLsizei>(3 * n), GL_UNSIGNED_INT,
            reinterpret_cast<const void*>(range.index_offset + first * sizeof(Triangle)),
            range.first_vertex);
      n_drawn += n;
      n = 0;
    };
    for (const Cluster& cluster : clusters_[index(object.mesh)]) {
      const bool hidden = (!object.double_sided && is_back_facing(cluster, eye_model)) ||
                          !may_meet(frustum, placed.world_from_model(cluster.centre),
                                    cluster.radius * placed.scale);
      if (hidden) {
        draw_run();
      } else {
        if (n == 0) first = cluster.first_triangle;
        n += cluster.n_triangles;
      }
    }
    draw_run();
  }
  gl_.Enable(GL_CULL_FACE);
  return n_drawn;
}

glm::dmat4 shift_pixels(const glm::dmat4& clip_from_world, const glm::dvec2& shift_px, int width_px,
                        int height_px) {
  glm::dmat4 shift(1);
  // clip.x += dx * clip.w; y grows upward in clip space.
  shift[3] = glm::dvec4(2 * shift_px.x / width_px, -2 * shift_px.y / height_px, 0, 1);
  return shift * clip_from_world;
}

}  // namespace viewcell
