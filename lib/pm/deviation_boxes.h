// A bound on the distance between a mesh that is being collapsed and its input.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

#include "pm/collapse_map.h"
#include "pm/vanish_map.h"

namespace viewcell {

/// Every face has a box of vectors that holds the deviations, point of the input minus matched
/// point, of all its points; the map of a collapse passes them on to the new faces. Every point of
/// the mesh and of the input is in some such pair, so the farthest reach of the boxes bounds the
/// distance both ways. Follows: [Cohen 1998 4.3], [Chen06 4.2.1].
/// Pieces that have vanished have boxes of their own on the faces that stand for them: they count
/// in bounds, and not in costs, which are of the surface that is left.
class DeviationBoxes {
 public:
  static constexpr bool kMoments = false;  ///< whether maps must have them

  explicit DeviationBoxes(std::size_t n_faces) : boxes_(n_faces) {}

  struct Next {
    std::uint32_t face;
    VectorBox box;
  };
  struct Change {
    std::vector<Next> faces;            ///< with new boxes
    std::vector<Next> vanished;         ///< faces with new boxes of vanished pieces
    std::vector<std::uint32_t> passed;  ///< those that have none of these any more, unless above
    void clear() { faces.clear(), vanished.clear(), passed.clear(); }
  };

  /// Adds what a map does to a change; a second map starts where the first ended.
  void add(const CollapseMap& map, Change& change);
  /// The farthest reach of the faces of a change.
  float cost(const Change& change) const { return reach(change.faces); }
  /// The same for what has vanished.
  float vanished_reach(const Change& change) const { return reach(change.vanished); }
  /// The same for a piece that vanishes.
  float vanish_reach(const VanishMap& map) const;
  /// A lower bound of cost() for the map's last locate(): the reach at u alone.
  float least_reach(const CollapseMap& map) const;
  /// The collapse with this change is made.
  void accept(const Change& change);
  void accept(const VanishMap& map);
  /// A collapse without a map is made: part of the input is matched with nothing, and bound() is
  /// infinite from now on.
  void invalidate() { bound_ = std::numeric_limits<float>::infinity(); }
  /// No point of the face is farther than this from the input.
  float reach(std::uint32_t face) const { return std::sqrt(boxes_[face].reach2()); }
  /// No point of the mesh, nor of the input, is farther than this from the other surface.
  float bound() const { return bound_; }

 private:
  struct Local {  // of a face of the map
    VectorBox before, after;
    bool is_old = false, is_new = false;
  };
  const VectorBox& box_of(std::uint32_t face, const Change& change) const;
  void add_vanished(const CollapseMap& map, Change& change);
  const VectorBox* vanished_box(std::uint32_t face, const Change& change) const;
  static float reach(const std::vector<Next>& faces);

  std::vector<VectorBox> boxes_;                           // by face
  std::unordered_map<std::uint32_t, VectorBox> vanished_;  // by face
  std::vector<Local> local_;                               // by index into CollapseMap::faces()
  float bound_ = 0;
};

}  // namespace viewcell
