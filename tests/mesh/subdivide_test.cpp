#include "mesh/subdivide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <tuple>

#include "base/random.h"
#include "common/expect_input_error.h"
#include "common/models.h"
#include "formats/mesh_file.h"
#include "mesh/cube.h"
#include "mesh/surfaces.h"
#include "mesh/topology.h"
#include "uv/texcoord_drift.h"
#include "uv/uv_stretch.h"

namespace viewcell {
namespace {

constexpr TexcoordRule kRules[] = {TexcoordRule::smooth, TexcoordRule::inside,
                                   TexcoordRule::linear};

SubdivideOptions make_options(int n_times, SubdivisionScheme scheme = SubdivisionScheme::loop,
                              TexcoordRule texcoords = TexcoordRule::inside) {
  return {n_times, scheme, texcoords};
}

double distance(const glm::vec3& a, const glm::dvec3& b) {
  return glm::length(glm::dvec3(a) - b);
}

bool has_position(const TriMesh& mesh, const glm::dvec3& p) {
  return std::any_of(mesh.positions.begin(), mesh.positions.end(),
                     [&p](const glm::vec3& q) { return distance(q, p) < 1e-6; });
}

// +x -x +y -y +z -z
TriMesh make_octahedron() {
  TriMesh mesh;
  mesh.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  return mesh;
}

// The mesh with a vertex of its own at every corner.
TriMesh take_apart(const TriMesh& mesh) {
  TriMesh out = mesh;
  out.positions.clear(), out.triangles.clear();
  for (const Triangle& t : mesh.triangles) {
    const auto n = static_cast<std::uint32_t>(out.positions.size());
    for (const std::uint32_t v : t) out.positions.push_back(mesh.positions[v]);
    out.triangles.push_back({n, n + 1, n + 2});
  }
  return out;
}

// Charts: parts of the surface joined across edges with the same texture coordinates on both sides.
std::size_t count_charts(const TriMesh& mesh) {
  using Key = std::tuple<std::uint32_t, float, float>;
  std::map<Key, std::uint32_t> wedges;
  TriMesh charts;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Triangle wedge;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::vec2 uv = mesh.texcoords[3 * t + k];
      const auto n = static_cast<std::uint32_t>(wedges.size());
      wedge[k] = wedges.try_emplace({mesh.triangles[t][k], uv.x, uv.y}, n).first->second;
    }
    charts.triangles.push_back(wedge);
  }
  charts.positions.resize(wedges.size());
  return measure_topology(charts).n_components;
}

// A valence of four: 5/8 of the vertex, the ring adds up to nothing; edges 3/8 (a + b), for c = -d.
TEST(Subdivide, OctahedronByHand) {
  const TriMesh mesh = subdivide(make_octahedron(), make_options(1)).mesh;
  ASSERT_EQ(mesh.triangles.size(), 32u);
  ASSERT_EQ(mesh.positions.size(), 18u);
  EXPECT_LT(distance(mesh.positions[0], {0.625, 0, 0}), 1e-7);
  EXPECT_LT(distance(mesh.positions[5], {0, 0, -0.625}), 1e-7);
  for (const double x : {-0.375, 0.375})
    for (const double y : {-0.375, 0.375}) {
      EXPECT_TRUE(has_position(mesh, {x, y, 0}));
      EXPECT_TRUE(has_position(mesh, {x, 0, y}));
      EXPECT_TRUE(has_position(mesh, {0, x, y}));
    }
  // Children of the first triangle: at its corners, then in its middle, all in its turn.
  EXPECT_EQ(mesh.triangles[0][0], 0u);
  EXPECT_EQ(mesh.triangles[1][1], 2u);
  EXPECT_EQ(mesh.triangles[2][2], 4u);
  EXPECT_EQ(mesh.triangles[3],
            (Triangle{mesh.triangles[0][1], mesh.triangles[1][2], mesh.triangles[2][0]}));
  EXPECT_TRUE(measure_topology(mesh).is_closed_manifold());
}

// In the limit a vertex of n edges is at (1 - n x) v + x (ring), x = 1 / (3 / (8 beta) + n): 1/8
// for four edges; and a vertex of a crease at 4/6 v + 1/6 (its two neighbours).
TEST(Subdivide, Limits) {
  const TriMesh ball = subdivide(make_octahedron(), make_options(6)).mesh;
  EXPECT_LT(distance(ball.positions[2], {0, 0.5, 0}), 1e-3);
  TriMesh triangle;
  triangle.positions = {{0, 0, 0}, {6, 0, 0}, {0, 6, 0}};
  triangle.triangles = {{0, 1, 2}};
  const TriMesh blob = subdivide(triangle, make_options(8)).mesh;
  EXPECT_EQ(blob.triangles.size(), 65536u);
  EXPECT_LT(distance(blob.positions[1], {4, 1, 0}), 1e-3);
}

// Three edges: 7/16 of the vertex and 3/16 of each neighbour; the ring is -v for the middle at 0.
TEST(Subdivide, TetrahedronByHand) {
  TriMesh mesh;
  mesh.positions = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  const TriMesh out = subdivide(mesh, make_options(1)).mesh;
  EXPECT_LT(distance(out.positions[0], glm::dvec3(0.25)), 1e-7);
}

TEST(Subdivide, OneTriangleByHand) {
  TriMesh mesh;
  mesh.positions = {{0, 0, 0}, {8, 0, 0}, {0, 8, 0}};
  mesh.triangles = {{0, 1, 2}};
  const TriMesh out = subdivide(mesh, make_options(1)).mesh;
  EXPECT_LT(distance(out.positions[0], {1, 1, 0}), 1e-7);
  EXPECT_LT(distance(out.positions[1], {6, 1, 0}), 1e-7);
  for (const glm::dvec3& middle : {glm::dvec3(4, 0, 0), {4, 4, 0}, {0, 4, 0}})
    EXPECT_TRUE(has_position(out, middle));
}

// Three wings on the edge 0-1: all four edges at 0 and at 1 are creases, so these stay.
TEST(Subdivide, ThreeTrianglesOnAnEdge) {
  TriMesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 0, 0}, {1, 2, 0}, {1, -2, 0}, {1, 0, 2}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  const TriMesh out = subdivide(mesh, make_options(1)).mesh;
  EXPECT_EQ(out.positions[0], mesh.positions[0]);
  EXPECT_EQ(out.positions[1], mesh.positions[1]);
  EXPECT_TRUE(has_position(out, {1, 0, 0}));
  EXPECT_LT(distance(out.positions[2], {1, 1.5, 0}), 1e-7);
  EXPECT_EQ(measure_topology(out).n_nonmanifold_edges, 2u);
}

// A plane stays a plane, and what is affine over it stays affine, up to the plane's border.
TEST(Subdivide, PlanesStayPlanesAndAffineStaysAffine) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    TriMesh mesh = make_grid(4, 0.2, seed);
    const auto height = [](const glm::vec2& p) { return 0.5f * p.x - 0.25f * p.y + 1; };
    const auto texcoord = [](const glm::vec3& p) {
      return glm::vec2(0.3f * p.x + 0.2f * p.y, 0.1f + 0.5f * p.y - 0.1f * p.x);
    };
    for (glm::vec3& p : mesh.positions) p.z = height(p), mesh.colors.push_back(0.5f * p);
    for (const Triangle& t : mesh.triangles)
      for (const std::uint32_t v : t) mesh.texcoords.push_back(texcoord(mesh.positions[v]));
    for (const SubdivisionScheme scheme : {SubdivisionScheme::loop, SubdivisionScheme::midpoint}) {
      const TriMesh out = subdivide(mesh, make_options(3, scheme, TexcoordRule::smooth)).mesh;
      ASSERT_EQ(out.triangles.size(), 64 * mesh.triangles.size());
      for (std::size_t v = 0; v < out.positions.size(); ++v) {
        const glm::vec3& p = out.positions[v];
        EXPECT_NEAR(p.z, height(p), 1e-6);
        EXPECT_LT(distance(out.colors[v], 0.5f * p), 1e-6);
      }
      for (std::size_t c = 0; c < out.texcoords.size(); ++c) {
        const glm::vec2 wanted = texcoord(out.positions[out.triangles[c / 3][c % 3]]);
        EXPECT_LT(glm::length(out.texcoords[c] - wanted), 1e-6);
      }
    }
  }
}

TEST(Subdivide, ClosedStaysClosed) {
  const TriMesh ball = make_ball(5);
  for (int n = 0; n <= 3; ++n) {
    const Subdivision out = subdivide(take_apart(ball), make_options(n));
    EXPECT_EQ(out.mesh.triangles.size(), ball.triangles.size() << (2 * n));
    EXPECT_EQ(out.n_welded, 3 * ball.triangles.size() - ball.positions.size());
    const MeshTopology topology = measure_topology(out.mesh);
    EXPECT_TRUE(topology.is_closed_manifold());
    EXPECT_EQ(topology.euler_characteristic, 2);
    EXPECT_EQ(topology.n_unreferenced_vertices, 0u);
  }
}

// A closed surface whose charts are its squares: positions are those of the surface without, charts
// stay apart, their outlines straight where asked, and each child has its place in the texture.
TEST(Subdivide, ChartsStayChartsAndSeamsClosed) {
  TriMesh cube;
  cube.positions = cube_positions(), cube.triangles = cube_triangles();
  const TriMesh plain = subdivide(cube, make_options(2)).mesh;
  for (std::size_t square = 0; square < 6; ++square) {
    const float u = 0.5f + 2 * static_cast<float>(square);
    for (const glm::vec2& uv : {glm::vec2{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}})
      cube.texcoords.push_back(uv + glm::vec2(u, 0));
  }
  ASSERT_EQ(count_charts(cube), 6u);
  for (const TexcoordRule rule : kRules) {
    SCOPED_TRACE(static_cast<int>(rule));
    const TriMesh out =
        subdivide(take_apart(cube), make_options(2, SubdivisionScheme::loop, rule)).mesh;
    EXPECT_TRUE(measure_topology(out).is_closed_manifold());
    EXPECT_EQ(count_charts(out), 6u);
    EXPECT_EQ(measure_uv_stretch(out).n_flipped, 0u);
    for (const glm::vec3& p : plain.positions) EXPECT_TRUE(has_position(out, p));
    double area = 0;
    for (std::size_t t = 0; t < out.triangles.size(); ++t) {
      const glm::vec2* uv = &out.texcoords[3 * t];
      area += twice_area(uv[0], uv[1], uv[2]) / 2;
      const double square = std::floor(uv[0].x / 2);
      EXPECT_EQ(square, std::floor(static_cast<double>(t) / 32));  // 2 x 16 of a square
      for (int k = 0; k < 3; ++k) EXPECT_EQ(std::floor(uv[k].x / 2), square);
    }
    // Squares stay squares; or their corners are cut: 1/8 + 1/8 a side, of twelve triangles with
    // area 1/2 (1/8)^2 less at the second time.
    if (rule == TexcoordRule::smooth) {
      EXPECT_LT(area, 5.9);
    } else {
      EXPECT_NEAR(area, 6, 1e-6);
    }
  }
}

// What is smooth inside a chart, and what is not.
TEST(Subdivide, TexcoordsInsideACharts) {
  TriMesh mesh = make_grid(2);
  mesh.positions[4].z = 1;
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t)
      mesh.texcoords.push_back(v == 4 ? glm::vec2(0.75f, 0.5f) : glm::vec2(mesh.positions[v]));
  const auto middle = [&mesh](TexcoordRule rule) {
    const TriMesh out = subdivide(mesh, make_options(1, SubdivisionScheme::loop, rule)).mesh;
    for (std::size_t c = 0; c < out.texcoords.size(); ++c)
      if (out.triangles[c / 3][c % 3] == 4) return out.texcoords[c];
    return glm::vec2(-1);
  };
  // Six edges: 5/8 of 0.75 and 3/8 of the ring's mean, 0.5.
  EXPECT_EQ(middle(TexcoordRule::inside), glm::vec2(0.65625f, 0.5f));
  EXPECT_EQ(middle(TexcoordRule::smooth), glm::vec2(0.65625f, 0.5f));
  EXPECT_EQ(middle(TexcoordRule::linear), glm::vec2(0.75f, 0.5f));
}

// Texture coordinates shifted by (3, 4) hundredths on one of two charts, whose outlines meet.
TEST(TexcoordDrift, ByHand) {
  TriMesh mesh = make_grid(2);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t])
      mesh.texcoords.push_back(glm::vec2(mesh.positions[v]) + glm::vec2(t < 4 ? 0 : 2, 0));
  TriMesh fine = subdivide(mesh, make_options(2, SubdivisionScheme::midpoint)).mesh;
  TexcoordDrift drift = measure_texcoord_drift(mesh, fine);
  EXPECT_NEAR(drift.max, 0, 1e-6);
  EXPECT_EQ(drift.n_compared, fine.triangles.size());
  for (std::size_t c = 0; c < fine.texcoords.size() / 2; ++c)
    fine.texcoords[c] += glm::vec2(0.03f, 0.04f);
  drift = measure_texcoord_drift(mesh, fine);
  EXPECT_NEAR(drift.max, 0.05, 1e-6);
  EXPECT_NEAR(drift.rms, 0.05 * std::sqrt(0.5), 1e-6);
  for (glm::vec3& p : fine.positions) p.y = 1 - p.y;  // each half lies on the other chart
  drift = measure_texcoord_drift(mesh, fine);
  EXPECT_EQ(drift.n_compared, 0u);
  EXPECT_EQ(drift.n_elsewhere, fine.triangles.size());
}

TEST(Subdivide, MidpointsKeepTheSurfaceAndTheTexture) {
  TriMesh mesh = make_ball(4);
  Random random(7);
  for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c)
    mesh.texcoords.emplace_back(random.uniform(), random.uniform());
  const TriMesh out = subdivide(mesh, make_options(2, SubdivisionScheme::midpoint)).mesh;
  const auto areas = [](const TriMesh& m, std::size_t t) {
    const glm::vec2* uv = &m.texcoords[3 * t];
    return glm::dvec2(glm::length(area_normal(m, m.triangles[t])), twice_area(uv[0], uv[1], uv[2]));
  };
  for (std::size_t t = 0; t < out.triangles.size(); ++t)
    EXPECT_LT(glm::length(areas(out, t) - areas(mesh, t / 16) / 16.0), 1e-6);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    EXPECT_EQ(out.positions[v], mesh.positions[v]);
}

// Two squares at a right angle, each in its own colour and with its own normal, however these are
// kept: by corner, or on vertices of their own.
TEST(Subdivide, HardEdgesAndColoursStay) {
  TriMesh corner;
  const glm::vec3 normals[2] = {{0, 0, 1}, {1, 0, 0}}, colors[2] = {{1, 0, 0}, {0, 0, 1}};
  for (int side = 0; side < 2; ++side) {
    const auto n = static_cast<std::uint32_t>(corner.positions.size());
    for (const glm::vec2 at : {glm::vec2(0, 0), {1, 0}, {1, 1}, {0, 1}})
      corner.positions.push_back(side == 0 ? glm::vec3(at.x - 1, at.y, 0)
                                           : glm::vec3(0, at.y, -at.x));
    corner.normals.insert(corner.normals.end(), 4, normals[side]);
    corner.colors.insert(corner.colors.end(), 4, colors[side]);
    corner.triangles.insert(corner.triangles.end(), {{n, n + 1, n + 2}, {n, n + 2, n + 3}});
  }
  TriMesh by_corner = corner;
  for (const Triangle& t : corner.triangles)
    for (const std::uint32_t v : t) by_corner.corner_normals.push_back(corner.normals[v]);
  by_corner.normals.clear();
  for (const TriMesh& input : {corner, by_corner})
    for (const int n_times : {0, 1, 3}) {
      SCOPED_TRACE(n_times);
      const TriMesh out = subdivide(input, {n_times, SubdivisionScheme::midpoint}).mesh;
      ASSERT_EQ(out.triangles.size(), 4u << (2 * n_times));
      for (std::size_t t = 0; t < out.triangles.size(); ++t) {
        const std::size_t side = 2 * t / out.triangles.size();
        for (std::size_t k = 0; k < 3; ++k) {
          EXPECT_EQ(out.corner_normals.at(3 * t + k), normals[side]);
          EXPECT_EQ(out.colors.at(out.triangles[t][k]), colors[side]);
          EXPECT_EQ(out.positions[out.triangles[t][k]][side == 0 ? 2 : 0], 0);
        }
      }
      const std::size_t n = (1u << n_times) + 1;
      EXPECT_EQ(out.positions.size(), 2 * n * n);  // split where they meet
    }
  const TriMesh smooth = subdivide(corner, {2, SubdivisionScheme::loop}).mesh;
  for (std::size_t t = 0; t < smooth.triangles.size(); ++t)
    for (const std::uint32_t v : smooth.triangles[t])
      EXPECT_EQ(smooth.colors[v], colors[2 * t / smooth.triangles.size()]);
}

TEST(Subdivide, WeldsDropsAndKeepsMaterials) {
  TriMesh mesh;
  mesh.positions = {{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.triangles = {{1, 2, 4}, {2, 3, 4}, {3, 5, 4}};
  mesh.normals.assign(6, {0, 1, 0});
  mesh.materials = {0, 1, 2};
  mesh.material_names = {"a", "b", "c"};
  const Subdivision out = subdivide(mesh, make_options(1));
  EXPECT_EQ(out.n_welded, 1u);
  EXPECT_EQ(out.n_dropped, 1u);
  EXPECT_EQ(out.mesh.materials, (std::vector<std::int32_t>{0, 0, 0, 0, 2, 2, 2, 2}));
  EXPECT_EQ(out.mesh.material_names, mesh.material_names);
  EXPECT_EQ(out.mesh.positions.size(), 9u);
  EXPECT_EQ(measure_topology(out.mesh).euler_characteristic, 1);
  ASSERT_EQ(out.mesh.normals.size(), 9u);
  EXPECT_EQ(out.mesh.normals[0], glm::vec3(0, 0, 1));
}

TEST(Subdivide, RefusesTooMuchAndNothing) {
  EXPECT_INPUT_ERROR(subdivide(make_octahedron(), make_options(12), "a.obj"),
                     "a.obj: 8 triangles become more than 100000000");
  EXPECT_INPUT_ERROR(subdivide(make_octahedron(), make_options(200), "a.obj"), "a.obj");
  TriMesh flat;
  flat.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}};
  flat.triangles = {{0, 1, 2}};
  EXPECT_INPUT_ERROR(subdivide(flat, {}, "b.obj"), "b.obj: has no triangle");
}

// Anything at all: no crash, 4^n triangles, finite.
TEST(Subdivide, SoupsOfTriangles) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    TriMesh mesh;
    for (int v = 0; v < 7; ++v)
      mesh.positions.emplace_back(random.below(3), random.below(3), random.below(3));
    for (int t = 0; t < 12; ++t) {
      mesh.triangles.push_back({random.below(7), random.below(7), random.below(7)});
      for (int k = 0; k < 3; ++k) mesh.texcoords.emplace_back(random.below(2), random.below(2));
    }
    const Subdivision coarse = subdivide(mesh, make_options(0));
    EXPECT_EQ(coarse.mesh.triangles.size() + coarse.n_dropped, mesh.triangles.size());
    const Subdivision fine = subdivide(mesh, make_options(2));
    EXPECT_EQ(fine.mesh.triangles.size(), 16 * coarse.mesh.triangles.size());
    EXPECT_EQ(fine.mesh.texcoords.size(), 3 * fine.mesh.triangles.size());
    for (const glm::vec3& p : fine.mesh.positions)
      EXPECT_TRUE(glm::all(glm::greaterThanEqual(p, glm::vec3(0))) &&
                  glm::all(glm::lessThanEqual(p, glm::vec3(2))));
  }
}

// Closed, of genus 0, in several charts.
void expect_subdivided_twice(const TriMesh& mesh, std::size_t n_triangles, std::size_t n_charts) {
  const TriMesh out = subdivide(mesh, make_options(2)).mesh;
  EXPECT_EQ(out.triangles.size(), 16 * n_triangles);
  EXPECT_EQ(measure_topology(out).euler_characteristic, 2);
  EXPECT_TRUE(measure_topology(out).is_closed_manifold());
  EXPECT_EQ(count_charts(out), n_charts);
}

TEST(Subdivide, AFigureInCharts) {
  expect_subdivided_twice(make_gored_figure(30, 6), 4 * 30 * 29, 6);
}

TEST(OutsideSubdivide, Spot) {
  const std::filesystem::path file =
      std::filesystem::path(VIEWCELL_SHARED_DATA) / "spot-6k/spot_triangulated.obj";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not here";
  expect_subdivided_twice(read_mesh(file), 5856, 13);
}

}  // namespace
}  // namespace viewcell
