#include <cmath>

#include "park/figure_dragon.h"

namespace viewcell {
namespace {

void add_skull(Figure& head) {
  head.unite(0, {make_ellipsoid({1, 0, 0.6f}, {3.2f, 2.7f, 2.5f})});
  head.unite(0.9f, {make_round_cone({2.2f, 0, 0.7f}, 2.1f, {7.6f, 0, 0.2f}, 1.35f)});  // the snout
  head.unite(0.5f, {make_ellipsoid({8.2f, 0, 0.7f}, {1.1f, 1.5f, 0.95f})});
  head.unite(0.6f, {make_round_cone({1.2f, 0, -1.6f}, 1.7f, {6.6f, 0, -4.0f}, 0.95f)});  // the jaw
  head.cut(0.3f, {make_ellipsoid({6.6f, 0, -1.65f}, {4, 1.15f, 0.75f}, turn_y(11))});  // the mouth
  head.unite(0.25f, {make_ellipsoid({4.6f, 0, -2.2f}, {2.9f, 0.75f, 0.4f}, turn_y(20))});  // tongue
  head.cut_pair(1, 0.2f, {make_ellipsoid({8.8f, 0.75f, 1.1f}, {0.5f, 0.32f, 0.35f})});
  head.unite_pair(1, 0.25f, {make_round_cone({8.0f, 0.8f, 1.4f}, 0.4f, {9, 1.1f, 1.5f}, 0.25f)});
  head.cut_pair(1, 0.3f, {make_ellipsoid({3.7f, 2.1f, 1.5f}, {1.15f, 0.7f, 0.75f})});
  head.unite_pair(1, 0.1f, {make_ball({3.6f, 1.65f, 1.45f}, 0.72f)});
  head.unite_pair(1, 0.35f, {make_round_cone({2, 2.1f, 2.2f}, 0.5f, {5, 1.7f, 2.2f}, 0.4f)});
  for (int ridge = 0; ridge < 5; ++ridge)  // wrinkles over the snout
    head.unite(0.2f, {make_ellipsoid({4.6f + 0.75f * static_cast<float>(ridge), 0,
                                      1.75f - 0.13f * static_cast<float>(ridge)},
                                     {0.26f, 1.1f, 0.42f})});
}

void add_teeth(Figure& head) {
  for (int i = 0; i < 6; ++i) {
    const float s = static_cast<float>(i);
    const float long_tooth = i == 5 ? 1.7f : i % 2 == 0 ? 0.95f : 0.7f;
    const glm::vec3 up(3.4f + 0.85f * s, 1.45f - 0.07f * s, -0.75f + 0.05f * s);
    head.unite_pair(1, 0.06f,
                    {make_round_cone(up, 0.3f, up + glm::vec3(0.1f, -0.05f, -long_tooth), 0.06f)});
    const glm::vec3 down(3.2f + 0.62f * s, 1.15f - 0.07f * s, -1.9f - 0.3f * s);
    head.unite_pair(
        1, 0.06f,
        {make_round_cone(down, 0.27f, down + glm::vec3(0.1f, -0.04f, 0.72f * long_tooth), 0.06f)});
  }
}

void add_horns_and_whiskers(Figure& head) {
  const Knot horn[] = {{{0.4f, 1.3f, 2.4f}, 0.75f},
                       {{-1.4f, 2.0f, 4}, 0.65f},
                       {{-4, 2.6f, 4.9f}, 0.52f},
                       {{-6.4f, 3.1f, 5.0f}, 0.4f},
                       {{-8.4f, 3.4f, 6.2f}, 0.1f}};
  head.unite_pair(1, 0.3f, make_chain(horn, 6));
  const Knot branch[] = {
      {{-2.6f, 2.3f, 4.5f}, 0.45f}, {{-3.8f, 2.9f, 6}, 0.35f}, {{-5, 3.1f, 7.2f}, 0.1f}};
  head.unite_pair(1, 0.15f, make_chain(branch, 4));
  const Knot whisker[] = {{{8.2f, 1.3f, 0.4f}, 0.36f},
                          {{9.4f, 2.7f, 0.6f}, 0.32f},
                          {{8.8f, 4.2f, -0.6f}, 0.3f},
                          {{6.8f, 4.9f, -2.2f}, 0.27f},
                          {{5, 5.6f, -1.9f}, 0.2f}};
  head.unite_pair(1, 0.15f, make_chain(whisker, 6));
  head.unite_pair(1, 0.3f,
                  {make_ellipsoid({-0.4f, 3.2f, 0.9f}, {1.5f, 0.5f, 0.85f}, turn_z(150))});  // ears
  for (int i = 0; i < 3; ++i) {  // the beard
    const float y = 0.6f * static_cast<float>(i - 1);
    const Knot lock[] = {
        {{6.3f, 0.8f * y, -4.5f}, 0.5f}, {{6, y, -5.8f}, 0.42f}, {{6.8f, 1.3f * y, -7.2f}, 0.1f}};
    head.unite(0.2f, make_chain(lock, 4));
  }
}

// Flame-shaped locks swept back from the cheeks and the nape.
void add_mane(Figure& head) {
  for (int ring = 0; ring < 3; ++ring)
    for (int i = 0; i < 9; ++i) {
      const float s = static_cast<float>(i), r = static_cast<float>(ring);
      const float angle = (s + 0.5f * r) / 9 * 4.6f - 2.3f;  // from under one cheek over the nape
      const glm::vec3 out(0, std::sin(angle), std::cos(angle));
      const float reach = 4.6f - 0.5f * r + (i % 2 == 0 ? 0.7f : 0.0f);
      const glm::vec3 root = glm::vec3(-0.6f - 1.1f * r, 0, 0.2f) + 1.9f * out;
      const Knot lock[] = {{root, 0.75f},
                           {root + glm::vec3(-0.45f * reach, 0, 0) + 0.9f * out, 0.62f},
                           {root + glm::vec3(-0.75f * reach, 0, 0.3f) + 1.1f * out, 0.45f},
                           {root + glm::vec3(-reach, 0, 0.8f) + 1.9f * out, 0.1f}};
      head.unite(0.25f, make_chain(lock, 4));
    }
}

}  // namespace

Figure make_dragon_head() {
  Figure head;
  add_skull(head);
  add_teeth(head);
  add_mane(head);
  add_horns_and_whiskers(head);
  return head;
}

}  // namespace viewcell
