// The correspondence of the surface before and after a half-edge collapse, cell by cell.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "pm/collapse_star.h"
#include "pm/vector_box.h"

namespace viewcell {

/// How points of the two surfaces are matched.
enum class Matching {
  texture,  ///< by equal texture coordinates [Cohen, Olano, Manocha 1998]
  nearest   ///< edges that cross at the nearest points of each other [Chen06 3.2.2, 4.2]
};

/// A part of one old face that goes to a part of one new face.
struct MapCell {
  std::uint32_t old_face, new_face;  ///< places in CollapseMap::faces()
  VectorBox shift{};  ///< of old point minus new point; linear between the corners, so it holds all
};

/// Of the points of a cell, over its part of the old face.
struct CellMoments {
  double area = 0;
  glm::dvec3 mean{0};  ///< of the shift
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
  /// Keeps references. with_moments: moments() are made. Not thread-safe.
  CollapseMap(const CollapseMesh& mesh, const WedgeTable& wedges,
              std::span<const glm::vec3> positions, std::span<const glm::vec2> texcoords,
              Matching matching, bool with_moments)
      : mesh_(mesh),
        star_(mesh, wedges, positions, texcoords),
        matching_(matching),
        with_moments_(with_moments) {}

  /// Finds where u goes. False when there is no map: the star of u is no fan, v is not at its
  /// boundary's end, or a part of the surface has no face to go to.
  bool place(std::uint32_t u, std::uint32_t v);
  /// The same, and lays out the cells.
  bool lay(std::uint32_t u, std::uint32_t v);
  /// To be called when the mesh has changed.
  void forget() { star_.forget(), placed_.clear(), places_.clear(); }

  /// Of the last place() or lay(): calls visit(face, shift) for every sector of the star, with the
  /// face that takes u in it (a place in faces()) and how far u is from there.
  template <typename Visit>
  void for_each_place(Visit&& visit) const {
    for (const Place& p : last_) visit(p.face, -make_double4(p.after));
  }
  /// The faces of u, by their numbers in the mesh, and those that take over from lone triangles.
  std::span<const std::uint32_t> faces() const { return star_.faces(); }
  /// Of the last lay().
  const std::vector<MapCell>& cells() const { return cells_; }
  const std::vector<CellMoments>& moments() const { return moments_; }
  /// The longest distance of a corner's two points.
  double largest_shift() const;
  /// Whether every new face of the last place() or lay() keeps the sign of the old one's texture
  /// area.
  bool keeps_texture_orientation() const;

 private:
  // Where u goes in one sector: into the new face (v, rim middle, rim middle + 1), counted from v.
  struct Place {
    std::size_t v = 0;  // of the sector's rim
    int step = 1;       // the way that the sector is walked from v
    std::size_t middle = 0;
    std::uint32_t face = 0;
    glm::dvec3 after{0};  // u's new place, relative to u
  };
  struct Placed {  // the places of all sectors for one target
    std::uint32_t v;
    bool is_legal;
    std::size_t first;
  };
  // An old edge u-w and the new edge v-w.
  struct Ray {
    Double4 to, from_v;     // w relative to u, and to v
    double to2, from_v2;    // squared lengths
    double to_v, from_v_v;  // dot products with v relative to u
    glm::dvec2 uv;          // w relative to u
    std::uint32_t face;     // to the next
  };
  struct Corner {
    Double4 shift{}, before{};  // relative to u
  };

  struct Around {  // of a cell; of a triangle, c and d are the same
    const Corner &a, &b, &c, &d;
  };

  bool place_sector(const CollapseStar::Sector& sector, std::uint32_t v, Place& place) const;
  void choose_by_texture(const CollapseStar::Sector& sector, Place& place) const;
  void choose_by_distance(const CollapseStar::Sector& sector, Place& place) const;
  void choose_on_edge(const CollapseStar::Sector& sector, Place& place) const;
  bool lay_sector(const CollapseStar::Sector& sector, const Place& place, std::uint32_t v);
  bool lay_lone(const CollapseStar::Sector& sector, const Place& place, std::uint32_t v);
  void make_rays(const CollapseStar::Sector& sector, const Place& place);
  Corner cross(const Ray& old_edge, const Ray& new_edge);
  void add_side(std::size_t middle, bool is_left, const Double4& u_after);
  using Corners = std::span<const Corner* const>;  // around a cell
  void add_cell(const MapCell& of, const Around& around);
  void add_moments(const Around& around);

  const CollapseMesh& mesh_;
  CollapseStar star_;
  Matching matching_;
  bool with_moments_;
  std::vector<Placed> placed_;  // of the star's vertex
  std::vector<Place> places_;
  std::span<const Place> last_;
  std::vector<MapCell> cells_;
  std::vector<CellMoments> moments_;
  double largest2_ = 0;
  std::vector<Ray> rays_;
  Double4 to_v_{};
  glm::dvec2 uv_to_v_{0};
  std::vector<Corner> row_, next_row_;
};

}  // namespace viewcell
