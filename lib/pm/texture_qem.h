// Quadrics over position and texture, as metrics of CollapseLoop.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "pm/qem.h"
#include "pm/quadric5.h"
#include "pm/wedge_mesh.h"

namespace viewcell {

struct TextureQemOptions {
  QemOptions qem;
  /// A length in texture space, after scaling so that the whole texture area is as large as the
  /// surface, counts this many times a length in space. 0: qem3.
  double texture_weight = 1;
};

/// What both placements share: each chart vertex gathers the planes of its own faces, so that
/// texture charts do not mix. Boundary edges are held in space, as in qem3. Keeps references.
struct TextureQuadrics {
  std::span<const glm::vec3> positions;
  const std::vector<glm::vec2>& texcoords;  ///< of wedges, as they are now
  glm::dvec3 centre;                        ///< of the box: positions are relative to it
  double scale = 0;                         ///< of texture coordinates
  QuadricScale cost_scale;
  LargeVector<Quadric5> of_wedges;  ///< by chart vertex
  LargeVector<Quadric> boundaries;  ///< by vertex

  /// triangles: of vertices, those of copies shrunk to points (without_copies).
  TextureQuadrics(const WedgeMesh& input, std::span<const glm::vec3> positions,
                  std::span<const Triangle> triangles, const std::vector<glm::vec2>& texcoords,
                  const TextureQemOptions& options);
  Vec5 point(std::uint32_t vertex, std::uint32_t wedge) const;
  /// The cost of both vertices at v, each wedge of u at that of v that the table has matched last.
  float cost_at_parent(const CollapseMesh& mesh, WedgeTable& wedges, std::uint32_t u,
                       std::uint32_t v) const;
  /// u has collapsed into v, as the table has matched it last.
  void merge(std::uint32_t u, std::uint32_t v, const WedgeTable& wedges);
};

/// Half-edge collapses; wedges go to the wedges of v in their charts.
/// Follows: [Garland, Heckbert 1998].
class TextureQemMetric {
 public:
  /// Keeps references; wedges is the table while the mesh collapses.
  TextureQemMetric(const CollapseMesh& mesh, const WedgeMesh& input, WedgeTable& wedges,
                   std::span<const glm::vec3> positions, std::span<const Triangle> triangles,
                   const TextureQemOptions& options = {})
      : mesh_(mesh),
        wedges_(wedges),
        quadrics_(input, positions, triangles, input.texcoords, options) {}

  float cost(std::uint32_t u, std::uint32_t v);
  bool allows(const CollapseMesh&, std::uint32_t, std::uint32_t) const { return true; }
  void traced(std::uint32_t u, std::uint32_t v, const CollapseTrace&) {
    quadrics_.merge(u, v, wedges_);
  }
  void collapsed(std::uint32_t, std::uint32_t) {}

 private:
  const CollapseMesh& mesh_;
  WedgeTable& wedges_;
  TextureQuadrics quadrics_;
};

/// Full-edge collapses into the position and texture coordinates where the quadrics' sum is least;
/// along chart borders, on the edge; from inside a chart to its border and at hubs, at v. Moves
/// positions.
/// Follows: [Garland, Heckbert 1998].
class TextureQemFullMetric {
 public:
  /// Keeps references; wedges is the table while the mesh collapses, texcoords those of its wedges,
  /// which somebody else moves.
  TextureQemFullMetric(const CollapseMesh& mesh, const WedgeMesh& input, WedgeTable& wedges,
                       std::span<glm::vec3> positions, std::span<const Triangle> triangles,
                       const std::vector<glm::vec2>& texcoords,
                       const TextureQemOptions& options = {})
      : mesh_(mesh),
        wedges_(wedges),
        positions_(positions),
        quadrics_(input, positions, triangles, texcoords, options) {}

  float cost(std::uint32_t u, std::uint32_t v) { return evaluate(u, v).cost; }
  /// Where v stays.
  float cost_at_end(std::uint32_t u, std::uint32_t v);
  glm::vec3 optimal_position(std::uint32_t u, std::uint32_t v) { return evaluate(u, v).position; }
  /// Of the last optimal_position(): texture coordinates for its one pair of wedges, if there is
  /// one.
  const std::optional<glm::vec2>& texcoord() const { return last_.texcoord; }
  bool allows(const CollapseMesh&, std::uint32_t, std::uint32_t) const { return true; }
  void traced(std::uint32_t u, std::uint32_t v, const CollapseTrace&) {
    quadrics_.merge(u, v, wedges_);
  }
  void collapsed(std::uint32_t, std::uint32_t v, const glm::vec3& position) {
    positions_[v] = position;
  }

 private:
  struct Evaluated {
    float cost = 0;
    glm::vec3 position{0};
    std::optional<glm::vec2> texcoord;
  };
  const Evaluated& evaluate(std::uint32_t u, std::uint32_t v);
  void place_freely(std::uint32_t u, std::uint32_t v);
  void place_on_edge(std::uint32_t u, std::uint32_t v);

  const CollapseMesh& mesh_;
  WedgeTable& wedges_;
  std::span<glm::vec3> positions_;
  TextureQuadrics quadrics_;
  Evaluated last_;
};

}  // namespace viewcell
