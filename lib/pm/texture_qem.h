// Quadrics over position and texture, as a metric of CollapseLoop.
#pragma once

#include <array>
#include <vector>

#include "pm/qem.h"
#include "pm/wedge_mesh.h"

namespace viewcell {

using Vec5 = std::array<double, 5>;

/// value(x) = sum over planes in R^5 of weight * (distance of x to the plane)^2. A plane is spanned
/// by a triangle's corners (position, scaled texture coordinates) [Garland, Heckbert 1998].
struct Quadric5 {
  std::array<double, 15> a{};  ///< upper triangle of the matrix, row by row
  Vec5 b{};
  double c = 0, weight = 0;

  void add_triangle(const Vec5& p, const Vec5& q, const Vec5& r, double w);
  void add(const Quadric5& q);
  double value(const Vec5& x) const;
};

struct TextureQemOptions {
  QemOptions qem;
  /// A length in texture space, after scaling so that the whole texture area is as large as the
  /// surface, counts this many times a length in space. 0: qem3.
  double texture_weight = 1;
};

/// Half-edge collapses; each wedge gathers the planes of its own faces, so that texture charts do
/// not mix, and goes to the wedge of v in its chart. Boundary edges are held in space, as in qem3.
/// Follows: [Garland, Heckbert 1998].
class TextureQemMetric {
 public:
  /// Keeps references; wedges is the table while the mesh collapses.
  TextureQemMetric(const CollapseMesh& mesh, const WedgeMesh& input, WedgeTable& wedges,
                   std::span<const glm::vec3> positions, const TextureQemOptions& options = {});

  float cost(std::uint32_t u, std::uint32_t v);
  bool allows(const CollapseMesh&, std::uint32_t, std::uint32_t) const { return true; }
  void traced(std::uint32_t u, std::uint32_t v, const CollapseTrace& trace);
  void collapsed(std::uint32_t, std::uint32_t) {}

 private:
  Vec5 point(std::uint32_t vertex, std::uint32_t wedge) const;
  void add_faces(const WedgeMesh& input);

  const CollapseMesh& mesh_;
  WedgeTable& wedges_;
  std::span<const glm::vec3> positions_;
  const std::vector<glm::vec2>& texcoords_;
  TextureQemOptions options_;
  glm::dvec3 centre_;
  double scale_ = 0;  // of texture coordinates
  QuadricScale cost_scale_;
  std::vector<Quadric5> quadrics_;     // by wedge
  std::vector<Quadric> boundaries_;    // by vertex
  std::vector<std::uint32_t> others_;  // scratch: wedges of v that no wedge of u goes to
};

}  // namespace viewcell
