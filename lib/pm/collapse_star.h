// The star of a vertex: its triangles in order around it, in sectors.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "pm/wedge_mesh.h"

namespace viewcell {

/// The star of one vertex u at a time: the triangles at u. A sector is one fan of triangles, joined
/// edge to edge around u, of one texture chart: several where u lies on borders of charts, on edges
/// of more than two triangles or where surfaces touch; else one. Fans end at edges of one, or of
/// more than two triangles, and go on where the winding turns. Positions and texture coordinates
/// are relative to u.
class CollapseStar {
 public:
  /// A neighbour of u; the neighbours in order are the rim of the star.
  struct Rim {
    std::uint32_t vertex, wedge;
    std::uint32_t face;  ///< index into faces() of the triangle from here to the next
    glm::dvec3 to;       ///< from u
    glm::dvec2 uv;       ///< from u, in the texture; 0 without texture coordinates
  };
  /// Part of the rim, in the winding of the triangles (of the first, where it turns); an open
  /// sector's last neighbour has no face.
  struct Sector {
    std::span<const Rim> rim;
    bool is_closed = false;
    glm::dvec2 origin{0};     ///< u in the texture
    std::uint32_t wedge = 0;  ///< of u; one of them
    std::uint32_t chart = 0;  ///< u's chart vertex; 0 where charts do not matter
    bool is_cut = false;      ///< open, but the surface goes on beyond an end
  };

  /// Keeps references. texcoords: of wedges; empty: charts matter only if they end at materials or
  /// colours, too.
  CollapseStar(const CollapseMesh& mesh, const WedgeTable& wedges,
               std::span<const glm::vec3> positions, std::span<const glm::vec2> texcoords)
      : mesh_(mesh), wedges_(wedges), positions_(positions), texcoords_(texcoords) {}

  /// False when some fan meets a neighbour twice, or turns its winding and there is a texture. The
  /// last star is cached until forget().
  bool gather(std::uint32_t u);
  void forget() { of_ = kNone; }
  /// Whether a texture seam ends in u: some neighbour then has two texture coordinates within one
  /// sector, and Rim::uv is one of them.
  bool has_seam_end() const { return has_seam_end_; }
  std::uint32_t of() const { return of_; }
  const std::vector<Sector>& sectors() const { return sectors_; }
  const std::vector<std::uint32_t>& faces() const { return faces_; }
  /// Appends a face that is not of u, or finds it; returns its index into faces().
  std::uint32_t index_of(std::uint32_t face);

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  struct Spoke {                                                 // a triangle (u, a, b)
    std::uint32_t face, a, b, chart, wedge_u, wedge_a, wedge_b;  // chart: u's chart vertex
  };
  bool order(std::size_t first, std::size_t last);
  bool order_fans(std::size_t first, std::size_t last);
  void link_fans(std::size_t first, std::size_t last);
  bool is_shared(std::size_t first, std::size_t last, std::uint32_t vertex) const;
  void push_rim(const Spoke& spoke, bool from_b = false);
  bool end_sector(const Spoke& spoke, std::size_t begin, bool is_closed, bool is_cut = false);
  bool differ(std::uint32_t wedge_a, std::uint32_t wedge_b) const;
  bool meets_each_once(std::size_t first) const;
  void fill_rim_vectors(std::size_t first, std::uint32_t wedge_u);

  const CollapseMesh& mesh_;
  const WedgeTable& wedges_;
  std::span<const glm::vec3> positions_;
  std::span<const glm::vec2> texcoords_;
  std::uint32_t of_ = kNone;
  bool is_legal_ = false, has_seam_end_ = false;
  std::vector<Spoke> spokes_;
  std::vector<std::size_t> joined_;  // spokes at a and at b -> the one there, or the same
  std::vector<Rim> rim_;
  std::vector<Sector> sectors_;
  std::vector<std::uint32_t> faces_;
};

}  // namespace viewcell
