#include "formats/gltf_mesh.h"

#include <algorithm>
#include <set>

#include "formats/gltf_attributes.h"
#include "formats/mesh_limits.h"

namespace viewcell {
namespace {

enum Mode { kTriangles = 4, kStrip = 5, kFan = 6 };

// Below it a triangle that is packed is not believed: Draco takes one to five bits for it.
constexpr double kMostPackedPerByte = 16;

// Sets of joints and weights: four each.
constexpr int kMostInfluenceSets = 8;

std::int64_t mode_of(const JsonCursor& primitive) {
  return primitive.has("mode") ? primitive.at("mode").integer(0, 6) : std::int64_t{kTriangles};
}

JsonCursor primitives_of(const GltfFile& gltf, std::int64_t mesh) {
  return gltf.root().at("meshes").at(static_cast<std::size_t>(mesh)).at("primitives");
}

std::optional<JsonCursor> material_at(const GltfFile& gltf, const JsonCursor& primitive) {
  const std::int64_t id = optional_gltf_index(primitive, "material");
  if (id < 0) return std::nullopt;
  return gltf.root().at("materials").at(static_cast<std::size_t>(id));
}

// What the vertices of a primitive take from its material.
struct Look {
  std::optional<GltfTextureUse> texture;
  glm::vec3 base_color{1};
};

Look look_of(const GltfFile& gltf, const JsonCursor& primitive) {
  const std::optional<JsonCursor> material = material_at(gltf, primitive);
  if (!material) return {};
  return {leading_texture(*material), glm::vec3(base_color_factor(*material))};
}

// Primitives with the same key have the same vertices. Exporters let many draw from one long list.
std::string vertices_key(const JsonCursor& primitive, const Look& look) {
  const GltfTexcoords t = look.texture ? look.texture->texcoords : GltfTexcoords();
  const Json own{t.set,      t.offset.x,        t.offset.y,        t.scale.x,        t.scale.y,
                 t.rotation, look.base_color.x, look.base_color.y, look.base_color.z};
  std::string key = own.dump();
  for (const char* name : {"attributes", "targets", "extensions"})
    if (primitive.has(name)) key += primitive.at(name).value().dump();
  return key;
}

double count_triangles(std::int64_t mode, double n_indices) {
  return mode == kTriangles ? std::floor(n_indices / 3) : std::max(0.0, n_indices - 2);
}

void check_packing(const GltfFile& gltf, const JsonCursor& primitive, double n_triangles,
                   const MeshLimits& limits) {
  if (limits.max_triangles != 0 || !has_extension(primitive, "KHR_draco_mesh_compression")) return;
  const JsonCursor extension = extension_of(primitive, "KHR_draco_mesh_compression");
  const double most =
      kMostPackedPerByte *
      static_cast<double>(read_view(gltf, gltf_index(extension.at("bufferView"))).bytes.size());
  if (n_triangles > most) extension.fail(describe_growth(n_triangles, "triangles", most));
}

// ---- triangles ----

std::vector<std::uint32_t> read_indices(const GltfFile& gltf, const JsonCursor& primitive,
                                        std::size_t n) {
  if (!primitive.has("indices")) {
    std::vector<std::uint32_t> all(n);
    for (std::size_t v = 0; v < n; ++v) all[v] = static_cast<std::uint32_t>(v);
    return all;
  }
  std::vector<std::uint32_t> out =
      read_integer_accessor(gltf, gltf_index(primitive.at("indices")), 1);
  for (std::size_t i = 0; i < out.size(); ++i)
    if (out[i] >= n)
      primitive.fail("index " + std::to_string(i) + ": vertex " + std::to_string(out[i]) +
                     " does not exist; there are " + std::to_string(n));
  return out;
}

// Every second triangle of a strip is turned over. What has a corner twice leads from one strip to
// the next.
std::vector<Triangle> make_triangles(const std::vector<std::uint32_t>& indices, std::int64_t mode) {
  std::vector<Triangle> out;
  const std::size_t n = indices.size();
  out.reserve(static_cast<std::size_t>(count_triangles(mode, static_cast<double>(n))));
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    const Triangle t{indices[a], indices[b], indices[c]};
    if (mode == kStrip && (t[0] == t[1] || t[1] == t[2] || t[0] == t[2])) return;
    out.push_back(t);
  };
  if (mode == kTriangles)
    for (std::size_t i = 0; i + 2 < n; i += 3) add(i, i + 1, i + 2);
  if (mode == kStrip)
    for (std::size_t i = 0; i + 2 < n; ++i) add(i, i + 1 + i % 2, i + 2 - i % 2);
  if (mode == kFan)
    for (std::size_t i = 1; i + 1 < n; ++i) add(i, i + 1, 0);
  return out;
}

// ---- vertices ----

std::vector<glm::vec3> to_vec3(const std::vector<float>& numbers, std::size_t stride) {
  std::vector<glm::vec3> out(numbers.size() / stride);
  for (std::size_t v = 0; v < out.size(); ++v)
    out[v] = {numbers[stride * v], numbers[stride * v + 1], numbers[stride * v + 2]};
  return out;
}

// The vertices' colours times the material's base colour.
std::vector<glm::vec3> read_gltf_colors(const GltfAttributes& attributes,
                                        const JsonCursor& primitive, const glm::vec3& base) {
  if (!attributes.has("COLOR_0")) {
    if (base == glm::vec3(1)) return {};
    return std::vector<glm::vec3>(attributes.n_vertices(), base);
  }
  const std::size_t n_channels = attributes.n_components("COLOR_0");
  if (n_channels != 3 && n_channels != 4)
    primitive.at("attributes").at("COLOR_0").fail("expected 3 or 4 components");
  std::vector<glm::vec3> out =
      to_vec3(attributes.floats("COLOR_0", n_channels, GltfIntegers::shares), n_channels);
  for (glm::vec3& color : out) color = base * glm::clamp(color, 0.0f, 1.0f);
  return out;
}

// The set that the texture asks for; without a texture the first that there is. -1: none.
std::int64_t choose_set(const GltfAttributes& attributes, const Look& look, Remarks* remarks) {
  const auto has = [&](std::int64_t set) {
    return attributes.has("TEXCOORD_" + std::to_string(set));
  };
  if (look.texture) {
    const std::int64_t set = look.texture->texcoords.set;
    if (has(set)) return set;
    add_remark(remarks, "primitives without the texture coordinates that their texture asks for");
    return -1;
  }
  for (std::int64_t set = 0; set < 8; ++set)
    if (has(set)) return set;
  return -1;
}

// glTF's texture origin is the upper left; ours is the lower left.
std::vector<glm::vec2> read_gltf_texcoords(const GltfAttributes& attributes, const Look& look,
                                           Remarks* remarks) {
  const std::int64_t set = choose_set(attributes, look, remarks);
  if (set < 0) return {};
  const GltfTexcoords how = look.texture ? look.texture->texcoords : GltfTexcoords();
  const bool is_moved = how != GltfTexcoords{.set = how.set};
  const std::vector<float> numbers = attributes.floats("TEXCOORD_" + std::to_string(set), 2);
  std::vector<glm::vec2> out(numbers.size() / 2);
  for (std::size_t v = 0; v < out.size(); ++v) {
    glm::dvec2 uv(numbers[2 * v], numbers[2 * v + 1]);
    if (is_moved) uv = how.apply(uv);
    out[v] = {uv.x, 1 - uv.y};
  }
  return out;
}

// Weights of each vertex add up to 1; where there are none, its first joint has it.
void normalize_weights(GltfVertices& out, Remarks* remarks) {
  const std::size_t n = out.n_influences;
  std::size_t n_unbound = 0;
  for (std::size_t first = 0; first < out.weights.size(); first += n) {
    float sum = 0;
    for (std::size_t k = 0; k < n; ++k) sum += out.weights[first + k];
    if (!(sum > 0)) {
      ++n_unbound;
      std::fill_n(out.weights.begin() + static_cast<std::ptrdiff_t>(first), n, 0.0f);
      out.weights[first] = sum = 1;
    }
    for (std::size_t k = 0; k < n; ++k) out.weights[first + k] /= sum;
  }
  add_remark(remarks, "vertices without weights of joints, bound to their first one", n_unbound);
}

void read_influences(const GltfAttributes& attributes, const JsonCursor& primitive,
                     GltfVertices& out, Remarks* remarks) {
  std::vector<std::vector<std::uint32_t>> joints;
  std::vector<std::vector<float>> weights;
  for (int set = 0; attributes.has("JOINTS_" + std::to_string(set)); ++set) {
    const std::string suffix = std::to_string(set);
    if (set == kMostInfluenceSets) primitive.fail("has more than 8 sets of joints");
    if (!attributes.has("WEIGHTS_" + suffix)) primitive.fail("has no WEIGHTS_" + suffix);
    joints.push_back(attributes.integers("JOINTS_" + suffix, 4));
    weights.push_back(attributes.floats("WEIGHTS_" + suffix, 4, GltfIntegers::shares));
  }
  if (joints.empty()) {
    add_remark(remarks, "primitives with a skin and without joints, shown where their node is");
    return;
  }
  out.n_influences = 4 * joints.size();
  for (std::size_t v = 0; v < attributes.n_vertices(); ++v)
    for (std::size_t set = 0; set < joints.size(); ++set)
      for (std::size_t k = 4 * v; k < 4 * v + 4; ++k) {
        out.joints.push_back(joints[set][k]);
        out.weights.push_back(weights[set][k]);
      }
  normalize_weights(out, remarks);
}

GltfVertices read_gltf_vertices(const GltfAttributes& attributes, const JsonCursor& primitive,
                                const Look& look, bool has_skin, Remarks* remarks) {
  GltfVertices out;
  out.positions = to_vec3(attributes.floats("POSITION", 3), 3);
  if (attributes.has("NORMAL")) out.normals = to_vec3(attributes.floats("NORMAL", 3), 3);
  out.colors = read_gltf_colors(attributes, primitive, look.base_color);
  out.texcoords = read_gltf_texcoords(attributes, look, remarks);
  if (has_skin) read_influences(attributes, primitive, out, remarks);
  return out;
}

// Pictures are drawn as if they repeated; what shows another thing then is said.
void remark_wrapping(const GltfFile& gltf, const Look& look, const GltfVertices& vertices,
                     const std::vector<Triangle>& triangles, Remarks* remarks) {
  if (!look.texture || vertices.texcoords.empty()) return;
  if (sampler_of(gltf.root(), look.texture->texture).is_repeating()) return;
  constexpr float kSlack = 1e-4f;
  const auto is_beyond = [&](std::uint32_t v) {
    const glm::vec2& uv = vertices.texcoords[v];
    return std::min(uv.x, uv.y) < -kSlack || std::max(uv.x, uv.y) > 1 + kSlack;
  };
  add_remark(remarks,
             "triangles beyond the sides of a picture that is clamped or mirrored there, read as "
             "if it repeated",
             static_cast<std::size_t>(
                 std::count_if(triangles.begin(), triangles.end(), [&](const Triangle& t) {
                   return is_beyond(t[0]) || is_beyond(t[1]) || is_beyond(t[2]);
                 })));
}

}  // namespace

GltfMeshSize measure_gltf_mesh(const GltfFile& gltf, std::int64_t mesh, const MeshLimits& limits,
                               Remarks* remarks) {
  GltfMeshSize out;
  std::set<std::string> keys;
  const JsonCursor primitives = primitives_of(gltf, mesh);
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    const JsonCursor primitive = primitives.at(i);
    const std::int64_t mode = mode_of(primitive);
    if (mode < kTriangles) {
      add_remark(remarks, "primitives of points or lines, left out");
      continue;
    }
    const std::int64_t position = optional_gltf_index(primitive.at("attributes"), "POSITION");
    if (position < 0) primitive.fail("has no POSITION");
    const auto count = [&](std::int64_t id) {
      return static_cast<double>(read_accessor_shape(gltf, id).count);
    };
    const double n_vertices = count(position);
    const std::int64_t indices = optional_gltf_index(primitive, "indices");
    const double n_triangles = count_triangles(mode, indices < 0 ? n_vertices : count(indices));
    check_packing(gltf, primitive, n_triangles, limits);
    out.n_triangles += n_triangles;
    if (keys.insert(vertices_key(primitive, look_of(gltf, primitive))).second)
      out.n_vertices += n_vertices;
  }
  return out;
}

std::vector<float> morph_weights(const GltfFile& gltf, const GltfPlacement& placement) {
  const JsonCursor owner =
      placement.has_weights ? gltf.root().at("nodes").at(placement.node)
                            : gltf.root().at("meshes").at(static_cast<std::size_t>(placement.mesh));
  std::vector<float> out;
  if (!owner.has("weights")) return out;
  const JsonCursor weights = owner.at("weights");
  for (const double w : weights.numbers(weights.size())) out.push_back(static_cast<float>(w));
  if (std::all_of(out.begin(), out.end(), [](float w) { return w == 0; })) out.clear();
  return out;
}

GltfMesh read_gltf_mesh(const GltfFile& gltf, const GltfPlacement& placement, Remarks* remarks) {
  GltfMesh out;
  std::map<std::string, std::size_t> ids;
  const std::vector<float> weights = morph_weights(gltf, placement);
  const JsonCursor primitives = primitives_of(gltf, placement.mesh);
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    const JsonCursor primitive = primitives.at(i);
    const std::int64_t mode = mode_of(primitive);
    if (mode < kTriangles) continue;
    const Look look = look_of(gltf, primitive);
    const GltfAttributes attributes(gltf, primitive, weights);
    const auto [found, is_new] =
        ids.try_emplace(vertices_key(primitive, look), out.vertices.size());
    if (is_new)
      out.vertices.push_back(
          read_gltf_vertices(attributes, primitive, look, placement.skin >= 0, remarks));
    GltfPart part;
    part.vertices = found->second;
    part.material = optional_gltf_index(primitive, "material");
    part.triangles =
        attributes.packed()
            ? attributes.packed()->triangles
            : make_triangles(read_indices(gltf, primitive, attributes.n_vertices()), mode);
    remark_wrapping(gltf, look, out.vertices[part.vertices], part.triangles, remarks);
    out.parts.push_back(std::move(part));
  }
  return out;
}

}  // namespace viewcell
