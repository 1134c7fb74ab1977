// Follows: [Floater03]: w_ij = (tan(a / 2) + tan(b / 2)) / |v_j - v_i|,
// a and b the angles at v_i on both sides of the edge. Any positive weights keep the map one to
// one, so those of degenerate triangles are clamped.
#include "uv/parameterize.h"

#include <Eigen/Sparse>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

#include "base/error.h"
#include "mesh/edges.h"
#include "uv/uv_stretch.h"

namespace viewcell {
namespace {

constexpr double kBulge = 0.02;           // of a square's half side
constexpr double kLeastEdgeShare = 0.05;  // of the mean boundary edge
constexpr double kMostRatio = 1e6;        // of stretch in one step
constexpr double kLeastTan = 1e-4;        // of half an angle; the most is its inverse

// ---- boundary ----

// Where each vertex of the loop stands, as a share [0, 1) of the way around.
std::vector<double> measure_shares(const TriMesh& mesh, const std::vector<std::uint32_t>& loop) {
  std::vector<double> lengths;
  for (std::size_t i = 0; i < loop.size(); ++i)
    lengths.push_back(glm::distance(glm::dvec3(mesh.positions[loop[i]]),
                                    glm::dvec3(mesh.positions[loop[(i + 1) % loop.size()]])));
  const double mean =
      std::accumulate(lengths.begin(), lengths.end(), 0.0) / static_cast<double>(lengths.size());
  for (double& length : lengths) length = mean > 0 ? std::max(length, kLeastEdgeShare * mean) : 1;
  const double total = std::accumulate(lengths.begin(), lengths.end(), 0.0);
  std::vector<double> shares;
  double way = 0;
  for (const double length : lengths) {
    shares.push_back(way / total);
    way += length;
  }
  return shares;
}

glm::dvec2 place_on_circle(double share) {
  return {std::cos(2 * std::numbers::pi * share), std::sin(2 * std::numbers::pi * share)};
}

// From the lower left corner on. A side is a parabola, so that the curve is strictly convex.
glm::dvec2 place_on_square(double share) {
  const int side = std::min(3, static_cast<int>(4 * share));
  const double s = 2 * (4 * share - side) - 1;
  const double along = (1 - kBulge) * s, out = 1 - kBulge * s * s;
  switch (side) {
    case 0:
      return {along, -out};
    case 1:
      return {out, along};
    case 2:
      return {-along, out};
    default:
      return {-out, -along};
  }
}

// ---- weights ----

struct Weight {
  std::uint32_t of, neighbour;
  double value;
};

// Several of one pair of vertices count together.
std::vector<Weight> make_mean_value_weights(const TriMesh& mesh) {
  std::vector<Weight> out;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t i = t[k], a = t[(k + 1) % 3], b = t[(k + 2) % 3];
      const glm::dvec3 here(mesh.positions[i]);
      const glm::dvec3 to_a = glm::dvec3(mesh.positions[a]) - here;
      const glm::dvec3 to_b = glm::dvec3(mesh.positions[b]) - here;
      const double l_a = glm::length(to_a), l_b = glm::length(to_b);
      VIEWCELL_CHECK(l_a > 0 && l_b > 0, "equal positions around vertex", i);
      const double tan_half =
          glm::length(glm::cross(to_a, to_b)) / std::max(1e-300, l_a * l_b + glm::dot(to_a, to_b));
      const double clamped = std::clamp(tan_half, kLeastTan, 1 / kLeastTan);
      out.push_back({i, a, clamped / l_a});
      out.push_back({i, b, clamped / l_b});
    }
  return out;
}

std::vector<Weight> make_uniform_weights(const TriMesh& mesh) {
  std::vector<Weight> out;
  const EdgeTable edges = build_edge_table(mesh);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto [a, b] = edges.ends(e, mesh);
    out.push_back({a, b, 1});
    out.push_back({b, a, 1});
  }
  return out;
}

// ---- solving ----

// Solves for the inner vertices; uv holds the boundary's.
class Solver {
 public:
  Solver(std::size_t n_vertices, const std::vector<std::uint32_t>& loop) : row_(n_vertices, 0) {
    for (const std::uint32_t v : loop) row_[v] = kFixed;
    for (std::uint32_t v = 0; v < n_vertices; ++v)
      if (row_[v] != kFixed) row_[v] = n_rows_++;
  }

  /// False when the weights differ by more than doubles can tell.
  bool solve(const std::vector<Weight>& weights, std::vector<glm::dvec2>& uv) {
    if (n_rows_ == 0) return true;
    std::vector<double> sums(row_.size(), 0.0);
    for (const Weight& w : weights) sums[w.of] += w.value;
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(n_rows_, 2);
    for (const Weight& w : weights) {
      const int i = row_[w.of], j = row_[w.neighbour];
      if (i == kFixed) continue;
      const double share = w.value / sums[w.of];
      if (j != kFixed)
        entries.emplace_back(i, j, -share);
      else
        right.row(i) += share * Eigen::RowVector2d(uv[w.neighbour].x, uv[w.neighbour].y);
    }
    for (int i = 0; i < n_rows_; ++i) entries.emplace_back(i, i, 1.0);
    if (!factorise(entries)) return false;
    const Eigen::MatrixX2d solution = lu_.solve(right);
    for (std::size_t v = 0; v < row_.size(); ++v)
      if (row_[v] != kFixed) uv[v] = {solution(row_[v], 0), solution(row_[v], 1)};
    return true;
  }

 private:
  static constexpr int kFixed = -1;

  bool factorise(const std::vector<Eigen::Triplet<double>>& entries) {
    Eigen::SparseMatrix<double> matrix(n_rows_, n_rows_);
    matrix.setFromTriplets(entries.begin(), entries.end());
    lu_.compute(matrix);
    return lu_.info() == Eigen::Success;
  }

  std::vector<int> row_;  // per vertex: its row, or kFixed
  int n_rows_ = 0;
  Eigen::SparseLU<Eigen::SparseMatrix<double>> lu_;
};

// ---- relaxing ----

struct Quality {
  std::size_t n_flipped = 0;
  double l2 = 0;               // stretch over the mesh, up to a factor that the boundary fixes
  std::vector<double> around;  // per vertex: L2 stretch over its triangles; finite

  bool is_better_than(const Quality& other) const {
    return std::tie(n_flipped, l2) < std::tie(other.n_flipped, other.l2);
  }
};

// What has no area in the plane has infinite stretch; it counts as kMostRatio times the least.
void bound(std::vector<double>& stretch) {
  const double least = *std::min_element(stretch.begin(), stretch.end());
  for (double& s : stretch) s = std::min(s, kMostRatio * least);
}

Quality measure_quality(const TriMesh& mesh, const std::vector<glm::dvec2>& uv) {
  Quality out;
  out.around.assign(mesh.positions.size(), 0);
  std::vector<double> areas(mesh.positions.size(), 0);
  double sum = 0, area = 0;
  for (const Triangle& t : mesh.triangles) {
    out.n_flipped += !(twice_area(uv[t[0]], uv[t[1]], uv[t[2]]) > 0);
    const double here = glm::length(area_normal(mesh, t));
    if (!(here > 0)) continue;
    std::array<glm::dvec3, 3> at;
    std::array<glm::dvec2, 3> plane;
    for (std::size_t k = 0; k < 3; ++k) at[k] = mesh.positions[t[k]], plane[k] = uv[t[k]];
    const double l2 = measure_triangle_stretch(at, plane).l2;
    sum += here * l2 * l2;
    area += here;
    for (const std::uint32_t v : t) out.around[v] += here * l2 * l2, areas[v] += here;
  }
  out.l2 = area > 0 ? std::sqrt(sum / area) : 0;
  for (std::size_t v = 0; v < areas.size(); ++v)
    out.around[v] = areas[v] > 0 ? std::sqrt(out.around[v] / areas[v]) : out.l2;
  bound(out.around);
  return out;
}

// Divides by the stretch around the neighbour; each vertex' weights are scaled to the sum 1.
void weaken(const std::vector<double>& stretch, std::vector<Weight>& weights) {
  std::vector<double> sums(stretch.size(), 0);
  for (Weight& w : weights) sums[w.of] += w.value /= stretch[w.neighbour];
  for (Weight& w : weights) w.value /= sums[w.of];
}

void relax(const TriMesh& mesh, Solver& solver, std::vector<Weight>& weights, int n_steps,
           std::vector<glm::dvec2>& uv) {
  Quality quality = measure_quality(mesh, uv);
  for (int step = 0; step < n_steps && quality.l2 > 0; ++step) {
    weaken(quality.around, weights);
    std::vector<glm::dvec2> next = uv;
    if (!solver.solve(weights, next)) return;
    Quality next_quality = measure_quality(mesh, next);
    if (!next_quality.is_better_than(quality)) return;
    uv = std::move(next);
    quality = std::move(next_quality);
  }
}

}  // namespace

std::vector<glm::dvec2> place_boundary(const TriMesh& mesh, const std::vector<std::uint32_t>& loop,
                                       UvBoundary boundary) {
  std::vector<glm::dvec2> out;
  for (const double share : measure_shares(mesh, loop))
    out.push_back(boundary == UvBoundary::circle ? place_on_circle(share) : place_on_square(share));
  return out;
}

std::vector<glm::dvec2> solve_interior(const TriMesh& mesh, const std::vector<std::uint32_t>& loop,
                                       const std::vector<glm::dvec2>& positions,
                                       const ParameterizeOptions& options) {
  VIEWCELL_CHECK(loop.size() == positions.size(), loop.size(), positions.size());
  std::vector<glm::dvec2> uv(mesh.positions.size(), glm::dvec2(0));
  for (std::size_t i = 0; i < loop.size(); ++i) uv[loop[i]] = positions[i];
  std::vector<Weight> weights = options.weights == UvWeights::uniform
                                    ? make_uniform_weights(mesh)
                                    : make_mean_value_weights(mesh);
  Solver solver(mesh.positions.size(), loop);
  const bool is_solved = solver.solve(weights, uv);
  VIEWCELL_CHECK(is_solved, "weights without a solution, of vertices:", mesh.positions.size());
  relax(mesh, solver, weights, options.relax_steps, uv);
  return uv;
}

std::vector<glm::dvec2> parameterize_disk(const TriMesh& mesh,
                                          const std::vector<std::uint32_t>& loop,
                                          const ParameterizeOptions& options) {
  std::vector<glm::dvec2> uv =
      solve_interior(mesh, loop, place_boundary(mesh, loop, options.boundary), options);
  for (glm::dvec2& p : uv) p = 0.5 + (0.5 - kUvMargin) * p;
  return uv;
}

void set_texcoords(TriMesh& mesh, const std::vector<glm::dvec2>& uv) {
  mesh.texcoords.clear();
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) mesh.texcoords.emplace_back(uv[v]);
}

}  // namespace viewcell
