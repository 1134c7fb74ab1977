// Source: the glTF 2.0 specification (Khronos).
// Differs: not by tinygltf (2.7.0 tried), which hands out addresses past a buffer's end for an
// image whose view is out of range, and whose accessors would all have to be checked again here.
// Not by cgltf (1.12 tried), whose check adds sizes without asking for their signs: a view from
// -100000000 of 100000064 bytes passes it, and is read.
#include <algorithm>
#include <map>
#include <memory>
#include <tuple>

#include "base/error.h"
#include "formats/face_list.h"
#include "formats/gltf_mesh.h"
#include "formats/material_ids.h"
#include "formats/mesh_limits.h"
#include "formats/readers.h"

namespace viewcell {
namespace {

// Vertices of morph targets, all together: what a second or two adds up.
constexpr double kMostMorphed = 1 << 28;

// Normals turn by the cofactors, which keep their direction under any scale.
struct VertexTransform {
  explicit VertexTransform(const glm::dmat4& matrix) : world(matrix) {
    const glm::dmat3 m(matrix);
    is_mirrored = glm::determinant(m) < 0;
    normals = glm::dmat3(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    if (is_mirrored) normals = -normals;
  }
  glm::vec3 normal(const glm::vec3& n) const {
    const glm::dvec3 turned = normals * glm::dvec3(n);
    const double length = glm::length(turned);
    return length > 0 ? glm::vec3(turned / length) : glm::vec3(0);
  }

  glm::dmat4 world;
  glm::dmat3 normals;
  bool is_mirrored;
};

// Decoded meshes stay while more placements of them are to come.
class MeshCache {
 public:
  explicit MeshCache(const std::vector<GltfPlacement>& placements) {
    for (const GltfPlacement& placement : placements) ++n_uses_[key_of(placement)];
  }
  std::shared_ptr<const GltfMesh> read(const GltfFile& gltf, const GltfPlacement& placement,
                                       Remarks* remarks) {
    const Key key = key_of(placement);
    std::shared_ptr<const GltfMesh> mesh = meshes_[key];
    if (mesh == nullptr)
      mesh = std::make_shared<const GltfMesh>(read_gltf_mesh(gltf, placement, remarks));
    if (--n_uses_[key] > 0)
      meshes_[key] = mesh;
    else
      meshes_.erase(key);
    return mesh;
  }

 private:
  using Key = std::tuple<std::int64_t, std::int64_t, bool>;
  static Key key_of(const GltfPlacement& p) {
    return {p.mesh, p.has_weights ? static_cast<std::int64_t>(p.node) : -1, p.skin >= 0};
  }
  std::map<Key, std::size_t> n_uses_;
  std::map<Key, std::shared_ptr<const GltfMesh>> meshes_;
};

class GltfFlattener {
 public:
  GltfFlattener(const GltfFile& gltf, const MeshLimits& limits, Remarks* remarks)
      : gltf_(gltf),
        remarks_(remarks),
        nodes_(gltf),
        placements_(nodes_.place_meshes(remarks)),
        cache_(placements_),
        material_names_(name_materials(gltf.root())) {
    check_growth(limits);
  }

  TriMesh flatten() {
    for (const GltfPlacement& placement : placements_) add_placement(placement);
    if (!mesh_.normals.empty()) mesh_.normals.resize(places_.size(), glm::vec3(0));
    if (!mesh_.colors.empty()) mesh_.colors.resize(places_.size(), glm::vec3(1));
    if (!mesh_.texcoords.empty()) mesh_.texcoords.resize(3 * mesh_.triangles.size(), glm::vec2(0));
    material_ids_.finish(std::move(materials_), mesh_);
    place_vertices(places_, corners_of(mesh_), mesh_, remarks_);
    return std::move(mesh_);
  }

 private:
  // Counts what all placements come to before anything is decoded, and makes room for it.
  void check_growth(const MeshLimits& limits) {
    const double most = most_triangles(limits, gltf_.n_bytes);
    std::map<std::int64_t, GltfMeshSize> sizes;
    double n_triangles = 0, n_vertices = 0, n_morphed = 0;
    for (const GltfPlacement& placement : placements_) {
      const auto [found, is_new] = sizes.try_emplace(placement.mesh);
      GltfMeshSize& size = found->second;
      if (is_new) size = measure_gltf_mesh(gltf_, placement.mesh, limits, remarks_);
      if (size.n_triangles == 0) continue;
      const auto n = static_cast<double>(placement.n_instances);
      n_triangles += n * size.n_triangles;
      n_vertices += n * size.n_vertices;
      if (!is_new && !placement.has_weights) continue;
      const std::vector<float> weights = morph_weights(gltf_, placement);
      n_morphed +=
          size.n_vertices * static_cast<double>(std::count_if(weights.begin(), weights.end(),
                                                              [](float w) { return w != 0; }));
    }
    const auto check = [&](double n, const char* of_what, double limit) {
      if (n > limit) throw InputError(gltf_.file.string(), "", describe_growth(n, of_what, limit));
    };
    check(n_triangles, "triangles", most);
    check(n_vertices, "vertices", 3 * most);
    if (n_morphed > kMostMorphed)
      throw InputError(gltf_.file.string(), "",
                       "its morph targets have too many vertices to add up");
    places_.reserve(static_cast<std::size_t>(n_vertices));
    mesh_.triangles.reserve(static_cast<std::size_t>(n_triangles));
  }

  void add_placement(const GltfPlacement& placement) {
    const std::shared_ptr<const GltfMesh> mesh = cache_.read(gltf_, placement, remarks_);
    if (std::all_of(mesh->parts.begin(), mesh->parts.end(),
                    [](const GltfPart& part) { return part.triangles.empty(); }))
      return;
    for (const glm::dmat4& matrix : nodes_.world_from_instances(placement)) {
      const VertexTransform rigid(matrix);
      std::vector<std::uint32_t> first;  // of each list of vertices
      std::vector<std::vector<bool>> is_mirrored;
      for (const GltfVertices& vertices : mesh->vertices) {
        first.push_back(static_cast<std::uint32_t>(places_.size()));
        is_mirrored.emplace_back();
        if (vertices.n_influences > 0)
          is_mirrored.back() = add_bound_vertices(vertices, placement.skin);
        else
          for (std::size_t v = 0; v < vertices.positions.size(); ++v)
            add_vertex(vertices, v, rigid);
        add_colors(vertices);
      }
      for (const GltfPart& part : mesh->parts)
        add_part(part, mesh->vertices[part.vertices], first[part.vertices], rigid.is_mirrored,
                 is_mirrored[part.vertices]);
    }
  }

  void add_vertex(const GltfVertices& from, std::size_t v, const VertexTransform& transform) {
    if (!from.normals.empty()) {
      mesh_.normals.resize(places_.size(), glm::vec3(0));
      mesh_.normals.push_back(transform.normal(from.normals[v]));
    }
    places_.emplace_back(transform.world * glm::dvec4(from.positions[v], 1));
  }

  // Each by the sum of its joints' matrices. Gives which of them are mirrored.
  std::vector<bool> add_bound_vertices(const GltfVertices& from, std::int64_t skin) {
    const std::vector<glm::dmat4>& joints = nodes_.world_from_bound(skin);
    std::vector<bool> is_mirrored;
    for (std::size_t v = 0; v < from.positions.size(); ++v) {
      glm::dmat4 sum(0);
      for (std::size_t k = v * from.n_influences; k < (v + 1) * from.n_influences; ++k) {
        if (from.weights[k] == 0) continue;
        if (from.joints[k] >= joints.size())
          throw InputError(gltf_.file.string(), "skins[" + std::to_string(skin) + "]",
                           "vertex " + std::to_string(v) + " is bound to joint " +
                               std::to_string(from.joints[k]) + "; there are " +
                               std::to_string(joints.size()));
        sum += static_cast<double>(from.weights[k]) * joints[from.joints[k]];
      }
      const VertexTransform transform(sum);
      add_vertex(from, v, transform);
      is_mirrored.push_back(transform.is_mirrored);
    }
    return is_mirrored;
  }

  void add_colors(const GltfVertices& from) {
    if (from.colors.empty()) return;
    mesh_.colors.resize(places_.size() - from.positions.size(), glm::vec3(1));
    mesh_.colors.insert(mesh_.colors.end(), from.colors.begin(), from.colors.end());
  }

  // Triangles that are mirrored are turned over, so that they stay outside. of_vertices: empty, or
  // of each vertex instead of is_mirrored.
  void add_part(const GltfPart& part, const GltfVertices& vertices, std::uint32_t first,
                bool is_mirrored, const std::vector<bool>& of_vertices) {
    if (!vertices.texcoords.empty())
      mesh_.texcoords.resize(3 * mesh_.triangles.size(), glm::vec2(0));
    for (Triangle t : part.triangles) {
      if (of_vertices.empty() ? is_mirrored : of_vertices[t[0]]) std::swap(t[1], t[2]);
      if (!vertices.texcoords.empty())
        for (const std::uint32_t v : t) mesh_.texcoords.push_back(vertices.texcoords[v]);
      mesh_.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
    materials_.resize(mesh_.triangles.size(), material_id(part.material));
  }

  std::int32_t material_id(std::int64_t material) {
    if (material < 0) return MaterialIds::kNone;
    return material_ids_.add(material_names_.at(static_cast<std::size_t>(material)));
  }

  const GltfFile& gltf_;
  Remarks* remarks_;
  GltfNodes nodes_;
  std::vector<GltfPlacement> placements_;
  MeshCache cache_;
  std::vector<std::string> material_names_;
  TriMesh mesh_;
  std::vector<glm::dvec3> places_;  // of its vertices
  MaterialIds material_ids_;
  std::vector<std::int32_t> materials_;
};

}  // namespace

TriMesh parse_gltf(std::string_view bytes, const std::filesystem::path& file, Remarks* remarks,
                   const MeshLimits& limits) {
  const GltfFile gltf = parse_gltf_file(bytes, file, remarks);
  if (gltf.root().has("animations"))
    add_remark(remarks, "animations, not played", gltf.root().at("animations").size());
  return GltfFlattener(gltf, limits, remarks).flatten();
}

}  // namespace viewcell
