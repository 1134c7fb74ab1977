#include "formats/gltf_attributes.h"

#include <algorithm>
#include <limits>

namespace viewcell {
namespace {

constexpr const char* kDraco = "KHR_draco_mesh_compression";
constexpr std::int64_t kModeTriangles = 4;

}  // namespace

GltfAttributes::GltfAttributes(const GltfFile& gltf, const JsonCursor& primitive,
                               std::span<const float> weights)
    : gltf_(gltf), primitive_(primitive), weights_(weights) {
  const std::int64_t id = accessor_of("POSITION");
  if (id < 0) primitive.fail("has no POSITION");
  n_vertices_ = read_accessor_shape(gltf, id).count;
  if (has_extension(primitive, kDraco)) unpack();
}

std::int64_t GltfAttributes::accessor_of(const std::string& name) const {
  return optional_gltf_index(primitive_.at("attributes"), name.c_str());
}

bool GltfAttributes::has(const std::string& name) const {
  return accessor_of(name) >= 0;
}

std::size_t GltfAttributes::n_components(const std::string& name) const {
  return read_accessor_shape(gltf_, accessor_of(name)).n_components;
}

void GltfAttributes::unpack() {
  const JsonCursor extension = extension_of(primitive_, kDraco);
  if (const std::int64_t mode = optional_gltf_index(primitive_, "mode");
      mode >= 0 && mode != kModeTriangles)
    primitive_.at("mode").fail("of meshes packed by Draco is read as 4 (triangles) alone");
  DracoShape shape;
  shape.n_vertices = n_vertices_;
  shape.n_triangles = read_accessor_shape(gltf_, gltf_index(primitive_.at("indices"))).count / 3;
  const JsonCursor names = extension.at("attributes");
  if (!names.value().is_object()) names.fail("is not an object");
  for (const auto& [name, ignored] : names.value().items())
    if (has(name)) shape.attributes[name] = {gltf_index(names.at(name)), n_components(name)};
  const GltfView view = read_view(gltf_, gltf_index(extension.at("bufferView")));
  packed_ = decode_draco(view.bytes, shape, extension);
}

const std::vector<float>* GltfAttributes::packed_values(const std::string& name) const {
  if (!packed_) return nullptr;
  const auto found = packed_->attributes.find(name);
  return found == packed_->attributes.end() ? nullptr : &found->second;
}

std::vector<float> GltfAttributes::floats(const std::string& name, std::size_t n_components,
                                          GltfIntegers integers) const {
  const std::int64_t id = accessor_of(name);
  GltfNumbers shape = read_accessor_shape(gltf_, id);
  if (shape.count != n_vertices_) primitive_.fail(name + " and POSITION differ in length");
  std::vector<float> out;
  if (const std::vector<float>* packed = packed_values(name)) {
    if (shape.n_components != n_components)
      primitive_.at("attributes")
          .at(name)
          .fail("expected " + std::to_string(n_components) + " components");
    shape.normalized |= integers == GltfIntegers::shares;
    out = *packed;
    const float scale = shape.scale();
    if (scale != 1)
      for (float& x : out) x = std::max(x * scale, -1.0f);
  } else {
    out = read_float_accessor(gltf_, id, n_components, integers);
  }
  add_targets(name, n_components, integers, out);
  return out;
}

std::vector<std::uint32_t> GltfAttributes::integers(const std::string& name,
                                                    std::size_t n_components) const {
  const std::int64_t id = accessor_of(name);
  if (read_accessor_shape(gltf_, id).count != n_vertices_)
    primitive_.fail(name + " and POSITION differ in length");
  const std::vector<float>* packed = packed_values(name);
  if (packed == nullptr) return read_integer_accessor(gltf_, id, n_components);
  if (packed->size() != n_vertices_ * n_components)
    primitive_.at("attributes")
        .at(name)
        .fail("expected " + std::to_string(n_components) + " components");
  std::vector<std::uint32_t> out;
  constexpr float kMost = 65535;  // joints; also: what a float holds exactly
  for (const float x : *packed)
    out.push_back(static_cast<std::uint32_t>(x >= 0 && x <= kMost ? x : kMost + 1));
  return out;
}

// Morph targets: to each value their differences times their weights.
void GltfAttributes::add_targets(const std::string& name, std::size_t n_components,
                                 GltfIntegers integers, std::vector<float>& values) const {
  if (weights_.empty() || !primitive_.has("targets")) return;
  const JsonCursor targets = primitive_.at("targets");
  if (targets.size() != weights_.size())
    targets.fail("are " + std::to_string(targets.size()) + ", but there are " +
                 std::to_string(weights_.size()) + " weights");
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    const std::int64_t id = optional_gltf_index(targets.at(i), name.c_str());
    if (weights_[i] == 0 || id < 0) continue;
    if (read_accessor_shape(gltf_, id).count != n_vertices_)
      targets.at(i).fail(name + " and the primitive's POSITION differ in length");
    const std::vector<float> moves = read_float_accessor(gltf_, id, n_components, integers);
    for (std::size_t k = 0; k < values.size(); ++k) values[k] += weights_[i] * moves[k];
  }
}

}  // namespace viewcell
