#include "play/unseen_renderer.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "scene/lighting.h"

namespace viewcell {
namespace {

// The depth is nearer than the cleared one, 0, and farther than anything's.
constexpr const char* kUnseenVertex = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 color_in;
layout(location = 0) out vec3 color;
uniform mat4 clip_from_local;
uniform vec4 all_in;  // if its alpha is 1, all are of this colour
void main() {
  gl_Position = clip_from_local * vec4(position, 1);
  gl_Position.z = 1e-20 * gl_Position.w;
  color = all_in.a > 0.0 ? all_in.rgb : color_in.rgb;
}
)";

constexpr const char* kUnseenFragment = R"(#version 450 core
layout(location = 0) in vec3 color;
layout(location = 0) out vec4 result;
void main() { result = vec4(color, 254.0 / 255.0); }
)";

}  // namespace

UnseenRenderer::UnseenRenderer(const Gl& gl)
    : gl_(gl), program_(gl, "unseen objects", kUnseenVertex, kUnseenFragment) {}

void UnseenRenderer::draw(const Camera& camera, const ResidentCell& cell, const HybridPlan& plan,
                          HybridStyle style) const {
  if (plan.unseen.empty()) return;
  std::vector<GLsizei> counts;
  std::vector<const void*> offsets;
  for (const std::uint16_t slot : plan.unseen) {
    const UnseenObject& object = cell.ready->unseen[slot];
    counts.push_back(static_cast<GLsizei>(object.n_indices));
    offsets.push_back(reinterpret_cast<const void*>(std::size_t{object.first_index} * 4));
  }
  const glm::mat4 clip(glm::translate(clip_from_world(camera), cell.ready->origin));
  const glm::vec4 all_in = style == HybridStyle::textured
                               ? glm::vec4(0)
                               : glm::vec4(srgb_encode(kind_color(Representation::unseen)), 1);
  program_.use();
  gl_.ProgramUniformMatrix4fv(program_.id(), program_.uniform("clip_from_local"), 1, GL_FALSE,
                              glm::value_ptr(clip));
  gl_.ProgramUniform4fv(program_.id(), program_.uniform("all_in"), 1, glm::value_ptr(all_in));
  cell.unseen_array.bind();
  gl_.Disable(GL_CULL_FACE);
  gl_.MultiDrawElements(GL_TRIANGLES, counts.data(), GL_UNSIGNED_INT, offsets.data(),
                        static_cast<GLsizei>(counts.size()));
  gl_.Enable(GL_CULL_FACE);
}

}  // namespace viewcell
