#include "pm/point_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace viewcell {

PointTree::PointTree(std::span<const glm::vec3> points)
    : points_(points.begin(), points.end()),
      point_at_(points.size()),
      place_of_(points.size()),
      n_present_(points.size()),
      is_present_(points.size(), true) {
  std::iota(point_at_.begin(), point_at_.end(), 0u);
  build(0, points_.size(), 0);
  for (std::uint32_t place = 0; place < point_at_.size(); ++place)
    place_of_[point_at_[place]] = place;
}

void PointTree::build(std::size_t first, std::size_t last, int axis) {
  if (first == last) return;
  const std::size_t middle = first + (last - first) / 2;
  const auto at = [&](std::size_t place) {
    return point_at_.begin() + static_cast<std::ptrdiff_t>(place);
  };
  std::nth_element(at(first), at(middle), at(last), [&](std::uint32_t a, std::uint32_t b) {
    const float x = points_[a][axis], y = points_[b][axis];
    return x != y ? x < y : a < b;
  });
  n_present_[middle] = static_cast<std::uint32_t>(last - first);
  build(first, middle, (axis + 1) % 3);
  build(middle + 1, last, (axis + 1) % 3);
}

void PointTree::set_present(std::uint32_t point, bool is_present) {
  if (is_present_[point] == is_present) return;
  is_present_[point] = is_present;
  const std::size_t place = place_of_[point];
  std::size_t first = 0, last = points_.size(), middle = last / 2;
  for (;; middle = first + (last - first) / 2) {
    n_present_[middle] += is_present ? 1u : ~0u;
    if (middle == place) return;
    (place < middle ? last : first) = place < middle ? middle : middle + 1;
  }
}

std::uint32_t PointTree::nearest(const glm::dvec3& to) const {
  Nearest nearest{to, std::numeric_limits<double>::infinity()};
  search(0, points_.size(), 0, nearest);
  return nearest.point;
}

bool PointTree::is_present(std::size_t first, std::size_t last) const {
  return first < last && n_present_[first + (last - first) / 2] > 0;
}

void PointTree::search(std::size_t first, std::size_t last, int axis, Nearest& nearest) const {
  if (!is_present(first, last)) return;
  const std::size_t middle = first + (last - first) / 2;
  const std::uint32_t root = point_at_[middle];
  const glm::dvec3 off = nearest.to - glm::dvec3(points_[root]);
  const int next = (axis + 1) % 3;
  const bool is_below = off[axis] < 0;
  is_below ? search(first, middle, next, nearest) : search(middle + 1, last, next, nearest);
  const double distance2 = glm::dot(off, off);
  if (is_present_[root] &&
      (distance2 < nearest.distance2 || (distance2 == nearest.distance2 && root < nearest.point)))
    nearest.distance2 = distance2, nearest.point = root;
  if (off[axis] * off[axis] > nearest.distance2) return;
  is_below ? search(middle + 1, last, next, nearest) : search(first, middle, next, nearest);
}

}  // namespace viewcell
