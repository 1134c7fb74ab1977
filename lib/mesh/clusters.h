// Runs of triangles that are culled and drawn together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace viewcell {

/// A run of triangles that are drawn or culled together.
struct Cluster {
  std::uint32_t first_triangle = 0, n_triangles = 0;
  glm::dvec3 centre{0};  ///< of a sphere around them
  double radius = 0;
  glm::dvec3 cone_apex{0}, cone_axis{0};
  double cone_cutoff = 2;  ///< sine of the half angle of the normals around the axis; 2: no cone
};

struct ClusteredMesh {
  std::vector<Triangle> triangles;  ///< all triangles of the mesh, cluster after cluster
  std::vector<Cluster> clusters;
};

struct ClusterOptions {
  std::size_t most_vertices = 128;   ///< 3 to 255
  std::size_t most_triangles = 252;  ///< a multiple of 4, to 512
  double cone_weight = 0.5;          ///< 0: compact clusters; 1: clusters of like normals
};

/// Clusters by meshopt_buildMeshlets; spheres and cones are computed here in double precision and
/// hold for every triangle, also of a small cluster far from the origin.
ClusteredMesh build_clusters(const TriMesh& mesh, const ClusterOptions& options = {});

/// True only when every triangle of the cluster turns its back on the eye, or shows it its edge.
bool is_back_facing(const Cluster& cluster, const glm::dvec3& eye);

}  // namespace viewcell
