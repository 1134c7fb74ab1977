#include <cmath>

#include "park/figures.h"

namespace viewcell {
namespace {

// A cloak: a folded drum, hollowed and opened in front. First of all limbs, since it is cut.
void add_cloak(Figure& figure) {
  Solid cloth = make_drum({0, 0.5f, 18.6f}, 2.2f, {0, 1.4f, 2.6f}, 4.6f, 0.2f);
  cloth.axes = turn_x(180), cloth.b = {0, 0.5f, 2.6f};
  cloth.n_flutes = 13, cloth.flute_depth = 0.9f, cloth.twist_rad = 0.5f;
  figure.unite(0, {cloth});
  Solid hollow = make_drum({0, 0.5f, 17.6f}, 1.5f, {0, 0.5f, 1}, 3.9f, 0.2f);
  hollow.n_flutes = 13, hollow.flute_depth = 0.9f, hollow.twist_rad = 0.5f;
  figure.cut(0.2f, {hollow});
  figure.cut(0.5f, {make_box({0, -5.2f, 9}, {6, 5, 9.6f}, 0.4f, turn_x(6))});
}

void add_robed_plinth(Figure& figure) {
  figure.unite(0, {make_box({0, 0, 0}, {5, 6, 0.9f}, 0.15f)});
  figure.unite(0.1f, {make_box({0, 0, 1.2f}, {4.4f, 5.4f, 0.7f}, 0.15f)});
  figure.unite(0.4f, {make_box({0, 0, 1.8f}, {4.1f, 5.1f, 0.75f}, 0.1f)});
}

void add_robed_body(Figure& figure) {
  Solid robe = make_drum({0, -0.1f, 13}, 1.7f, {0, -0.1f, 2.3f}, 3.4f, 0.3f, {1, 0.92f});
  robe.n_flutes = 14, robe.flute_depth = 0.75f, robe.twist_rad = -0.7f;
  figure.unite(0.3f, {robe});
  figure.unite(0.7f, {make_ellipsoid({0, 0.1f, 15}, {2.3f, 1.6f, 3.3f})});
  figure.unite(0.6f, {make_round_cone({-2.0f, 0.3f, 17.2f}, 1.05f, {2.0f, 0.3f, 17.2f}, 1.05f)});
  figure.unite_pair(0, 0.2f, {make_ellipsoid({1.2f, -3.3f, 2.9f}, {0.7f, 1.2f, 0.6f})});  // feet
  std::vector<Knot> belt;
  for (int i = 0; i <= 16; ++i) {
    const float angle = 2 * 3.14159265f * static_cast<float>(i) / 16;
    belt.push_back({{2.0f * std::cos(angle), 1.65f * std::sin(angle), 13.1f}, 0.28f});
  }
  figure.unite(0.1f, make_chain(belt, 2));
  const Knot ends[] = {
      {{0.5f, -1.7f, 13.1f}, 0.25f}, {{0.7f, -2.3f, 11}, 0.22f}, {{0.5f, -2.9f, 8.4f}, 0.3f}};
  figure.unite(0.1f, make_chain(ends, 4));
}

void add_robed_head(Figure& figure) {
  figure.unite(0.4f, {make_ellipsoid({0, 0.5f, 20.5f}, {1.75f, 1.75f, 2.2f})});  // the hood
  figure.unite(0.6f, {make_round_cone({0, 1.2f, 21.8f}, 0.9f, {0, 2.6f, 21.2f}, 0.4f)});
  figure.unite(0.6f, {make_round_cone({0, 0.6f, 18.6f}, 1.6f, {0, 0.4f, 17}, 2)});
  figure.cut(0.25f, {make_ellipsoid({0, -1.3f, 20.4f}, {1.25f, 1.3f, 1.75f})});
  figure.unite(0.1f, {make_ellipsoid({0, -0.2f, 20.3f}, {1.0f, 1.1f, 1.45f})});  // the face
  figure.cut_pair(0, 0.15f, {make_ball({0.42f, -1.35f, 20.5f}, 0.3f)});
  figure.unite(0.15f, {make_round_cone({0, -1.2f, 20.7f}, 0.16f, {0, -1.6f, 20}, 0.24f)});
  for (int i = 0; i < 7; ++i) {  // the beard
    const float x = 0.27f * static_cast<float>(i - 3), drop = 0.5f * std::abs(x);
    const Knot lock[] = {{{0.9f * x, -1.05f + 0.25f * std::abs(x), 19.6f}, 0.32f},
                         {{1.1f * x, -1.75f, 18.4f}, 0.3f},
                         {{0.6f * x + 0.1f, -2.0f, 16.7f + drop}, 0.14f}};
    figure.unite(0.12f, make_chain(lock, 4));
  }
}

// An arm from the shoulder; its sleeve hangs open below the wrist.
void add_arm(Figure& figure, const glm::vec3& shoulder, const glm::vec3& elbow,
             const glm::vec3& hand) {
  figure.unite(0.4f, {make_round_cone(shoulder, 1.0f, elbow, 0.95f)});
  const glm::vec3 wrist = glm::mix(elbow, hand, 0.72f);
  figure.unite(0.35f,
               {make_round_cone(elbow, 0.9f, wrist, 1.05f),
                make_round_cone(elbow, 0.8f, wrist + glm::vec3(0, 0.3f, -1.6f), 0.75f),
                make_round_cone(wrist, 1.05f, wrist + glm::vec3(0, 0.3f, -1.8f), 0.6f)},
               0.3f);
  const glm::vec3 out = glm::normalize(hand - elbow);
  figure.cut(0.15f,
             {make_ellipsoid(wrist + 1.15f * out + glm::vec3(0, 0, -0.5f), {0.75f, 0.95f, 1.3f})});
  figure.unite(0.1f, {make_round_cone(wrist, 0.5f, hand, 0.45f)});
  figure.unite(0.15f, {make_ellipsoid(hand, {0.62f, 0.6f, 0.55f})});
}

void add_staff(Figure& figure, const glm::vec3& hand) {
  const float x = hand.x, y = hand.y - 0.25f;
  const Knot staff[] = {{{x, y, 2.2f}, 0.3f},          {{x, y, 12}, 0.27f},
                        {{x, y, 19.5f}, 0.27f},        {{x, y + 0.2f, 22}, 0.3f},
                        {{x, y + 1.2f, 23.1f}, 0.32f}, {{x, y + 2.3f, 22.4f}, 0.32f},
                        {{x, y + 2.1f, 21.1f}, 0.3f},  {{x, y + 1.2f, 21.2f}, 0.3f}};
  figure.unite(0.1f, make_chain(staff, 5));
  for (int finger = 0; finger < 4; ++finger) {
    const float z = hand.z - 0.42f + 0.28f * static_cast<float>(finger);
    figure.unite(
        0.05f, {make_round_cone({x - 0.35f, y + 0.1f, z}, 0.18f, {x + 0.2f, y - 0.38f, z}, 0.18f)});
  }
}

void add_lantern(Figure& figure, const glm::vec3& hand) {
  const float x = hand.x, y = hand.y - 0.3f, top = hand.z - 1.2f;
  figure.unite(0.05f, {make_round_cone({x, y, hand.z}, 0.16f, {x, y, top}, 0.16f)});
  figure.unite(0.05f, {make_drum({x, y, top - 0.7f}, 1.3f, {x, y, top + 0.1f}, 0.3f, 0.1f)});
  figure.unite(0.05f, {make_drum({x, y, top - 3.5f}, 1.1f, {x, y, top - 2.9f}, 1.05f, 0.12f)});
  for (int i = 0; i < 6; ++i) {
    const float angle = 3.14159265f * static_cast<float>(i) / 3;
    const glm::vec3 p(x + 0.9f * std::cos(angle), y + 0.9f * std::sin(angle), top - 3.1f);
    figure.unite(0.05f, {make_round_cone(p, 0.14f, p + glm::vec3(0, 0, 2.6f), 0.14f)});
  }
  figure.unite(0.05f,
               {make_round_cone({x, y, top - 3}, 0.4f, {x, y, top - 1.6f}, 0.12f)});  // flame
}

}  // namespace

Figure make_robed_figure() {
  Figure figure;
  add_cloak(figure);
  add_robed_plinth(figure);
  add_robed_body(figure);
  add_robed_head(figure);
  const glm::vec3 staff_hand(-4.6f, -2.9f, 14.6f), lantern_hand(2.9f, -4.9f, 15.2f);
  add_arm(figure, {-2.3f, 0.2f, 17}, {-4.1f, -0.1f, 14.3f}, staff_hand);
  add_arm(figure, {2.3f, 0.2f, 17}, {3.6f, -1.3f, 14.2f}, lantern_hand);
  add_staff(figure, staff_hand);
  add_lantern(figure, lantern_hand);
  return figure;
}

}  // namespace viewcell
