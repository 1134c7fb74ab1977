#include "uv/triangle_atlas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/error.h"

namespace viewcell {
namespace {

constexpr double kMargin_px = 2;  // around a triangle, to the square's sides and its diagonal
constexpr double kLeastSquare_px = 8;
constexpr double kSqrt2 = 1.4142135623730951;

// The leg of the triangles in a square.
//   +-------+
//   |\   2  |   margin at the sides, and to both sides of the diagonal
//   |  \    |
//   | 1  \  |
//   +-------+
double leg_of(double side_px) {
  return side_px - (2 + kSqrt2) * kMargin_px;
}

// Squares of a picture: as many large ones as fit, halved up to `depth` times.
struct Squares {
  double side_px;  // of the large ones
  std::uint64_t n_across, n_large;
  int depth;

  Squares(int width_px, int height_px)
      : side_px(std::min(width_px, height_px)),
        n_across(static_cast<std::uint64_t>(width_px / std::min(width_px, height_px))),
        n_large(n_across * static_cast<std::uint64_t>(height_px / std::min(width_px, height_px))),
        depth(static_cast<int>(std::floor(std::log2(std::max(1.0, side_px / kLeastSquare_px))))) {}

  double side_at(int level) const { return std::ldexp(side_px, -level); }
  // In the smallest squares.
  std::uint64_t area_at(int level) const { return std::uint64_t{1} << 2 * (depth - level); }
  std::uint64_t area() const { return n_large * area_at(0); }

  // The lower left corner of the square that begins at the smallest one of that number; they are
  // counted along a Z in each large square, so that what is aligned is a square.
  glm::dvec2 corner_at(std::uint64_t number) const {
    const std::uint64_t large = number / area_at(0), within = number % area_at(0);
    std::uint64_t x = 0, y = 0;
    for (int bit = 0; bit < depth; ++bit) {
      x |= (within >> (2 * bit) & 1) << bit;
      y |= (within >> (2 * bit + 1) & 1) << bit;
    }
    const double least = side_at(depth);
    return glm::dvec2(double(large % n_across), double(large / n_across)) * side_px +
           least * glm::dvec2(double(x), double(y));
  }
};

// The level of the smallest square in which the leg fits, or the largest square's.
int level_for(const Squares& squares, double leg_px) {
  int level = squares.depth;
  while (level > 0 && leg_of(squares.side_at(level)) < leg_px) --level;
  return level;
}

std::vector<int> choose_levels(const Squares& squares, const std::vector<double>& legs,
                               double px_per_unit) {
  std::vector<int> out;
  out.reserve(legs.size());
  for (const double leg : legs) out.push_back(level_for(squares, leg * px_per_unit));
  return out;
}

// Two triangles of a level share a square.
std::uint64_t area_of(const Squares& squares, const std::vector<int>& levels) {
  std::vector<std::uint64_t> counts(static_cast<std::size_t>(squares.depth) + 1, 0);
  for (const int level : levels) ++counts[static_cast<std::size_t>(level)];
  std::uint64_t sum = 0;
  for (int level = 0; level <= squares.depth; ++level)
    sum += (counts[static_cast<std::size_t>(level)] + 1) / 2 * squares.area_at(level);
  return sum;
}

// Of the right-angled triangle with as much area.
std::vector<double> measure_legs(const TriMesh& mesh) {
  std::vector<double> out;
  for (const Triangle& t : mesh.triangles)
    out.push_back(std::sqrt(glm::length(area_normal(mesh, t))));
  return out;
}

// The largest scale at which all fit, to a hundredth of a doubling.
std::vector<int> fit_levels(const Squares& squares, const std::vector<double>& legs,
                            const std::string& name) {
  if (area_of(squares, choose_levels(squares, legs, 0)) > squares.area())
    throw InputError(name, "",
                     std::to_string(legs.size()) +
                         " triangles need a larger picture: " + "8 x 8 texels hold two");
  const double longest = *std::max_element(legs.begin(), legs.end());
  if (!(longest > 0)) return choose_levels(squares, legs, 0);
  double lo = std::log2(squares.side_at(squares.depth) / longest) - 1,
         hi = lo + 2 + 2 * squares.depth + 20;
  while (hi - lo > 0.01) {
    const double middle = (lo + hi) / 2;
    const auto levels = choose_levels(squares, legs, std::exp2(middle));
    (area_of(squares, levels) <= squares.area() ? lo : hi) = middle;
  }
  return choose_levels(squares, legs, std::exp2(lo));
}

// The corner opposite the longest edge.
std::size_t widest_corner(const TriMesh& mesh, const Triangle& t) {
  std::array<double, 3> opposite;
  for (std::size_t k = 0; k < 3; ++k)
    opposite[k] = glm::distance(glm::dvec3(mesh.positions[t[(k + 1) % 3]]),
                                glm::dvec3(mesh.positions[t[(k + 2) % 3]]));
  return static_cast<std::size_t>(std::max_element(opposite.begin(), opposite.end()) -
                                  opposite.begin());
}

// Counter-clockwise; is_upper: the half of the square beyond the diagonal.
void place(const TriMesh& mesh, std::uint32_t triangle, const glm::dvec2& corner, double side_px,
           bool is_upper, const glm::dvec2& size_px, std::vector<glm::vec2>& out) {
  const double leg = leg_of(side_px), sign = is_upper ? -1 : 1;
  const glm::dvec2 right_angle =
      corner + (is_upper ? glm::dvec2(side_px - kMargin_px) : glm::dvec2(kMargin_px));
  const std::array<glm::dvec2, 3> points{right_angle, right_angle + sign * glm::dvec2(leg, 0),
                                         right_angle + sign * glm::dvec2(0, leg)};
  const std::size_t first = widest_corner(mesh, mesh.triangles[triangle]);
  for (std::size_t k = 0; k < 3; ++k)
    out[3 * triangle + (first + k) % 3] = glm::vec2(points[k] / size_px);
}

}  // namespace

std::vector<glm::vec2> make_triangle_atlas(const TriMesh& mesh, int width_px, int height_px,
                                           const std::string& name) {
  VIEWCELL_CHECK(width_px > 0 && height_px > 0 && !mesh.triangles.empty(), width_px, height_px);
  const Squares squares(width_px, height_px);
  if (squares.side_px < kLeastSquare_px)
    throw InputError(name, "", "a picture of less than 8 texels holds no triangle");
  const std::vector<int> levels = fit_levels(squares, measure_legs(mesh), name);
  std::vector<std::uint32_t> order(levels.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return levels[a] < levels[b]; });
  std::vector<glm::vec2> out(3 * levels.size());
  std::uint64_t at = 0;
  bool is_upper = false;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const int level = levels[order[i]];
    place(mesh, order[i], squares.corner_at(at), squares.side_at(level), is_upper,
          {width_px, height_px}, out);
    const bool is_last = i + 1 == order.size() || levels[order[i + 1]] != level;
    if (is_upper || is_last) at += squares.area_at(level);
    is_upper = !is_upper && !is_last;
  }
  return out;
}

}  // namespace viewcell
