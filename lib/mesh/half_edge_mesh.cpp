// Whether a triangle can be taken in is left to OpenMesh's add_face: when it refuses, it changes
// nothing. It says so on stderr, which is shut up.
#include "mesh/half_edge_mesh.h"

#include <OpenMesh/Core/Mesh/TriConnectivity.hh>

#include "base/error.h"

namespace viewcell {
namespace {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

VertexHandle vertex_handle(std::uint32_t vertex) {
  return VertexHandle(static_cast<int>(vertex));
}

[[maybe_unused]] const bool kIsSilent = (omerr().disable(), true);

}  // namespace

struct HalfEdgeMesh::Kernel : OpenMesh::TriConnectivity {
  std::vector<FaceHandle> face_of;  // by number

  explicit Kernel(std::size_t n_vertices) {
    VIEWCELL_CHECK(n_vertices <= 0x7fffffff, n_vertices);
    resize(n_vertices, 0, 0);
  }
};

HalfEdgeMesh::HalfEdgeMesh(std::size_t n_vertices)
    : kernel_(std::make_unique<Kernel>(n_vertices)) {}

HalfEdgeMesh::HalfEdgeMesh(const TriMesh& mesh) : HalfEdgeMesh(mesh.positions.size()) {
  kernel_->reserve(mesh.positions.size(), 3 * mesh.triangles.size() / 2, mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) add(t, mesh.triangles[t]);
}

HalfEdgeMesh::~HalfEdgeMesh() = default;

bool HalfEdgeMesh::add(std::uint32_t number, const Triangle& t) {
  const auto [a, b, c] = t;
  FaceHandle face;
  if (a != b && b != c && c != a)
    face = kernel_->add_face(vertex_handle(a), vertex_handle(b), vertex_handle(c));
  (face.is_valid() ? taken_ : refused_).push_back(number);
  if (!face.is_valid()) return false;
  std::vector<FaceHandle>& face_of = kernel_->face_of;
  if (number >= face_of.size()) face_of.resize(number + std::size_t{1});
  VIEWCELL_CHECK(!face_of[number].is_valid(), "two triangles of number", number);
  face_of[number] = face;
  return true;
}

bool HalfEdgeMesh::has_vertex(std::uint32_t vertex) const {
  return !kernel_->is_isolated(vertex_handle(vertex));
}

bool HalfEdgeMesh::is_boundary(std::uint32_t vertex) const {
  return has_vertex(vertex) && kernel_->is_boundary(vertex_handle(vertex));
}

EdgeSide HalfEdgeMesh::side(std::uint32_t from, std::uint32_t to) const {
  const HalfedgeHandle half = kernel_->find_halfedge(vertex_handle(from), vertex_handle(to));
  if (!half.is_valid()) return EdgeSide::absent;
  return kernel_->is_boundary(half) ? EdgeSide::open : EdgeSide::taken;
}

std::uint32_t HalfEdgeMesh::across(std::uint32_t triangle, std::size_t k) const {
  const FaceHandle here = kernel_->face_of.at(triangle);
  VIEWCELL_CHECK(here.is_valid(), "not taken in: triangle", triangle);
  // The kernel keeps a face's last half-edge: that from corner 2 to corner 0.
  HalfedgeHandle half = kernel_->halfedge_handle(here);
  for (std::size_t i = 0; i <= k; ++i) half = kernel_->next_halfedge_handle(half);
  const FaceHandle face = kernel_->opposite_face_handle(half);
  return face.is_valid() ? taken_[static_cast<std::size_t>(face.idx())] : kNone;
}

std::vector<std::vector<std::uint32_t>> HalfEdgeMesh::boundary_loops() const {
  std::vector<std::vector<std::uint32_t>> loops;
  std::vector<bool> is_seen(kernel_->n_halfedges(), false);
  const auto walk = [&](HalfedgeHandle first) {
    loops.emplace_back();
    HalfedgeHandle half = first;
    do {
      is_seen[static_cast<std::size_t>(half.idx())] = true;
      loops.back().push_back(static_cast<std::uint32_t>(kernel_->from_vertex_handle(half).idx()));
      half = kernel_->prev_halfedge_handle(half);  // a boundary's own has the surface on its right
    } while (half != first);
  };
  for (std::uint32_t v = 0; v < kernel_->n_vertices(); ++v) {
    if (!is_boundary(v)) continue;
    for (const HalfedgeHandle half : kernel_->voh_range(vertex_handle(v)))
      if (kernel_->is_boundary(half) && !is_seen[static_cast<std::size_t>(half.idx())]) walk(half);
  }
  return loops;
}

}  // namespace viewcell
