#include "mesh/clusters.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "base/error.h"

namespace viewcell {
namespace {

static_assert(sizeof(Triangle) == 3 * sizeof(unsigned));
static_assert(sizeof(glm::vec3) == 3 * sizeof(float));

std::vector<meshopt_Meshlet> build_meshlets(const TriMesh& mesh, const ClusterOptions& options,
                                            std::vector<unsigned>& vertices,
                                            std::vector<unsigned char>& corners) {
  const std::size_t n_indices = 3 * mesh.triangles.size();
  const std::size_t n_most =
      meshopt_buildMeshletsBound(n_indices, options.most_vertices, options.most_triangles);
  std::vector<meshopt_Meshlet> meshlets(n_most);
  vertices.resize(n_most * options.most_vertices);
  corners.resize(n_most * options.most_triangles * 3);
  meshlets.resize(meshopt_buildMeshlets(
      meshlets.data(), vertices.data(), corners.data(), mesh.triangles.data()->data(), n_indices,
      &mesh.positions.data()->x, mesh.positions.size(), sizeof(glm::vec3), options.most_vertices,
      options.most_triangles, static_cast<float>(options.cone_weight)));
  return meshlets;
}

void bound_sphere(const TriMesh& mesh, std::span<const Triangle> triangles, Cluster& cluster) {
  Box box;
  for (const Triangle& t : triangles)
    for (const std::uint32_t v : t) box.add(mesh.positions[v]);
  cluster.centre = box.centre();
  for (const Triangle& t : triangles)
    for (const std::uint32_t v : t)
      cluster.radius =
          std::max(cluster.radius, glm::distance(cluster.centre, glm::dvec3(mesh.positions[v])));
}

// An eye in the cone is behind every triangle: the apex is behind all their planes, and their
// normals are within a half angle of the axis.
//          \  eyes  /
//   axis <- \  :   /       apex = centre - t * axis, with the least t for which
//            \ :  /        (apex - corner) . normal <= 0 for every triangle
//             apex
void bound_normals(const TriMesh& mesh, std::span<const Triangle> triangles, Cluster& cluster) {
  constexpr double kLeastCosine = 0.1;  // a wider cone culls next to nothing, and its apex runs off
  glm::dvec3 sum(0);
  std::vector<glm::dvec3> normals;
  for (const Triangle& t : triangles) {
    const glm::dvec3 normal = area_normal(mesh, t);
    const double length = glm::length(normal);
    normals.push_back(length > 0 ? normal / length : glm::dvec3(0));
    sum += normals.back();
  }
  if (!(glm::length(sum) > 0)) return;
  const glm::dvec3 axis = glm::normalize(sum);
  double least_cosine = 1, t = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (normals[i] == glm::dvec3(0)) continue;  // shows nothing
    const double cosine = glm::dot(axis, normals[i]);
    least_cosine = std::min(least_cosine, cosine);
    if (cosine < kLeastCosine) return;
    const glm::dvec3 corner(mesh.positions[triangles[i][0]]);
    t = std::max(t, glm::dot(cluster.centre - corner, normals[i]) / cosine);
  }
  cluster.cone_axis = axis;
  cluster.cone_apex = cluster.centre - t * axis;
  cluster.cone_cutoff = std::sqrt(std::max(0.0, 1 - least_cosine * least_cosine));
}

}  // namespace

ClusteredMesh build_clusters(const TriMesh& mesh, const ClusterOptions& options) {
  VIEWCELL_CHECK(options.most_vertices >= 3 && options.most_vertices <= 255);
  VIEWCELL_CHECK(options.most_triangles >= 4 && options.most_triangles <= 512 &&
                 options.most_triangles % 4 == 0);
  ClusteredMesh out;
  if (mesh.triangles.empty()) return out;
  std::vector<unsigned> vertices;
  std::vector<unsigned char> corners;
  for (const meshopt_Meshlet& m : build_meshlets(mesh, options, vertices, corners)) {
    Cluster cluster;
    cluster.first_triangle = static_cast<std::uint32_t>(out.triangles.size());
    cluster.n_triangles = m.triangle_count;
    for (unsigned t = 0; t < m.triangle_count; ++t) {
      const unsigned char* corner = corners.data() + m.triangle_offset + 3 * t;
      const unsigned* vertex = vertices.data() + m.vertex_offset;
      out.triangles.push_back({vertex[corner[0]], vertex[corner[1]], vertex[corner[2]]});
    }
    const std::span<const Triangle> run(out.triangles.data() + cluster.first_triangle,
                                        cluster.n_triangles);
    bound_sphere(mesh, run, cluster);
    bound_normals(mesh, run, cluster);
    out.clusters.push_back(cluster);
  }
  return out;
}

bool is_back_facing(const Cluster& cluster, const glm::dvec3& eye) {
  constexpr double kSlack = 1e-9;  // of the lengths at hand: rounding of double arithmetic
  if (cluster.cone_cutoff > 1) return false;
  const glm::dvec3 sight = cluster.cone_apex - eye;
  const double length = glm::length(sight);
  const double slack = kSlack * (length + glm::length(cluster.cone_apex));
  return glm::dot(sight, cluster.cone_axis) > cluster.cone_cutoff * length + slack;
}

}  // namespace viewcell
