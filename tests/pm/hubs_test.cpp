// Vertices of very many triangles.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "pm/build.h"
#include "pm/shapes.h"
#include "pm/simplify.h"
#include "pm/ways.h"

namespace viewcell {
namespace {

glm::vec3 on_circle(std::uint32_t i, std::uint32_t n, double radius, double z) {
  const double angle = 6.283185307179586 * i / n;
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

// n pages at the edge 0 1.
TriMesh make_book(std::uint32_t n) {
  TriMesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 1}};
  for (std::uint32_t i = 0; i < n; ++i) {
    mesh.positions.push_back(on_circle(i, n, 1, 0.5));
    mesh.triangles.push_back({0, 1, i + 2});
  }
  return mesh;
}

// Two tips, 0 and 1, and n sides; open: the first alone.
TriMesh make_cones(std::uint32_t n, bool is_open) {
  TriMesh mesh;
  mesh.positions = {{0, 0, 1}, {0, 0, -1}};
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t a = i + 2, b = (i + 1) % n + 2;
    mesh.positions.push_back(on_circle(i, n, 1, 0));
    mesh.triangles.push_back({0, a, b});
    if (!is_open) mesh.triangles.push_back({1, b, a});
  }
  return mesh;
}

// A pipe of n sides with lids around 0 and 1.
TriMesh make_pipe(std::uint32_t n) {
  TriMesh mesh;
  mesh.positions = {{0, 0, -1}, {0, 0, 1}};
  for (const int z : {-1, 1})
    for (std::uint32_t i = 0; i < n; ++i) mesh.positions.push_back(on_circle(i, n, 1, z));
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t a = 2 + i, b = 2 + (i + 1) % n, c = n + a, d = n + b;
    mesh.triangles.insert(mesh.triangles.end(), {{0, b, a}, {1, c, d}, {a, b, d}, {a, d, c}});
  }
  return mesh;
}

// n spikes on the triangle 0 1 2: three hubs with triangles in common.
TriMesh make_spikes(std::uint32_t n) {
  TriMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t k = i + 3;
    mesh.positions.push_back(glm::vec3(0.3f, 0.3f, 0.2f + float(i) / float(n)) +
                             on_circle(7 * i, n, 0.1, 0));
    mesh.triangles.insert(mesh.triangles.end(), {{0, 1, k}, {1, 2, k}, {2, 0, k}});
  }
  return mesh;
}

void add_texture(TriMesh& mesh) {
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) {
      const glm::vec3& p = mesh.positions[v];
      mesh.texcoords.emplace_back(0.5f + 0.3f * p.x + 0.1f * p.z, 0.5f + 0.3f * p.y);
    }
}

struct Shape {
  const char* name;
  TriMesh (*make)(std::uint32_t n);
};
const Shape kShapes[] = {{"book", make_book},
                         {"cone", [](std::uint32_t n) { return make_cones(n, true); }},
                         {"cones", [](std::uint32_t n) { return make_cones(n, false); }},
                         {"pipe", make_pipe},
                         {"spikes", make_spikes}};

using Faces = std::map<std::uint32_t, Triangle>;

// What is left, face by face, told the collapses one after another.
void collapse_faces(Faces& faces, std::uint32_t u, std::uint32_t v) {
  std::erase_if(faces, [&](const auto& f) {
    const auto has = [&](std::uint32_t w) {
      return std::find(f.second.begin(), f.second.end(), w) != f.second.end();
    };
    return has(u) && has(v);
  });
  for (auto& [number, face] : faces)
    for (std::uint32_t& w : face)
      if (w == u) w = v;
}

std::set<std::uint32_t> ring_in(const Faces& faces, std::uint32_t v) {
  std::set<std::uint32_t> out;
  for (const auto& [number, f] : faces)
    if (std::find(f.begin(), f.end(), v) != f.end()) out.insert(f.begin(), f.end());
  out.erase(v);
  return out;
}

// The link condition, from all faces.
bool keeps_link(const Faces& faces, std::uint32_t u, std::uint32_t v) {
  const std::set<std::uint32_t> around_u = ring_in(faces, u), around_v = ring_in(faces, v);
  std::set<std::uint32_t> third;
  std::set<std::set<std::uint32_t>> of_u, of_v;  // opposite edges
  for (const auto& [number, f] : faces) {
    std::set<std::uint32_t> others(f.begin(), f.end());
    const bool has_u = others.erase(u) > 0, has_v = others.erase(v) > 0;
    if (has_u && has_v) third.insert(others.begin(), others.end());
    if (has_u && !has_v) of_u.insert(others);
    if (has_v && !has_u) of_v.insert(others);
  }
  for (const std::uint32_t w : around_u)
    if (w != v && around_v.contains(w) && !third.contains(w)) return false;
  for (const auto& edge : of_u)
    if (of_v.contains(edge)) return false;
  return !third.empty();
}

TEST(Hubs, ListsAndLinksAreThoseOfAllFaces) {
  for (const auto& [name, make] : kShapes)
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      SCOPED_TRACE(testing::Message() << name << ", seed " << seed);
      const TriMesh input = make(200);
      CollapseMesh mesh(input.positions, input.triangles);
      EXPECT_TRUE(mesh.is_hub(0));
      Faces faces;
      for (std::uint32_t t = 0; t < input.triangles.size(); ++t) faces[t] = input.triangles[t];
      Random random(seed);
      std::vector<std::uint32_t> ring;
      const auto n = static_cast<std::uint32_t>(input.positions.size());
      for (int i = 0; i < 250; ++i) {
        const std::uint32_t u = random.below(n);
        const std::set<std::uint32_t> around = ring_in(faces, u);
        mesh.ring(u, ring);
        ASSERT_EQ(std::set<std::uint32_t>(ring.begin(), ring.end()), around);
        if (around.empty()) continue;
        auto v = around.begin();
        std::advance(v, random.below(static_cast<std::uint32_t>(around.size())));
        const bool is_legal = keeps_link(faces, u, *v);
        ASSERT_EQ(mesh.check(u, *v, -1) != Refusal::link, is_legal) << u << " " << *v;
        if (!is_legal && random.below(4)) continue;  // the lists hold for any collapse
        mesh.collapse(u, *v);
        collapse_faces(faces, u, *v);
        std::vector<Triangle> expected;
        for (const auto& [number, face] : faces) expected.push_back(face);
        ASSERT_EQ(mesh.triangles(), expected);
        ASSERT_EQ(mesh.n_triangles(), expected.size());
      }
    }
}

// Eight times the triangles are little more than eight times the work, whatever the way.
TEST(Hubs, WorkIsInProportionToTheTriangles) {
  for (const auto& [name, make] : kShapes)
    for (const Way& way : kWays)
      for (const bool lazy : {true, false}) {
        SCOPED_TRACE(testing::Message() << name << " " << metric_name(way.metric) << " "
                                        << placement_name(way.placement) << " lazy " << lazy);
        if (!lazy && texture_needs(options_of(way)).no_folds) continue;
        double per_face[2];
        for (const std::uint32_t n : {300u, 2400u}) {
          TriMesh mesh = make(n);
          if (texture_needs(options_of(way)).coordinates) add_texture(mesh);
          BuildOptions options = options_of(way);
          options.lazy = lazy;
          const BuildResult built = build_progressive_mesh(mesh, options);
          per_face[n > 300] = double(built.counts.n_visited) / double(mesh.triangles.size());
        }
        EXPECT_LT(per_face[1], 1.2 * per_face[0] + 40);
      }
}

TEST(Hubs, SoAreChainsOfLevels) {
  for (const auto& [name, make] : kShapes) {
    SCOPED_TRACE(name);
    double per_face[2];
    for (const std::uint32_t n : {1000u, 8000u}) {
      const TriMesh mesh = make(n);
      const SimplifyResult result = simplify(mesh, {.target_triangles = 100});
      per_face[n > 1000] = double(result.counts.n_visited) / double(mesh.triangles.size());
    }
    EXPECT_LT(per_face[1], 1.5 * per_face[0] + 50);
  }
}

// Their rims collapse until they are hubs no more, and then as all others do.
TEST(Hubs, AreSimplifiedToTheCountAskedForAndBackToTheInput) {
  for (const Shape& shape : {kShapes[1], kShapes[2], kShapes[3]})
    for (const Way& way : kWays) {
      SCOPED_TRACE(testing::Message() << shape.name << " " << metric_name(way.metric) << " "
                                      << placement_name(way.placement));
      TriMesh mesh = shape.make(1500);
      if (texture_needs(options_of(way)).coordinates) add_texture(mesh);
      BuildOptions options = options_of(way);
      options.target_faces = 60;
      const BuildResult built = build_progressive_mesh(mesh, options);
      EXPECT_EQ(check_record(built.record), "");
      ProgressiveMesh pm(built.record);
      EXPECT_LE(pm.n_faces(), 60u);
      pm.set_level(pm.n_splits());
      EXPECT_EQ(pm.extract().positions, mesh.positions);
      EXPECT_EQ(pm.extract().triangles, mesh.triangles);
    }
}

// Of a book of flat pages the least pages go first, and those that stay are as they were.
TEST(Hubs, PagesGoInOrderOfTheirSize) {
  TriMesh book = make_book(600);
  for (std::uint32_t i = 0; i < 600; ++i)
    book.positions[i + 2] *= glm::vec3(1.0f + float(i) / 100, 1.0f + float(i) / 100, 1);
  const SimplifyResult result = simplify(book, {.target_triangles = 300});
  EXPECT_EQ(result.mesh.triangles.size(), 300u);
  double sum = 0;
  for (const std::uint32_t v : result.source_vertex) sum += v >= 2 ? v - 2 : 0;
  EXPECT_GT(sum / 300, 400);  // 449.5 if none but the 300 largest stayed
}

}  // namespace
}  // namespace viewcell
