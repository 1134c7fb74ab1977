// Whether an edge collapse keeps a mesh's topology and turns no triangle over.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "pm/fan.h"
#include "pm/refusal.h"

namespace viewcell {

class CollapseMesh;

/// The checks of CollapseMesh, which documents them, and their scratch lists.
class StarCheck {
 public:
  void ring(const CollapseMesh& mesh, std::uint32_t v, std::vector<std::uint32_t>& out);
  Refusal check(const CollapseMesh& mesh, std::uint32_t u, std::uint32_t v, float min_cosine);
  Refusal check(const CollapseMesh& mesh, std::uint32_t u, std::uint32_t v,
                const glm::vec3& position, float min_cosine);
  bool is_on_boundary(const CollapseMesh& mesh, std::uint32_t v);

 private:
  bool keeps_topology(const CollapseMesh& mesh, std::uint32_t u, std::uint32_t v,
                      bool& is_odd_edge);
  bool compare_stars(const CollapseMesh& mesh, std::uint32_t u, std::uint32_t v) const;
  bool compare_with_hub(const CollapseMesh& mesh, std::uint32_t hub) const;

  Fan fan_u_, fan_v_;
  std::vector<std::uint32_t> opposite_;  // u: third corners of its triangles with v
};

}  // namespace viewcell
