#include "play/ready_cell.h"

#include <gtest/gtest.h>

#include "bake/small_bake.h"

namespace viewcell {
namespace {

// Against the derived meshes themselves: positions within an offset's unit, normals within a step,
// indices of the whole cell.
TEST(ReadyCell, IsWhatWasDerived) {
  const SmallBake& small = shared_bake();
  const Bundle bundle(shared_bundle());
  for (const CellId cell : small.list) {
    SCOPED_TRACE(int(cell));
    const CellGeometry g = bundle.read_cell(cell);
    const ReadyCell ready = make_ready_cell(bundle.scene(), bundle.cells(), cell, g);
    EXPECT_EQ(ready.cell, cell);
    EXPECT_EQ(ready.origin, eye_of(small.cells, cell));
    ASSERT_EQ(ready.objects.size(), g.objects.size());
    ASSERT_EQ(ready.vertices.size(), g.source_vertices.size());
    ASSERT_EQ(ready.indices.size(), g.indices.size());
    std::map<ObjectId, CellMesh> derived;
    for (const auto& from : {small.inputs.svmesh, small.inputs.mvmesh})
      for (CellMesh& m : read_weighted_meshes(from / weighted_mesh_name(cell), small.scene).meshes)
        derived[m.object] = std::move(m);
    std::uint32_t next = 0;
    for (std::size_t slot = 0; slot < ready.objects.size(); ++slot) {
      const ReadyObject& o = ready.objects[slot];
      const CellMesh& mesh = derived.at(o.object);
      EXPECT_EQ(o.first_index, next);
      EXPECT_EQ(o.n_indices, 3 * mesh.triangles.size());
      next += o.n_indices;
      std::map<std::uint32_t, std::size_t> place;
      for (std::size_t v = 0; v < mesh.source_vertex.size(); ++v) place[mesh.source_vertex[v]] = v;
      for (std::uint32_t i = o.first_index; i < next; ++i) {
        const std::uint32_t v = ready.indices[i];
        const std::size_t at = place.at(g.source_vertices.at(v));
        const glm::dvec3 p = ready.origin + glm::dvec3(ready.vertices[v].position);
        ASSERT_LT(glm::distance(p, glm::dvec3(mesh.vertices.positions[at])), kOffsetUnit);
        for (int k = 0; k < 3; ++k) {
          ASSERT_NEAR(ready.vertices[v].normal[k], 32767 * mesh.vertices.normals[at][k], 2);
          ASSERT_GE(p[k], static_cast<double>(o.lo[k]) - kOffsetUnit);
          ASSERT_LE(p[k], static_cast<double>(o.hi[k]) + kOffsetUnit);
        }
      }
    }
  }
}

// Whatever lies beyond a face's line is marked; what lies wholly on this side of it is not.
TEST(ReadyCell, WindowsAreTheFacesThatTheBoxReachesBeyond) {
  const Bundle bundle(shared_bundle());
  const CellSet& cells = bundle.cells();
  const double apothem = std::sqrt(0.75) * cells.grid.size;
  Random random(9);
  for (int k = 0; k < 2000; ++k) {
    const CellId cell = shared_bake().list[random.below(9)];
    const glm::dvec2 centre = centre_of(cells.grid, coord_of(cells.grid, cell));
    BundleObject o;
    o.kind = 1;
    for (int axis = 0; axis < 3; ++axis) {
      o.lo[axis] = static_cast<float>(random.uniform(-100, 200));
      o.hi[axis] = o.lo[axis] + static_cast<float>(random.uniform(0, 50));
    }
    CellGeometry g;
    g.objects = {o};
    const auto windows = make_ready_cell(bundle.scene(), cells, cell, g).objects.at(0).windows;
    for (int face = 0; face < 6; ++face) {
      const double a = glm::radians(30.0 + 60.0 * face);
      double farthest = -1e9;
      for (int corner = 0; corner < 4; ++corner) {
        const glm::dvec2 p(corner & 1 ? o.hi[0] : o.lo[0], corner & 2 ? o.hi[1] : o.lo[1]);
        farthest = std::max(farthest, glm::dot(p - centre, {std::cos(a), std::sin(a)}));
      }
      if (std::abs(farthest - apothem) > 1e-3) {
        ASSERT_EQ(windows >> face & 1, farthest > apothem) << "case " << k << " face " << face;
      }
    }
  }
}

}  // namespace
}  // namespace viewcell
