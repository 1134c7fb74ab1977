#include "mesh/weld.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "mesh/topology.h"
#include "mesh/used_vertices.h"

namespace viewcell {
namespace {

// Vertices with shorter edges than this share of the tolerance asks for are not welded beyond equal
// positions: then there are few sizes of cells to look through.
constexpr double kLeastReach = 1.0 / 1024;

std::uint64_t hash_number(std::uint64_t x) {
  x = (x ^ (x >> 32)) * 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 29)) * 0xbf58476d1ce4e5b9ull;
  return x ^ (x >> 32);
}

// Whether edges that run out of a vertex do not all run back into it: where edges have one triangle
// each, or two that are wound unlike. Told by sums of hashes, in which opposite edges cancel.
std::vector<bool> find_border_vertices(std::span<const Triangle> triangles,
                                       const std::vector<std::uint32_t>& of) {
  std::vector<std::uint64_t> sums(of.size(), 0), hashes(of.size());
  for (std::size_t v = 0; v < of.size(); ++v) hashes[v] = hash_number(v);
  for (const Triangle& t : triangles) {
    const std::uint32_t a = of[t[0]], b = of[t[1]], c = of[t[2]];
    if (a == b || b == c || c == a) continue;
    sums[a] += hashes[b] - hashes[c];
    sums[b] += hashes[c] - hashes[a];
    sums[c] += hashes[a] - hashes[b];
  }
  std::vector<bool> out(of.size(), false);
  for (std::size_t v = 0; v < sums.size(); ++v) out[v] = sums[v] != 0;
  return out;
}

// Per border vertex how far it may be welded; 0 for others.
std::vector<double> find_reaches(std::span<const glm::vec3> positions,
                                 std::span<const Triangle> triangles, const WeldOptions& options,
                                 const std::vector<std::uint32_t>& of,
                                 const std::vector<bool>& is_border) {
  std::vector<double> shortest2(of.size(), std::numeric_limits<double>::infinity());
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = of[t[k]], b = of[t[(k + 1) % 3]];
      if (a == b || (!is_border[a] && !is_border[b])) continue;
      const glm::dvec3 edge = glm::dvec3(positions[a]) - glm::dvec3(positions[b]);
      const double length2 = glm::dot(edge, edge);
      shortest2[a] = std::min(shortest2[a], length2);
      shortest2[b] = std::min(shortest2[b], length2);
    }
  std::vector<double> reaches(of.size(), 0);
  for (std::size_t v = 0; v < of.size(); ++v) {
    if (!is_border[v]) continue;
    const double reach =
        std::min(options.tolerance, options.most_of_edge * std::sqrt(shortest2[v]));
    reaches[v] = reach >= kLeastReach * options.tolerance ? reach : 0;
  }
  return reaches;
}

// The vertices that others may be welded to, by cells of space. A vertex of reach r is in cells of
// 2^(level + 1), 2^level the next power of two above r: those are far enough apart that a cell
// holds few, and what is within r of a point is in eight cells at most.
class WeldCells {
 public:
  WeldCells(std::span<const glm::vec3> positions, const std::vector<double>& reaches)
      : positions_(positions), reaches_(reaches), next_(positions.size(), kNone) {
    std::size_t n = 0;
    for (std::size_t v = 0; v < reaches.size(); ++v) {
      if (!(reaches[v] > 0)) continue;
      ++n;
      origin_ = glm::min(origin_, glm::dvec3(positions[v]));
      const int level = level_of(reaches[v]);
      if (std::find(levels_.begin(), levels_.end(), level) == levels_.end())
        levels_.push_back(level);
    }
    heads_.assign(std::bit_ceil(2 * n + 1), kNone);
  }

  /// The nearest vertex that v may be welded to, the lowest of several; or kNone.
  std::uint32_t find(std::uint32_t v) const {
    const glm::dvec3 at = glm::dvec3(positions_[v]) - origin_;
    std::uint32_t best = kNone;
    double best2 = std::numeric_limits<double>::infinity();
    for (const int level : levels_) {
      const double reach = std::min(reaches_[v], std::ldexp(1.0, level));
      const Cell lo = cell_at(at - reach, level), hi = cell_at(at + reach, level);
      for (std::int64_t x = lo.x; x <= hi.x; ++x)
        for (std::int64_t y = lo.y; y <= hi.y; ++y)
          for (std::int64_t z = lo.z; z <= hi.z; ++z)
            for (std::uint32_t w = heads_[slot({x, y, z}, level)]; w != kNone; w = next_[w]) {
              const glm::dvec3 off = at - (glm::dvec3(positions_[w]) - origin_);
              const double most = std::min(reaches_[v], reaches_[w]), off2 = glm::dot(off, off);
              if (off2 <= most * most && (off2 < best2 || (off2 == best2 && w < best)))
                best = w, best2 = off2;
            }
    }
    return best;
  }
  void add(std::uint32_t v) {
    const int level = level_of(reaches_[v]);
    std::uint32_t& head = heads_[slot(cell_at(glm::dvec3(positions_[v]) - origin_, level), level)];
    next_[v] = std::exchange(head, v);
  }

  static constexpr std::uint32_t kNone = 0xffffffffu;

 private:
  struct Cell {
    std::int64_t x, y, z;
  };
  static int level_of(double reach) { return std::ilogb(reach) + 1; }
  static Cell cell_at(const glm::dvec3& p, int level) {
    const glm::dvec3 q = glm::floor(p * std::ldexp(1.0, -level - 1));
    return {static_cast<std::int64_t>(q.x), static_cast<std::int64_t>(q.y),
            static_cast<std::int64_t>(q.z)};
  }
  std::size_t slot(const Cell& cell, int level) const {
    std::uint64_t h = hash_number(static_cast<std::uint64_t>(cell.x) + 0x100000001ull);
    h = hash_number(h + static_cast<std::uint64_t>(cell.y));
    h = hash_number(h + static_cast<std::uint64_t>(cell.z));
    return hash_number(h + static_cast<std::uint64_t>(level)) & (heads_.size() - 1);
  }

  std::span<const glm::vec3> positions_;
  const std::vector<double>& reaches_;
  glm::dvec3 origin_{1e300};
  std::vector<int> levels_;
  std::vector<std::uint32_t> heads_, next_;
};

}  // namespace

double default_weld_tolerance(const TriMesh& mesh) {
  return mesh.triangles.empty() ? 0 : kWeldShare * glm::length(surface_box(mesh).size());
}

BorderWeld weld_borders(std::span<const glm::vec3> positions, std::span<const Triangle> triangles,
                        const WeldOptions& options, std::vector<std::uint32_t>& of) {
  BorderWeld out;
  if (!(options.tolerance > 0)) return out;
  const std::vector<bool> is_border = find_border_vertices(triangles, of);
  if (std::find(is_border.begin(), is_border.end(), true) == is_border.end()) return out;
  const std::vector<double> reaches = find_reaches(positions, triangles, options, of, is_border);
  WeldCells cells(positions, reaches);
  for (std::uint32_t v = 0; v < of.size(); ++v) {
    if (of[v] != v) {
      of[v] = of[of[v]];  // what it is at the place of comes before it
    } else if (reaches[v] > 0) {
      const std::uint32_t w = cells.find(v);
      if (w == WeldCells::kNone) {
        cells.add(v);
        continue;
      }
      of[v] = w;
    } else {
      continue;
    }
    if (positions[of[v]] == positions[v]) continue;
    ++out.n_welded;
    out.gap =
        std::max(out.gap, glm::distance(glm::dvec3(positions[v]), glm::dvec3(positions[of[v]])));
  }
  return out;
}

BorderWeld close_cracks(TriMesh& mesh) {
  std::vector<std::uint32_t> of = match_positions(mesh);
  const BorderWeld out =
      weld_borders(mesh.positions, mesh.triangles, {.tolerance = default_weld_tolerance(mesh)}, of);
  if (out.n_welded > 0)
    for (std::size_t v = 0; v < of.size(); ++v) mesh.positions[v] = mesh.positions[of[v]];
  return out;
}

std::vector<std::uint32_t> weld_vertices(const TriMesh& mesh, const WeldOptions& options) {
  std::vector<std::uint32_t> of = match_positions(mesh);
  weld_borders(mesh.positions, mesh.triangles, options, of);
  return of;
}

}  // namespace viewcell
