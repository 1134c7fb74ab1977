#include "mesh/topology.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <tuple>

#include "base/buckets.h"
#include "base/disjoint_sets.h"

namespace viewcell {
namespace {

bool repeats_index(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

// ---- edges ----

// A half-edge, in the bucket of its lower vertex.
struct HalfEdge {
  std::uint32_t higher;
  bool is_upward;  // from the lower vertex to the higher
};

void measure_edges(const TriMesh& mesh, MeshTopology& out) {
  auto buckets = fill_buckets<HalfEdge>(mesh.positions.size(), [&](const auto& emit) {
    for (const Triangle& t : mesh.triangles)
      for (std::size_t k = 0; k < 3 && !repeats_index(t); ++k) {
        const std::uint32_t a = t[k], b = t[(k + 1) % 3];
        emit(std::min(a, b), HalfEdge{std::max(a, b), a < b});
      }
  });
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const std::span<HalfEdge> halves = buckets.of(v);
    std::sort(halves.begin(), halves.end(),
              [](const HalfEdge& a, const HalfEdge& b) { return a.higher < b.higher; });
    for (auto first = halves.begin(); first != halves.end();) {
      auto last = first;
      std::size_t n_upward = 0;
      for (; last != halves.end() && last->higher == first->higher; ++last)
        n_upward += last->is_upward;
      ++out.n_edges;
      if (last - first == 1) ++out.n_boundary_edges;
      if (last - first == 2 && n_upward != 1) ++out.n_opposed_edges;
      if (last - first > 2) ++out.n_nonmanifold_edges;
      first = last;
    }
  }
}

// ---- vertices ----

// The edge opposite to a vertex in one of its triangles.
struct LinkEdge {
  std::uint32_t from, to;
};

// True when the edges form one open path or one cycle.
bool is_path_or_cycle(std::span<const LinkEdge> link) {
  std::vector<std::uint32_t> names;
  for (const LinkEdge& e : link) names.push_back(e.from), names.push_back(e.to);
  std::sort(names.begin(), names.end());
  for (std::size_t i = 2; i < names.size(); ++i)
    if (names[i] == names[i - 2]) return false;  // three edges meet
  names.erase(std::unique(names.begin(), names.end()), names.end());
  const auto place = [&names](std::uint32_t name) {
    return static_cast<std::uint32_t>(std::lower_bound(names.begin(), names.end(), name) -
                                      names.begin());
  };
  DisjointSets sets(names.size());
  std::size_t n_sets = names.size();
  for (const LinkEdge& e : link) n_sets -= sets.join(place(e.from), place(e.to));
  return n_sets == 1;
}

void measure_vertices(const TriMesh& mesh, MeshTopology& out) {
  auto links = fill_buckets<LinkEdge>(mesh.positions.size(), [&](const auto& emit) {
    for (const Triangle& t : mesh.triangles)
      for (std::size_t k = 0; k < 3 && !repeats_index(t); ++k)
        emit(t[k], LinkEdge{t[(k + 1) % 3], t[(k + 2) % 3]});
  });
  DisjointSets components(mesh.positions.size());
  std::size_t n_referenced = 0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const std::span<const LinkEdge> link = links.of(v);
    if (link.empty()) {
      ++out.n_unreferenced_vertices;
      continue;
    }
    ++n_referenced;
    ++out.n_components;
    if (!is_path_or_cycle(link)) ++out.n_nonmanifold_vertices;
  }
  std::size_t n_triangles = 0;
  for (const Triangle& t : mesh.triangles) {
    if (repeats_index(t)) continue;
    ++n_triangles;
    out.n_components -= components.join(t[0], t[1]);
    out.n_components -= components.join(t[0], t[2]);
  }
  out.euler_characteristic = static_cast<std::int64_t>(n_referenced + n_triangles) -
                             static_cast<std::int64_t>(out.n_edges);
}

// ---- cleaning ----

// Marks triangles that have the same vertices in the same turn as an earlier one.
std::vector<bool> find_duplicates(const TriMesh& mesh) {
  struct Row {
    std::uint32_t second, third, triangle;
  };
  auto buckets = fill_buckets<Row>(mesh.positions.size(), [&](const auto& emit) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const Triangle& v = mesh.triangles[t];
      const auto least = static_cast<std::size_t>(std::min_element(v.begin(), v.end()) - v.begin());
      emit(v[least], Row{v[(least + 1) % 3], v[(least + 2) % 3], t});
    }
  });
  std::vector<bool> is_duplicate(mesh.triangles.size(), false);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const std::span<Row> rows = buckets.of(v);
    std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
      return std::tie(a.second, a.third, a.triangle) < std::tie(b.second, b.third, b.triangle);
    });
    for (std::size_t i = 1; i < rows.size(); ++i)
      if (rows[i].second == rows[i - 1].second && rows[i].third == rows[i - 1].third)
        is_duplicate[rows[i].triangle] = true;
  }
  return is_duplicate;
}

// Keeps what stays, in order; per_triangle values stand together.
template <typename T>
void compact(std::vector<T>& values, std::size_t per_triangle, const std::vector<bool>& stays) {
  if (values.empty()) return;
  std::size_t n = 0;
  for (std::size_t t = 0; t < stays.size(); ++t)
    for (std::size_t k = 0; k < per_triangle && stays[t]; ++k)
      values[n++] = values[t * per_triangle + k];
  values.resize(n);
}

}  // namespace

MeshTopology measure_topology(const TriMesh& mesh) {
  MeshTopology out;
  measure_edges(mesh, out);
  measure_vertices(mesh, out);
  return out;
}

std::vector<std::uint32_t> match_positions(const TriMesh& mesh) {
  const std::vector<glm::vec3>& at = mesh.positions;
  std::vector<std::uint32_t> order(at.size()), first(at.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&at](std::uint32_t a, std::uint32_t b) {
    return std::tie(at[a].x, at[a].y, at[a].z, a) < std::tie(at[b].x, at[b].y, at[b].z, b);
  });
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && at[order[i]] == at[order[i - 1]] ? first[order[i - 1]] : order[i];
  return first;
}

std::vector<std::uint32_t> match_twins(std::span<const Triangle> triangles,
                                       std::size_t n_vertices) {
  struct Row {
    std::uint32_t lower, higher;  // of the vertices other than the least
    bool turns_back;
    std::uint32_t triangle;
    auto key() const { return std::tie(lower, higher, turns_back, triangle); }
  };
  auto buckets = fill_buckets<Row>(n_vertices, [&](const auto& emit) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      const Triangle& v = triangles[t];
      if (repeats_index(v)) continue;
      const auto least = static_cast<std::size_t>(std::min_element(v.begin(), v.end()) - v.begin());
      const std::uint32_t second = v[(least + 1) % 3], third = v[(least + 2) % 3];
      emit(v[least], Row{std::min(second, third), std::max(second, third), second > third, t});
    }
  });
  std::vector<std::uint32_t> twins;
  for (std::size_t v = 0; v < n_vertices; ++v) {
    const std::span<Row> rows = buckets.of(v);
    std::sort(rows.begin(), rows.end(),
              [](const Row& a, const Row& b) { return a.key() < b.key(); });
    for (std::size_t first = 0, last; first < rows.size(); first = last) {
      std::size_t turned = first;  // the first that turns back
      for (last = first; last < rows.size() && rows[last].lower == rows[first].lower &&
                         rows[last].higher == rows[first].higher;
           ++last)
        turned += !rows[last].turns_back;
      const std::size_t n = std::min(turned - first, last - turned);
      if (n > 0 && twins.empty()) twins.assign(triangles.size(), kNoTwin);
      for (std::size_t i = 0; i < n; ++i) {
        twins[rows[first + i].triangle] = rows[turned + i].triangle;
        twins[rows[turned + i].triangle] = rows[first + i].triangle;
      }
    }
  }
  return twins;
}

MeshDefects clean_mesh(TriMesh& mesh) {
  MeshDefects defects;
  const std::vector<bool> is_duplicate = find_duplicates(mesh);
  std::vector<bool> stays(mesh.triangles.size(), false);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (repeats_index(mesh.triangles[t]))
      ++defects.n_repeated_index;
    else if (!(glm::length(area_normal(mesh, mesh.triangles[t])) > 0))
      ++defects.n_zero_area;
    else if (is_duplicate[t])
      ++defects.n_duplicates;
    else
      stays[t] = true;
  }
  compact(mesh.triangles, 1, stays);
  compact(mesh.texcoords, 3, stays);
  compact(mesh.materials, 1, stays);
  defects.topology = measure_topology(mesh);
  return defects;
}

}  // namespace viewcell
