// A disk stays a disk when the triangle joined to it meets it in one run of edges: by one edge with
// the opposite corner outside, or by two edges. The order of joining is that of the sublevel sets
// of distance with their holes filled, found backwards: the level at which a triangle is no longer
// connected to what lies outside is the widest bottleneck of distance on its ways there.
#include "uv/patch.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>

#include "base/error.h"
#include "mesh/edges.h"
#include "mesh/half_edge_mesh.h"
#include "mesh/topology.h"
#include "mesh/used_vertices.h"

namespace viewcell {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// ---- distances ----

// Along edges, from one vertex; infinity where no edge leads.
std::vector<double> measure_distances(const TriMesh& mesh, const EdgeTable& edges,
                                      std::uint32_t around) {
  std::vector<std::vector<std::uint32_t>> neighbours(mesh.positions.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto [a, b] = edges.ends(e, mesh);
    neighbours[a].push_back(b);
    neighbours[b].push_back(a);
  }
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  std::vector<double> distance(mesh.positions.size(), kInfinity);
  queue.push({distance[around] = 0, around});
  while (!queue.empty()) {
    const auto [d, v] = queue.top();
    queue.pop();
    if (d > distance[v]) continue;
    for (const std::uint32_t w : neighbours[v]) {
      const double through =
          d + glm::distance(glm::dvec3(mesh.positions[v]), glm::dvec3(mesh.positions[w]));
      if (through < distance[w]) queue.push({distance[w] = through, w});
    }
  }
  return distance;
}

// A triangle is as far as its farthest corner.
std::vector<double> measure_faces(const TriMesh& mesh, const std::vector<double>& of_vertex) {
  std::vector<double> out;
  for (const Triangle& t : mesh.triangles)
    out.push_back(std::max({of_vertex[t[0]], of_vertex[t[1]], of_vertex[t[2]]}));
  return out;
}

// ---- order ----

// visit(other) for each triangle across an edge of the triangle.
template <typename Visit>
void for_each_neighbour(const EdgeTable& edges, std::uint32_t face, const Visit& visit) {
  for (std::uint32_t k = 0; k < 3; ++k)
    for (const std::uint32_t half : edges.halves(edges.edge_of[3 * face + k]))
      if (half / 3 != face) visit(half / 3);
}

std::vector<std::uint32_t> find_component(const EdgeTable& edges, std::uint32_t first,
                                          std::size_t n_faces) {
  std::vector<bool> is_found(n_faces, false);
  std::vector<std::uint32_t> found{first};
  is_found[first] = true;
  for (std::size_t i = 0; i < found.size(); ++i)
    for_each_neighbour(edges, found[i], [&](std::uint32_t other) {
      if (is_found[other]) return;
      is_found[other] = true;
      found.push_back(other);
    });
  return found;
}

bool is_at_border(const EdgeTable& edges, std::uint32_t face) {
  for (std::uint32_t k = 0; k < 3; ++k)
    if (edges.halves(edges.edge_of[3 * face + k]).size() == 1) return true;
  return false;
}

// Per triangle: the level at which the growing set takes it in or encloses it. Outside is what is
// connected to the farthest triangle or to an end of the surface.
std::vector<double> measure_levels(const EdgeTable& edges, const std::vector<double>& distance,
                                   const std::vector<std::uint32_t>& component) {
  std::vector<double> level(distance.size(), -1);
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry> queue;
  const auto farthest =
      *std::max_element(component.begin(), component.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::tie(distance[a], a) < std::tie(distance[b], b);
      });
  for (const std::uint32_t face : component)
    if (face == farthest || is_at_border(edges, face)) queue.push({distance[face], face});
  while (!queue.empty()) {
    const double d = queue.top().first;  // no binding: clang 14 does not capture those
    const std::uint32_t face = queue.top().second;
    queue.pop();
    if (level[face] >= 0) continue;
    level[face] = d;
    for_each_neighbour(edges, face, [&](std::uint32_t other) {
      if (level[other] < 0) queue.push({std::min(d, distance[other]), other});
    });
  }
  return level;
}

// ---- growing ----

// True when the disk with the triangle is a disk.
bool is_joinable(const HalfEdgeMesh& disk, const Triangle& t) {
  int n_shared = 0;
  std::uint32_t opposite = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const EdgeSide side = disk.side(t[k], t[(k + 1) % 3]);
    if (side == EdgeSide::taken) return false;
    if (side == EdgeSide::absent) continue;
    ++n_shared;
    opposite = t[(k + 2) % 3];
  }
  return n_shared == 2 || (n_shared == 1 && !disk.has_vertex(opposite));
}

std::vector<std::uint32_t> grow_disk(const TriMesh& mesh, const EdgeTable& edges,
                                     std::uint32_t first, std::size_t n_faces,
                                     const std::vector<double>& level,
                                     const std::vector<double>& distance) {
  HalfEdgeMesh disk(mesh.positions.size());
  using Entry = std::tuple<double, double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  enum State : std::uint8_t { kOut, kQueued, kIn };
  std::vector<State> state(mesh.triangles.size(), kOut);
  const auto join = [&](std::uint32_t face) {
    const bool is_joined = disk.add(face, mesh.triangles[face]);
    VIEWCELL_CHECK(is_joined, "triangle", face);
    state[face] = kIn;
    for_each_neighbour(edges, face, [&](std::uint32_t other) {
      if (state[other] != kOut) return;
      state[other] = kQueued;
      queue.push({level[other], distance[other], other});
    });
  };
  join(first);
  while (!queue.empty() && disk.taken().size() < n_faces) {
    const std::uint32_t face = std::get<2>(queue.top());
    queue.pop();
    state[face] = kOut;  // a refused one is looked at again when the disk gets to its other edges
    if (is_joinable(disk, mesh.triangles[face])) join(face);
  }
  return disk.taken();
}

// ---- the result ----

// The mesh with vertices at one position made one. Triangles that lose a corner stay, unused.
TriMesh weld(const TriMesh& mesh, const std::vector<std::uint32_t>& first) {
  TriMesh out;
  out.positions = mesh.positions;
  out.offset = mesh.offset;
  for (Triangle t : mesh.triangles) {
    for (std::uint32_t& v : t) v = first[v];
    out.triangles.push_back(t);
  }
  if (mesh.normals.empty()) {
    out.normals = make_vertex_normals(out);
    return out;
  }
  std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0));
  for (std::size_t v = 0; v < first.size(); ++v) sums[first[v]] += glm::dvec3(mesh.normals[v]);
  for (std::size_t v = 0; v < first.size(); ++v) {
    const double length = glm::length(sums[v]);
    out.normals.push_back(length > 0 ? glm::vec3(sums[v] / length) : mesh.normals[v]);
  }
  return out;
}

Patch gather(const TriMesh& mesh, std::vector<std::uint32_t> faces) {
  Patch out;
  std::sort(faces.begin(), faces.end());
  std::vector<Triangle> triangles;
  for (const std::uint32_t face : faces) triangles.push_back(mesh.triangles[face]);
  CompactMesh disk = compact(mesh, triangles);
  out.mesh = std::move(disk.mesh);
  out.source_vertex = std::move(disk.source_vertex);
  out.source_triangle = std::move(faces);
  return out;
}

// Per vertex: whether a triangle of three positions has a corner at its place.
std::vector<bool> find_starts(const TriMesh& mesh, const std::vector<std::uint32_t>& first) {
  std::vector<bool> is_start(first.size(), false);
  for (const Triangle& t : mesh.triangles) {
    const Triangle w = {first[t[0]], first[t[1]], first[t[2]]};
    if (w[0] == w[1] || w[1] == w[2] || w[2] == w[0]) continue;
    for (const std::uint32_t v : w) is_start[v] = true;
  }
  for (std::size_t v = 0; v < first.size(); ++v) is_start[v] = is_start[first[v]];
  return is_start;
}

}  // namespace

bool is_patch_start(const TriMesh& mesh, std::uint32_t vertex) {
  return vertex < mesh.positions.size() && find_starts(mesh, match_positions(mesh))[vertex];
}

std::optional<std::uint32_t> find_top_vertex(const TriMesh& mesh, const glm::dvec3& up) {
  const std::vector<bool> is_start = find_starts(mesh, match_positions(mesh));
  std::optional<std::uint32_t> top;
  double highest = -kInfinity;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    const double height = glm::dot(up, glm::dvec3(mesh.positions[v]));
    if (!is_start[v] || !(height > highest)) continue;
    top = v;
    highest = height;
  }
  return top;
}

Patch cut_patch(const TriMesh& input, std::uint32_t around, std::size_t n_faces) {
  const std::vector<std::uint32_t> first_at = match_positions(input);
  const TriMesh mesh = weld(input, first_at);
  const EdgeTable edges = build_edge_table(mesh);
  const std::vector<double> distance =
      measure_faces(mesh, measure_distances(mesh, edges, first_at.at(around)));
  std::uint32_t first = kNoEdge;
  for (std::uint32_t face = 0; face < mesh.triangles.size(); ++face)
    if (std::count(mesh.triangles[face].begin(), mesh.triangles[face].end(), first_at[around]) &&
        edges.edge_of[3 * face] != kNoEdge &&
        (first == kNoEdge || distance[face] < distance[first]))
      first = face;
  VIEWCELL_CHECK(first != kNoEdge, "no triangle at vertex", around);

  const std::vector<std::uint32_t> component = find_component(edges, first, mesh.triangles.size());
  const std::vector<double> level = measure_levels(edges, distance, component);
  Patch patch = gather(mesh, grow_disk(mesh, edges, first, n_faces, level, distance));
  patch.n_component_faces = component.size();
  return patch;
}

std::vector<std::uint32_t> find_boundary_loop(const TriMesh& mesh) {
  const HalfEdgeMesh half_edges(mesh);
  VIEWCELL_CHECK(half_edges.refused().empty(), "no manifold at triangle", half_edges.refused()[0]);
  std::vector<std::vector<std::uint32_t>> loops = half_edges.boundary_loops();
  VIEWCELL_CHECK(loops.size() == 1, "boundary loops:", loops.size());
  std::vector<std::uint32_t> once = loops[0];
  std::sort(once.begin(), once.end());
  const auto twice = std::adjacent_find(once.begin(), once.end());
  VIEWCELL_CHECK(twice == once.end(), "the boundary passes twice vertex", *twice);
  return std::move(loops[0]);
}

}  // namespace viewcell
