#include <cmath>

#include "park/figures.h"

namespace viewcell {
namespace {

void add_horse_plinth(Figure& figure) {
  figure.unite(0, {make_box({0, 0, 0}, {19, 27, 2.6f}, 0.6f)});
  figure.unite(0, {make_box({0, 0, 3.4f}, {16.8f, 24.8f, 2}, 0.6f)});
  figure.unite(1.2f, {make_box({0, 0, 11}, {13.4f, 21.2f, 7}, 0.6f)});
  figure.unite(1, {make_box({0, 0, 17.4f}, {15.6f, 23.4f, 1.4f}, 0.6f)});
  figure.cut_pair(0, 0.3f, {make_box({13.8f, 0, 11}, {1.4f, 17, 3.8f}, 0.3f)});  // panels
  figure.cut_pair(1, 0.3f, {make_box({0, 21.6f, 11}, {9.4f, 1.4f, 3.8f}, 0.3f)});
  for (const float y : {-11.5f, 0.0f, 11.5f}) {  // wreaths in the long panels
    std::vector<Knot> ring;
    for (int i = 0; i <= 12; ++i) {
      const float angle = 2 * 3.14159265f * static_cast<float>(i) / 12;
      ring.push_back({{12.6f, y + 2.6f * std::cos(angle), 11 + 2.6f * std::sin(angle)}, 0.8f});
    }
    figure.unite_pair(0, 0.3f, make_chain(ring, 3));
  }
}

void add_horse_trunk(Figure& figure) {
  figure.unite(0, {make_ellipsoid({0, 9, 45}, {6.4f, 7.2f, 7})});  // the croup
  figure.unite(4, {make_round_cone({0, 6, 47}, 6.1f, {0, -5, 57}, 6.6f)});
  figure.unite(3, {make_ellipsoid({0, -8, 60}, {5.9f, 6.2f, 7})});
  const Knot neck[] = {{{0, -6, 61}, 6.2f},
                       {{0, -10.5f, 67}, 4.9f},
                       {{0, -14.5f, 73}, 3.6f},
                       {{0, -18, 76.4f}, 2.7f}};
  figure.unite(2.5f, make_chain(neck, 5));
}

void add_horse_head(Figure& figure) {
  figure.unite(0.8f,
               {make_round_cone({0, -18.4f, 76}, 2.8f, {0, -22.6f, 70.6f}, 2.1f),
                make_round_cone({0, -22.6f, 70.6f}, 2.1f, {0, -25, 66.8f}, 1.8f)},
               0.6f);
  figure.unite(0.9f, {make_ellipsoid({0, -18.6f, 73}, {2.2f, 2.7f, 2.9f})});  // the jaw
  figure.cut_pair(0, 0.4f, {make_ellipsoid({1.5f, -26.4f, 66.8f}, {0.7f, 0.9f, 0.7f})});
  figure.unite(0.4f, {make_round_cone({0, -22.4f, 68.4f}, 1.0f, {0, -23.4f, 65.2f}, 1.1f)});
  figure.unite_pair(0, 0.3f, {make_ellipsoid({2.3f, -20.8f, 75.2f}, {0.8f, 1, 1})});
  figure.unite_pair(0, 0.4f,
                    {make_round_cone({1.5f, -17, 77.8f}, 1.1f, {2.1f, -16.8f, 82}, 0.35f)});
}

// Locks blown back from the crest of the neck, and the tail down to the plinth.
void add_mane_and_tail(Figure& figure) {
  for (int i = 0; i < 9; ++i) {
    const float s = static_cast<float>(i), side = i % 2 == 0 ? 1.0f : -1.0f;
    const glm::vec3 root(0.7f * side, -16.5f + 1.6f * s, 78.4f - 1.75f * s);
    const Knot lock[] = {{root, 1.6f},
                         {root + glm::vec3(1.4f * side, 3.2f, 0.6f), 1.3f},
                         {root + glm::vec3(3.0f * side, 5.6f, -1.8f), 0.9f},
                         {root + glm::vec3(3.6f * side, 8.4f, -2.6f), 0.35f}};
    figure.unite(0.5f, make_chain(lock, 3));
  }
  figure.unite(0.5f, {make_round_cone({0, -19, 78}, 1.2f, {0.6f, -22.8f, 75.4f}, 0.6f)});
  for (int strand = 0; strand < 3; ++strand) {
    const float x = 1.7f * static_cast<float>(strand - 1);
    const Knot tail[] = {{{0.3f * x, 14.5f, 48}, 1.8f},
                         {{0.8f * x, 20, 50}, 2},
                         {{1.1f * x, 25, 44 + 0.5f * x}, 2.1f},
                         {{1.3f * x, 25.5f, 35}, 2},
                         {{0.9f * x, 21.5f, 28 + 0.4f * x}, 1.8f},
                         {{1.4f * x, 18.5f, 24}, 1.3f}};
    figure.unite(0.7f, make_chain(tail, 4));
  }
}

void add_hoof(Figure& figure, const glm::vec3& fetlock, const glm::vec3& toe) {
  const glm::vec3 along = glm::normalize(toe - fetlock);
  figure.unite(0.4f, {make_drum(fetlock + 0.2f * along, 1.4f, toe, 2.3f, 0.4f)});
}

void add_horse_legs(Figure& figure) {
  for (const float side : {-1.0f, 1.0f}) {
    const float back = side < 0 ? 0.0f : 2.5f;
    figure.unite(2.5f, {make_ellipsoid({side * 3.6f, 8, 41.5f}, {3.5f, 6, 7}, turn_x(15))});
    const Knot hind[] = {{{side * 4.2f, 4.5f + back, 39}, 3.7f},
                         {{side * 4.8f, 7.5f + back, 35}, 2.6f},
                         {{side * 5, 12.5f + back, 32.6f}, 2.0f},
                         {{side * 5, 9.5f + back, 28}, 1.5f},
                         {{side * 5, 7.6f + back, 26}, 1.6f}};
    figure.unite(1.5f, make_chain(hind, 4));
    add_hoof(figure, {side * 5, 7.4f + back, 26}, {side * 5, 6.2f + back, 23.8f});
  }
  const Knot left[] = {{{3.6f, -10, 57}, 4},
                       {{4.4f, -15.5f, 56.5f}, 2.8f},
                       {{4.8f, -21.5f, 57.5f}, 2.1f},
                       {{4.6f, -22.6f, 51}, 1.4f},
                       {{4.6f, -22, 48}, 1.6f}};
  const Knot right[] = {{{-3.6f, -10, 58.5f}, 4},
                        {{-4.4f, -16, 60}, 2.8f},
                        {{-4.8f, -22, 62.8f}, 2.1f},
                        {{-4.6f, -26.4f, 58}, 1.4f},
                        {{-4.6f, -27.6f, 55.4f}, 1.6f}};
  figure.unite(1.5f, make_chain(left, 4));
  figure.unite(1.5f, make_chain(right, 4));
  add_hoof(figure, {4.6f, -22, 48.4f}, {4.6f, -20.6f, 45.6f});
  add_hoof(figure, {-4.6f, -27.6f, 55.8f}, {-4.6f, -27.4f, 52.6f});
}

}  // namespace

Figure make_horse_figure() {
  Figure figure;
  add_horse_plinth(figure);
  Figure horse;
  add_horse_trunk(horse);
  add_horse_head(horse);
  add_horse_legs(horse);
  add_mane_and_tail(horse);
  figure.add(horse, 1.1f, glm::mat3(1), {0, 1.5f, -7.6f});
  return figure;
}

}  // namespace viewcell
