#include "capture/raster_capture.h"

#include <algorithm>
#include <cstddef>
#include <glm/gtc/type_ptr.hpp>

#include "base/error.h"
#include "gl/mip_upload.h"

namespace viewcell {
namespace {

struct Vertex {
  glm::vec3 position, normal;
};

// Besides, of meshes with pictures or colours.
struct DressedVertex {
  glm::vec2 texcoord{0};
  glm::vec3 color{1};
};

// Nearer than anything that is captured; float depth keeps its relative precision however small
// this is.
constexpr double kNearest = 1e-6;
// Framebuffers of 4.5 may be limited to 16384; a block of this side takes 336 MB.
constexpr int kMostBlock_px = 4096;

// 1/w is affine on the screen and comes without a division: it is the inverse depth, kept where
// alpha would be.
std::string fragment_source(const SurfaceKind& kind) {
  return "#version 450 core\n"
         "layout(location = 0) out vec4 result;\n"
         "uniform vec3 toward_light, light, ambient_sky, ambient_ground;\n" +
         make_shade_glsl() + surface_fragment_glsl(kind) +
         "void main() { result = vec4(surface_color(), gl_FragCoord.w); }\n";
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
    : gl_(gl), scene_(scene), meshes_(scene.meshes.size()) {}

const GlProgram& RasterCapture::program_for(const SurfaceKind& kind) {
  const auto [at, is_new] = programs_.try_emplace(kind);
  GlProgram& program = at->second;
  if (!is_new) return program;
  program = GlProgram(gl_, "capture", surface_vertex_glsl(kind), fragment_source(kind));
  const Lighting& lighting = scene_.lighting;
  set_uniform(gl_, program, "toward_light", lighting.toward_light);
  set_uniform(gl_, program, "light", lighting.light);
  set_uniform(gl_, program, "ambient_sky", lighting.ambient_sky);
  set_uniform(gl_, program, "ambient_ground", lighting.ambient_ground);
  check_gl(gl_, "making the capture program");
  return program;
}

const GlTexture& RasterCapture::texture_for(const Material& material) {
  const auto [at, is_new] =
      textures_.try_emplace({material.picture, material.wrap_u, material.wrap_v});
  if (is_new) at->second = upload_mips(gl_, scene_.texture_of(material));
  return at->second;
}

const RasterCapture::GpuMesh& RasterCapture::upload(MeshId id) {
  std::optional<GpuMesh>& slot = meshes_[index(id)];
  if (slot) return *slot;
  const SceneMesh& of_scene = scene_.meshes[index(id)];
  const TriMesh& mesh = of_scene.mesh;
  VIEWCELL_CHECK(mesh.normals.size() == mesh.positions.size(), mesh.normals.size());
  std::vector<Vertex> vertices;
  vertices.reserve(mesh.positions.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    vertices.push_back({mesh.positions[v], mesh.normals[v]});
  std::vector<Triangle> triangles = mesh.triangles;
  GpuMesh gpu{make_buffer(gl_, vertices),
              {},
              {},
              GlVertexArray(gl_),
              group_by_slot(of_scene.looks, triangles)};
  gpu.indices = make_buffer(gl_, triangles);
  gl_.VertexArrayVertexBuffer(gpu.array.id(), 0, gpu.vertices.id(), 0, sizeof(Vertex));
  gl_.VertexArrayElementBuffer(gpu.array.id(), gpu.indices.id());
  gpu.array.set_attribute(0, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, position));
  gpu.array.set_attribute(1, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, normal));
  if (!of_scene.looks.texcoords.empty() || !mesh.colors.empty()) {
    std::vector<DressedVertex> dressed(mesh.positions.size());
    for (std::size_t v = 0; v < dressed.size(); ++v) {
      if (!of_scene.looks.texcoords.empty()) dressed[v].texcoord = of_scene.looks.texcoords[v];
      if (!mesh.colors.empty()) dressed[v].color = mesh.colors[v];
    }
    gpu.dressed = make_buffer(gl_, dressed);
    gl_.VertexArrayVertexBuffer(gpu.array.id(), 1, gpu.dressed.id(), 0, sizeof(DressedVertex));
    gpu.array.set_attribute(kTexcoordPlace, 2, GL_FLOAT, GL_FALSE,
                            offsetof(DressedVertex, texcoord), 1);
    gpu.array.set_attribute(kColorPlace, 3, GL_FLOAT, GL_FALSE, offsetof(DressedVertex, color), 1);
  }
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
  const GlFramebuffer target(gl_, block.width_px, block.height_px, {GL_RGBA32F});
  check_gl(gl_, "making a framebuffer to capture into");
  target.bind();
  target.clear({0, 0, 0, 0});
  mesh.array.bind();
  for (const SlotRange& slot : mesh.slots) {
    const Material& material = scene_.material_of(object, static_cast<std::size_t>(slot.slot));
    use(object, material, clip_from_model);
    gl_.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * slot.n_triangles), GL_UNSIGNED_INT,
                     reinterpret_cast<const void*>(slot.first_triangle * sizeof(Triangle)));
  }
  gl_.Enable(GL_CULL_FACE);
  store(tile, block, target.read_rgba_float(0));
}

void RasterCapture::use(const SceneObject& object, const Material& material,
                        const glm::mat4& clip_from_model) {
  const SurfaceKind kind = surface_kind(material, scene_.mesh_of(object));
  const GlProgram& program = program_for(kind);
  const glm::mat3 rotation(glm::mat3_cast(object.rotation));
  gl_.ProgramUniformMatrix4fv(program.id(), program.uniform("clip_from_model"), 1, GL_FALSE,
                              glm::value_ptr(clip_from_model));
  gl_.ProgramUniformMatrix3fv(program.id(), program.uniform("normal_matrix"), 1, GL_FALSE,
                              glm::value_ptr(rotation));
  set_uniform(gl_, program, "base_color", material.base_color);
  set_uniform(gl_, program, "emissive", material.emissive);
  gl_.ProgramUniform1f(program.id(), program.uniform("opacity"), material.opacity);
  gl_.ProgramUniform1f(program.id(), program.uniform("alpha_cutoff"), material.alpha_cutoff);
  if (kind.has_picture) gl_.BindTextureUnit(0, texture_for(material).id());
  program.use();
  (material.double_sided ? gl_.Disable : gl_.Enable)(GL_CULL_FACE);
}

}  // namespace viewcell
