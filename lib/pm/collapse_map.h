// The correspondence of the surface before and after an edge collapse, by overlay cells.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "pm/collapse_star.h"
#include "pm/fan_overlay.h"

namespace viewcell {

/// New texture coordinates of a wedge.
struct WedgeMove {
  std::uint32_t wedge;
  glm::vec2 texcoord;
};

/// When u collapses into v, the faces of u are mapped onto the faces that remain: the edges from u
/// (old) and those from v (new) overlay in the star and cut it into overlay cells, whose corners
/// are u, the star's vertices and crossings of an old with a new edge. Each corner has a point on
/// the old and one on the new surface.
///
///        n2----n1          old edges  u-n1, u-n2, u-n3, u-v
///       /  \  / |          new edges  v-n2
///      n3 - u   |          u lies in the new face (v, n2, n3) or (v, n1, n2); say in the first:
///       \____\__v          then u-n1 crosses v-n2
///
/// Follows: [Chen06 3.2.2]. Differs: for Matching::nearest, which new face takes u is decided by
/// where the nearest point is, and crossings follow from that (in the paper the texture decides
/// which edges cross, and the nearest point may lie in another face than the cells say):
/// so every cell lies in one old and one new face, and a maximum over corners is one over the cell.
/// On a boundary of the mesh or of a texture chart u goes to the new boundary edge. A fan of u that
/// v is not in (beyond an edge of more than two triangles, or where surfaces touch) moves as a
/// whole to where v is.
///
/// A full-edge collapse is two maps, one after the other: v moves to the new position, by
/// build_move(), then u collapses into v there, by build() with that apex.
class CollapseMap {
 public:
  /// Keeps references. keep: what is made of cells. Not thread-safe.
  CollapseMap(const CollapseMesh& mesh, const WedgeTable& wedges,
              std::span<const glm::vec3> positions, std::span<const glm::vec2> texcoords,
              Matching matching, const FanOverlay::Keep& keep = {})
      : mesh_(mesh),
        positions_(positions),
        star_(mesh, wedges, positions, texcoords),
        matching_(matching),
        overlay_(matching, keep) {}

  /// Finds the point of the new surface that u is mapped to. False when there is no map: the star
  /// of u is no fan, v is not at its boundary's end, or a part of the surface has no face to go to.
  bool locate(std::uint32_t u, std::uint32_t v);
  /// The same, and builds the overlay cells.
  bool build(std::uint32_t u, std::uint32_t v);
  /// The same, as if v were at `apex`. Matching::nearest only.
  bool build(std::uint32_t u, std::uint32_t v, const glm::dvec3& apex);
  /// The map of v's faces when v moves to `apex`, and in the texture its wedges to `texcoords`,
  /// where they are given. Matching::nearest only.
  bool build_move(std::uint32_t v, const glm::dvec3& apex,
                  std::span<const WedgeMove> texcoords = {});
  /// To be called when the mesh has changed.
  void forget() { star_.forget(); }

  /// Of the last locate() or build(): calls visit(face, shift) for every sector of the star, with
  /// the new face that u is mapped to (an index into faces()) and u minus the point there.
  template <typename Visit>
  void for_each_location(Visit&& visit) const {
    for (const Location& p : last_) visit(p.face, -make_double4(p.after.at));
  }
  /// The vertex that is removed, or moves.
  std::uint32_t u() const { return star_.of(); }
  /// Whether a texture seam ends in u: then the map is right in space, but not in the texture at
  /// the seam.
  bool has_seam_end() const { return star_.has_seam_end(); }
  /// The faces of u, by their numbers in the mesh, and the faces that inherit the surface of a
  /// triangle that is alone in its sector and vanishes.
  std::span<const std::uint32_t> faces() const { return star_.faces(); }
  /// Of the last build() or build_move(); faces are indices into faces().
  const FanOverlay& overlay() const { return overlay_; }

 private:
  using Sector = CollapseStar::Sector;
  // Where u goes in one sector, or one side of v in it: into the new face (v, rim middle, rim
  // middle + 1), counted from v.
  struct Location {
    Location(const Sector& of, std::span<const CollapseStar::Rim> its_rim, const glm::dvec3& at)
        : sector(&of), rim(its_rim), apex(at) {}
    const Sector* sector;
    std::span<const CollapseStar::Rim> rim;  // the sector's, or one side's
    bool is_moved = false;                   // v is not in the sector, which keeps its faces
    int step = 1;                            // the way that the rim is walked from v
    std::size_t v = 0;                       // of the rim
    std::size_t middle = 0;
    std::uint32_t face = 0;
    glm::dvec3 apex;        // v, relative to u
    glm::dvec2 apex_uv{0};  // of sectors that are moved
    FanPoint after{};       // the point of the new surface for u
  };
  // How a sector's apex moves: the new one lies in the old face of rim `first`, of open sectors on
  // the edge to it, the first or the last; the old one in the new face of rim `second`.
  struct Move {
    std::size_t first = 0, second = 0;
    FanPoint before, after;  // the new apex on the old surface, the old one on the new
  };
  struct Located {  // the locations for one target
    std::uint32_t v;
    bool is_legal;
    std::size_t first, n;
  };

  bool gather(std::uint32_t u);
  bool locate_all(std::uint32_t v, const glm::dvec3& apex, std::vector<Location>& to) const;
  bool locate_at(const Sector& sector, std::span<const CollapseStar::Rim> rim, std::size_t i,
                 const glm::dvec3& apex, std::vector<Location>& to) const;
  bool locate_moved(const Sector& sector, std::uint32_t v, const glm::dvec3& apex,
                    std::vector<Location>& to) const;
  bool choose_face(Location& location) const;
  void choose_by_texture(Location& location) const;
  void choose_by_distance(Location& location) const;
  void choose_on_edge(Location& location) const;
  bool build_located(std::uint32_t v);
  void build_sector(const Location& location);
  std::optional<std::uint32_t> find_face_at(std::uint32_t a, std::uint32_t b,
                                            std::uint32_t but) const;
  std::optional<std::uint32_t> find_other_face(std::uint32_t v, std::uint32_t but) const;
  bool build_vanishing(const Location& location, std::uint32_t v);
  FanPoint point_on(const FanPoint& top, const CollapseStar::Rim& b, const CollapseStar::Rim& c,
                    const glm::dvec3& at) const;
  std::optional<Move> find_move(const Sector& sector, const FanPoint& apex) const;
  std::optional<Move> find_closed_move(const Sector& sector, const FanPoint& apex) const;
  Move find_open_move(const Sector& sector, const FanPoint& apex) const;
  bool move_sector(const Sector& sector, const FanPoint& apex);
  void move_closed(const Sector& sector, const FanPoint& apex, const Move& move);
  void move_open(const Sector& sector, const FanPoint& apex, const Move& move);

  const CollapseMesh& mesh_;
  std::span<const glm::vec3> positions_;
  CollapseStar star_;
  Matching matching_;
  FanOverlay overlay_;
  std::vector<Located> located_;  // of the star's vertex
  std::vector<Location> locations_, moved_;
  std::span<const Location> last_;
};

}  // namespace viewcell
