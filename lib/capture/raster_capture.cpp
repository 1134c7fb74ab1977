#include "capture/raster_capture.h"

#include <algorithm>
#include <cstddef>
#include <glm/gtc/type_ptr.hpp>

#include "base/error.h"

namespace viewcell {
namespace {

struct Vertex {
  glm::vec3 position, normal;
};

// Nearer than anything that is captured; float depth keeps its relative precision however small
// this is.
constexpr double kNearest = 1e-6;
// Framebuffers of 4.5 may be limited to 16384; a block of this side takes 336 MB.
constexpr int kMostBlock_px = 4096;

constexpr const char* kVertexSource = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 clip_from_model;
uniform mat3 world_from_model;
layout(location = 0) out vec3 normal_world;
void main() {
  normal_world = world_from_model * normal;
  gl_Position = clip_from_model * vec4(position, 1);
}
)";

// 1/w is affine on the screen and comes without a division: it is the inverse depth, kept where
// alpha would be.
std::string fragment_source() {
  return "#version 450 core\n"
         "layout(location = 0) in vec3 normal_world;\n"
         "layout(location = 0) out vec4 result;\n"
         "uniform vec3 base_color, toward_light, light, ambient_sky, ambient_ground;\n" +
         make_shade_glsl() +
         "void main() {\n"
         "  vec3 n = normalize(normal_world);\n"
         "  if (!gl_FrontFacing) n = -n;  // the far side of a double-sided surface\n"
         "  result = vec4(shade(base_color, n), gl_FragCoord.w);\n"
         "}\n";
}

void set_uniform(const Gl& gl, const GlProgram& program, const char* name, const glm::vec3& v) {
  gl.ProgramUniform3fv(program.id(), program.uniform(name), 1, glm::value_ptr(v));
}

// Copies a block that was read back into the tile.
void store(CaptureTile& tile, const Crop& block, const ImageRgbaFloat& pixels) {
  for (int y = 0; y < block.height_px; ++y)
    for (int x = 0; x < block.width_px; ++x) {
      const RgbaFloat& from = pixels.at(x, y);
      if (!(from[3] > 0)) continue;
      const int to_x = block.x - tile.crop.x + x, to_y = block.y - tile.crop.y + y;
      tile.color.at(to_x, to_y) = {from[0], from[1], from[2], 1};
      tile.inverse_depth.at(to_x, to_y) = from[3];
    }
}

}  // namespace

// With d = world - eye, the image point is X = half + focal (d.right) / depth, and the block's
// clip x = (2 (X - block.x) / width - 1) depth; Y alike, turned over.
glm::dmat4 clip_from_world(const CaptureView& view, const Crop& block) {
  const double half = 0.5 * view.source_px;
  const double sx = 2.0 / block.width_px, sy = 2.0 / block.height_px;
  const glm::dvec3 x = sx * view.focal_px * view.right + (sx * (half - block.x) - 1) * view.forward;
  const glm::dvec3 y = sy * view.focal_px * view.up + (1 - sy * (half - block.y)) * view.forward;
  glm::dmat4 rows(glm::dvec4(x, -glm::dot(x, view.eye)), glm::dvec4(y, -glm::dot(y, view.eye)),
                  glm::dvec4(0, 0, 0, kNearest),
                  glm::dvec4(view.forward, -glm::dot(view.forward, view.eye)));
  return glm::transpose(rows);
}

RasterCapture::RasterCapture(const Gl& gl, const Scene& scene)
    : gl_(gl),
      scene_(scene),
      program_(gl, "capture", kVertexSource, fragment_source()),
      meshes_(scene.meshes.size()) {
  const Lighting& lighting = scene.lighting;
  set_uniform(gl, program_, "toward_light", lighting.toward_light);
  set_uniform(gl, program_, "light", lighting.light);
  set_uniform(gl, program_, "ambient_sky", lighting.ambient_sky);
  set_uniform(gl, program_, "ambient_ground", lighting.ambient_ground);
  check_gl(gl, "making the capture program");
}

const RasterCapture::GpuMesh& RasterCapture::upload(MeshId id) {
  std::optional<GpuMesh>& slot = meshes_[index(id)];
  if (slot) return *slot;
  const TriMesh& mesh = scene_.meshes[index(id)].mesh;
  VIEWCELL_CHECK(mesh.normals.size() == mesh.positions.size(), mesh.normals.size());
  std::vector<Vertex> vertices;
  vertices.reserve(mesh.positions.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    vertices.push_back({mesh.positions[v], mesh.normals[v]});
  GpuMesh gpu{make_buffer(gl_, vertices), make_buffer(gl_, mesh.triangles), GlVertexArray(gl_),
              static_cast<GLsizei>(3 * mesh.triangles.size())};
  gl_.VertexArrayVertexBuffer(gpu.array.id(), 0, gpu.vertices.id(), 0, sizeof(Vertex));
  gl_.VertexArrayElementBuffer(gpu.array.id(), gpu.indices.id());
  gpu.array.set_attribute(0, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, position));
  gpu.array.set_attribute(1, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, normal));
  check_gl(gl_, "uploading a mesh to capture");
  return slot.emplace(std::move(gpu));
}

CaptureTile RasterCapture::capture(ObjectId id, const CaptureView& view, const Crop& crop) {
  VIEWCELL_CHECK(crop.width_px > 0 && crop.height_px > 0, crop.width_px, crop.height_px);
  CaptureTile tile{id, view, crop, ImageRgbaFloat(crop.width_px, crop.height_px),
                   Image<float>(crop.width_px, crop.height_px)};
  for (int y = 0; y < crop.height_px; y += kMostBlock_px)
    for (int x = 0; x < crop.width_px; x += kMostBlock_px)
      draw_block(tile, {crop.x + x, crop.y + y, std::min(kMostBlock_px, crop.width_px - x),
                        std::min(kMostBlock_px, crop.height_px - y)});
  return tile;
}

void RasterCapture::draw_block(CaptureTile& tile, const Crop& block) {
  const SceneObject& object = scene_.objects[index(tile.object)];
  const GpuMesh& mesh = upload(object.mesh);
  // The product in double: far from the origin, float would lose what cancels.
  const glm::mat4 clip_from_model(clip_from_world(tile.view, block) *
                                  object.matrix_world_from_model());
  const glm::mat3 rotation(glm::mat3_cast(object.rotation));
  gl_.ProgramUniformMatrix4fv(program_.id(), program_.uniform("clip_from_model"), 1, GL_FALSE,
                              glm::value_ptr(clip_from_model));
  gl_.ProgramUniformMatrix3fv(program_.id(), program_.uniform("world_from_model"), 1, GL_FALSE,
                              glm::value_ptr(rotation));
  set_uniform(gl_, program_, "base_color", scene_.material_of(object).base_color);

  const GlFramebuffer target(gl_, block.width_px, block.height_px, {GL_RGBA32F});
  check_gl(gl_, "making a framebuffer to capture into");
  target.bind();
  target.clear({0, 0, 0, 0});
  program_.use();
  mesh.array.bind();
  if (scene_.material_of(object).double_sided) gl_.Disable(GL_CULL_FACE);
  gl_.DrawElements(GL_TRIANGLES, mesh.n_indices, GL_UNSIGNED_INT, nullptr);
  gl_.Enable(GL_CULL_FACE);
  store(tile, block, target.read_rgba_float(0));
}

}  // namespace viewcell
