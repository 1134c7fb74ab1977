#include "park/figures.h"

namespace viewcell {
namespace {

// An animal's leg through its knots, ending in a cloven hoof.
void add_cattle_leg(Figure& figure, const Knot (&knots)[4]) {
  figure.unite(1.2f, make_chain(knots, 4));
  const glm::vec3 foot = knots[3].point;
  for (const float side : {-0.6f, 0.6f})
    figure.unite(0.2f, {make_round_cone(foot + glm::vec3(0.2f, side, 0), 0.9f,
                                        foot + glm::vec3(0.7f, side, -1), 1.0f)});
}

void add_bull_trunk(Figure& figure) {
  figure.unite(0, {make_ellipsoid({6, 0, 15.5f}, {7.4f, 5.9f, 7.6f})});
  figure.unite(3, {make_ellipsoid({-2, 0, 15.5f}, {11, 5.7f, 6.4f})});
  figure.unite(2.5f, {make_ellipsoid({-11, 0, 16.2f}, {5.6f, 5, 6})});
  figure.unite(2, {make_ellipsoid({5.5f, 0, 21.5f}, {6, 3.4f, 4.6f}, turn_y(12))});
  figure.unite(2.2f, {make_round_cone({9.5f, -0.4f, 19}, 5, {14.4f, -2.2f, 18}, 3.8f)});
  figure.unite(1.5f, {make_ellipsoid({12, -1.2f, 11}, {3.2f, 1.0f, 4.6f}, turn_y(-15))});
  for (int fold = 0; fold < 3; ++fold) {  // creases of the neck
    const float s = static_cast<float>(fold);
    const Knot crease[] = {{{10.5f + 1.2f * s, -5.6f - 0.1f * s, 21 - s}, 0.5f},
                           {{11 + 1.2f * s, -6.1f, 17.5f - s}, 0.7f},
                           {{11 + 1.1f * s, -4.6f, 14 - s}, 0.4f}};
    figure.cut(0.5f, make_chain(crease, 4));
  }
  for (const float side : {-1.0f, 1.0f})  // ribs
    for (int rib = 0; rib < 5; ++rib) {
      const float x = 1.5f - 2.1f * static_cast<float>(rib);
      const Knot knots[] = {{{x + 1, side * 5.1f, 19}, 0.25f},
                            {{x, side * 6.1f, 15.5f}, 0.4f},
                            {{x + 0.6f, side * 5.2f, 12}, 0.25f}};
      figure.cut(0.7f, make_chain(knots, 4));
    }
}

// In the head's own frame: the muzzle along +x, the poll at the origin.
Figure make_bull_head() {
  Figure head;
  head.unite(0, {make_round_cone({0, 0, 0}, 3.1f, {5.6f, 0, -1.4f}, 2.0f)});
  head.unite(0.8f, {make_ellipsoid({6.2f, 0, -1.7f}, {1.7f, 2.1f, 1.9f})});
  head.unite(1, {make_round_cone({0.6f, 0, -1.8f}, 2.2f, {5, 0, -3}, 1.2f)});
  head.cut_pair(1, 0.3f, {make_ellipsoid({7.6f, 1.0f, -1.2f}, {0.8f, 0.5f, 0.5f})});
  head.cut(0.2f, {make_box({7, 0, -2.9f}, {2.2f, 3, 0.14f}, 0.1f, turn_y(10))});
  head.unite_pair(1, 0.4f, {make_ellipsoid({1.8f, 2.5f, 0.7f}, {0.9f, 0.6f, 0.6f})});
  head.unite_pair(1, 0.4f, {make_ellipsoid({-0.9f, 4.6f, -0.2f}, {0.9f, 2.2f, 0.7f}, turn_z(12))});
  const Knot horn[] = {{{-0.3f, 1.8f, 1.8f}, 1.35f},
                       {{-0.6f, 4.6f, 2.8f}, 1.15f},
                       {{0.6f, 7, 4.2f}, 0.9f},
                       {{3, 7.4f, 6.6f}, 0.35f}};
  head.unite_pair(1, 0.5f, make_chain(horn, 5));
  for (int i = 0; i < 7; ++i) {  // curls between the horns
    const float y = 0.75f * static_cast<float>(i - 3), x = i % 2 == 0 ? 1.2f : 0.4f;
    head.unite(0.2f, {make_ellipsoid({x, y, 2.5f - 0.16f * y * y}, {0.95f, 0.6f, 0.75f})});
  }
  return head;
}

void add_bull_legs(Figure& figure) {
  add_cattle_leg(figure, {{{8, 3.4f, 11.5f}, 3.2f},
                          {{9.6f, 3.8f, 7}, 1.8f},
                          {{9, 3.8f, 3.4f}, 1.2f},
                          {{9.4f, 3.8f, 1.6f}, 1.3f}});
  add_cattle_leg(figure, {{{8, -3.4f, 11.5f}, 3.2f},
                          {{12.4f, -3.8f, 9}, 1.9f},
                          {{11.2f, -3.8f, 4.8f}, 1.2f},
                          {{11.4f, -3.8f, 2.4f}, 1.3f}});
  add_cattle_leg(figure, {{{-11.5f, 3, 12.5f}, 4},
                          {{-10.5f, 3.6f, 8.6f}, 2.5f},
                          {{-13.8f, 3.8f, 6}, 1.5f},
                          {{-12.8f, 3.8f, 1.6f}, 1.3f}});
  add_cattle_leg(figure, {{{-11.5f, -3, 12.5f}, 4},
                          {{-12, -3.6f, 8.6f}, 2.5f},
                          {{-16.4f, -3.8f, 6.4f}, 1.5f},
                          {{-16, -3.8f, 1.6f}, 1.3f}});
  const Knot tail[] = {{{-15.6f, 0, 20}, 1.0f},    {{-18.4f, 0.6f, 21.4f}, 0.8f},
                       {{-20, 1.6f, 17}, 0.7f},    {{-19, 3, 12}, 0.7f},
                       {{-17, 5.4f, 11.4f}, 0.9f}, {{-15.8f, 7, 9.6f}, 1.3f},
                       {{-16.2f, 7.6f, 7}, 0.5f}};
  figure.unite(0.5f, make_chain(tail, 4));
}

Figure make_bull() {
  Figure bull;
  add_bull_trunk(bull);
  add_bull_legs(bull);
  bull.add(make_bull_head(), 1, turn_z(-28) * turn_y(24), {15.2f, -2.4f, 18.4f});
  return bull;
}

// Lying on folded legs, its head raised and turned back.
Figure make_calf() {
  Figure calf;
  calf.unite(0, {make_ellipsoid({0, 0, 4}, {8, 3.9f, 4.2f})});
  calf.unite(1.5f, {make_ellipsoid({-5.5f, 0.4f, 4.2f}, {3.8f, 3.7f, 3.9f})});
  const Knot neck[] = {{{5, 0, 6}, 3}, {{8, 0.3f, 9}, 2.2f}, {{8.6f, 0.8f, 11.6f}, 1.9f}};
  calf.unite(1.4f, make_chain(neck, 5));
  calf.unite_pair(1, 0.8f,
                  {make_round_cone({5, 2.6f, 2.6f}, 1.5f, {8.8f, 2.8f, 1.2f}, 1.0f),
                   make_round_cone({8.8f, 2.8f, 1.2f}, 1.0f, {5.6f, 3.6f, 0.6f}, 0.8f)});
  calf.unite_pair(1, 0.8f,
                  {make_round_cone({-6, 2.6f, 3}, 2.6f, {-1.6f, 4, 1.5f}, 1.4f),
                   make_round_cone({-1.6f, 4, 1.5f}, 1.1f, {-5.4f, 5, 0.8f}, 0.8f)});
  Figure head;
  head.unite(0, {make_round_cone({0, 0, 0}, 2, {3.6f, 0, -0.9f}, 1.2f)});
  head.unite(0.5f, {make_ellipsoid({4, 0, -1}, {1, 1.2f, 1.1f})});
  head.unite_pair(1, 0.3f, {make_ellipsoid({-0.8f, 2.6f, 0.5f}, {0.7f, 1.7f, 0.5f}, turn_z(15))});
  head.unite_pair(1, 0.3f, {make_ball({1.1f, 1.5f, 0.5f}, 0.55f)});
  head.unite_pair(1, 0.3f, {make_round_cone({-0.4f, 1.0f, 1.6f}, 0.5f, {-0.6f, 1.4f, 2.6f}, 0.3f)});
  calf.add(head, 1, turn_z(150) * turn_y(8), {8.6f, 1.0f, 12.6f});
  const Knot tail[] = {{{-8.6f, 0.6f, 6}, 0.7f},
                       {{-10, 2, 3.4f}, 0.6f},
                       {{-8, 4.6f, 1.4f}, 0.6f},
                       {{-6, 5.6f, 1}, 0.9f}};
  calf.unite(0.4f, make_chain(tail, 4));
  return calf;
}

}  // namespace

Figure make_cattle_figure() {
  Figure figure;
  figure.unite(0, {make_drum({0, 0, -1}, 19.6f, {0, 0, 1.2f}, 19, 0.6f, {1, 1.02f})});
  for (int i = 0; i < 9; ++i) {  // uneven ground
    const float s = static_cast<float>(i);
    const glm::vec3 at(14 * (0.13f * static_cast<float>(i * 7 % 9) - 0.52f), 3.2f * s - 13, 0.8f);
    figure.unite(1.5f, {make_ellipsoid(at, {4.5f, 3.4f, 1.1f})});
  }
  figure.add(make_bull(), 1, turn_z(-14), {-0.6f, -5.6f, 0.9f});
  figure.add(make_calf(), 1.05f, turn_z(-160), {-2, 11, 1});
  return figure;
}

}  // namespace viewcell
