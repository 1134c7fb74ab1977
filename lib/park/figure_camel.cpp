#include "park/figures.h"

namespace viewcell {
namespace {

void add_camel_trunk(Figure& figure) {
  figure.unite(0, {make_box({-0.5f, 0, 0}, {20.5f, 7.9f, 1.9f}, 0.6f)});
  figure.unite(0, {make_ellipsoid({-3, 0, 22.5f}, {14, 6.4f, 7})});
  figure.unite(2.5f, {make_ellipsoid({8, 0, 22}, {6.4f, 5.6f, 7})});
  figure.unite(2.5f, {make_ellipsoid({-14, 0, 22.5f}, {5.8f, 5.6f, 6.4f})});
  figure.unite(3.5f, {make_round_cone({-10, 0, 28}, 4.4f, {-12, 0, 35.6f}, 1.7f)});
  figure.unite(3.5f, {make_round_cone({3, 0, 28}, 4.6f, {3.6f, 0, 36.6f}, 1.7f)});
}

void add_neck_and_head(Figure& figure) {
  const Knot neck[] = {{{8, 0, 22}, 5.2f},     {{14.5f, 0, 19.5f}, 4},    {{18.6f, 0, 24.5f}, 2.9f},
                       {{18.8f, 0, 33}, 2.4f}, {{17.6f, 0, 39.5f}, 2.3f}, {{18, 0, 41.6f}, 2.2f}};
  figure.unite(1.5f, make_chain(neck, 6));
  // the shaggy throat
  for (int i = 0; i < 5; ++i) {
    const float s = static_cast<float>(i);
    const glm::vec3 root(19.5f - 0.25f * s * s + 0.5f * s, 0, 31 - 3 * s);
    figure.unite(0.8f, {make_round_cone(root, 1.9f, root + glm::vec3(1.7f, 0, -3.4f), 0.6f)});
  }
  figure.unite(0.8f, {make_round_cone({17.8f, 0, 42}, 2.5f, {23.8f, 0, 40.6f}, 1.55f)});
  figure.unite(0.5f, {make_round_cone({18.6f, 0, 40}, 1.7f, {23.2f, 0, 38.9f}, 1.0f)});
  figure.cut(0.3f, {make_box({23.6f, 0, 39.6f}, {2.6f, 3, 0.16f}, 0.1f, turn_y(12))});  // mouth
  figure.cut_pair(1, 0.2f, {make_ball({25.2f, 0.8f, 41}, 0.4f)});
  figure.unite_pair(1, 0.3f, {make_ball({20, 1.9f, 42.7f}, 0.75f)});
  figure.unite_pair(1, 0.4f,
                    {make_round_cone({16.8f, 1.6f, 43.2f}, 0.95f, {15.9f, 2.4f, 45.6f}, 0.65f)});
  figure.unite(0.6f, {make_round_cone({16.6f, 0, 44}, 1.3f, {18.6f, 0, 44.6f}, 0.8f)});  // forelock
}

// A leg through the four knots given, and its two-toed foot.
void add_camel_leg(Figure& figure, const Knot (&knots)[5]) {
  figure.unite(1.6f, make_chain(knots, 4));
  const glm::vec3 foot = knots[4].point;
  figure.unite(0.5f, {make_ellipsoid(foot + glm::vec3(0.9f, 0.6f, -0.9f), {2, 1.1f, 1.2f}),
                      make_ellipsoid(foot + glm::vec3(0.9f, -0.6f, -0.9f), {2, 1.1f, 1.2f})});
}

void add_camel_legs(Figure& figure) {
  add_camel_leg(figure, {{{8.5f, 3.4f, 19}, 3.6f},
                         {{9.5f, 4, 14}, 2.3f},
                         {{10.5f, 4.2f, 10.5f}, 1.9f},
                         {{10.3f, 4.2f, 6}, 1.2f},
                         {{10.6f, 4.2f, 3.4f}, 1.3f}});
  add_camel_leg(figure, {{{8.5f, -3.4f, 19}, 3.6f},
                         {{7.4f, -4, 14}, 2.3f},
                         {{7, -4.2f, 10.5f}, 1.9f},
                         {{4.6f, -4.2f, 6}, 1.2f},
                         {{4.2f, -4.2f, 3.4f}, 1.3f}});
  add_camel_leg(figure, {{{-14, 3.2f, 19}, 4.4f},
                         {{-14.5f, 3.8f, 14}, 2.8f},
                         {{-18, 4, 10.6f}, 1.8f},
                         {{-17.8f, 4, 6}, 1.2f},
                         {{-18, 4, 3.4f}, 1.3f}});
  add_camel_leg(figure, {{{-14, -3.2f, 19}, 4.4f},
                         {{-11.5f, -3.8f, 14}, 2.8f},
                         {{-12.6f, -4, 10.6f}, 1.8f},
                         {{-10.6f, -4, 6}, 1.2f},
                         {{-10.2f, -4, 3.4f}, 1.3f}});
}

void add_load(Figure& figure) {
  figure.unite(0.3f, {make_ellipsoid({-4, 0, 25}, {3.4f, 6.8f, 6.2f})});  // the saddle cloth
  figure.unite_pair(1, 0.3f, {make_box({-4, 6.6f, 21}, {3.9f, 1.5f, 3.6f}, 0.9f)});
  figure.unite_pair(1, 0.2f, {make_box({-4, 8, 22.6f}, {3.0f, 0.5f, 1.4f}, 0.4f)});
  const Knot tail[] = {{{-19, 0, 24.5f}, 0.9f},
                       {{-21.4f, 0.4f, 21}, 0.7f},
                       {{-21.6f, 0.8f, 16}, 0.7f},
                       {{-21.4f, 0.6f, 12.5f}, 1.2f},
                       {{-21.6f, 0.6f, 10.4f}, 0.5f}};
  figure.unite(0.6f, make_chain(tail, 4));
}

}  // namespace

Figure make_camel_figure() {
  Figure figure;
  add_camel_trunk(figure);
  add_neck_and_head(figure);
  add_camel_legs(figure);
  add_load(figure);
  return figure;
}

}  // namespace viewcell
