#include "bake/cell_mesh.h"

#include <gtest/gtest.h>

#include "bake/small_bake.h"

namespace viewcell {
namespace {

// All views of an object from a cell's seven centres, or from its own alone.
std::vector<ClassifiedView> views_of_object(const SmallBake& small, const RayCapture& rays,
                                            CellId cell, ObjectId object, Representation kind) {
  std::vector<ClassifiedView> views;
  const auto centres = views_of(small.cells.grid, cell);
  for (int k = 0; k < (kind == Representation::single_view ? 1 : kViews); ++k)
    if (auto view = classify_view(small.scene, rays, object,
                                  eye_of(small.cells, centres[static_cast<std::size_t>(k)]),
                                  small.settings.density, k))
      views.push_back(std::move(*view));
  return views;
}

struct Derived {
  CellMesh mesh;
  CellMeshCounts counts;
};

// The object's mesh as of that kind, whatever would be chosen.
CellMesh derive_as(Representation kind, CellId cell, ObjectId object,
                   std::span<const ClassifiedView> views, const BakeOptions& options,
                   CellMeshCounts& counts) {
  const BakeScene& bake = shared_bake().bake;
  CellObject chosen = choose_representation(bake, cell, object, options);
  chosen.kind = kind;
  return derive_mesh(bake, cell, std::move(chosen), views, options, counts);
}

Derived derive(CellId cell, ObjectId object, Representation kind, const BakeOptions& options) {
  const SmallBake& small = shared_bake();
  static const RayCapture rays(small.scene, 2);
  Derived out;
  out.mesh = derive_as(kind, cell, object, views_of_object(small, rays, cell, object, kind),
                       options, out.counts);
  return out;
}

// Calls visit(cell, object, kind) for what stands outside.
template <typename Visit>
void for_each_outside(const Visit& visit) {
  const SmallBake& small = shared_bake();
  for (const CellId cell : small.list)
    for (std::size_t o = 0; o < small.scene.objects.size(); ++o) {
      const Representation kind =
          choose_representation(small.bake, cell, ObjectId(o), small.options).kind;
      if (kind != Representation::original) visit(cell, ObjectId(o), kind);
    }
}

glm::dvec3 random_eye(const CellSet& cells, CellId cell, Random& random) {
  const glm::dvec3 centre = eye_of(cells, cell);
  const ConvexPolygon corners = corners_of(cells.grid, coord_of(cells.grid, cell));
  for (;;) {
    const glm::dvec2 p = glm::dvec2(centre) +
                         cells.grid.size * glm::dvec2(random.uniform(-1, 1), random.uniform(-1, 1));
    if (contains(corners, p)) return {p, random.uniform(cells.eye_height.lo, cells.eye_height.hi)};
  }
}

Scene scene_of(const CellMesh& mesh) {
  TriMesh world;
  world.positions = mesh.vertices.positions, world.normals = mesh.vertices.normals;
  world.triangles = mesh.triangles;
  return make_scene_of(std::move(world));
}

// Pixels that one shows and the other does not, with no rim pixel of the first within 2 px.
int count_uncovered(const CaptureTile& a, const CaptureTile& b) {
  const auto is_rim_near = [&](int x, int y) {
    bool has_seen = false, has_unseen = false;
    for (int j = y - 2; j <= y + 2; ++j)
      for (int i = x - 2; i <= x + 2; ++i) {
        const bool inside = i >= 0 && j >= 0 && i < a.crop.width_px && j < a.crop.height_px;
        (inside && a.is_seen(i, j) ? has_seen : has_unseen) = true;
      }
    return has_seen && has_unseen;
  };
  int n = 0;
  for (int y = 0; y < a.crop.height_px; ++y)
    for (int x = 0; x < a.crop.width_px; ++x)
      n += a.is_seen(x, y) != b.is_seen(x, y) && !is_rim_near(x, y);
  return n;
}

void expect_same_coverage(const Derived& derived, CellId cell, ObjectId object, Random& random) {
  const SmallBake& small = shared_bake();
  static const RayCapture originals(small.scene, 2);
  const Scene scene = scene_of(derived.mesh);
  const RayCapture rays(scene, 1);
  for (int k = 0; k < 2; ++k) {
    const glm::dvec3 eye = random_eye(small.cells, cell, random);
    const auto viewed = choose_view(
        eye, world_points(small.scene, small.scene.objects[index(object)]), small.settings.density);
    if (!viewed) continue;
    const CaptureTile a = originals.capture(object, viewed->view, viewed->crop);
    const CaptureTile b = rays.capture(ObjectId(0), viewed->view, viewed->crop);
    EXPECT_EQ(count_uncovered(a, b), 0) << eye.x << " " << eye.y << " " << eye.z;
  }
}

TEST(CellMesh, VerticesAreTheOriginalsMovedAlongTheirNormals) {
  const SmallBake& small = shared_bake();
  const double focal = 128 / std::tan(glm::radians(30.0));
  for_each_outside([&](CellId cell, ObjectId id, Representation kind) {
    SCOPED_TRACE(testing::Message() << "cell " << int(cell) << " object " << int(id));
    const Derived derived = derive(cell, id, kind, small.options);
    const CellMesh& mesh = derived.mesh;
    const SceneObject& object = small.scene.objects[index(id)];
    const TriMesh& original = small.scene.mesh_of(object).mesh;
    const glm::dvec3 centre = eye_of(small.cells, cell);
    ASSERT_EQ(mesh.source_vertex.size(), mesh.vertices.positions.size());
    ASSERT_EQ(mesh.views.size(), mesh.triangles.size());
    EXPECT_EQ(mesh.object, id);
    EXPECT_GT(mesh.triangles.size(), 8u);
    EXPECT_LT(mesh.triangles.size(), original.triangles.size() / 2);
    for (std::size_t v = 0; v < mesh.source_vertex.size(); ++v) {
      const std::uint32_t source = mesh.source_vertex.at(v);
      const glm::dvec3 at = object.world_from_model(glm::dvec3(original.positions.at(source)));
      const glm::dvec3 moved = glm::dvec3(mesh.vertices.positions[v]) - at;
      const glm::dvec3 normal(mesh.vertices.normals[v]);
      // max_drift_px as the farthest point of the cell sees them
      const double most =
          small.options.max_drift_px / focal * (glm::length(at - centre) + small.cells.grid.size);
      EXPECT_LT(glm::length(moved), most + 1e-4);
      EXPECT_LT(glm::length(glm::cross(moved, normal)), 1e-4);
      EXPECT_NEAR(glm::dot(normal, object.rotation * glm::dvec3(original.normals[source])), 1,
                  1e-4);
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      unsigned shared = 0x7f;
      for (const std::uint32_t v : mesh.triangles[t]) shared &= mesh.vertices.views.at(v);
      ASSERT_EQ(mesh.views[t], shared);
    }
    EXPECT_EQ(derived.counts.n_out, mesh.triangles.size());
    EXPECT_EQ(derived.counts.n_original, original.triangles.size());
    EXPECT_LE(derived.counts.n_start, derived.counts.n_original);
  });
}

TEST(CellMesh, EyesOfTheCellSeeTheSameOutline) {
  Random random(17);
  int n_single = 0, n_multi = 0;
  for_each_outside([&](CellId cell, ObjectId object, Representation kind) {
    SCOPED_TRACE(testing::Message() << "cell " << int(cell) << " object " << int(object));
    ++(kind == Representation::single_view ? n_single : n_multi);
    expect_same_coverage(derive(cell, object, kind, shared_bake().options), cell, object, random);
  });
  EXPECT_GT(n_single, 3);
  EXPECT_GT(n_multi, 3);
}

TEST(CellMesh, StartingFromTheOriginalGivesTheSameOutline) {
  Random random(18);
  BakeOptions options = shared_bake().options;
  std::size_t n_from_original = 0, n_from_level = 0;
  for_each_outside([&](CellId cell, ObjectId object, Representation kind) {
    if (index(object) == 1) return;
    SCOPED_TRACE(testing::Message() << "cell " << int(cell) << " object " << int(object));
    options.start_error_px = 0;
    const Derived from_original = derive(cell, object, kind, options);
    options.start_error_px = 0.25;
    const Derived from_level = derive(cell, object, kind, options);
    EXPECT_EQ(from_original.counts.n_start, from_original.counts.n_original);
    n_from_original += from_original.counts.n_start;
    n_from_level += from_level.counts.n_start;
    expect_same_coverage(from_original, cell, object, random);
    const double ratio = static_cast<double>(from_level.counts.n_out) /
                         static_cast<double>(from_original.counts.n_out);
    EXPECT_GT(ratio, 0.5);
    EXPECT_LT(ratio, 2);
  });
  EXPECT_LT(n_from_level, n_from_original);
}

TEST(CellMesh, MoreDriftMeansFewerTriangles) {
  const SmallBake& small = shared_bake();
  for_each_outside([&](CellId cell, ObjectId object, Representation kind) {
    if (index(cell) % 4 != 0) return;
    std::size_t last = ~std::size_t{0};
    for (const double drift : {0.1, 0.5, 2.5}) {
      BakeOptions options = small.options;
      options.max_drift_px = drift;
      const std::size_t n = derive(cell, object, kind, options).counts.n_out;
      EXPECT_LT(n, last) << "cell " << int(cell) << " object " << int(object) << " " << drift;
      last = n;
    }
  });
}

// Triangles whose corners share no view: collapses of an MVMesh make none, those of an SVMesh,
// given the same views, do.
TEST(CellMesh, MultiViewCollapsesKeepCommonViews) {
  const SmallBake& small = shared_bake();
  const RayCapture rays(small.scene, 2);
  std::size_t n_multi = 0, n_single = 0;
  for_each_outside([&](CellId cell, ObjectId object, Representation kind) {
    if (kind != Representation::multi_view) return;
    const auto views = views_of_object(small, rays, cell, object, kind);
    const auto count = [&](Representation as) {
      CellMeshCounts counts;
      const CellMesh mesh = derive_as(as, cell, object, views, small.options, counts);
      return static_cast<std::size_t>(std::count(mesh.views.begin(), mesh.views.end(), 0));
    };
    n_multi += count(Representation::multi_view);
    n_single += count(Representation::single_view);
  });
  EXPECT_GT(2 * n_single, 3 * n_multi);
}

TEST(CellMesh, SameEachTime) {
  for_each_outside([&](CellId cell, ObjectId object, Representation kind) {
    if (index(cell) % 3 != 0) return;
    const CellMesh a = derive(cell, object, kind, shared_bake().options).mesh;
    const CellMesh b = derive(cell, object, kind, shared_bake().options).mesh;
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(a.vertices.positions, b.vertices.positions);
    EXPECT_EQ(a.source_vertex, b.source_vertex);
    EXPECT_EQ(a.views, b.views);
  });
}

TEST(Representation, InsideNearAndFar) {
  const SmallBake& small = shared_bake();
  double farthest_multi = 0, nearest_single = 1e9;
  for (const CellId cell : small.list)
    for (std::size_t o = 0; o < small.scene.objects.size(); ++o) {
      const auto kind = choose_representation(small.bake, cell, ObjectId(o), small.options).kind;
      EXPECT_EQ(kind == Representation::original, is_inside(small.cells, cell, ObjectId(o)));
      if (o % 2 != 0) continue;  // of the balls, all alike
      const double d = glm::distance(eye_of(small.cells, cell), small.scene.objects[o].translation);
      if (kind == Representation::multi_view) farthest_multi = std::max(farthest_multi, d);
      if (kind == Representation::single_view) nearest_single = std::min(nearest_single, d);
    }
  EXPECT_LT(farthest_multi, nearest_single + 2);
  EXPECT_GT(farthest_multi, 40);
  EXPECT_LT(nearest_single, 150);
}

TEST(Representation, MoreToleranceMeansMoreSingleViews) {
  const SmallBake& small = shared_bake();
  BakeOptions options = small.options;
  for (const CellId cell : small.list)
    for (std::size_t o = 0; o < small.scene.objects.size(); ++o) {
      bool was_single = false;
      for (const double ts : {0.0, 2.0, 5.0, 10.0, 20.0, 40.0, 1e6}) {
        options.ts_px = ts;
        const auto kind = choose_representation(small.bake, cell, ObjectId(o), options).kind;
        const bool is_single = kind == Representation::single_view;
        EXPECT_TRUE(is_single || !was_single) << int(cell) << " " << o << " " << ts;
        if (ts == 0) {
          EXPECT_FALSE(is_single);
        }
        was_single = is_single;
      }
      EXPECT_EQ(was_single, !is_inside(small.cells, cell, ObjectId(o)));
    }
}

}  // namespace
}  // namespace viewcell
