// Keeps texture charts from growing over one another while their borders are simplified.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "image/image.h"
#include "image/texel_spans.h"
#include "pm/wedge_mesh.h"

namespace viewcell {

/// Which texels of a square texture the charts hold, as the mesh collapses. Where a collapse
/// straightens a border that was bent inwards, the chart grows over texels that were free, or
/// another's: then the two charts would overlap.
class ChartGuard {
 public:
  /// mesh must have texture coordinates. 8 bytes a texel. What lies outside [0, 1] holds none.
  ChartGuard(const WedgeMesh& mesh, int size_px);

  /// Whether the collapse u -> v, which the table has matched last, makes a chart hold a texel that
  /// is another's or touches one. merged, full: as for turns_over_texture(). Known limit: a chart
  /// may grow over another part of itself.
  bool overlaps(const CollapseMesh& mesh, const WedgeTable& wedges,
                std::span<const glm::vec2> texcoords, std::uint32_t u, std::uint32_t v,
                std::span<const glm::vec2> merged, bool full);
  /// The collapse of the last overlaps() is made.
  void accept();

 private:
  struct Face {
    TexelTriangle corners;
    std::uint32_t owner;   // chart + 1
    std::size_t pair = 0;  // of the table's, whose wedge it has
  };
  void gather(const CollapseMesh& mesh, const WedgeTable& wedges,
              std::span<const glm::vec2> texcoords, std::uint32_t moved, std::uint32_t other,
              bool is_parent, std::span<const glm::vec2> merged);
  bool keeps_areas(std::size_t n_pairs) const;
  bool comes_near_others(const Face& face) const;
  template <typename Visit>
  void for_each_texel(const Face& face, Visit&& visit) const;

  std::vector<std::uint32_t> charts_;  // of faces
  Image<std::uint32_t> owners_;        // chart + 1, or 0
  Image<std::uint32_t> stamps_;        // the last overlaps() whose star held the texel
  std::uint32_t stamp_ = 0;
  std::vector<Face> before_, after_;  // of the last overlaps()
};

}  // namespace viewcell
