// Source: the glTF 2.0 specification (Khronos).
// Differs: not by tinygltf (2.7.0 tried), which hands out addresses past a buffer's end for an
// image whose view is out of range, and whose accessors would all have to be checked again here.
// Not by cgltf (1.12 tried), whose check adds sizes without asking for their signs: a view from
// -100000000 of 100000064 bytes passes it, and is read.
#include <glm/gtc/quaternion.hpp>

#include "base/error.h"
#include "formats/gltf_buffers.h"
#include "formats/material_ids.h"
#include "formats/readers.h"

namespace viewcell {
namespace {

// A small file can place one mesh many times; what it grows to is bounded.
constexpr std::size_t kMostTriangles = 1 << 26;
constexpr std::size_t kMostVertices = 1 << 26;

enum Mode { kTriangles = 4, kStrip = 5, kFan = 6 };

glm::dmat4 local_matrix(const JsonCursor& node) {
  if (node.has("matrix")) {
    const std::vector<double> m = node.at("matrix").numbers(16);  // column by column
    glm::dmat4 matrix;
    for (int c = 0; c < 4; ++c)
      for (int r = 0; r < 4; ++r) matrix[c][r] = m[static_cast<std::size_t>(4 * c + r)];
    return matrix;
  }
  glm::dmat4 matrix(1);
  if (node.has("rotation")) {
    const std::vector<double> q = node.at("rotation").numbers(4);
    const glm::dquat rotation(q[3], q[0], q[1], q[2]);
    if (glm::length(rotation) > 0) matrix = glm::mat4_cast(glm::normalize(rotation));
  }
  if (node.has("scale")) {
    const std::vector<double> s = node.at("scale").numbers(3);
    for (int k = 0; k < 3; ++k) matrix[k] *= s[static_cast<std::size_t>(k)];
  }
  if (node.has("translation")) {
    const std::vector<double> t = node.at("translation").numbers(3);
    matrix[3] = glm::dvec4(t[0], t[1], t[2], 1);
  }
  return matrix;
}

class GltfFlattener {
 public:
  explicit GltfFlattener(const GltfFile& gltf) : gltf_(gltf), root_(gltf.root()) {}

  TriMesh flatten() {
    visit_nodes();
    if (!has_normals_) mesh_.normals.clear();
    if (!has_colors_) mesh_.colors.clear();
    if (!has_texcoords_) mesh_.texcoords.clear();
    material_ids_.finish(std::move(materials_), mesh_);
    return std::move(mesh_);
  }

 private:
  struct Visit {
    std::size_t node;
    glm::dmat4 world_from_parent;
  };

  // The default scene's roots; without scenes, the nodes that are nobody's children.
  std::vector<std::size_t> root_nodes() const {
    std::vector<std::size_t> roots;
    if (root_.has("scenes") && root_.at("scenes").size() > 0) {
      const std::int64_t id = root_.has("scene") ? root_.at("scene").integer(0, 1 << 30) : 0;
      const JsonCursor scene = root_.at("scenes").at(static_cast<std::size_t>(id));
      if (scene.has("nodes")) add_children(scene.at("nodes"), roots);
      return roots;
    }
    std::vector<std::size_t> children;
    const JsonCursor nodes = root_.at("nodes");
    std::vector<bool> is_child(nodes.size(), false);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (nodes.at(i).has("children")) add_children(nodes.at(i).at("children"), children);
    for (const std::size_t child : children)
      if (child < is_child.size()) is_child[child] = true;
    for (std::size_t i = 0; i < is_child.size(); ++i)
      if (!is_child[i]) roots.push_back(i);
    return roots;
  }

  static void add_children(const JsonCursor& ids, std::vector<std::size_t>& out) {
    for (std::size_t i = 0; i < ids.size(); ++i)
      out.push_back(static_cast<std::size_t>(ids.at(i).integer(0, 1 << 30)));
  }

  void visit_nodes() {
    if (!root_.has("nodes")) return;
    const JsonCursor nodes = root_.at("nodes");
    std::vector<bool> is_visited(nodes.size(), false);
    std::vector<Visit> stack;
    const auto push = [&](const std::vector<std::size_t>& ids, const glm::dmat4& matrix) {
      for (std::size_t i = ids.size(); i-- > 0;) stack.push_back({ids[i], matrix});
    };
    push(root_nodes(), glm::dmat4(1));
    while (!stack.empty()) {
      const Visit visit = stack.back();
      stack.pop_back();
      const JsonCursor node = nodes.at(visit.node);
      if (is_visited[visit.node]) node.fail("is reached twice; nodes must form a tree");
      is_visited[visit.node] = true;
      const glm::dmat4 world_from_node = visit.world_from_parent * local_matrix(node);
      if (node.has("mesh")) add_mesh(node.at("mesh").integer(0, 1 << 30), world_from_node);
      std::vector<std::size_t> children;
      if (node.has("children")) add_children(node.at("children"), children);
      push(children, world_from_node);
    }
  }

  void add_mesh(std::int64_t id, const glm::dmat4& matrix) {
    const JsonCursor primitives =
        root_.at("meshes").at(static_cast<std::size_t>(id)).at("primitives");
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      const JsonCursor primitive = primitives.at(i);
      const std::int64_t mode =
          primitive.has("mode") ? primitive.at("mode").integer(0, 6) : std::int64_t{kTriangles};
      if (mode >= kTriangles) add_primitive(primitive, mode, matrix);  // else points or lines
    }
  }

  static std::int64_t attribute(const JsonCursor& primitive, const char* name) {
    const JsonCursor attributes = primitive.at("attributes");
    return attributes.has(name) ? attributes.at(name).integer(0, 1 << 30) : -1;
  }

  void add_primitive(const JsonCursor& primitive, std::int64_t mode, const glm::dmat4& matrix) {
    const std::int64_t position_id = attribute(primitive, "POSITION");
    if (position_id < 0) primitive.fail("has no POSITION");
    const std::vector<float> positions = read_float_accessor(gltf_, position_id, 3);
    const std::size_t first = mesh_.positions.size(), n = positions.size() / 3;
    if (first + n > kMostVertices) primitive.fail("the scene has too many vertices");
    for (std::size_t v = 0; v < n; ++v) {
      const glm::dvec4 p(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2], 1);
      mesh_.positions.emplace_back(matrix * p);
    }
    add_normals(primitive, n, glm::dmat3(matrix));
    add_colors(primitive, n);
    const std::size_t first_triangle = mesh_.triangles.size();
    const bool is_mirrored = glm::determinant(glm::dmat3(matrix)) < 0;
    add_triangles(read_indices(primitive, n), mode, is_mirrored, first);
    if (mesh_.triangles.size() > kMostTriangles) primitive.fail("the scene has too many triangles");
    add_texcoords(primitive, n, first, first_triangle);
    materials_.resize(mesh_.triangles.size(), material_of(primitive));
  }

  std::vector<std::uint32_t> read_indices(const JsonCursor& primitive, std::size_t n) const {
    std::vector<std::uint32_t> indices;
    if (!primitive.has("indices")) {
      for (std::size_t v = 0; v < n; ++v) indices.push_back(static_cast<std::uint32_t>(v));
      return indices;
    }
    indices = read_index_accessor(gltf_, primitive.at("indices").integer(0, 1 << 30));
    for (std::size_t i = 0; i < indices.size(); ++i)
      if (indices[i] >= n)
        primitive.fail("index " + std::to_string(i) + ": vertex " + std::to_string(indices[i]) +
                       " does not exist; there are " + std::to_string(n));
    return indices;
  }

  void add_triangles(const std::vector<std::uint32_t>& indices, std::int64_t mode, bool is_mirrored,
                     std::size_t first) {
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      if (is_mirrored) std::swap(b, c);
      const auto vertex = [&](std::size_t i) {
        return static_cast<std::uint32_t>(first + indices[i]);
      };
      mesh_.triangles.push_back({vertex(a), vertex(b), vertex(c)});
    };
    const std::size_t n = indices.size();
    if (mode == kTriangles)
      for (std::size_t i = 0; i + 2 < n; i += 3) add(i, i + 1, i + 2);
    if (mode == kStrip)
      for (std::size_t i = 0; i + 2 < n; ++i) add(i, i + 1 + i % 2, i + 2 - i % 2);
    if (mode == kFan)
      for (std::size_t i = 1; i + 1 < n; ++i) add(i, i + 1, 0);
  }

  // Normals turn by the cofactors, which keep their direction under any scale.
  void add_normals(const JsonCursor& primitive, std::size_t n, const glm::dmat3& m) {
    const std::int64_t id = attribute(primitive, "NORMAL");
    if (id < 0) {
      mesh_.normals.resize(mesh_.positions.size(), glm::vec3(0));
      return;
    }
    const std::vector<float> normals = read_float_accessor(gltf_, id, 3);
    if (normals.size() != 3 * n) primitive.fail("NORMAL and POSITION differ in length");
    has_normals_ = true;
    const double sign = glm::determinant(m) < 0 ? -1 : 1;
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]),
                               glm::cross(m[0], m[1]));
    for (std::size_t v = 0; v < n; ++v) {
      const glm::dvec3 normal(normals[3 * v], normals[3 * v + 1], normals[3 * v + 2]);
      const glm::dvec3 turned = sign * (cofactors * normal);
      const double length = glm::length(turned);
      mesh_.normals.emplace_back(length > 0 ? turned / length : glm::dvec3(0));
    }
  }

  glm::vec3 base_color(const JsonCursor& primitive) const {
    if (!primitive.has("material")) return glm::vec3(1);
    const JsonCursor material = material_at(primitive);
    if (!material.has("pbrMetallicRoughness")) return glm::vec3(1);
    const JsonCursor pbr = material.at("pbrMetallicRoughness");
    if (!pbr.has("baseColorFactor")) return glm::vec3(1);
    const std::vector<double> c = pbr.at("baseColorFactor").numbers(4, 0, 1);
    return {c[0], c[1], c[2]};
  }

  // The vertex's colour times the material's base colour.
  void add_colors(const JsonCursor& primitive, std::size_t n) {
    const glm::vec3 base = base_color(primitive);
    has_colors_ |= base != glm::vec3(1);
    const std::int64_t id = attribute(primitive, "COLOR_0");
    if (id < 0) {
      mesh_.colors.resize(mesh_.positions.size(), base);
      return;
    }
    const std::size_t n_channels = accessor_components(gltf_, id);
    if (n_channels < 3) primitive.fail("COLOR_0 has fewer than three components");
    const std::vector<float> colors = read_float_accessor(gltf_, id, n_channels);
    if (colors.size() != n_channels * n) primitive.fail("COLOR_0 and POSITION differ in length");
    has_colors_ = true;
    for (std::size_t v = 0; v < n; ++v) {
      const float* c = colors.data() + n_channels * v;
      mesh_.colors.push_back(base * glm::clamp(glm::vec3(c[0], c[1], c[2]), 0.0f, 1.0f));
    }
  }

  // glTF's texture origin is the upper left; ours is the lower left.
  void add_texcoords(const JsonCursor& primitive, std::size_t n, std::size_t first,
                     std::size_t first_triangle) {
    const std::int64_t id = attribute(primitive, "TEXCOORD_0");
    if (id < 0) {
      mesh_.texcoords.resize(3 * mesh_.triangles.size(), glm::vec2(0));
      return;
    }
    const std::vector<float> texcoords = read_float_accessor(gltf_, id, 2);
    if (texcoords.size() != 2 * n) primitive.fail("TEXCOORD_0 and POSITION differ in length");
    has_texcoords_ = true;
    for (std::size_t t = first_triangle; t < mesh_.triangles.size(); ++t)
      for (const std::uint32_t v : mesh_.triangles[t])
        mesh_.texcoords.emplace_back(texcoords[2 * (v - first)],
                                     1 - texcoords[2 * (v - first) + 1]);
  }

  JsonCursor material_at(const JsonCursor& primitive) const {
    const std::int64_t id = primitive.at("material").integer(0, 1 << 30);
    return root_.at("materials").at(static_cast<std::size_t>(id));
  }

  std::int32_t material_of(const JsonCursor& primitive) {
    if (!primitive.has("material")) return MaterialIds::kNone;
    const JsonCursor material = material_at(primitive);
    return material_ids_.add(material.has("name") ? material.at("name").string()
                                                  : material.place());
  }

  const GltfFile& gltf_;
  JsonCursor root_;
  TriMesh mesh_;
  MaterialIds material_ids_;
  std::vector<std::int32_t> materials_;
  bool has_normals_ = false, has_colors_ = false, has_texcoords_ = false;
};

}  // namespace

TriMesh parse_gltf(std::string_view bytes, const std::filesystem::path& file, Remarks*) {
  const GltfFile gltf = parse_gltf_file(bytes, file);
  return GltfFlattener(gltf).flatten();
}

}  // namespace viewcell
