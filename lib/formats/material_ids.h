// Numbers material names as a reader meets them.
#pragma once

#include <algorithm>
#include <map>
#include <string>

#include "mesh/mesh.h"

namespace viewcell {

/// Gives each triangle of a mesh a material; those given none get one named "default".
class MaterialIds {
 public:
  static constexpr std::int32_t kNone = -1;

  /// The name's place in material_names.
  std::int32_t add(const std::string& name) {
    const auto [found, is_new] = ids_.try_emplace(name, static_cast<std::int32_t>(names_.size()));
    if (is_new) names_.push_back(name);
    return found->second;
  }
  /// materials: per triangle, kNone allowed. Sets mesh.materials, or leaves it empty when no
  /// triangle has one.
  void finish(std::vector<std::int32_t> materials, TriMesh& mesh) {
    const auto n_none = std::count(materials.begin(), materials.end(), kNone);
    if (n_none == static_cast<std::ptrdiff_t>(materials.size())) return;
    const std::int32_t fallback = n_none ? add("default") : kNone;
    for (std::int32_t& id : materials)
      if (id == kNone) id = fallback;
    mesh.materials = std::move(materials);
    mesh.material_names = std::move(names_);
  }

 private:
  std::map<std::string, std::int32_t> ids_;
  std::vector<std::string> names_;
};

}  // namespace viewcell
