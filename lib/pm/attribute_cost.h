// What collapses do to materials and colours, as a cost beside any metric's.
#pragma once

#include <span>
#include <vector>

#include "base/large_vector.h"
#include "pm/qem.h"
#include "pm/wedge_mesh.h"

namespace viewcell {

struct AttributeCostOptions {
  bool borders = true;  ///< where materials or colours meet count as boundaries do in qem3
  bool colours = true;
  /// A difference of 1 of a colour, as sRGB encodes it, counts as this share of the box's diagonal.
  double colour_weight = 0.05;
  double boundary_weight = 10;  ///< of borders, as QemOptions has it
  QuadricScale scale = {};
  /// Instead of by scale: the fourth root of the sum (an area times a squared length), for metrics
  /// whose costs are lengths and no means.
  bool fourth_root = false;
};

/// Of a linear function of position for each of three channels: value(p, s) = sum over faces of
/// weight * |colour of the face's plane at p - s|^2 [Hoppe99].
struct ColourQuadric {
  Symmetric3 a{};
  glm::dvec3 b{0};
  double c = 0;
  glm::dvec3 gradients[3] = {glm::dvec3(0), glm::dvec3(0), glm::dvec3(0)};  // by channel
  glm::dvec3 constants{0};
  double weight = 0;

  /// A triangle with a colour at each corner; one without area says nothing.
  void add_triangle(const glm::dvec3 (&corners)[3], const glm::dvec3 (&colours)[3], double w);
  void add(const ColourQuadric& q);
  double value(const glm::dvec3& p, const glm::dvec3& colour) const;
};

/// Quadrics of the borders between materials or colours (planes through them, at right angles to
/// their faces), and of colours, which chart vertices gather from their own faces. A collapse costs
/// what its two vertices' sums come to where both go, with v's colours.
class AttributeCost {
 public:
  /// mesh, positions (of its vertices) and triangles (without copies) as they are before the first
  /// collapse; colours: of the file's vertices, linear, or empty.
  AttributeCost(const WedgeMesh& mesh, std::span<const glm::vec3> positions,
                std::span<const Triangle> triangles, std::span<const glm::vec3> colours,
                const AttributeCostOptions& options);

  /// No border, and one colour.
  bool is_empty() const { return borders_.empty() && quadrics_.empty(); }
  bool has_colours() const { return !quadrics_.empty(); }
  /// Whether colours change beside u or v, as the table has matched them last.
  bool has_gradient(const WedgeTable& table, std::uint32_t u, std::uint32_t v) const;
  std::size_t n_border_edges() const { return n_border_edges_; }

  /// Of u and v at the position, as the table has matched them last (not looked at without
  /// colours); a length in the unit of the positions.
  float cost(const WedgeTable& table, std::uint32_t u, std::uint32_t v,
             const glm::vec3& position) const;
  /// u has collapsed into v.
  void merge(const WedgeTable& table, std::uint32_t u, std::uint32_t v);

 private:
  void add_borders(const WedgeMesh& mesh, std::span<const glm::vec3> positions,
                   std::span<const Triangle> triangles, const AttributeCostOptions& options);
  void add_colours(const WedgeMesh& mesh, std::span<const glm::vec3> positions,
                   std::span<const Triangle> triangles, std::span<const glm::vec3> colours,
                   const AttributeCostOptions& options);
  double square_of_cost(double value, double weight) const;
  std::size_t slot(const WedgeTable& table, std::uint32_t wedge, std::uint32_t vertex) const {
    return table.has_charts() ? table.chart_vertex(wedge) : vertex;
  }

  glm::dvec3 centre_;
  QuadricScale scale_;
  bool fourth_root_ = false;
  LargeVector<Quadric> borders_;         // by vertex; or empty
  LargeVector<ColourQuadric> quadrics_;  // by chart vertex, without charts by vertex; or empty
  std::vector<glm::vec3> colours_;       // likewise, scaled
  std::size_t n_border_edges_ = 0;
};

}  // namespace viewcell
