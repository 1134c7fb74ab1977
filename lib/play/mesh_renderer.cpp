#include "play/mesh_renderer.h"

#include <array>
#include <cstddef>
#include <glm/gtc/type_ptr.hpp>

#include "base/error.h"
#include "play/contact_sheet.h"
#include "play/index_map_lookup.h"
#include "play/shading.h"
#include "scene/scene.h"

namespace viewcell {
namespace {

struct Vertex {
  glm::vec3 position, normal;  // frame space
  glm::vec3 surface;           // texture coordinates and 0; or a linear colour
};
static_assert(sizeof(Vertex) == 36);

// Every three vertices are a triangle of their own, so the corner's number gives the distance to
// the edges.
constexpr const char* kVertexSource = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal_in;
layout(location = 2) in vec3 surface_in;
uniform mat4 clip_from_frame;
layout(location = 0) out vec3 normal;
layout(location = 1) out vec3 surface;
layout(location = 2) out vec3 corner;
void main() {
  normal = normal_in;
  surface = surface_in;
  int k = gl_VertexID % 3;
  corner = vec3(k == 0, k == 1, k == 2);
  gl_Position = clip_from_frame * vec4(position, 1);
}
)";

// surface_color() is the one place that says how a fragment comes by its colour.
constexpr const char* kTextureColor = R"(
layout(binding = 0) uniform sampler2D base_texture;
vec3 surface_color() { return texture(base_texture, surface.xy).rgb; }
)";
constexpr const char* kIndexedColor = R"(
vec3 surface_color() { return indexed_color(surface.xy); }
)";
constexpr const char* kVertexColor = R"(
vec3 surface_color() { return surface; }
)";

constexpr const char* kLitColor = R"(
uniform mat3 light_from_frame;
vec3 lit_color(vec3 base_color) {
  vec3 n = normal * inversesqrt(max(dot(normal, normal), 1e-20));
  if (!gl_FrontFacing) n = -n;
  return shade(base_color, light_from_frame * n);
}
)";
constexpr const char* kUnlitColor = R"(
vec3 lit_color(vec3 base_color) { return base_color; }
)";

// Each triangle draws its own half of an edge.
constexpr const char* kWireColor = R"(
uniform float half_width;
vec3 wire_color(vec3 color) {
  vec3 dx = dFdx(corner), dy = dFdy(corner);
  vec3 distance_px = corner * inversesqrt(max(dx * dx + dy * dy, 1e-20));
  float nearest = min(distance_px.x, min(distance_px.y, distance_px.z));
  return nearest < half_width ? vec3(0.01) : color;
}
)";
constexpr const char* kNoWireColor = R"(
vec3 wire_color(vec3 color) { return color; }
)";

enum class Surface { colors, texture, indexed_texture };

std::string surface_source(Surface surface) {
  if (surface == Surface::colors) return kVertexColor;
  if (surface == Surface::texture) return kTextureColor;
  return index_map_glsl() + kIndexedColor;
}

std::string fragment_source(const MeshStyle& style, Surface surface) {
  return std::string(
             "#version 450 core\n"
             "layout(location = 0) in vec3 normal;\n"
             "layout(location = 1) in vec3 surface;\n"
             "layout(location = 2) in vec3 corner;\n"
             "layout(location = 0) out vec4 color;\n") +
         make_shading_glsl(style.lighting) + surface_source(surface) +
         (style.lit ? kLitColor : kUnlitColor) + (style.wireframe ? kWireColor : kNoWireColor) +
         "void main() {\n"
         "  color = vec4(srgb_encode(wire_color(lit_color(surface_color()))), 1);\n}\n";
}

std::vector<glm::vec3> choose_normals(const TriMesh& mesh, NormalSource source) {
  if (source == NormalSource::mesh && !mesh.normals.empty()) return mesh.normals;
  return source == NormalSource::flat ? std::vector<glm::vec3>() : make_vertex_normals(mesh);
}

glm::vec3 flat_normal(const TriMesh& mesh, const Triangle& t) {
  const glm::dvec3 n = area_normal(mesh, t);
  const double length = glm::length(n);
  return length > 0 ? glm::vec3(n / length) : glm::vec3(0, 0, 1);  // no area, no pixel
}

glm::vec3 surface_of(const TriMesh& mesh, bool has_texture, const MeshStyle& style, std::size_t t,
                     std::size_t k) {
  if (has_texture) {
    const glm::vec2& uv = mesh.texcoords[3 * t + k];
    return {uv.x, style.flip_v ? 1 - uv.y : uv.y, 0};
  }
  return mesh.colors.empty() ? style.base_color : mesh.colors[mesh.triangles[t][k]];
}

// Positions are normalised in double: a small mesh far from the origin keeps its shape.
std::vector<Vertex> make_vertices(const TriMesh& mesh, const MeshFrame& frame, bool has_texture,
                                  const MeshStyle& style) {
  const std::vector<glm::vec3> normals = choose_normals(mesh, style.normals);
  std::vector<glm::vec3> positions;
  positions.reserve(mesh.positions.size());
  for (const glm::vec3& p : mesh.positions)
    positions.emplace_back(frame_from_mesh(frame, glm::dvec3(p)));
  std::vector<Vertex> vertices;
  vertices.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& triangle = mesh.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::vec3 normal = normals.empty() ? flat_normal(mesh, triangle) : normals[triangle[k]];
      vertices.push_back({positions[triangle[k]], turn_up_axis(frame.up, normal),
                          surface_of(mesh, has_texture, style, t, k)});
    }
  }
  return vertices;
}

// An image's first row is the top, a texture's is v = 0.
template <typename Pixel>
std::vector<Pixel> rows_upwards(const Image<Pixel>& image) {
  std::vector<Pixel> texels;
  texels.reserve(image.pixels.size());
  for (int row = image.height_px; row-- > 0;) {
    const Pixel* first = &image.at(0, row);
    texels.insert(texels.end(), first, first + image.width_px);
  }
  return texels;
}

GlTexture upload(const Gl& gl, const ImageRgba8& image) {
  return GlTexture::make_mipmapped(gl, GL_SRGB8_ALPHA8, image.width_px, image.height_px,
                                   rows_upwards(image).data());
}

GlTexture upload(const Gl& gl, const IndexMap& map) {
  GlTexture texture = GlTexture::make_2d(gl, GL_RG32F, map.width_px, map.height_px);
  texture.write(0, 0, 0, map.width_px, map.height_px, GL_RG, GL_FLOAT, rows_upwards(map).data());
  check_gl(gl, "an indexing map");
  return texture;
}

}  // namespace

const char* name_of(NormalSource source) {
  constexpr std::array<const char*, 3> kNames{"mesh", "computed", "flat"};
  return kNames[static_cast<std::size_t>(source)];
}

NormalSource parse_normal_source(const std::string& name) {
  for (const auto source : {NormalSource::mesh, NormalSource::computed, NormalSource::flat})
    if (name == name_of(source)) return source;
  throw UsageError("normals '" + name + "' are unknown: mesh, computed or flat");
}

MeshRenderer::MeshRenderer(const Gl& gl, const TriMesh& mesh, const MeshFrame& frame,
                           const ImageRgba8* texture, const MeshStyle& style,
                           const IndexMap* index_map)
    : gl_(gl), style_(style), array_(gl) {
  VIEWCELL_CHECK(style.size_px > 0 && style.samples > 0 &&
                     style.size_px <= kMostSamplesPerSide / style.samples,
                 style.size_px, style.samples);
  VIEWCELL_CHECK(!texture || mesh.texcoords.size() == 3 * mesh.triangles.size(),
                 mesh.texcoords.size());
  VIEWCELL_CHECK(texture || !index_map, "an indexing map without a texture");
  const Surface surface =
      index_map ? Surface::indexed_texture : (texture ? Surface::texture : Surface::colors);
  target_ = GlFramebuffer(gl, style.size_px * style.samples, style.size_px * style.samples);
  program_ = GlProgram(gl, "mesh", kVertexSource, fragment_source(style, surface));
  gl.ProgramUniform1f(program_.id(), program_.uniform("half_width"),
                      0.5f * static_cast<float>(style.samples));
  if (texture) texture_ = upload(gl, *texture);
  if (index_map) index_map_ = upload(gl, *index_map);
  const std::vector<Vertex> vertices = make_vertices(mesh, frame, texture != nullptr, style);
  vertices_ = make_buffer(gl, vertices);
  n_vertices_ = static_cast<GLsizei>(vertices.size());
  gl.VertexArrayVertexBuffer(array_.id(), 0, vertices_.id(), 0, sizeof(Vertex));
  array_.set_attribute(0, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, position));
  array_.set_attribute(1, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, normal));
  array_.set_attribute(2, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, surface));
  check_gl(gl, "making the mesh renderer");
}

ImageRgba8 MeshRenderer::draw(const Camera& view) const {
  const glm::mat4 clip_from_frame(clip_from_world(view));
  const glm::mat3 light_from_frame(style_.light_follows ? turn_eye_to_front(view) : glm::dmat3(1));
  const GLuint id = program_.id();
  gl_.ProgramUniformMatrix4fv(id, program_.uniform("clip_from_frame"), 1, GL_FALSE,
                              glm::value_ptr(clip_from_frame));
  gl_.ProgramUniformMatrix3fv(id, program_.uniform("light_from_frame"), 1, GL_FALSE,
                              glm::value_ptr(light_from_frame));
  const glm::vec3 sky = srgb_encode(style_.lighting.sky_color);
  target_.bind();
  target_.clear({sky.x, sky.y, sky.z, 0});
  gl_.BindTextureUnit(0, texture_.id());
  gl_.BindTextureUnit(1, index_map_.id());
  program_.use();
  array_.bind();
  gl_.Disable(GL_CULL_FACE);
  gl_.DrawArrays(GL_TRIANGLES, 0, n_vertices_);
  gl_.Enable(GL_CULL_FACE);
  ImageRgba8 picture = shrink_to_width(target_.read_rgba8(), style_.size_px);
  for (Rgba8& p : picture.pixels) p[3] = p[3] > 0 ? 255 : 0;
  return picture;
}

}  // namespace viewcell
