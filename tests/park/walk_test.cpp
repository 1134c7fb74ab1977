#include "park/walk.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "park/park.h"
#include "park/stand_ins.h"

namespace viewcell {
namespace {

// The share of a frame of n x n pixels that the objects cover: each triangle rasterised.
double draw_coverage(const std::vector<SceneMesh>& meshes, std::span<const SceneObject> objects,
                     const Camera& camera, int n) {
  std::vector<bool> covered(static_cast<std::size_t>(n * n), false);
  const glm::dmat4 clip_from = clip_from_world(camera);
  for (const SceneObject& object : objects) {
    const TriMesh& mesh = meshes[index(object.mesh)].mesh;
    const glm::dmat4 matrix = clip_from * object.matrix_world_from_model();
    std::vector<glm::dvec3> p;  // pixels, and the distance ahead
    for (const glm::vec3& q : mesh.positions) {
      const glm::dvec4 c = matrix * glm::dvec4(glm::dvec3(q), 1);
      p.emplace_back((c.x / c.w + 1) * n / 2, (1 - c.y / c.w) * n / 2, c.w);
    }
    for (const Triangle& t : mesh.triangles) {
      const glm::dvec3 &a = p[t[0]], &b = p[t[1]], &c = p[t[2]];
      const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
      if (a.z < 1 || b.z < 1 || c.z < 1 || area == 0) continue;
      const auto first = [&](int k) {
        return std::max(0, static_cast<int>(std::min({a[k], b[k], c[k]})));
      };
      const auto last = [&](int k) {
        return std::min(n - 1, static_cast<int>(std::max({a[k], b[k], c[k]})));
      };
      for (int y = first(1); y <= last(1); ++y)
        for (int x = first(0); x <= last(0); ++x) {
          const double u =
              ((b.x - x - 0.5) * (c.y - y - 0.5) - (b.y - y - 0.5) * (c.x - x - 0.5)) / area;
          const double v =
              ((c.x - x - 0.5) * (a.y - y - 0.5) - (c.y - y - 0.5) * (a.x - x - 0.5)) / area;
          if (u >= 0 && v >= 0 && u + v <= 1) covered[static_cast<std::size_t>(y * n + x)] = true;
        }
    }
  }
  return static_cast<double>(std::count(covered.begin(), covered.end(), true)) / (n * n);
}

void expect_calm(const CameraPath& path) {
  for (std::size_t i = 1; i < path.samples.size(); ++i) {
    const PathSample &a = path.samples[i - 1], &b = path.samples[i];
    const double dt = b.time_s - a.time_s;
    ASSERT_GT(dt, 0);
    EXPECT_LE(glm::length(b.eye - a.eye) / dt, 30);
    const double turn = std::acos(std::min(1.0, glm::dot(a.forward, b.forward)));
    EXPECT_LE(glm::degrees(turn) / dt, 45);
    EXPECT_NEAR(glm::length(b.forward), 1, 1e-12);
    EXPECT_TRUE(b.eye.z >= 16 && b.eye.z <= 20) << b.eye.z;
  }
}

// The eye, wherever it is between samples, keeps from all statues of the 8M park.
void expect_clear(const CameraPath& path, const std::vector<ConvexPolygon>& footprints) {
  for (const Camera& camera : sample_path(path, 4 * path.samples.size()))
    for (const ConvexPolygon& footprint : footprints) {
      const glm::dvec2 eye(camera.eye);
      if (glm::length(footprint[0] - eye) > 100) continue;  // farther than any statue is long
      ASSERT_GT(distance({eye}, footprint), 3 + 1.3);
    }
}

// The hexagon of circumradius 50 that the point is in, by its six edges, and its corners.
ConvexPolygon hexagon_at(const glm::dvec2& p) {
  for (int column = 0; column < 24; ++column)
    for (int row = 0; row < 25; ++row) {
      const glm::dvec2 centre(75 * column, 50 * std::sqrt(3.0) * (row + 0.5 * (column % 2)));
      ConvexPolygon corners;
      for (int k = 0; k < 6; ++k)
        corners.push_back(centre + 50.0 * glm::dvec2(std::cos(k * std::numbers::pi / 3),
                                                     std::sin(k * std::numbers::pi / 3)));
      if (contains(corners, p)) return corners;
    }
  ADD_FAILURE() << "no cell at " << p.x << " " << p.y;
  return {};
}

// What the issue asks of every walk, measured here without the walk's own report.
void expect_worth_seeing(const CameraPath& path, const std::vector<SceneObject>& objects,
                         const std::vector<ConvexPolygon>& footprints, std::size_t n_objects) {
  const auto cameras = sample_path(path, 120);
  int n_inside = 0, n_large = 0;
  std::set<std::pair<int, int>> cells;
  for (const Camera& camera : cameras) {
    const ConvexPolygon hexagon = hexagon_at(glm::dvec2(camera.eye));
    cells.insert(
        {static_cast<int>(std::lround(hexagon[0].x)), static_cast<int>(std::lround(hexagon[0].y))});
    bool is_inside = false, sees_large = false;
    for (std::size_t i = 0; i < n_objects; ++i) {
      if (distance(hexagon, footprints[i]) > 0) continue;
      is_inside = true;
      const glm::dvec2 way =
          glm::normalize(glm::dvec2(objects[i].translation) - glm::dvec2(camera.eye));
      sees_large |=
          index(objects[i].mesh) < 2 &&
          glm::dot(way, glm::normalize(glm::dvec2(camera.forward))) > std::cos(glm::radians(28.0));
    }
    n_inside += is_inside;
    n_large += sees_large;
  }
  EXPECT_GE(n_inside, 12);
  EXPECT_GE(n_large, 2);
  EXPECT_GE(cells.size(), 12u);
}

double mean_coverage(const std::vector<SceneMesh>& meshes, std::span<const SceneObject> objects,
                     const CameraPath& path) {
  double sum = 0;
  for (const Camera& camera : sample_path(path, 24))
    sum += draw_coverage(meshes, objects, camera, 160) / 24;
  return sum;
}

TEST(Walk, IsCalmClearAndWorthSeeingForAnySeed) {
  const std::vector<SceneMesh> meshes = make_stand_ins();
  for (const std::uint64_t seed : {0u, 77u}) {
    SCOPED_TRACE(seed);
    const auto objects = scatter_statues(meshes, seed);
    std::vector<ConvexPolygon> footprints;
    for (const SceneObject& object : objects)
      footprints.push_back(
          place_footprint(make_footprint(meshes[index(object.mesh)].mesh), object));
    const Walks walks = make_walks(meshes, objects, seed);
    for (const Walk* walk : {&walks.whole, &walks.brief}) {
      expect_calm(walk->path);
      expect_clear(walk->path, footprints);
      expect_worth_seeing(walk->path, objects, footprints, 132);
    }
    expect_worth_seeing(walks.whole.path, objects, footprints, 64);
    EXPECT_GE(walks.brief.report.n_cells, 12);
    EXPECT_LE(walks.brief.report.n_cells, 20);
    const std::span all(objects);
    const double small = mean_coverage(meshes, all.first(64), walks.whole.path);
    const double large = mean_coverage(meshes, all, walks.whole.path);
    EXPECT_GE(small, 0.05);
    EXPECT_GE(large, 0.13);
    EXPECT_NEAR(walks.whole.report.coverage[0], small, 0.2 * small);
    EXPECT_NEAR(walks.whole.report.coverage[2], large, 0.2 * large);
  }
}

TEST(Walk, IsTheSameForEveryPresetAndThreadCount) {
  const std::vector<SceneMesh> meshes = make_stand_ins();
  const auto text = [](const CameraPath& path) {
    return format_json(format_path(path, {{"tool", "test"}}));
  };
  const auto park = [&](std::size_t preset, int n_threads) {
    return make_park(meshes, park_presets()[preset], 5, n_threads);
  };
  const Park demo = park(0, 2), p2 = park(1, 1), p4 = park(2, 3), p8 = park(3, 2);
  EXPECT_EQ(text(p2.path), text(p4.path));
  EXPECT_EQ(text(p2.path), text(p8.path));
  const auto is_subset = [](const Park& a, const Park& b) {
    for (std::size_t i = 0; i < a.scene.objects.size(); ++i) {
      const SceneObject &x = a.scene.objects[i], &y = b.scene.objects[i];
      if (x.name != y.name || x.translation != y.translation || x.rotation != y.rotation ||
          x.mesh != y.mesh || x.materials != y.materials)
        return false;
    }
    return a.scene.objects.size() <= b.scene.objects.size();
  };
  EXPECT_TRUE(is_subset(p2, p4) && is_subset(p4, p8) && is_subset(demo, p4) && is_subset(p4, demo));
  EXPECT_EQ(count_triangles(p2.scene), 2017700u);
  EXPECT_EQ(count_triangles(p4.scene), 4188885u);
  EXPECT_EQ(count_triangles(p8.scene), 8004863u);
  // the demo's walk is a piece of the whole one
  const auto& whole = p4.path.samples;
  const auto& brief = demo.path.samples;
  const auto start = std::find_if(whole.begin(), whole.end(),
                                  [&](const PathSample& s) { return s.eye == brief[0].eye; });
  ASSERT_LE(brief.size(), static_cast<std::size_t>(whole.end() - start));
  for (std::size_t i = 0; i < brief.size(); ++i) {
    EXPECT_EQ(brief[i].eye, start[static_cast<std::ptrdiff_t>(i)].eye);
    EXPECT_EQ(brief[i].forward, start[static_cast<std::ptrdiff_t>(i)].forward);
  }
}

}  // namespace
}  // namespace viewcell
