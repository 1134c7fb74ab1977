// The triangles around a vertex, stored so that many vertices are compared at once (SIMD).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace viewcell {

/// Triangles (v, a[i], b[i]) of a vertex v, in any order.
class Fan {
 public:
  /// Makes room for n triangles; set() each of them then.
  void resize(std::size_t n);
  void set(std::size_t i, std::uint32_t at_a, std::uint32_t at_b) { a_[i] = at_a, b_[i] = at_b; }

  std::span<const std::uint32_t> a() const { return {a_.data(), n_}; }
  std::span<const std::uint32_t> b() const { return {b_.data(), n_}; }

  /// Whether each a is one b, and each b is one a: then the triangles go around v, all wound
  /// alike, and every neighbour is one a.
  bool is_closed() const;
  /// Whether some edge of v has an odd number of triangles.
  bool has_odd_edge() const;

 private:
  std::size_t n_ = 0;
  std::vector<std::uint32_t> a_, b_;  // n of them, and more to fill whole vectors
};

}  // namespace viewcell
