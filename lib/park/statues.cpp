#include "park/statues.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/disjoint_sets.h"
#include "base/error.h"
#include "mesh/half_edge_mesh.h"
#include "mesh/used_vertices.h"
#include "park/figures.h"
#include "park/polygonise.h"
#include "park/relief.h"
#include "pm/simplify.h"

namespace viewcell {
namespace {

// How a kind is sculpted.
struct Recipe {
  Figure (*figure)();
  double oversampling;  // triangles of the first mesh, in those of the finished one
  int n_relax;
  double grain_edges;  // rms height of the grain, in mean edge lengths
  Waves strokes;       // of fur or chisel, coarser than the grain
};

// The shortest wavelength of the grain in mean edge lengths: a scan's noise, just above what the
// mesh can hold.
constexpr double kGrainEdges = 2.8;

const Recipe& recipe_of(const StatueKind& kind) {
  static const std::array<Recipe, kStatueKinds> recipes{{
      {make_dragon_figure, 1.12, 2, 0.07, {}},
      {make_hare_figure, 1.12, 1, 0.06, {0.07, {1.3, 1.3, 4}, 12}},
      {make_robed_figure, 1.4, 1, 0.08, {}},
      {make_cattle_figure, 1.8, 1, 0.06, {0.08, {2.2, 2.2, 3.4}, 14}},
      {make_horse_figure, 3, 1, 0.06, {}},
      {make_moai_figure, 2, 1, 0.07, {0.045, {2.6, 2.6, 1.5}, 16}},
      {make_camel_figure, 3, 1, 0.07, {}},
      {make_bust_figure, 5, 0, 0.04, {}},
  }};
  const auto& kinds = statue_kinds();
  const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const StatueKind& k) {
    return std::string_view(k.name) == kind.name;
  });
  VIEWCELL_CHECK(found != kinds.end(), kind.name);
  return recipes[static_cast<std::size_t>(found - kinds.begin())];
}

// The figure as a mesh of about n triangles. The count goes as 1 / cell^2, so a coarse mesh tells
// the cell to take.
TriMesh polygonise_to_count(const Figure& figure, double n, int n_threads) {
  const Box box = figure_box(figure);
  PolygoniseOptions options;
  options.n_threads = n_threads;
  options.cell = glm::length(box.size()) / 60;
  for (int attempt = 0; attempt < 6; ++attempt) {
    TriMesh mesh = polygonise(figure, options);
    const double ratio = static_cast<double>(mesh.triangles.size()) / n;
    if (ratio >= 1 && ratio < 1.1) return mesh;
    options.cell *= std::sqrt(ratio / 1.04);
  }
  throw_bug(__FILE__, __LINE__, "a cell size gives the count", n);
}

// The connected piece with the most triangles (a detail below the grid's cell may come off).
TriMesh largest_piece(const TriMesh& mesh) {
  DisjointSets sets(mesh.positions.size());
  for (const Triangle& t : mesh.triangles) sets.join(t[0], t[1]), sets.join(t[0], t[2]);
  std::vector<std::size_t> count(mesh.positions.size(), 0);
  for (const Triangle& t : mesh.triangles) ++count[sets.find(t[0])];
  const auto largest =
      static_cast<std::uint32_t>(std::max_element(count.begin(), count.end()) - count.begin());
  std::vector<Triangle> kept;
  for (const Triangle& t : mesh.triangles)
    if (sets.find(t[0]) == largest) kept.push_back(t);
  return compact(mesh, kept).mesh;
}

// Unit normals weighted by area: the plain sides of a plinth stay plain.
std::vector<glm::vec3> make_area_normals(const TriMesh& mesh) {
  std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0));
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) sums[v] += area_normal(mesh, t);
  std::vector<glm::vec3> normals;
  for (const glm::dvec3& sum : sums)
    normals.push_back(glm::length(sum) > 0 ? glm::vec3(glm::normalize(sum)) : glm::vec3(0, 0, 1));
  return normals;
}

// Takes away the triangles of the floor, leaving its rim as a boundary.
void open_base(TriMesh& mesh, double floor_height) {
  const auto top = static_cast<float>(bounding_box(mesh).lo.z + floor_height);
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    return mesh.positions[t[0]].z <= top && mesh.positions[t[1]].z <= top &&
           mesh.positions[t[2]].z <= top;
  });
}

// Takes away one triangle that has exactly one boundary edge and no other boundary vertex: the
// surface stays manifold, its boundary one edge longer.
void drop_boundary_triangle(TriMesh& mesh) {
  const HalfEdgeMesh half_edges(mesh);
  VIEWCELL_CHECK(half_edges.refused().empty(), half_edges.refused()[0]);
  const auto is_droppable = [&](std::uint32_t t) {
    int n_open = 0, n_rim = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      n_open += half_edges.across(t, k) == HalfEdgeMesh::kNone;
      n_rim += half_edges.is_boundary(mesh.triangles[t][k]);
    }
    return n_open == 1 && n_rim == 2;
  };
  std::uint32_t t = 0;
  while (t < mesh.triangles.size() && !is_droppable(t)) ++t;
  VIEWCELL_CHECK(t < mesh.triangles.size(), "no triangle can be dropped");
  mesh.triangles.erase(mesh.triangles.begin() + t);
}

TriMesh simplify_to_count(const TriMesh& mesh, std::size_t n) {
  const bool is_open = n % 2 == 1;  // a closed surface has an even number of triangles
  TriMesh out = simplify(mesh, {.target_triangles = is_open ? n + 1 : n}).mesh;
  if (is_open && out.triangles.size() == n + 1) drop_boundary_triangle(out);
  VIEWCELL_CHECK(out.triangles.size() == n, out.triangles.size(), n);
  return out;
}

}  // namespace

const std::array<StatueKind, kStatueKinds>& statue_kinds() {
  static const std::array<StatueKind, kStatueKinds> kinds{{
      {"dragon", 202520, {57.3, 25.6, 40.4}, {4, 10, 18}, "a serpent dragon"},
      {"bunny", 69451, {43.6, 33.8, 43.2}, {7, 12, 26}, "a sitting hare"},
      {"statue", 35280, {11.8, 13.4, 23.4}, {13, 21, 40}, "a robed walker with a staff"},
      {"cattle", 12398, {40.0, 40.8, 30.7}, {9, 19, 42}, "a bull and a calf"},
      {"horse", 7257, {38.3, 57.2, 82.6}, {13, 29, 51}, "a rearing horse on a plinth"},
      {"easter", 4976, {12.4, 10.7, 30.8}, {6, 14, 22}, "a long-eared stone head"},
      {"camel", 3969, {49.4, 16.8, 46.6}, {4, 14, 26}, "a camel of two humps"},
      {"venus", 1396, {10.2, 8.4, 21.9}, {8, 13, 28}, "a bust on a socle"},
  }};
  return kinds;
}

void fit_to_size(TriMesh& mesh, const glm::dvec3& size) {
  const Box box = bounding_box(mesh);
  const glm::dvec3 base(-0.5 * size.x, -0.5 * size.y, 0);
  for (glm::vec3& p : mesh.positions)
    p = glm::vec3(base + (glm::dvec3(p) - box.lo) / box.size() * size);
}

TriMesh make_statue(const StatueKind& kind, int n_threads) {
  const Recipe& recipe = recipe_of(kind);
  const double n_first = recipe.oversampling * static_cast<double>(kind.n_triangles);
  TriMesh mesh = largest_piece(polygonise_to_count(recipe.figure(), n_first, n_threads));
  fit_to_size(mesh, kind.size);
  const double floor_height = 1e-3 * kind.size.z;
  if (kind.n_triangles % 2 == 1) open_base(mesh, floor_height);
  if (recipe.strokes.height > 0) add_waves(mesh, recipe.strokes, floor_height);
  mesh = simplify_to_count(mesh, kind.n_triangles);
  relax_tangentially(mesh, recipe.n_relax, floor_height);
  const double edge = mean_edge_length(mesh);
  add_waves(mesh, {recipe.grain_edges * edge, glm::dvec3(kGrainEdges * edge), kind.n_triangles},
            floor_height);
  fit_to_size(mesh, kind.size);
  mesh.normals = make_area_normals(mesh);
  return mesh;
}

}  // namespace viewcell
