#include "play/hybrid_plan.h"

#include <gtest/gtest.h>

#include <set>

#include "bake/small_bake.h"
#include "scene/in_frame.h"

namespace viewcell {
namespace {

struct Grid {
  HexGrid grid{{0, 0}, 40, 6, 6};
  std::array<glm::dvec3, kViews> centres_of_cell(CellId cell) const {
    std::array<glm::dvec3, kViews> out;
    const auto place = coord_of(grid, cell);
    out[0] = glm::dvec3(centre_of(grid, place), 18);
    for (int k = 0; k < 6; ++k)
      out[static_cast<std::size_t>(k) + 1] = glm::dvec3(centre_of(grid, neighbour(place, k)), 18);
    return out;
  }
  // Within the hexagon shrunk by `share`.
  glm::dvec2 random_point(CellId cell, Random& random, double share = 1) const {
    const auto place = coord_of(grid, cell);
    for (;;) {
      const glm::dvec2 d = grid.size * glm::dvec2(random.uniform(-1, 1), random.uniform(-1, 1));
      if (contains(corners_of(grid, place), centre_of(grid, place) + d))
        return centre_of(grid, place) + share * d;
    }
  }
};

const CellId kCell{14};

// The weight of each view, 0 when it is not chosen.
std::array<double, kViews> weights_of(const ViewChoice& choice) {
  std::array<double, kViews> out{};
  for (std::size_t i = 0; i < 2; ++i)
    if (choice.view[i] >= 0)
      out[static_cast<std::size_t>(choice.view[i])] += static_cast<double>(choice.weight[i]);
  return out;
}

TEST(ChooseViews, SumToOneAndAreAvailable) {
  const Grid g;
  const auto centres = g.centres_of_cell(kCell);
  Random random(1);
  for (int k = 0; k < 20000; ++k) {
    const glm::dvec3 eye(g.random_point(kCell, random), random.uniform(16, 20));
    const glm::dvec3 middle(random.uniform(-200, 400), random.uniform(-200, 400),
                            random.uniform(0, 40));
    const unsigned available = random.below(128);
    const ViewChoice choice = choose_views(eye, middle, centres, available);
    const int n = __builtin_popcount(available);
    ASSERT_EQ(choice.view[0] >= 0, n > 0) << "case " << k;
    ASSERT_EQ(choice.view[1] >= 0, n > 1) << "case " << k;
    for (std::size_t i = 0; i < 2; ++i) {
      if (choice.view[i] >= 0) {
        ASSERT_TRUE(available >> choice.view[i] & 1) << "case " << k;
      }
      ASSERT_GE(choice.weight[i], 0) << "case " << k;
      ASSERT_LE(choice.weight[i], 1) << "case " << k;
    }
    ASSERT_NEAR(choice.weight[0] + choice.weight[1], 1, 1e-6) << "case " << k;
    ASSERT_GE(choice.weight[0], choice.weight[1]) << "case " << k;
    if (n > 1) {
      ASSERT_NE(choice.view[0], choice.view[1]);
    }
    if (n == 1) {
      ASSERT_EQ(choice.weight[0], 1) << "case " << k;
    }
  }
}

double most_change(const ViewChoice& a, const ViewChoice& b) {
  const auto wa = weights_of(a), wb = weights_of(b);
  double most = 0;
  for (std::size_t v = 0; v < kViews; ++v) most = std::max(most, std::abs(wa[v] - wb[v]));
  return most;
}

// Whichever way the eye walks, no view's weight jumps, also where the choice changes. Near
// the line through a centre weights are steep: a step that changes much is halved until it is short
// against the least angle that counts. A jump would stay as large.
TEST(ChooseViews, NothingPopsAlongAPath) {
  const Grid g;
  const auto centres = g.centres_of_cell(kCell);
  constexpr int kSteps = 1000;
  std::size_t n_changes = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Random random(seed);
    const glm::dvec3 from(g.random_point(kCell, random), random.uniform(16, 20));
    const glm::dvec3 to(g.random_point(kCell, random), random.uniform(16, 20));
    const double a = random.uniform(0, glm::two_pi<double>()), r = random.uniform(60, 250);
    const glm::dvec3 middle =
        centres[0] + glm::dvec3(r * std::cos(a), r * std::sin(a), random.uniform(-10, 20));
    const unsigned available = seed % 2 ? 0x7f : 1 + random.below(127);
    const auto at = [&](double t) {
      return choose_views(glm::mix(from, to, t), middle, centres, available);
    };
    for (int i = 0; i < kSteps; ++i) {
      double lo = double(i) / kSteps, hi = double(i + 1) / kSteps;
      n_changes += at(lo).view != at(hi).view;
      for (int k = 0; k < 30 && most_change(at(lo), at(hi)) > 0.005; ++k) {
        const double mid = 0.5 * (lo + hi);
        (most_change(at(lo), at(mid)) > most_change(at(mid), at(hi)) ? hi : lo) = mid;
      }
      ASSERT_LE(most_change(at(lo), at(hi)), 0.005) << "seed " << seed << " step " << i;
    }
  }
  EXPECT_GT(n_changes, 100u);
}

TEST(ChooseViews, TheViewThatTheEyeStandsAtWins) {
  const Grid g;
  const auto centres = g.centres_of_cell(kCell);
  const glm::dvec3 middle(300, 200, 12);
  for (int k = 0; k < kViews; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const ViewChoice choice = choose_views(centres[at], middle, centres, 0x7f);
    EXPECT_EQ(choice.view[0], k);
    EXPECT_GT(choice.weight[0], 0.999f);
  }
  // On the line through two centres, seen from beyond: the angles are equal and zero.
  const glm::dvec3 beyond = centres[0] + 3.0 * (centres[0] - centres[1]);
  const ViewChoice tie = choose_views(0.5 * (centres[0] + centres[1]), beyond, centres, 0x7f);
  EXPECT_EQ(tie.view, (std::array<int, 2>{0, 1}));
  EXPECT_NEAR(tie.weight[0], 0.5, 1e-3);
}

TEST(ChooseViews, DegenerateEyesGiveNumbers) {
  const Grid g;
  const auto centres = g.centres_of_cell(kCell);
  for (const glm::dvec3& middle : {centres[0], centres[3], glm::dvec3(0)})
    for (const glm::dvec3& eye : {middle, centres[0], centres[3]})
      for (unsigned available = 0; available < 128; ++available)
        for (const float w : choose_views(eye, middle, centres, available).weight) {
          ASSERT_TRUE(std::isfinite(w));
          ASSERT_GE(w, 0);
        }
  std::array<glm::dvec3, kViews> same;
  same.fill({1, 2, 3});
  for (const float w : choose_views({9, 9, 9}, {0, 0, 0}, same, 0x7f).weight)
    EXPECT_TRUE(std::isfinite(w));
}

// The face through which the segment from the eye leaves the hexagon.
int face_between(const HexGrid& grid, CellId cell, const glm::dvec2& eye, const glm::dvec2& point) {
  const glm::dvec2 centre = centre_of(grid, coord_of(grid, cell));
  const double apothem = std::sqrt(0.75) * grid.size;
  int face = -1;
  double first = 1;
  for (int k = 0; k < 6; ++k) {
    const double a = glm::radians(30.0 + 60.0 * k);
    const glm::dvec2 n(std::cos(a), std::sin(a));
    const double from = glm::dot(eye - centre, n), to = glm::dot(point - centre, n);
    if (to <= apothem) continue;
    const double t = (apothem - from) / (to - from);
    if (t < first) first = t, face = k;
  }
  return face;
}

TEST(Windows, WhatIsSeenIsSeenThroughAVisibleWindow) {
  const Grid g;
  std::size_t n_seen = 0, n_closed = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    for (int k = 0; k < 50; ++k) {
      Camera camera;
      camera.eye = glm::dvec3(g.random_point(kCell, random), random.uniform(16, 20));
      camera.forward = glm::normalize(
          glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-0.8, 0.8)));
      camera.fov_y_deg = random.uniform(20, 90);
      camera.aspect = random.uniform(0.5, 2);
      const std::uint8_t windows = find_visible_windows(g.grid, kCell, camera);
      n_closed += static_cast<std::size_t>(6 - __builtin_popcount(windows));
      for (int i = 0; i < 200; ++i) {
        const glm::dvec3 p =
            camera.eye + random.uniform(1, 300) *
                             glm::normalize(glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1),
                                                       random.uniform(-1, 1)));
        if (!is_in_frame(camera, p)) continue;
        const int face = face_between(g.grid, kCell, glm::dvec2(camera.eye), glm::dvec2(p));
        if (face < 0) continue;
        ++n_seen;
        ASSERT_TRUE(windows >> face & 1) << "seed " << seed << " camera " << k << " face " << face;
      }
    }
  }
  EXPECT_GT(n_seen, 20000u);
  EXPECT_GT(n_closed, 2000u);  // it culls, too
}

TEST(Windows, ByHand) {
  const Grid g;
  Camera camera;
  camera.eye = glm::dvec3(centre_of(g.grid, coord_of(g.grid, kCell)), 18);
  camera.fov_y_deg = 50;
  for (int face = 0; face < 6; ++face) {
    const double a = glm::radians(30.0 + 60.0 * face);
    camera.forward = {std::cos(a), std::sin(a), 0};
    // The one behind the eye may count too: the wedge's sides pass it on either hand.
    const unsigned windows = find_visible_windows(g.grid, kCell, camera);
    EXPECT_EQ(windows | 1u << (face + 3) % 6, 1u << face | 1u << (face + 3) % 6) << face;
    EXPECT_TRUE(windows >> face & 1) << face;
  }
  camera.forward = glm::normalize(glm::dvec3(0.1, 0, -1));
  EXPECT_EQ(find_visible_windows(g.grid, kCell, camera), 0x3f);
}

// A cell of the baked park, ready.
struct Planned {
  const SmallBake& small = shared_bake();
  Bundle bundle{shared_bundle()};
  std::vector<MeshLevels> levels = build_scene_levels(bundle.scene(), false);
  PlanScene plan_scene = make_plan_scene(bundle.scene(), levels);
};

// Every vertex in the frame belongs to an object of the plan; nothing is in it twice.
TEST(PlanHybrid, NoObjectWithAVertexInTheFrameIsCulled) {
  const Planned planned;
  const CellSet& cells = planned.bundle.cells();
  Random random(21);
  std::size_t n_visible = 0, n_culled = 0;
  for (const CellId cell : planned.small.list) {
    const ReadyCell ready =
        make_ready_cell(planned.bundle.scene(), cells, cell, planned.bundle.read_cell(cell));
    const ViewsAvailable views(ready.objects.size(), 0x7f);
    const glm::dvec3 centre = eye_of(cells, cell);
    for (int k = 0; k < 60; ++k) {
      Camera camera;
      camera.eye = centre + glm::dvec3(random.uniform(-20, 20), random.uniform(-20, 20),
                                       random.uniform(-2, 2));
      camera.forward = glm::normalize(
          glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-0.4, 0.4)));
      const HybridPlan plan = plan_hybrid(planned.plan_scene, cells, ready, views, camera);
      std::set<std::size_t> slots;
      std::set<ObjectId> inside(plan.originals.begin(), plan.originals.end());
      std::size_t n_triangles = 0;
      double last = 0;
      for (const HybridDraw& draw : plan.outside) {
        const ReadyObject& o = ready.objects.at(draw.slot);
        EXPECT_TRUE(slots.insert(draw.slot).second);
        n_triangles += o.n_indices / 3;
        const double d = glm::distance(camera.eye, 0.5 * glm::dvec3(o.lo + o.hi));
        EXPECT_GE(d, last - 1e-3);
        last = d;
        if (o.kind == Representation::single_view) {
          EXPECT_EQ(draw.views.view, (std::array<int, 2>{0, -1}));
        }
      }
      EXPECT_EQ(plan.n_triangles, n_triangles);
      EXPECT_EQ(inside.size(), plan.originals.size());
      for (std::size_t slot = 0; slot < ready.objects.size(); ++slot) {
        bool seen = false;
        const ReadyObject& o = ready.objects[slot];
        for (std::uint32_t i = 0; i < o.n_indices; ++i)
          seen |= is_in_frame(
              camera,
              ready.origin + glm::dvec3(ready.vertices[ready.indices[o.first_index + i]].position));
        n_visible += seen, n_culled += !slots.contains(slot);
        ASSERT_TRUE(!seen || slots.contains(slot)) << "cell " << int(cell) << " slot " << slot;
      }
      for (const ObjectId id : cells.inside[index(cell)]) {
        bool seen = false;
        for (const glm::dvec3& p :
             world_points(planned.bundle.scene(), planned.bundle.scene().objects[index(id)]))
          seen |= is_in_frame(camera, p);
        ASSERT_TRUE(!seen || inside.contains(id)) << "cell " << int(cell);
      }
      for (const ObjectId id : inside) EXPECT_TRUE(is_inside(cells, cell, id));
    }
  }
  EXPECT_GT(n_visible, 200u);
  EXPECT_GT(n_culled, 500u);
}

TEST(PlanHybrid, ObjectsWithoutTrianglesAreNotDrawn) {
  const Planned planned;
  const CellSet& cells = planned.bundle.cells();
  CellGeometry g = planned.bundle.read_cell(CellId(0));
  for (BundleObject& o : g.objects) o.n_vertices = o.n_triangles = 0;
  g.source_vertices.clear(), g.offsets.clear(), g.indices.clear(), g.views.clear();
  const ReadyCell ready = make_ready_cell(planned.bundle.scene(), cells, CellId(0), g);
  Camera camera;
  camera.eye = eye_of(cells, CellId(0));
  camera.forward = glm::normalize(glm::dvec3(1, 1, 0));
  const ViewsAvailable views(ready.objects.size(), 0x7f);
  EXPECT_TRUE(plan_hybrid(planned.plan_scene, cells, ready, views, camera).outside.empty());
}

}  // namespace
}  // namespace viewcell
