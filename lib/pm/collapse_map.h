// The correspondence of the surface before and after a half-edge collapse, cell by cell.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "pm/wedge_mesh.h"

namespace viewcell {

/// A box of vectors, in float, rounded outwards by whoever makes it.
struct VectorBox {
  glm::vec3 lo{0}, hi{0};  ///< the zero vector alone
  void add(const VectorBox& b) { lo = glm::min(lo, b.lo), hi = glm::max(hi, b.hi); }
  /// Of sums of one vector from each.
  VectorBox plus(const VectorBox& b) const { return {lo + b.lo, hi + b.hi}; }
  /// Squared length of the longest vector.
  float reach2() const {
    const glm::vec3 far = glm::max(glm::abs(lo), glm::abs(hi));
    return glm::dot(far, far);
  }
};

/// How points of the two surfaces are matched.
enum class Matching {
  texture,  ///< by equal texture coordinates [Cohen, Olano, Manocha 1998]
  nearest   ///< edges that cross at the nearest points of each other [Chen06 3.2.2, 4.2]
};

/// A part of one old face that goes to a part of one new face.
struct MapCell {
  std::uint32_t old_face, new_face;
  VectorBox shift;  ///< of old point minus new point; linear between the corners, so it holds all
  double area = 0;  ///< of its part of the old face
  glm::dvec3 mean{0};  ///< of the shift, over that area
  double square = 0;   ///< mean squared length of the shift
};

/// When u collapses into v, the faces of u are mapped onto the faces that remain: the edges from u
/// (old) and those from v (new) overlay in the star and cut it into cells, whose corners are u, the
/// star's vertices and crossings of an old with a new edge. Each corner has a point on the old and
/// one on the new surface.
///
///        n2----n1          old edges  u-n1, u-n2, u-n3, u-v
///       /  \  / |          new edges  v-n2
///      n3 - u   |          u lies in the new face (v, n2, n3) or (v, n1, n2); say in the first:
///       \____\__v          then u-n1 crosses v-n2
///
/// Follows: [Chen06 3.2.2]. Differs: for Matching::nearest, which new face takes u is decided by
/// where the nearest point is, and crossings follow from that (in the paper the texture decides
/// which edges cross, and the nearest point may lie in another face than the cells say, trap 19):
/// so every cell lies in one old and one new face, and a maximum over corners is one over the cell.
/// On a boundary of the mesh or of a texture chart u goes to the new boundary edge.
class CollapseMap {
 public:
  /// Keeps references. with_moments: cells have area, mean and square. Not thread-safe.
  CollapseMap(const CollapseMesh& mesh, const WedgeTable& wedges,
              std::span<const glm::vec3> positions, std::span<const glm::vec2> texcoords,
              Matching matching, bool with_moments)
      : mesh_(mesh),
        wedges_(wedges),
        positions_(positions),
        texcoords_(texcoords),
        matching_(matching),
        with_moments_(with_moments) {}

  /// Lays out the map of u -> v. False when there is none: the star of u is no fan, v is not at
  /// its boundary's end, or a part of the surface has no face to go to.
  bool lay(std::uint32_t u, std::uint32_t v);
  /// Of the last lay().
  const std::vector<MapCell>& cells() const { return cells_; }
  /// The longest distance of a corner's two points.
  double largest_shift() const;
  /// Whether every new face of the last lay() keeps the sign of the old one's texture area.
  bool keeps_texture_orientation() const { return keeps_orientation_; }

 private:
  // One triangle (u, a, b) of the star.
  struct Spoke {
    std::uint32_t face, a, b, wedge_u, wedge_a, wedge_b;
  };
  // A neighbour of u in a fan that starts at v.
  struct Rim {
    std::uint32_t vertex, wedge, face;  // face: from this neighbour to the next
    glm::dvec3 at;
    glm::dvec2 uv;
  };
  struct Corner {
    glm::dvec3 before, after;
  };

  bool gather(std::uint32_t u);
  bool order_sector(std::size_t first, std::size_t last, std::uint32_t v);
  bool lay_sector(std::uint32_t u, std::uint32_t v);
  bool choose_face();
  void choose_by_texture();
  void choose_by_distance();
  void choose_on_edge();
  Corner cross(std::size_t i, std::size_t j) const;
  Corner corner(std::size_t i, std::size_t j, bool is_left) const;
  void add_cell(std::uint32_t old_face, std::uint32_t new_face, std::span<const Corner> corners);
  void add_side(bool is_left);
  void check_orientation();

  const CollapseMesh& mesh_;
  const WedgeTable& wedges_;
  std::span<const glm::vec3> positions_;
  std::span<const glm::vec2> texcoords_;
  Matching matching_;
  bool with_moments_;
  std::vector<MapCell> cells_;
  double largest2_ = 0;
  bool keeps_orientation_ = true;
  // of the sector that is being laid out
  std::vector<Spoke> spokes_;
  std::vector<Rim> rim_;
  bool is_closed_ = false;
  glm::dvec3 u_at_{0}, u_after_{0};
  glm::dvec2 u_uv_{0};
  std::size_t middle_ = 0;  // u goes to the new face (v, rim[middle], rim[middle + 1])
};

}  // namespace viewcell
