#include "formats/gltf_nodes.h"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>

#include "formats/gltf_accessors.h"
#include "mesh/offset.h"

namespace viewcell {
namespace {

constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";

glm::dmat4 make_matrix(const glm::dvec3& translation, const glm::dquat& rotation,
                       const glm::dvec3& scale) {
  glm::dmat4 matrix(1);
  if (glm::length(rotation) > 0) matrix = glm::mat4_cast(glm::normalize(rotation));
  for (int k = 0; k < 3; ++k) matrix[k] *= scale[k];
  matrix[3] = glm::dvec4(translation, 1);
  return matrix;
}

glm::dmat4 local_matrix(const JsonCursor& node) {
  if (node.has("matrix")) {
    const std::vector<double> m = node.at("matrix").numbers(16);  // column by column
    glm::dmat4 matrix;
    for (int c = 0; c < 4; ++c)
      for (int r = 0; r < 4; ++r) matrix[c][r] = m[static_cast<std::size_t>(4 * c + r)];
    return matrix;
  }
  const auto numbers = [&](const char* key, std::vector<double> standard) {
    return node.has(key) ? node.at(key).numbers(standard.size()) : standard;
  };
  std::vector<double> t{0, 0, 0};  // where we wrote it: an offset
  if (node.has("translation")) t = node.at("translation").numbers(3, -kMostOffset, kMostOffset);
  const std::vector<double> q = numbers("rotation", {0, 0, 0, 1}), s = numbers("scale", {1, 1, 1});
  return make_matrix({t[0], t[1], t[2]}, {q[3], q[0], q[1], q[2]}, {s[0], s[1], s[2]});
}

std::vector<std::size_t> list_ids(const JsonCursor& object, const char* key) {
  std::vector<std::size_t> out;
  if (!object.has(key)) return out;
  const JsonCursor ids = object.at(key);
  for (std::size_t i = 0; i < ids.size(); ++i)
    out.push_back(static_cast<std::size_t>(gltf_index(ids.at(i))));
  return out;
}

constexpr std::size_t kNoParent = static_cast<std::size_t>(-1);

bool is_hidden(const JsonCursor& node) {
  if (!has_extension(node, "KHR_node_visibility")) return false;
  const JsonCursor extension = extension_of(node, "KHR_node_visibility");
  return extension.has("visible") && !extension.at("visible").boolean();
}

std::size_t count_instances(const GltfFile& gltf, const JsonCursor& node) {
  if (!has_extension(node, kInstancing)) return 1;
  const JsonCursor attributes = extension_of(node, kInstancing).at("attributes");
  std::optional<std::size_t> n;
  if (!attributes.value().is_object()) attributes.fail("is not an object");
  for (const auto& [name, ignored] : attributes.value().items()) {
    const std::size_t count = read_accessor_shape(gltf, gltf_index(attributes.at(name))).count;
    if (n && *n != count) attributes.at(name).fail("differs in length from the others");
    n = count;
  }
  return n.value_or(1);
}

std::vector<glm::dmat4> read_bind_matrices(const GltfFile& gltf, const JsonCursor& skin,
                                           std::size_t n) {
  std::vector<glm::dmat4> out(n, glm::dmat4(1));
  const std::int64_t id = optional_gltf_index(skin, "inverseBindMatrices");
  if (id < 0) return out;
  const std::vector<float> numbers = read_float_accessor(gltf, id, 16);
  if (numbers.size() < 16 * n) skin.fail("has fewer inverse bind matrices than joints");
  for (std::size_t i = 0; i < n; ++i)
    for (int c = 0; c < 4; ++c)
      for (int r = 0; r < 4; ++r)
        out[i][c][r] = numbers[16 * i + static_cast<std::size_t>(4 * c + r)];
  return out;
}

}  // namespace

GltfNodes::GltfNodes(const GltfFile& gltf) : gltf_(gltf) {
  if (!gltf.root().has("nodes")) return;
  const JsonCursor nodes = gltf.root().at("nodes");
  parents_.assign(nodes.size(), kNoParent);
  for (std::size_t i = 0; i < parents_.size(); ++i)
    for (const std::size_t child : list_ids(nodes.at(i), "children")) {
      if (child >= parents_.size()) nodes.fail("has no element " + std::to_string(child));
      parents_[child] = i;
    }
}

// The default scene's roots; without scenes, the nodes that are nobody's children.
std::vector<std::size_t> GltfNodes::root_nodes(Remarks* remarks) const {
  const JsonCursor root = gltf_.root();
  if (root.has("scenes") && root.at("scenes").size() > 0) {
    const JsonCursor scenes = root.at("scenes");
    const std::int64_t id = std::max<std::int64_t>(0, optional_gltf_index(root, "scene"));
    add_remark(remarks, "scenes beside the default one, left out", scenes.size() - 1);
    return list_ids(scenes.at(static_cast<std::size_t>(id)), "nodes");
  }
  std::vector<std::size_t> roots;
  for (std::size_t i = 0; i < parents_.size(); ++i)
    if (parents_[i] == kNoParent) roots.push_back(i);
  return roots;
}

GltfPlacement GltfNodes::place_mesh(std::size_t id, const glm::dmat4& world_from_node,
                                    Remarks* remarks) const {
  const JsonCursor node = node_at(id);
  GltfPlacement out;
  out.node = id;
  out.mesh = gltf_index(node.at("mesh"));
  out.skin = optional_gltf_index(node, "skin");
  out.world_from_node = world_from_node;
  out.has_weights = node.has("weights");
  if (out.skin < 0) out.n_instances = count_instances(gltf_, node);
  if (out.skin >= 0 && has_extension(node, kInstancing))
    add_remark(remarks, "nodes with a skin and instances, of which one is shown");
  return out;
}

std::vector<GltfPlacement> GltfNodes::place_meshes(Remarks* remarks) const {
  struct Visit {
    std::size_t node;
    glm::dmat4 world_from_parent;
  };
  std::vector<GltfPlacement> out;
  std::vector<bool> is_visited(parents_.size(), false);
  std::vector<Visit> stack;
  const auto push = [&](const std::vector<std::size_t>& ids, const glm::dmat4& matrix) {
    for (std::size_t i = ids.size(); i-- > 0;) stack.push_back({ids[i], matrix});
  };
  push(root_nodes(remarks), glm::dmat4(1));
  while (!stack.empty()) {
    const Visit visit = stack.back();
    stack.pop_back();
    const JsonCursor node = node_at(visit.node);
    if (is_visited[visit.node]) node.fail("is reached twice; nodes must form a tree");
    is_visited[visit.node] = true;
    if (is_hidden(node)) {
      add_remark(remarks, "nodes that are not visible, left out with what hangs on them");
      continue;
    }
    const glm::dmat4 matrix = visit.world_from_parent * local_matrix(node);
    if (node.has("mesh")) out.push_back(place_mesh(visit.node, matrix, remarks));
    push(list_ids(node, "children"), matrix);
  }
  return out;
}

std::vector<glm::dmat4> GltfNodes::world_from_instances(const GltfPlacement& placement) const {
  const JsonCursor node = node_at(placement.node);
  if (placement.skin >= 0 || !has_extension(node, kInstancing)) return {placement.world_from_node};
  const JsonCursor attributes = extension_of(node, kInstancing).at("attributes");
  const auto numbers = [&](const char* key, const std::vector<float>& standard) {
    if (attributes.has(key))
      return read_float_accessor(
          gltf_, gltf_index(attributes.at(key)), standard.size(),
          standard.size() == 4 ? GltfIntegers::shares : GltfIntegers::as_said);
    std::vector<float> out;
    for (std::size_t i = 0; i < placement.n_instances; ++i)
      out.insert(out.end(), standard.begin(), standard.end());
    return out;
  };
  const std::vector<float> t = numbers("TRANSLATION", {0, 0, 0}),
                           q = numbers("ROTATION", {0, 0, 0, 1}), s = numbers("SCALE", {1, 1, 1});
  std::vector<glm::dmat4> out;
  for (std::size_t i = 0; i < placement.n_instances; ++i)
    out.push_back(placement.world_from_node *
                  make_matrix({t[3 * i], t[3 * i + 1], t[3 * i + 2]},
                              {q[4 * i + 3], q[4 * i], q[4 * i + 1], q[4 * i + 2]},
                              {s[3 * i], s[3 * i + 1], s[3 * i + 2]}));
  return out;
}

// The node's and its forebears' matrices together.
const glm::dmat4& GltfNodes::world_from_node(std::size_t id) {
  std::vector<std::size_t> line;  // from the node up to one that is known, or has no parent
  for (std::size_t at = id; at != kNoParent && !worlds_.contains(at); at = parents_[at]) {
    line.push_back(at);
    if (line.size() > parents_.size()) node_at(id).fail("hangs on itself; nodes must form a tree");
  }
  for (; !line.empty(); line.pop_back()) {
    const std::size_t at = line.back(), parent = parents_[at];
    const glm::dmat4 local = local_matrix(node_at(at));
    worlds_[at] = parent == kNoParent ? local : worlds_.at(parent) * local;
  }
  return worlds_.at(id);
}

const std::vector<glm::dmat4>& GltfNodes::world_from_bound(std::int64_t id) {
  const auto [found, is_new] = bound_.try_emplace(id);
  if (!is_new) return found->second;
  const JsonCursor skin = gltf_.root().at("skins").at(static_cast<std::size_t>(id));
  const std::vector<std::size_t> joints = list_ids(skin, "joints");
  found->second = read_bind_matrices(gltf_, skin, joints.size());
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (joints[i] >= parents_.size()) skin.at("joints").at(i).fail("no such node");
    found->second[i] = world_from_node(joints[i]) * found->second[i];
  }
  return found->second;
}

}  // namespace viewcell
