// How far a collapse of any kind would take a mesh from its input.
#pragma once

#include <span>

#include "pm/deviation_boxes.h"

namespace viewcell {

/// Beside whatever metric: looks at collapses, half-edge or full-edge, and takes those that are
/// made.
class CollapseBound {
 public:
  /// Keeps references.
  CollapseBound(const CollapseMesh& mesh, const WedgeTable& wedges,
                std::span<const glm::vec3> positions, std::size_t n_faces)
      : map_(mesh, wedges, positions, {}, Matching::nearest, false), boxes_(n_faces) {}

  /// No point of the faces that change would be farther than this from the input, nor the input's
  /// points there from the mesh; infinite when the collapse has no map.
  float look(std::uint32_t u, std::uint32_t v);
  /// The same for both vertices going to `place`.
  float look(std::uint32_t u, std::uint32_t v, const glm::vec3& place);
  /// The collapse last looked at is made.
  void take();
  /// Of the whole mesh as it is.
  float bound() const { return boxes_.bound(); }

 private:
  bool add_full(std::uint32_t gone, std::uint32_t kept, const glm::dvec3& place);

  CollapseMap map_;
  DeviationBoxes boxes_;
  DeviationBoxes::Change change_, other_;
};

}  // namespace viewcell
