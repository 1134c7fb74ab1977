#include "pm/point_tree.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

namespace viewcell {
namespace {

constexpr std::size_t kLeafPoints = 8;

}  // namespace

PointTree::PointTree(std::span<const glm::vec3> points)
    : points_(points.begin(), points.end()),
      n_leaves_(std::bit_ceil((points.size() + kLeafPoints - 1) / kLeafPoints)),
      nodes_(2 * n_leaves_),
      is_present_(points.size(), true) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Node& leaf = nodes_[n_leaves_ + i / kLeafPoints];
    const bool is_first = leaf.n_present++ == 0;
    leaf.lo = is_first ? points_[i] : glm::min(leaf.lo, points_[i]);
    leaf.hi = is_first ? points_[i] : glm::max(leaf.hi, points_[i]);
  }
  for (std::size_t i = n_leaves_ - 1; i > 0; --i) {
    const Node &a = nodes_[2 * i], &b = nodes_[2 * i + 1];
    nodes_[i] = b.n_present == 0
                    ? a
                    : Node{glm::min(a.lo, b.lo), glm::max(a.hi, b.hi), a.n_present + b.n_present};
  }
}

void PointTree::set_present(std::uint32_t point, bool is_present) {
  if (is_present_[point] == is_present) return;
  is_present_[point] = is_present;
  for (std::size_t i = n_leaves_ + point / kLeafPoints; i > 0; i /= 2)
    nodes_[i].n_present += is_present ? 1u : ~0u;
}

std::uint32_t PointTree::nearest(const glm::dvec3& to) const {
  Nearest nearest{to, std::numeric_limits<double>::infinity()};
  search(1, nearest);
  return nearest.point;
}

// No more than to any of its points, rounded as theirs is.
double PointTree::distance2(const Node& node, const glm::dvec3& to) {
  const glm::dvec3 off =
      glm::max(glm::max(glm::dvec3(node.lo) - to, to - glm::dvec3(node.hi)), glm::dvec3(0));
  return glm::dot(off, off);
}

void PointTree::search(std::size_t node, Nearest& nearest) const {
  if (nodes_[node].n_present == 0 || distance2(nodes_[node], nearest.to) > nearest.distance2)
    return;
  if (node >= n_leaves_) return search_leaf(node - n_leaves_, nearest);
  std::size_t first = 2 * node, second = first + 1;
  if (distance2(nodes_[second], nearest.to) < distance2(nodes_[first], nearest.to))
    std::swap(first, second);
  search(first, nearest);
  search(second, nearest);
}

void PointTree::search_leaf(std::size_t leaf, Nearest& nearest) const {
  const std::size_t last = std::min(kLeafPoints * (leaf + 1), points_.size());
  for (std::size_t i = kLeafPoints * leaf; i < last; ++i) {
    if (!is_present_[i]) continue;
    const auto point = static_cast<std::uint32_t>(i);
    const glm::dvec3 off = nearest.to - glm::dvec3(points_[i]);
    const double d2 = glm::dot(off, off);
    if (d2 < nearest.distance2 || (d2 == nearest.distance2 && point < nearest.point))
      nearest.distance2 = d2, nearest.point = point;
  }
}

}  // namespace viewcell
