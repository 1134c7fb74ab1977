// The attributes of a glTF primitive, whichever way they are stored. Private to the room.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "formats/gltf_accessors.h"
#include "formats/gltf_draco.h"

namespace viewcell {

/// Reads accessors, or what Draco packed, with morph targets added. Keeps the file and the weights
/// by reference.
class GltfAttributes {
 public:
  /// Decodes what is packed.
  GltfAttributes(const GltfFile& gltf, const JsonCursor& primitive, std::span<const float> weights);

  std::size_t n_vertices() const { return n_vertices_; }
  bool has(const std::string& name) const;
  std::size_t n_components(const std::string& name) const;
  /// n_components a vertex.
  std::vector<float> floats(const std::string& name, std::size_t n_components,
                            GltfIntegers integers = GltfIntegers::as_said) const;
  std::vector<std::uint32_t> integers(const std::string& name, std::size_t n_components) const;
  /// Of the triangles that are packed, if they are.
  const std::optional<DracoMesh>& packed() const { return packed_; }

 private:
  std::int64_t accessor_of(const std::string& name) const;
  const std::vector<float>* packed_values(const std::string& name) const;
  void add_targets(const std::string& name, std::size_t n_components, GltfIntegers integers,
                   std::vector<float>& values) const;
  void unpack();

  const GltfFile& gltf_;
  JsonCursor primitive_;
  std::span<const float> weights_;
  std::size_t n_vertices_ = 0;
  std::optional<DracoMesh> packed_;
};

}  // namespace viewcell
