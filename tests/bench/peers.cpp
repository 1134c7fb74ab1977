#include "bench/peers.h"

#include <meshoptimizer.h>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <chrono>
#include <vector>

namespace viewcell {
namespace {

template <typename Run>
double seconds_of(Run&& run) {
  const auto start = std::chrono::steady_clock::now();
  run();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

PeerResult run_meshoptimizer(const TriMesh& mesh, std::size_t target_faces) {
  std::vector<unsigned> in, out(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) in.insert(in.end(), t.begin(), t.end());
  PeerResult result;
  std::size_t n = 0;
  result.time_s = seconds_of([&] {
    n = meshopt_simplify(out.data(), in.data(), in.size(), &mesh.positions[0].x,
                         mesh.positions.size(), sizeof(glm::vec3), 3 * target_faces, 1e9f, 0,
                         nullptr);
  });
  std::vector<bool> is_used(mesh.positions.size(), false);
  for (std::size_t i = 0; i < n; ++i) is_used[out[i]] = true;
  result.n_faces = n / 3;
  for (const bool used : is_used) result.n_removed += !used;
  return result;
}

PeerResult run_openmesh(const TriMesh& mesh, std::size_t target_faces) {
  using Mesh = OpenMesh::TriMesh_ArrayKernelT<>;
  Mesh half_edges;
  half_edges.request_face_status();
  half_edges.request_edge_status();
  half_edges.request_halfedge_status();
  half_edges.request_vertex_status();
  for (const glm::vec3& p : mesh.positions) half_edges.add_vertex({p.x, p.y, p.z});
  for (const auto& [a, b, c] : mesh.triangles)
    half_edges.add_face(Mesh::VertexHandle(static_cast<int>(a)),
                        Mesh::VertexHandle(static_cast<int>(b)),
                        Mesh::VertexHandle(static_cast<int>(c)));
  PeerResult result;
  result.time_s = seconds_of([&] {
    OpenMesh::Decimater::DecimaterT<Mesh> decimater(half_edges);
    OpenMesh::Decimater::ModQuadricT<Mesh>::Handle quadrics;
    decimater.add(quadrics);
    decimater.module(quadrics).unset_max_err();
    decimater.initialize();
    result.n_removed = decimater.decimate_to_faces(0, target_faces);
  });
  half_edges.garbage_collection();
  result.n_faces = half_edges.n_faces();
  return result;
}

}  // namespace viewcell
