// Where the surface of a piece goes that vanishes.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "pm/collapse_mesh.h"
#include "pm/point_tree.h"
#include "pm/vector_box.h"

namespace viewcell {

/// Every face of the piece goes onto one face that stays, linearly, its corners to the nearest
/// points there.
struct VanishMap {
  struct Shift {
    std::uint32_t face;  ///< of the piece
    VectorBox shift;     ///< its points minus where they go
  };
  std::uint32_t onto = 0;  ///< the face that stays
  std::vector<Shift> faces;
};

/// Finds a face that stays near a piece that vanishes: at the vertex of the input that is nearest
/// to its middle, or where collapses have brought that one, and from there to ever nearer faces. It
/// need not be the nearest of all. O(log n), and the piece's faces.
class VanishMapper {
 public:
  /// Keeps references. input: the mesh before any collapse; vertices without faces are passed over.
  VanishMapper(const CollapseMesh& mesh, std::span<const glm::vec3> positions,
               std::span<const Triangle> input);

  /// u has been collapsed into v.
  void traced(std::uint32_t u, std::uint32_t v, const CollapseTrace& trace);
  /// The map of a piece with these faces. From now on nothing goes to it, unless it is put back.
  /// False when no face is left.
  bool build(std::span<const std::uint32_t> input_faces, std::span<const std::uint32_t> live_faces);
  const VanishMap& map() const { return map_; }
  void put_back(std::span<const std::uint32_t> input_faces) { set_present(input_faces, true); }

 private:
  struct Nearest {
    std::uint32_t face;
    double distance2;
  };
  void set_present(std::span<const std::uint32_t> input_faces, bool is_present);
  std::uint32_t live_vertex(std::uint32_t v);
  glm::dvec3 corner(std::uint32_t face, std::uint32_t k) const;
  glm::dvec3 closest_on(std::uint32_t face, const glm::dvec3& p) const;
  void look_around(std::uint32_t v, const glm::dvec3& p, Nearest& nearest) const;
  std::uint32_t find_face(const glm::dvec3& p, std::uint32_t from) const;

  const CollapseMesh& mesh_;
  std::span<const glm::vec3> positions_;
  std::span<const Triangle> input_;
  PointTree tree_;
  std::vector<std::uint32_t> into_;  // vertex -> the one that it was collapsed into, or itself
  VanishMap map_;
};

}  // namespace viewcell
