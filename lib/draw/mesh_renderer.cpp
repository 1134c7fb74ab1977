#include "draw/mesh_renderer.h"

#include <array>
#include <cstddef>
#include <glm/gtc/type_ptr.hpp>

#include "base/error.h"
#include "draw/index_map_lookup.h"
#include "draw/shading.h"
#include "mesh/split_corners.h"
#include "mesh/tangents.h"
#include "report/contact_sheet.h"
#include "scene/scene.h"

namespace viewcell {
namespace {

struct MeshVertex {
  glm::vec3 position, normal;  // frame space
  glm::vec3 surface;           // texture coordinates and 0; or a linear colour
};
static_assert(sizeof(MeshVertex) == 36);

// Further vertex attributes, with a normal map.
struct MappedVertex {
  glm::vec4 tangent;  // frame space; w: the side of the bitangent
  glm::vec2 uv;
};
static_assert(sizeof(MappedVertex) == 24);

// Every three vertices are a triangle of their own, so the corner's number gives the distance to
// the edges.
constexpr const char* kVertexSource = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal_in;
layout(location = 2) in vec3 surface_in;
layout(location = 3) in vec4 tangent_in;
layout(location = 4) in vec2 uv_in;
uniform mat4 clip_from_frame;
layout(location = 0) out vec3 normal;
layout(location = 1) out vec3 surface;
layout(location = 2) out vec3 corner;
layout(location = 3) out vec4 tangent;
layout(location = 4) out vec2 uv;
void main() {
  tangent = tangent_in;
  uv = uv_in;
  normal = normal_in;
  surface = surface_in;
  int k = gl_VertexID % 3;
  corner = vec3(k == 0, k == 1, k == 2);
  gl_Position = clip_from_frame * vec4(position, 1);
}
)";

// surface_color() alone decides a fragment's colour.
constexpr const char* kTextureColor = R"(
layout(binding = 0) uniform sampler2D base_texture;
vec3 surface_color() { return texture(base_texture, surface.xy).rgb; }
)";
constexpr const char* kIndexedColor = R"(
layout(binding = 0) uniform sampler2D base_texture;
vec3 surface_color() {
  IndexedTexcoords found = indexed_texcoords(surface.xy);
  return textureGrad(base_texture, found.uv, found.dx, found.dy).rgb;
}
)";
constexpr const char* kVertexColor = R"(
vec3 surface_color() { return surface; }
)";

// surface_normal() likewise for the normal, of any length. The frame of a normal map is that of
// mix_tangent_frame (mesh/tangents.h).
constexpr const char* kOwnNormal = R"(
vec3 surface_normal() { return normal; }
)";
constexpr const char* kNormalMap = R"(
layout(binding = 2) uniform sampler2D normal_map;
uniform float green_up;
vec3 mapped_normal(vec3 code) {
  vec3 n = 2 * code - 1;
  vec3 bitangent = tangent.w * cross(normal, tangent.xyz);
  return n.x * tangent.xyz + green_up * n.y * bitangent + n.z * normal;
}
)";
constexpr const char* kTextureNormal = R"(
vec3 surface_normal() { return mapped_normal(texture(normal_map, uv).xyz); }
)";
constexpr const char* kIndexedNormal = R"(
vec3 surface_normal() {
  IndexedTexcoords found = indexed_texcoords(uv);
  return mapped_normal(textureGrad(normal_map, found.uv, found.dx, found.dy).xyz);
}
)";

constexpr const char* kLitColor = R"(
uniform mat3 light_from_frame;
vec3 lit_color(vec3 base_color) {
  vec3 n = surface_normal();
  n *= inversesqrt(max(dot(n, n), 1e-20));
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

// Which textures there are.
struct Surface {
  bool has_texture, has_normal_map, is_indexed;
};

std::string surface_source(const Surface& s) {
  std::string out = s.is_indexed ? index_map_glsl() : "";
  out += !s.has_texture ? kVertexColor : (s.is_indexed ? kIndexedColor : kTextureColor);
  if (!s.has_normal_map) return out + kOwnNormal;
  return out + kNormalMap + (s.is_indexed ? kIndexedNormal : kTextureNormal);
}

std::string fragment_source(const MeshStyle& style, const Surface& surface) {
  return std::string(
             "#version 450 core\n"
             "layout(location = 0) in vec3 normal;\n"
             "layout(location = 1) in vec3 surface;\n"
             "layout(location = 2) in vec3 corner;\n"
             "layout(location = 3) in vec4 tangent;\n"
             "layout(location = 4) in vec2 uv;\n"
             "layout(location = 0) out vec4 color;\n") +
         make_shading_glsl(style.lighting) + surface_source(surface) +
         (style.lit ? kLitColor : kUnlitColor) + (style.wireframe ? kWireColor : kNoWireColor) +
         "void main() {\n"
         "  color = vec4(srgb_encode(wire_color(lit_color(surface_color()))), 1);\n}\n";
}

// By corner; empty: each triangle's own.
std::vector<glm::vec3> choose_normals(const TriMesh& mesh, NormalSource source) {
  if (source == NormalSource::flat) return {};
  return source == NormalSource::mesh ? make_corner_normals(mesh) : compute_corner_normals(mesh);
}

glm::vec3 flat_normal(const TriMesh& mesh, const Triangle& t) {
  const glm::dvec3 n = area_normal(mesh, t);
  const double length = glm::length(n);
  return length > 0 ? glm::vec3(n / length) : glm::vec3(0, 0, 1);  // no area, no pixel
}

glm::vec3 normal_of(const TriMesh& mesh, const std::vector<glm::vec3>& normals, std::size_t t,
                    std::size_t k) {
  const Triangle& triangle = mesh.triangles[t];
  return normals.empty() ? flat_normal(mesh, triangle) : normals[3 * t + k];
}

glm::vec2 uv_of(const TriMesh& mesh, const MeshStyle& style, std::size_t corner) {
  const glm::vec2& uv = mesh.texcoords[corner];
  return {uv.x, style.flip_v ? 1 - uv.y : uv.y};
}

glm::vec3 surface_of(const TriMesh& mesh, bool has_texture, const MeshStyle& style, std::size_t t,
                     std::size_t k) {
  if (has_texture) return {uv_of(mesh, style, 3 * t + k), 0};
  return mesh.colors.empty() ? style.base_color : mesh.colors[mesh.triangles[t][k]];
}

// Positions are normalised in double: a small mesh far from the origin keeps its shape.
std::vector<MeshVertex> make_vertices(const TriMesh& mesh, const MeshFrame& frame, bool has_texture,
                                      const MeshStyle& style) {
  const std::vector<glm::vec3> normals = choose_normals(mesh, style.normals);
  std::vector<glm::vec3> positions;
  positions.reserve(mesh.positions.size());
  for (const glm::vec3& p : mesh.positions)
    positions.emplace_back(frame_from_mesh(frame, glm::dvec3(p)));
  std::vector<MeshVertex> vertices;
  vertices.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& triangle = mesh.triangles[t];
    for (std::size_t k = 0; k < 3; ++k)
      vertices.push_back({positions[triangle[k]],
                          turn_up_axis(frame.up, normal_of(mesh, normals, t, k)),
                          surface_of(mesh, has_texture, style, t, k)});
  }
  return vertices;
}

// Upside down, a texture's v grows the other way: the same tangent on the other side.
std::vector<MappedVertex> make_mapped_vertices(const TriMesh& mesh, const MeshFrame& frame,
                                               const MeshStyle& style) {
  const std::vector<glm::vec3> normals = choose_normals(mesh, style.normals);
  std::vector<glm::vec3> of_corners;
  for (std::size_t c = 0; c < mesh.texcoords.size(); ++c)
    of_corners.push_back(normal_of(mesh, normals, c / 3, c % 3));
  std::vector<MappedVertex> vertices;
  for (const glm::vec4& t : make_corner_tangents(mesh, of_corners))
    vertices.push_back({glm::vec4(turn_up_axis(frame.up, glm::vec3(t)), style.flip_v ? -t.w : t.w),
                        uv_of(mesh, style, vertices.size())});
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

GlTexture upload(const Gl& gl, const ImageRgba8& image, GLenum format) {
  return GlTexture::make_mipmapped(gl, format, image.width_px, image.height_px,
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
                           const MeshTextures& textures, const MeshStyle& style,
                           const IndexMap* index_map, const ImageRgba8* normal_map)
    : gl_(gl), style_(style), array_(gl) {
  VIEWCELL_CHECK(style.size_px > 0 && style.samples > 0 &&
                     style.size_px <= kMostSamplesPerSide / style.samples,
                 style.size_px, style.samples);
  const bool has_texture = !textures.empty();
  VIEWCELL_CHECK(!(has_texture || normal_map) || mesh.texcoords.size() == 3 * mesh.triangles.size(),
                 mesh.texcoords.size());
  VIEWCELL_CHECK(has_texture || normal_map || !index_map, "an indexing map without a texture");
  const Surface surface{has_texture, normal_map && style.lit, index_map != nullptr};
  target_ = GlFramebuffer(gl, style.size_px * style.samples, style.size_px * style.samples);
  program_ = GlProgram(gl, "mesh", kVertexSource, fragment_source(style, surface));
  gl.ProgramUniform1f(program_.id(), program_.uniform("half_width"),
                      0.5f * static_cast<float>(style.samples));
  textures.for_each(mesh.triangles.size(), [&](const ImageRgba8& texture, std::size_t n) {
    runs_.push_back({upload(gl, texture, GL_SRGB8_ALPHA8), static_cast<GLsizei>(3 * n)});
  });
  if (index_map) index_map_ = upload(gl, *index_map);
  const std::vector<MeshVertex> vertices = make_vertices(mesh, frame, has_texture, style);
  vertices_ = make_buffer(gl, vertices);
  if (!has_texture) runs_.push_back({GlTexture(), static_cast<GLsizei>(vertices.size())});
  gl.VertexArrayVertexBuffer(array_.id(), 0, vertices_.id(), 0, sizeof(MeshVertex));
  array_.set_attribute(0, 3, GL_FLOAT, GL_FALSE, offsetof(MeshVertex, position));
  array_.set_attribute(1, 3, GL_FLOAT, GL_FALSE, offsetof(MeshVertex, normal));
  array_.set_attribute(2, 3, GL_FLOAT, GL_FALSE, offsetof(MeshVertex, surface));
  if (surface.has_normal_map) {
    normal_map_ = upload(gl, *normal_map, GL_RGBA8);
    gl.ProgramUniform1f(program_.id(), program_.uniform("green_up"),
                        style.normal_map_y == NormalMapY::up ? 1.0f : -1.0f);
    mapped_vertices_ = make_buffer(gl, make_mapped_vertices(mesh, frame, style));
    gl.VertexArrayVertexBuffer(array_.id(), 1, mapped_vertices_.id(), 0, sizeof(MappedVertex));
    array_.set_attribute(3, 4, GL_FLOAT, GL_FALSE, offsetof(MappedVertex, tangent), 1);
    array_.set_attribute(4, 2, GL_FLOAT, GL_FALSE, offsetof(MappedVertex, uv), 1);
  }
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
  gl_.BindTextureUnit(1, index_map_.id());
  gl_.BindTextureUnit(2, normal_map_.id());
  program_.use();
  array_.bind();
  gl_.Disable(GL_CULL_FACE);
  GLint first = 0;
  for (const Run& run : runs_) {
    gl_.BindTextureUnit(0, run.texture.id());
    gl_.DrawArrays(GL_TRIANGLES, first, run.n_vertices);
    first += run.n_vertices;
  }
  gl_.Enable(GL_CULL_FACE);
  ImageRgba8 picture = shrink_to_width(target_.read_rgba8(), style_.size_px);
  for (Rgba8& p : picture.pixels) p[3] = p[3] > 0 ? 255 : 0;
  return picture;
}

}  // namespace viewcell
