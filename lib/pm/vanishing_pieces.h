// Pieces of a mesh, parts that neither edges nor vertices join, in the order in which they vanish.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

#include "base/buckets.h"
#include "mesh/charts.h"
#include "pm/collapse_mesh.h"

namespace viewcell {

/// What the end of a piece costs, in the unit of the metric: its radius, the farthest of its
/// vertices from the middle of its box, as all of its points would be off at most if it shrank to
/// one. For metrics that add up squared distances over the surface, that times the root of the
/// piece's share in the area of all; for those that add up planes, of their number.
enum class PieceCost { radius, area, planes };

struct VanishOptions {
  PieceCost cost = PieceCost::radius;
  std::vector<bool> locked;  ///< vertices; pieces that have one stay; empty: none
};

/// Cheapest first, the lower number of equal ones. The one that costs most never vanishes, so some
/// piece is left. One that has many faces left waits, and with it those that cost more: no level
/// loses more than a tenth of its faces at once, or kFewFaces.
class VanishingPieces {
 public:
  /// None ever vanishes.
  VanishingPieces() = default;
  /// pieces: of the faces, connected by corners. faces: as in the mesh. Positions as they are now.
  VanishingPieces(std::span<const glm::vec3> positions, std::span<const Triangle> faces,
                  const Charts& pieces, const VanishOptions& options);

  /// Of the next piece; infinity: there is none.
  float cost() const { return cost_; }
  static constexpr std::size_t kFewFaces = 64;
  /// Whether the next piece has few enough live faces. Asked again before the mesh has lost a tenth
  /// of its triangles, a no is repeated unless is_last. O(faces that the piece had at first).
  bool is_small(const CollapseMesh& mesh, bool is_last);
  /// The faces that it had at first.
  std::span<const std::uint32_t> faces() const { return faces_.of(order_[at_]); }
  /// Those that live, copies too.
  std::span<const std::uint32_t> live_faces(const CollapseMesh& mesh);
  /// The next piece has vanished, or stays for good.
  void pop();

 private:
  void set_cost();

  Buckets<std::uint32_t> faces_;  // by piece
  std::vector<float> costs_;      // by piece
  std::vector<std::uint32_t> order_, live_;
  std::size_t at_ = 0, n_when_large_ = 0;
  float cost_ = std::numeric_limits<float>::infinity();
};

}  // namespace viewcell
