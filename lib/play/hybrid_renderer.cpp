#include "play/hybrid_renderer.h"

#include <algorithm>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "base/error.h"
#include "play/hybrid_shaders.h"
#include "scene/surface.h"

namespace viewcell {

// The uniform block of one draw (std140).
struct HybridRenderer::DrawBlock {
  glm::vec4 base_color{0};
  glm::vec4 weights{0};
  glm::vec4 rows[6] = {};
  glm::ivec4 regions[2] = {};
  glm::vec4 codes[2] = {};
  glm::vec4 eyes[3] = {};
};

namespace {

std::size_t uniform_alignment(const Gl& gl) {
  GLint alignment = 256;
  gl.GetIntegerv(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT, &alignment);
  return static_cast<std::size_t>(alignment);
}

GlProgram make_program(const Gl& gl, const char* name, int n_views, DrawnSides sides,
                       const Lighting& lighting) {
  return GlProgram(gl, name, make_hybrid_vertex_glsl(n_views, sides, lighting),
                   make_hybrid_fragment_glsl(n_views, sides));
}

DrawnSides sides_of(const Scene& scene, const SceneObject& object) {
  if (scene.is_masked(object)) return DrawnSides::masked;
  if (scene.is_double_sided(object) || scene.mesh_of(object).has_twins) return DrawnSides::both;
  return DrawnSides::front;
}

glm::vec3 middle_of(const ReadyObject& object) {
  return 0.5f * (object.lo + object.hi);
}

}  // namespace

glm::vec3 kind_color(Representation kind) {
  switch (kind) {
    case Representation::original:
      return {0.55f, 0.5f, 0.42f};
    case Representation::single_view:
      return {0.35f, 0.08f, 0.45f};
    case Representation::multi_view:
      return {0.05f, 0.18f, 0.60f};
    case Representation::unseen:
      return {0.60f, 0.05f, 0.04f};
  }
  throw_bug(__FILE__, __LINE__, "a Representation", static_cast<int>(kind));
}

float depth_tolerance(const ViewProjection& view, const glm::vec3& eye, const glm::vec3& middle,
                      const HybridOptions& options) {
  // The code is linear in 1 / depth. A point z away that moves by z^2 along a ray of the view
  // changes 1 / z by 1, and the eye, d away, sees this under the sine aside / d.
  const glm::vec3 ray = middle - view.eye;
  const float d2 = std::max(glm::dot(middle - eye, middle - eye), 1e-3f);
  const float aside_z = std::max(glm::length(glm::cross(ray, eye - view.eye)), 1e-3f);
  const float shift_px = view.focal_px * aside_z * glm::length(ray) / d2;  // of a change of 1
  return std::max(options.depth_tolerance, options.shift_px * view.code_scale / shift_px);
}

HybridRenderer::HybridRenderer(const Gl& gl, const Scene& scene, const HybridOptions& options)
    : gl_(gl),
      scene_(scene),
      options_(options),
      edges_(gl, "edges", make_hybrid_vertex_glsl(0, DrawnSides::front, scene.lighting),
             make_edge_fragment_glsl()) {
  for (const SceneObject& object : scene.objects) {
    const DrawnSides sides = sides_of(scene, object);
    if (!programs_.contains(sides)) programs_[sides] = make_programs(sides);
  }
  const std::size_t alignment = uniform_alignment(gl);
  block_stride_ = (sizeof(DrawBlock) + alignment - 1) / alignment * alignment;
}

HybridRenderer::Programs HybridRenderer::make_programs(DrawnSides sides) const {
  return {make_program(gl_, "two views", 2, sides, scene_.lighting),
          make_program(gl_, "one view", 1, sides, scene_.lighting),
          make_program(gl_, "lit mesh", 0, sides, scene_.lighting)};
}

const HybridRenderer::Programs& HybridRenderer::programs_for(const SceneObject& object) const {
  return programs_.at(sides_of(scene_, object));
}

void HybridRenderer::upload_blocks(const ResidentCell& cell, const HybridPlan& plan,
                                   const glm::vec3& eye, HybridStyle style) {
  staged_.assign(plan.outside.size() * block_stride_, 0);
  const glm::vec3 origin(cell.ready->origin);
  char* to = staged_.data();
  const auto stage = [&](const HybridDraw& draw) {
    const ReadyObject& ready = cell.ready->objects[draw.slot];
    const SceneObject& object = scene_.objects[index(ready.object)];
    DrawBlock block;
    block.base_color =
        glm::vec4(style == HybridStyle::textured ? mean_color(scene_, scene_.material_of(object, 0))
                                                 : kind_color(ready.kind),
                  1);
    block.weights = {draw.views.weight[0], draw.views.weight[1],
                     scene_.is_double_sided(object) ? 1 : 0, 0};
    block.eyes[2] = glm::vec4(eye, 1);
    for (std::size_t i = 0; i < 2; ++i) {
      if (draw.views.view[i] < 0) continue;
      const ViewProjection& p = cell.projections[std::size_t{draw.slot} * kViews +
                                                 static_cast<std::size_t>(draw.views.view[i])];
      block.rows[3 * i] = p.row_s, block.rows[3 * i + 1] = p.row_t, block.rows[3 * i + 2] = p.row_q;
      block.eyes[i] = glm::vec4(p.eye, 1);
      block.regions[i] = {p.first_texel, p.width_px, p.height_px, 0};
      block.codes[i] = {p.code_scale, p.code_bias,
                        1 / depth_tolerance(p, eye, middle_of(ready) - origin, options_), 0};
    }
    std::memcpy(to, &block, sizeof block);
    to += block_stride_;
  };
  for (const HybridDraw& draw : plan.outside) stage(draw);
  if (blocks_.n_bytes() < staged_.size())
    blocks_ = GlBuffer(gl_, 2 * staged_.size(), nullptr, GL_DYNAMIC_STORAGE_BIT);
  if (!staged_.empty()) blocks_.write(0, staged_.size(), staged_.data());
}

void HybridRenderer::draw_one(const ResidentCell& cell, const HybridPlan& plan,
                              std::size_t i) const {
  const ReadyObject& object = cell.ready->objects[plan.outside[i].slot];
  gl_.BindBufferRange(GL_UNIFORM_BUFFER, 0, blocks_.id(), static_cast<GLintptr>(i * block_stride_),
                      sizeof(DrawBlock));
  gl_.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(object.n_indices), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(std::size_t{object.first_index} * 4));
}

void HybridRenderer::draw(const Camera& camera, const ResidentCell& cell, GLuint texels,
                          const HybridPlan& plan, HybridStyle style) {
  upload_blocks(cell, plan, glm::vec3(camera.eye - cell.ready->origin), style);
  cell.array.bind();
  gl_.BindTextureUnit(0, texels);
  const glm::mat4 clip_from_local(glm::translate(clip_from_world(camera), cell.ready->origin));
  const auto set_clip = [&](const GlProgram& program) {
    gl_.ProgramUniformMatrix4fv(program.id(), program.uniform("clip_from_local"), 1, GL_FALSE,
                                glm::value_ptr(clip_from_local));
  };
  for (const auto& [sides, p] : programs_)
    set_clip(p.two_views), set_clip(p.one_view), set_clip(p.lit);
  set_clip(edges_);
  const GlProgram* current = nullptr;
  for (std::size_t i = 0; i < plan.outside.size(); ++i) {
    const bool blends = plan.outside[i].views.weight[1] > 0;
    const SceneObject& object =
        scene_.objects[index(cell.ready->objects[plan.outside[i].slot].object)];
    const Programs& programs = programs_for(object);
    const GlProgram& program = style != HybridStyle::textured
                                   ? programs.lit
                                   : (blends ? programs.two_views : programs.one_view);
    if (&program != current) program.use();
    current = &program;
    const bool culls = !scene_.is_double_sided(object);
    if (!culls) gl_.Disable(GL_CULL_FACE);
    draw_one(cell, plan, i);
    if (!culls) gl_.Enable(GL_CULL_FACE);
  }
  if (style == HybridStyle::wireframe) draw_edges(cell, plan);
}

void HybridRenderer::draw_edges(const ResidentCell& cell, const HybridPlan& plan) const {
  edges_.use();
  gl_.PolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  gl_.DepthFunc(GL_GEQUAL);
  for (std::size_t i = 0; i < plan.outside.size(); ++i) draw_one(cell, plan, i);
  gl_.DepthFunc(GL_GREATER);
  gl_.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

}  // namespace viewcell
