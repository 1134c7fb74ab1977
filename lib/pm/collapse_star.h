// The triangles around a vertex, in order, sector by sector.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "pm/wedge_mesh.h"

namespace viewcell {

/// The star of one vertex u at a time. Where u lies on borders of texture charts its wedges cut the
/// star into sectors; elsewhere, and without texture coordinates, there is one. Places are relative
/// to u.
class CollapseStar {
 public:
  /// A neighbour of u.
  struct Rim {
    std::uint32_t vertex, wedge;
    std::uint32_t face;  ///< place in faces() of the triangle from here to the next
    glm::dvec3 to;       ///< from u
    glm::dvec2 uv;       ///< from u, in the texture; 0 without texture coordinates
  };
  /// Part of the rim, in the winding of the triangles; an open sector's last neighbour has no face.
  struct Sector {
    std::span<const Rim> rim;
    bool is_closed = false;
    glm::dvec2 origin{0};     ///< u in the texture
    std::uint32_t wedge = 0;  ///< of u; one of them
  };

  /// Keeps references. texcoords: of wedges; empty: charts do not matter.
  CollapseStar(const CollapseMesh& mesh, const WedgeTable& wedges,
               std::span<const glm::vec3> positions, std::span<const glm::vec2> texcoords)
      : mesh_(mesh), wedges_(wedges), positions_(positions), texcoords_(texcoords) {}

  /// False when some sector is not one fan that meets each neighbour once. What was gathered last
  /// is kept until forget().
  bool gather(std::uint32_t u);
  void forget() { of_ = kNone; }
  /// Whether a seam ends in u: a neighbour in one sector has two places in the texture, and Rim::uv
  /// is one of them.
  bool is_torn() const { return is_torn_; }
  std::uint32_t of() const { return of_; }
  const std::vector<Sector>& sectors() const { return sectors_; }
  const std::vector<std::uint32_t>& faces() const { return faces_; }
  /// Appends a face that is not of u, or finds it; returns its place in faces().
  std::uint32_t place_of(std::uint32_t face);

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  struct Spoke {                                                 // a triangle (u, a, b)
    std::uint32_t face, a, b, chart, wedge_u, wedge_a, wedge_b;  // chart: u's texture vertex
  };
  bool order(std::size_t first, std::size_t last);
  bool differ(std::uint32_t wedge_a, std::uint32_t wedge_b) const;
  bool meets_each_once(std::size_t first) const;
  void locate(std::size_t first, std::uint32_t wedge_u);

  const CollapseMesh& mesh_;
  const WedgeTable& wedges_;
  std::span<const glm::vec3> positions_;
  std::span<const glm::vec2> texcoords_;
  std::uint32_t of_ = kNone;
  bool is_legal_ = false, is_torn_ = false;
  std::vector<Spoke> spokes_;
  std::vector<Rim> rim_;
  std::vector<Sector> sectors_;
  std::vector<std::uint32_t> faces_;
};

}  // namespace viewcell
