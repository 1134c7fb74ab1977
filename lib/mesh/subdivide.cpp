// Follows: [Loop 1987] with Warren's weights; on creases the cubic B-spline of [Hoppe et al. 1994].
// Differs: there, a vertex with one crease (a dart) is smooth; here it stays, for a single crease
// comes only from edges of more than two triangles.
// Not by OpenMesh's LoopT: it cannot hold such edges, has Loop's weights in a table that ends at 49
// edges a vertex, does not say which triangle a triangle came from, and takes n^2 steps for a fan.
#include "mesh/subdivide.h"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "mesh/edges.h"
#include "mesh/topology.h"
#include "mesh/used_vertices.h"

namespace viewcell {
namespace {

// Values on a topology of their own: positions are joined across the seams of charts, texture
// coordinates are not.
struct Layer {
  std::vector<Triangle> triangles;
  std::vector<glm::dvec3> values;
};

enum class Rule { smooth, fixed_creases, linear };

//        c              1
//       / \            / \          New vertices: on edges from 3 3 and 1 1 eighths, at vertices
//      a---b    edge  3---3         from the ring around them. On a crease: from the middle, and
//       \ /            \ /          from 1 6 1 eighths along it.
//        d              1
glm::dvec3 edge_point(const Layer& layer, const EdgeTable& edges, std::size_t edge, Rule rule) {
  const auto halves = edges.halves(edge);
  const auto corner = [&](std::uint32_t half, std::uint32_t k) {
    return layer.values[layer.triangles[half / 3][(half + k) % 3]];
  };
  const glm::dvec3 a = corner(halves[0], 0), b = corner(halves[0], 1);
  if (rule == Rule::linear || halves.size() != 2) return 0.5 * (a + b);
  return 0.375 * (a + b) + 0.125 * (corner(halves[0], 2) + corner(halves[1], 2));
}

// Sums over the edges at each vertex.
struct Ring {
  glm::dvec3 all{0}, creases{0};
  std::uint32_t n = 0, n_creases = 0;
};

std::vector<Ring> sum_rings(const Layer& layer, const EdgeTable& edges, const TriMesh& view) {
  std::vector<Ring> rings(layer.values.size());
  const auto add = [&](std::uint32_t at, std::uint32_t other, bool is_crease) {
    Ring& ring = rings[at];
    ring.all += layer.values[other], ++ring.n;
    if (is_crease) ring.creases += layer.values[other], ++ring.n_creases;
  };
  for (std::size_t edge = 0; edge < edges.size(); ++edge) {
    const auto [a, b] = edges.ends(edge, view);
    const bool is_crease = edges.halves(edge).size() != 2;
    add(a, b, is_crease), add(b, a, is_crease);
  }
  return rings;
}

glm::dvec3 vertex_point(const glm::dvec3& value, const Ring& ring, Rule rule) {
  if (ring.n_creases == 0) {
    const double beta = ring.n > 3 ? 3.0 / (8.0 * ring.n) : 3.0 / 16.0;
    return (1 - ring.n * beta) * value + beta * ring.all;
  }
  if (ring.n_creases != 2 || rule == Rule::fixed_creases) return value;
  return 0.75 * value + 0.125 * ring.creases;
}

std::vector<Triangle> split_triangles(const Layer& layer, const EdgeTable& edges) {
  std::vector<Triangle> out;
  out.reserve(4 * layer.triangles.size());
  const auto n = static_cast<std::uint32_t>(layer.values.size());
  for (std::uint32_t t = 0; t < layer.triangles.size(); ++t) {
    const auto [a, b, c] = layer.triangles[t];
    const std::uint32_t ab = n + edges.edge_of[3 * t], bc = n + edges.edge_of[3 * t + 1],
                        ca = n + edges.edge_of[3 * t + 2];
    out.insert(out.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return out;
}

void split(Layer& layer, Rule rule) {
  TriMesh view;  // the edge table wants triangles of a mesh
  view.triangles.swap(layer.triangles);
  const EdgeTable edges = build_edge_table(view);
  layer.triangles = view.triangles;
  std::vector<glm::dvec3> values = layer.values;
  if (rule != Rule::linear) {
    const std::vector<Ring> rings = sum_rings(layer, edges, view);
    for (std::size_t v = 0; v < values.size(); ++v)
      values[v] = vertex_point(layer.values[v], rings[v], rule);
  }
  values.reserve(values.size() + edges.size());
  for (std::size_t edge = 0; edge < edges.size(); ++edge)
    values.push_back(edge_point(layer, edges, edge, rule));
  layer.triangles = split_triangles(layer, edges);
  layer.values = std::move(values);
}

struct Welded {
  Layer layer;
  std::vector<std::uint32_t> source_vertex;  // per vertex of the layer
  std::vector<std::size_t> source_triangle;
  std::size_t n_welded = 0;
};

Welded weld_positions(const TriMesh& mesh) {
  Welded out;
  const std::vector<std::uint32_t> first = match_positions(mesh);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    const Triangle welded{first[a], first[b], first[c]};
    if (welded[0] == welded[1] || welded[1] == welded[2] || welded[2] == welded[0]) continue;
    out.layer.triangles.push_back(welded);
    out.source_triangle.push_back(t);
  }
  for (std::uint32_t v = 0; v < first.size(); ++v) out.n_welded += first[v] != v;
  UsedVertices used = find_used_vertices(out.layer.triangles, first.size());
  out.layer.triangles = used.renumber(out.layer.triangles);
  for (const std::uint32_t v : used.source) out.layer.values.emplace_back(mesh.positions[v]);
  out.source_vertex = std::move(used.source);
  return out;
}

// One value for each pair of a vertex and a value at a corner there, by vertex, then value.
// value_of(triangle, k): of the input.
template <typename ValueOf>
Layer make_corner_layer(const Welded& welded, const ValueOf& value_of) {
  using Key = std::tuple<std::uint32_t, float, float, float>;
  std::vector<Key> corners;
  for (std::size_t t = 0; t < welded.source_triangle.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::vec3 value = value_of(welded.source_triangle[t], k);
      corners.emplace_back(welded.layer.triangles[t][k], value.x, value.y, value.z);
    }
  std::vector<Key> keys = corners;
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  Layer out;
  for (const auto& [vertex, x, y, z] : keys) out.values.emplace_back(x, y, z);
  for (std::size_t c = 0; c < corners.size(); c += 3) {
    const auto place = [&](std::size_t k) {
      return static_cast<std::uint32_t>(std::lower_bound(keys.begin(), keys.end(), corners[c + k]) -
                                        keys.begin());
    };
    out.triangles.push_back({place(0), place(1), place(2)});
  }
  return out;
}

Rule position_rule(const SubdivideOptions& options) {
  return options.scheme == SubdivisionScheme::loop ? Rule::smooth : Rule::linear;
}

Rule texcoord_rule(const SubdivideOptions& options) {
  if (options.scheme == SubdivisionScheme::midpoint) return Rule::linear;
  switch (options.texcoords) {
    case TexcoordRule::smooth:
      return Rule::smooth;
    case TexcoordRule::inside:
      return Rule::fixed_creases;
    case TexcoordRule::linear:
      return Rule::linear;
  }
  return Rule::linear;
}

Layer split_times(Layer layer, int n_times, Rule rule) {
  for (int i = 0; i < n_times; ++i) split(layer, rule);
  return layer;
}

// On the same surface those of the input, by corner where a vertex has several; on a smoother one
// its own.
void set_normals(const TriMesh& mesh, const Welded& welded, const SubdivideOptions& options,
                 TriMesh& out) {
  if (options.scheme != SubdivisionScheme::midpoint && options.n_times > 0) {
    out.normals = make_vertex_normals(out);
    return;
  }
  const auto value_of = [&](std::size_t t, std::size_t k) {
    return mesh.normals.empty() ? mesh.corner_normals[3 * t + k]
                                : mesh.normals[mesh.triangles[t][k]];
  };
  Layer layer = split_times(make_corner_layer(welded, value_of), options.n_times, Rule::linear);
  for (glm::dvec3& n : layer.values)
    if (const double length = glm::length(n); length > 0) n /= length;
  if (layer.values.size() == out.positions.size()) {
    out.normals.assign(layer.values.begin(), layer.values.end());
    return;
  }
  for (const Triangle& t : layer.triangles)
    for (const std::uint32_t v : t) out.corner_normals.emplace_back(layer.values[v]);
}

// Vertices that have several, where colours meet, are split; all else of `out` is by corner by now,
// or follows.
void set_colors(const TriMesh& mesh, const Welded& welded, const SubdivideOptions& options,
                TriMesh& out) {
  Layer layer = make_corner_layer(
      welded, [&](std::size_t t, std::size_t k) { return mesh.colors[mesh.triangles[t][k]]; });
  const bool is_split = layer.values.size() != welded.layer.values.size();
  const Rule rule = position_rule(options);
  layer = split_times(std::move(layer), options.n_times,
                      is_split && rule == Rule::smooth ? Rule::fixed_creases : rule);
  constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<std::uint32_t> color_of(out.positions.size(), kNone);  // vertex -> its layer's
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> others;
  for (std::size_t t = 0; t < out.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& v = out.triangles[t][k];
      const std::uint32_t color = layer.triangles[t][k];
      if (color_of[v] == kNone) color_of[v] = color;
      if (color_of[v] == color) continue;
      const auto n = static_cast<std::uint32_t>(out.positions.size());
      const auto [found, is_new] = others.try_emplace({v, color}, n);
      if (is_new) {
        out.positions.push_back(glm::vec3(out.positions[v]));
        if (!out.normals.empty()) out.normals.push_back(glm::vec3(out.normals[v]));
        color_of.push_back(color);
      }
      v = found->second;
    }
  for (const std::uint32_t color : color_of)
    out.colors.emplace_back(color == kNone ? glm::dvec3(0) : layer.values[color]);
}

void check_count(std::size_t n_triangles, int n_times, const std::string& file) {
  VIEWCELL_CHECK(n_times >= 0, n_times);
  if (n_triangles == 0) throw InputError(file, "", "has no triangle of three different positions");
  std::size_t n = n_triangles;
  for (int i = 0; i < n_times && n <= kMostSubdividedFaces; ++i) n *= 4;
  if (n > kMostSubdividedFaces)
    throw InputError(file, "",
                     std::to_string(n_triangles) + " triangles become more than " +
                         std::to_string(kMostSubdividedFaces) + " when subdivided " +
                         std::to_string(n_times) + " times");
}

}  // namespace

Subdivision subdivide(const TriMesh& mesh, const SubdivideOptions& options,
                      const std::string& file) {
  const Welded welded = weld_positions(mesh);
  check_count(welded.layer.triangles.size(), options.n_times, file);
  Subdivision out;
  out.n_welded = welded.n_welded;
  out.n_dropped = mesh.triangles.size() - welded.layer.triangles.size();

  Layer surface = split_times(welded.layer, options.n_times, position_rule(options));
  out.mesh.positions.assign(surface.values.begin(), surface.values.end());
  out.mesh.triangles = std::move(surface.triangles);
  out.mesh.offset = mesh.offset;
  out.mesh.material_libraries = mesh.material_libraries;
  if (!mesh.texcoords.empty()) {
    const auto value_of = [&](std::size_t t, std::size_t k) {
      return glm::vec3(mesh.texcoords[3 * t + k], 0);
    };
    const Layer uv =
        split_times(make_corner_layer(welded, value_of), options.n_times, texcoord_rule(options));
    for (const Triangle& t : uv.triangles)
      for (const std::uint32_t v : t) out.mesh.texcoords.emplace_back(uv.values[v]);
  }
  if (!mesh.normals.empty() || !mesh.corner_normals.empty())
    set_normals(mesh, welded, options, out.mesh);
  if (!mesh.colors.empty()) set_colors(mesh, welded, options, out.mesh);
  if (!mesh.materials.empty()) {
    const std::size_t n_children = out.mesh.triangles.size() / welded.source_triangle.size();
    for (const std::size_t t : welded.source_triangle)
      out.mesh.materials.insert(out.mesh.materials.end(), n_children, mesh.materials[t]);
    out.mesh.material_names = mesh.material_names;
  }
  return out;
}

}  // namespace viewcell
