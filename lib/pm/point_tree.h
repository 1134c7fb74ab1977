// The nearest of some points, which come and go.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace viewcell {

/// A balanced tree of points, cut along x, y, z in turn. All are there at first.
class PointTree {
 public:
  /// Copies the points. O(n log n); 20 bytes a point.
  explicit PointTree(std::span<const glm::vec3> points);

  /// Takes a point out, or puts it back. O(log n).
  void set_present(std::uint32_t point, bool is_present);
  /// The lowest number among the nearest of those that are there, or kNone.
  std::uint32_t nearest(const glm::dvec3& to) const;
  static constexpr std::uint32_t kNone = 0xffffffffu;

 private:
  struct Nearest {
    glm::dvec3 to;
    double distance2;
    std::uint32_t point = kNone;
  };
  void build(std::size_t first, std::size_t last, int axis);
  void search(std::size_t first, std::size_t last, int axis, Nearest& nearest) const;
  bool is_present(std::size_t first, std::size_t last) const;

  std::vector<glm::vec3> points_;
  // Of places [first, last) the one in the middle is the root, those before it lie below it along
  // the axis, those after it above.
  std::vector<std::uint32_t> point_at_, place_of_;
  std::vector<std::uint32_t> n_present_;  // by place: of the range whose root is there
  std::vector<bool> is_present_;          // by point
};

}  // namespace viewcell
