// The nearest of some points, which come and go.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace viewcell {

/// Boxes around points that follow one another, in pairs up to one box around all. Quick where
/// points that are near in number are near in space. All are there at first.
class PointTree {
 public:
  /// Copies the points. O(n); 20 bytes a point.
  explicit PointTree(std::span<const glm::vec3> points);

  /// Takes a point out, or puts it back. O(log n).
  void set_present(std::uint32_t point, bool is_present);
  /// The lowest number among the nearest of those that are there, or kNone.
  std::uint32_t nearest(const glm::dvec3& to) const;
  static constexpr std::uint32_t kNone = 0xffffffffu;

 private:
  struct Node {
    glm::vec3 lo{0}, hi{0};       // around its points, those that are not there too
    std::uint32_t n_present = 0;  // of them
  };
  struct Nearest {
    glm::dvec3 to;
    double distance2;
    std::uint32_t point = kNone;
  };
  static double distance2(const Node& node, const glm::dvec3& to);
  void search(std::size_t node, Nearest& nearest) const;
  void search_leaf(std::size_t leaf, Nearest& nearest) const;

  std::vector<glm::vec3> points_;
  std::size_t n_leaves_ = 1;  // a power of two
  std::vector<Node> nodes_;   // of node i those below it are 2 i and 2 i + 1; leaves from n_leaves_
  std::vector<bool> is_present_;  // by point
};

}  // namespace viewcell
