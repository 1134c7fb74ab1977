// The overlay of two fans of triangles over one polygon, whose apexes differ, as overlay cells.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "pm/overlay_cells.h"

namespace viewcell {

/// A fan is the triangles from one apex to the edges of a polygon; a ray goes from the apex to a
/// corner of the polygon. The old fan's apex is the origin. Each corner of an overlay cell has a
/// point on the old and one on the new surface.
///
/// In the texture corners keep their order along each edge and some distance from each other, so
/// that no cell folds or vanishes where the faces do not. Differs from [Chen06 3.2.2], where points
/// that are nearest may pass each other and cells overlap.
class FanOverlay {
 public:
  /// What is made of cells beside what OverlayCell has.
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
  /// The next corner of the polygon, and the number of the faces from there to the next.
  void add_ray(const FanPoint& corner, std::uint32_t face);
  /// The corner of ray i again, after a whole turn.
  void repeat_ray(std::size_t i) {
    const Ray ray = rays_[i];
    rays_.push_back(ray);
  }
  /// The cell around the old apex, whose point on the new surface is `after`, in the new face
  /// between ray and ray + 1.
  void add_old_apex(std::size_t ray, const FanPoint& after);
  /// The cell around the new apex, whose point on the old surface is `before`.
  void add_new_apex(std::size_t ray, const FanPoint& before);
  /// The cells on one side, from the new apex to the old one. The polygon's corners are counted
  /// from `first`, forwards or backwards. Old edges i = 1 ... middle make rows of corners with new
  /// edges j > i; before the rows is the new apex, beyond the middle the old one. Old face i lies
  /// between rows i and i + 1, new face j between columns j and j + 1.
  void add_side(std::size_t first, bool is_forward, std::size_t middle, const FanPoint& before,
                const FanPoint& after);
  /// The face between rays 0 and 1, alone in its sector, vanishes: its apex goes to `after`, on the
  /// edge that is left, so its surface is mapped onto `inheriting_face`, which itself stays as it
  /// is.
  void add_vanishing_face(std::uint32_t inheriting_face, const FanPoint& after);
  /// The same where the edge is left over, too: all of the face goes to the corner of ray 0, the
  /// new apex, in `inheriting_face`.
  void add_vanishing_fin(std::uint32_t inheriting_face);

  const std::vector<OverlayCell>& cells() const { return cells_; }
  /// Beside the cells, if asked for. Of an inheriting face's own, unchanged part all corners are 0.
  const std::vector<CellMoments>& moments() const { return moments_; }
  const std::vector<CellCorners>& textures() const { return textures_; }
  const std::vector<TexturePoint>& texture_points() const { return points_; }
  /// Crossings that had to be moved along their edges.
  std::size_t n_moved_points() const { return n_moved_points_; }
  /// The longest distance of a corner's two points.
  double largest_shift() const;

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  struct Corner {
    Double4 shift{}, before{};  // old minus new point, and the old one
    std::uint32_t point = 0;    // in the texture
  };
  struct Crossing {
    double s, t;  // along the old edge from the old apex, along the new edge from the new apex
  };
  struct Around {  // of a cell; of a triangle, c and d are the same
    const Corner &a, &b, &c, &d;
  };
  // Made in place: a copy would wait until its numbers, stored one by one, are in memory.
  struct Ray {
    Ray(const FanPoint& corner, const Double4& apex, std::uint32_t face_in)
        : to(make_double4(corner.at)),
          from_apex(to - apex),
          from_apex2(dot(from_apex, from_apex)),
          texture(corner.texture),
          face(face_in) {}
    // What Matching::nearest asks for besides.
    void set_nearest(const Double4& apex) {
      to2 = dot(to, to), to_a = dot(to, apex), from_apex_a = dot(from_apex, apex);
    }
    Double4 to, from_apex;             // relative to the old and to the new apex
    double from_apex2, to2 = 0;        // squared lengths
    double to_a = 0, from_apex_a = 0;  // dot products with the new apex
    glm::dvec2 texture;
    std::uint32_t face;
    std::uint32_t point = kNone;  // in the texture
  };
  Corner cross(const Ray& old_edge, const Ray& new_edge);
  Corner old_apex(const FanPoint& after);
  Corner new_apex(const FanPoint& before);
  Corner on_rim(const Ray& ray) const;
  void keep_face(std::uint32_t face);
  std::uint32_t add_point(const glm::dvec2& before, const glm::dvec2& after);
  template <typename RayAt>
  void order_crossings(std::size_t middle, const RayAt& ray);
  template <typename RayAt>
  void set_crossing_points(std::size_t middle, const RayAt& ray);
  void add_apex(std::size_t ray, std::uint32_t new_face, const Corner& apex);
  void add_cell(std::uint32_t old_face, std::uint32_t new_face, const Around& around);
  void add_moments(const Around& around);

  Matching matching_;
  Keep keep_;
  std::vector<OverlayCell> cells_;
  std::vector<CellMoments> moments_;
  std::vector<CellCorners> textures_;
  std::vector<TexturePoint> points_;
  std::size_t n_moved_points_ = 0;
  double largest2_ = 0;
  Double4 apex_{};
  glm::dvec2 apex_texture_{0}, origin_{0};
  bool is_backward_ = false, is_mirrored_ = false;  // the rays; the cells that are added
  std::uint32_t old_apex_point_ = kNone, new_apex_point_ = kNone;
  std::vector<Crossing> crossings_;  // of a side: old edge 1 with new edges 2, 3, ...; old edge 2
  std::vector<double> along_;        // of one edge
  std::vector<std::pair<double, double>> pools_;
  std::vector<Ray> rays_;
  std::vector<Corner> row_, next_row_;
};

}  // namespace viewcell
