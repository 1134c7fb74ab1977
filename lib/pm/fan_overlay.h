// The overlay of two fans of triangles over one polygon, with other apexes, as cells.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "pm/vector_box.h"

namespace viewcell {

/// How points of the two surfaces are matched.
enum class Matching {
  texture,  ///< by equal texture coordinates [Cohen, Olano, Manocha 1998]
  nearest   ///< edges that cross at the nearest points of each other [Chen06 3.2.2, 4.2]
};

/// A part of one old face that goes to a part of one new face.
struct MapCell {
  std::uint32_t old_face, new_face;  ///< numbers that whoever laid the rays gave
  VectorBox shift{};  ///< of old point minus new point; linear between the corners, so it holds all
};

/// Of the points of a cell, over its part of the old face.
struct CellMoments {
  double area = 0;
  glm::dvec3 mean{0};  ///< of the shift
  double square = 0;   ///< mean squared length of the shift
};

/// The corners of a cell in the texture, of its part of the old and of the new face, in the winding
/// of the faces; of a triangle two neighbours are the same.
struct CellTexture {
  std::array<glm::dvec2, 4> before, after;
};

/// A point relative to the old fan's apex, in space and in the texture.
struct FanPoint {
  glm::dvec3 at{0};
  glm::dvec2 texture{0};
};

/// The old fan's apex is the origin. Each corner of a cell has a point on the old and one on the
/// new surface.
class FanOverlay {
 public:
  /// What is made of cells beside what MapCell has.
  struct Keep {
    bool moments = false, texture = false;
  };
  FanOverlay(Matching matching, const Keep& keep) : matching_(matching), keep_(keep) {}

  bool keeps_texture() const { return keep_.texture; }

  /// Forgets all cells.
  void clear();
  /// A new pair of fans; origin: the old apex' texture coordinates; is_backward: rays come against
  /// the winding of the faces.
  void start(const FanPoint& new_apex, const glm::dvec2& origin = {0, 0}, bool is_backward = false);
  /// The next place of the polygon, and the number of the faces from there on.
  void add_ray(const FanPoint& place, std::uint32_t face);
  /// The cell around the old apex: its place on the new surface is `after`, in the new face between
  /// ray and ray + 1.
  void add_old_apex(std::size_t ray, const FanPoint& after);
  /// The cell around the new apex, whose place on the old surface is `before`.
  void add_new_apex(std::size_t ray, const FanPoint& before);
  /// The cells on one side, from the new apex to the old one. The polygon's places are counted from
  /// `first`, forwards or backwards. Old edges i = 1 ... middle make rows of corners with new edges
  /// j > i; before the rows is the new apex, beyond the middle the old one. Old face i lies between
  /// rows i and i + 1, new face j between columns j and j + 1.
  void add_side(std::size_t first, bool is_forward, std::size_t middle, const FanPoint& before,
                const FanPoint& after);
  /// The face between rays 0 and 1 vanishes: its apex goes to `after`, on the edge that is left,
  /// and `heir` takes it, itself unchanged.
  void add_lone(std::uint32_t heir, const FanPoint& after);

  const std::vector<MapCell>& cells() const { return cells_; }
  /// Beside the cells, if asked for. The unchanged heir of a lone face has no texture.
  const std::vector<CellMoments>& moments() const { return moments_; }
  const std::vector<CellTexture>& textures() const { return textures_; }
  /// The longest distance of a corner's two points.
  double largest_shift() const;

 private:
  struct Corner {
    Double4 shift{}, before{};  // old minus new point, and the old one
    glm::dvec2 old_texture{0}, new_texture{0};
  };
  struct Around {  // of a cell; of a triangle, c and d are the same
    const Corner &a, &b, &c, &d;
  };
  struct Ray {
    Double4 to, from_apex;     // relative to the old and to the new apex
    double to2, from_apex2;    // squared lengths
    double to_a, from_apex_a;  // dot products with the new apex
    glm::dvec2 texture;
    std::uint32_t face;
  };
  Corner cross(const Ray& old_edge, const Ray& new_edge);
  Corner old_apex(const FanPoint& after) const;
  Corner new_apex(const FanPoint& before) const;
  Corner on_rim(const Ray& ray) const;
  void add_apex(std::size_t ray, std::uint32_t new_face, const Corner& apex);
  void add_cell(std::uint32_t old_face, std::uint32_t new_face, const Around& around);
  void add_moments(const Around& around);

  Matching matching_;
  Keep keep_;
  std::vector<MapCell> cells_;
  std::vector<CellMoments> moments_;
  std::vector<CellTexture> textures_;
  double largest2_ = 0;
  Double4 apex_{};
  glm::dvec2 apex_texture_{0}, origin_{0};
  bool is_backward_ = false, is_mirrored_ = false;  // the rays; the cells that are added
  std::vector<Ray> rays_;
  std::vector<Corner> row_, next_row_;
};

}  // namespace viewcell
