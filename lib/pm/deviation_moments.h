// The mean squared distance between a mesh that is being collapsed and its input.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "pm/collapse_map.h"

namespace viewcell {

/// Every face has area, sum and sum of squares of the deviations, point of the input minus matched
/// point, over the part of the input that it stands for; the map of a collapse passes them on
/// to the new faces. Within a face the deviations are assumed to be independent of the next shift.
class DeviationMoments {
 public:
  struct Moments {
    double area = 0, square = 0;  ///< square: integral of the squared length
    glm::dvec3 sum{0};            ///< integral
  };
  struct Next {
    std::uint32_t face;
    Moments moments;
  };
  struct Change {
    std::vector<Next> faces;
    double increase = 0;  ///< of the sum of all squares
    void clear() { faces.clear(), increase = 0; }
  };

  static constexpr bool kMoments = true;

  DeviationMoments(std::span<const glm::vec3> positions, std::span<const Triangle> triangles);

  /// Adds what a map does to a change; a second map starts where the first ended.
  void add(const CollapseMap& map, Change& change);
  double area() const { return area_; }  ///< of the whole input; 1 where it has none
  /// The root of what the change adds to the mean square over the whole input; not below 0.
  float cost(const Change& change) const;
  /// The collapse with this change is made.
  void accept(const Change& change);
  void invalidate() {}  ///< a collapse without a map is made: moments claim no bound

 private:
  struct Local {  // of a face of the map
    Moments before, after;
    double old_area = 0;      // of its cells
    std::size_t n_cells = 0;  // of it as an old face
    bool is_old = false, is_new = false;
  };
  const Moments& moments_of(std::uint32_t face, const Change& change) const;
  void distribute(const CollapseMap& map);

  std::vector<Moments> moments_;  // by face
  std::vector<Local> local_;      // by index into CollapseMap::faces()
  double area_ = 0;
};

}  // namespace viewcell
