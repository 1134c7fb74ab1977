// Figures as implicit surfaces: solids joined into limbs, limbs joined with fillets.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace viewcell {

/// A convex solid (a fluted one is nearly so). Made by the functions below.
struct Solid {
  enum class Shape : std::uint8_t { kRoundCone, kEllipsoid, kBox, kDrum };
  Shape shape = Shape::kRoundCone;
  int n_flutes = 0;       ///< drum: folds around the axis
  float flute_depth = 0;  ///< drum: of the folds, at the end b
  float twist_rad = 0;    ///< drum: turn of the folds from a to b
  float round = 0;        ///< box, drum: radius of the edges
  float ra = 0, rb = 0;   ///< round cone, drum: radii at the ends
  glm::vec3 a{0}, b{0};   ///< ends of the axis; a: the centre of an ellipsoid or box
  glm::vec3 size{1};      ///< ellipsoid: radii; box: half sides; drum: x, y stretch of the section
  glm::mat3 axes{1};      ///< columns: the solid's own axes (of the section, for a drum)
};

/// The convex hull of two balls.
Solid make_round_cone(const glm::vec3& a, float ra, const glm::vec3& b, float rb);
Solid make_ball(const glm::vec3& centre, float radius);
Solid make_ellipsoid(const glm::vec3& centre, const glm::vec3& radii,
                     const glm::mat3& axes = glm::mat3(1));
Solid make_box(const glm::vec3& centre, const glm::vec3& half, float round,
               const glm::mat3& axes = glm::mat3(1));
/// A cone's frustum from a to b, its section stretched along the world's x and y when the axis is
/// vertical. Set n_flutes, flute_depth and twist_rad for folds.
Solid make_drum(const glm::vec3& a, float ra, const glm::vec3& b, float rb, float round,
                const glm::vec2& stretch = glm::vec2(1));
/// The solid seen in a mirror at x = 0 (axis 0) or y = 0 (axis 1).
Solid mirror(const Solid& solid, int axis);

/// Rotation matrices; angles in degrees, counter-clockwise seen from the axis's tip.
glm::mat3 turn_x(float deg);
glm::mat3 turn_y(float deg);
glm::mat3 turn_z(float deg);
/// Axes whose third column points along `z` (any length).
glm::mat3 axes_along(const glm::vec3& z);

/// Solids that are one piece, and how it joins what stands before it in the figure.
struct Limb {
  enum class Op : std::uint8_t { kUnite, kCut };
  Op op = Op::kUnite;
  float blend = 0;        ///< width of the fillet where it joins; 0: a crease
  float inner_blend = 0;  ///< the same between its own solids
  std::vector<Solid> solids;
};

/// Limbs in the order in which they are united or cut out.
struct Figure {
  std::vector<Limb> limbs;
  void unite(float blend, std::vector<Solid> solids, float inner_blend = 0);
  void cut(float blend, std::vector<Solid> solids, float inner_blend = 0);
  /// The same, and once more in the mirror.
  void unite_pair(int axis, float blend, const std::vector<Solid>& solids, float inner_blend = 0);
  void cut_pair(int axis, float blend, const std::vector<Solid>& solids, float inner_blend = 0);
  /// Another figure's limbs, scaled, turned and moved. A cut among them cuts what is already here.
  void add(const Figure& other, float scale, const glm::mat3& turn, const glm::vec3& move);
};

/// A point of a curve that a limb follows.
struct Knot {
  glm::vec3 point{0};
  float radius = 1;
};
/// Round cones along the Catmull-Rom curve through the knots, `steps` to a span.
std::vector<Solid> make_chain(std::span<const Knot> knots, int steps);
/// The curve itself, at t in [0, number of knots - 1].
Knot point_on_chain(std::span<const Knot> knots, float t);

/// The part of a figure that matters inside one ball of space.
class FigureView {
 public:
  /// The whole figure; keeps a reference to it.
  explicit FigureView(const Figure& figure);
  /// What of this view decides the surface within `radius` of the centre: values near zero there
  /// are those of the whole figure, and all have its sign.
  FigureView near(const glm::vec3& centre, float radius) const;
  /// About the distance to the surface, negative inside; never changes faster than about 1 : 1.
  float value(const glm::vec3& p) const;

 private:
  struct Part {
    const Limb* limb;
    std::uint32_t first, last;  // in solids_
  };
  FigureView() = default;
  std::vector<Part> parts_;
  std::vector<const Solid*> solids_;
};

/// A box that holds the figure's surface.
Box figure_box(const Figure& figure);

}  // namespace viewcell
