#include <cmath>

#include "park/figures.h"

namespace viewcell {
namespace {

void add_mound(Figure& figure) {
  figure.unite(0, {make_drum({0, 0, -1}, 17.2f, {0, 0, 2.2f}, 15.8f, 1.0f, {1.22f, 0.94f})});
  for (int i = 0; i < 14; ++i) {  // stones and tufts around the rim
    const float angle = 0.449f * static_cast<float>(i), r = i % 3 == 0 ? 0.86f : 0.93f;
    const float size = 1.6f + 0.7f * static_cast<float>(i * 5 % 4);
    figure.unite(0.6f, {make_ellipsoid(
                           {19.6f * r * std::cos(angle), 15.2f * r * std::sin(angle), 1.8f},
                           {1.3f * size, size, 0.75f * size}, turn_z(static_cast<float>(37 * i)))});
  }
  for (int i = 0; i < 24; ++i) {  // blades of grass before the paws
    const float s = static_cast<float>(i);
    const glm::vec3 root(13.5f + 2.6f * std::sin(2.1f * s), -9.5f + 0.85f * s, 1.6f);
    const glm::vec3 tip = root + glm::vec3(0.9f * std::sin(3.7f * s), 0.9f * std::cos(2.9f * s),
                                           3.6f + 1.4f * std::sin(5.3f * s));
    figure.unite(0.3f, {make_round_cone(root, 0.55f, tip, 0.16f)});
  }
}

void add_hare_body(Figure& figure) {
  figure.unite(1.2f, {make_ellipsoid({-4, 0, 15}, {14, 10.5f, 12.2f}, turn_y(-14))});
  figure.unite(4, {make_ellipsoid({6, 0, 16.5f}, {8.2f, 8.2f, 10.5f}, turn_y(-20))});  // the chest
  figure.unite_pair(1, 1.6f, {make_ellipsoid({-7, 7.6f, 11}, {9.6f, 5.2f, 9.4f}, turn_y(12))});
  figure.unite_pair(1, 1, {make_round_cone({-6.5f, 10.6f, 4.4f}, 2.9f, {6.2f, 11.2f, 3.7f}, 2.2f)});
  for (int toe = 0; toe < 3; ++toe)
    figure.unite_pair(
        1, 0.4f,
        {make_ellipsoid({7.4f, 9.7f + 1.5f * static_cast<float>(toe), 3.4f}, {2.1f, 0.95f, 1.3f})});
  figure.unite(1.0f,
               {make_ellipsoid({-18.2f, 0, 9}, {3.6f, 3.4f, 4}),
                make_ellipsoid({-20, 0.4f, 11.2f}, {2.2f, 2.4f, 2.6f})},
               0.8f);  // the tail
  // front legs, a little apart
  for (const float side : {-1.0f, 1.0f}) {
    const float ahead = side > 0 ? 1.2f : 0.0f;
    const Knot leg[] = {{{8, side * 5, 14}, 3.6f},
                        {{9.8f + ahead, side * 4.9f, 8.5f}, 2.4f},
                        {{10.8f + ahead, side * 4.6f, 4.5f}, 1.9f},
                        {{12 + ahead, side * 4.5f, 3.1f}, 1.8f}};
    figure.unite(1.4f, make_chain(leg, 4));
    for (int toe = 0; toe < 3; ++toe)
      figure.unite(
          0.35f,
          {make_ellipsoid({13.4f + ahead, side * 4.5f + 1.2f * static_cast<float>(toe - 1), 2.9f},
                          {1.6f, 0.75f, 1.1f})});
  }
  // tufts of the breast
  for (int i = 0; i < 15; ++i) {
    const float row = static_cast<float>(i / 5), y = 2.2f * static_cast<float>(i % 5 - 2);
    const float z = 21 - 3.4f * row, x = 13.2f - 0.06f * y * y - 0.3f * row;
    figure.unite(0.5f,
                 {make_round_cone({x - 0.8f, y, z}, 1.5f, {x + 0.9f, 1.06f * y, z - 3.6f}, 0.35f)});
  }
}

void add_hare_head(Figure& figure) {
  figure.unite(2.5f, {make_ellipsoid({10.5f, 0, 27.4f}, {6.6f, 5.4f, 5.9f}, turn_y(14))});
  figure.unite(1.5f, {make_ellipsoid({15.4f, 0, 25.6f}, {3.9f, 3.2f, 3.2f})});  // the muzzle
  figure.unite_pair(1, 0.8f, {make_ellipsoid({17.3f, 1.3f, 24.9f}, {1.7f, 1.45f, 1.6f})});
  figure.unite(0.4f, {make_ellipsoid({18.9f, 0, 26.3f}, {0.75f, 1.0f, 0.7f})});  // the nose
  figure.cut(0.3f, {make_box({19, 0, 24.6f}, {1.6f, 0.13f, 1.5f}, 0.1f)});
  figure.unite(0.6f, {make_ellipsoid({15.8f, 0, 22.9f}, {2.1f, 1.6f, 1.1f})});
  figure.unite_pair(1, 1.2f, {make_ellipsoid({11.2f, 4.3f, 25}, {3.5f, 2, 3})});  // cheeks
  figure.cut_pair(1, 0.5f,
                  {make_ellipsoid({13.2f, 5.4f, 28.2f}, {1.9f, 1.2f, 1.35f}, turn_z(-20))});
  figure.unite_pair(1, 0.2f,
                    {make_ellipsoid({12.9f, 4.15f, 28.2f}, {1.4f, 0.9f, 1.05f}, turn_z(-20))});
  const Knot lid[] = {{{11.2f, 4.9f, 28.2f}, 0.3f},
                      {{12.2f, 5.1f, 29.4f}, 0.42f},
                      {{13.8f, 4.6f, 29.5f}, 0.42f},
                      {{15, 3.9f, 28.4f}, 0.3f}};
  figure.unite_pair(1, 0.5f, make_chain(lid, 4));
}

// A long hollow ear from its root along the curve; `open`: where the hollow looks.
void add_ear(Figure& figure, const Knot (&knots)[5], const glm::vec3& open) {
  std::vector<Solid> shell, hollow;
  constexpr int kSteps = 9;
  for (int i = 0; i <= 4 * kSteps; ++i) {
    const float t = static_cast<float>(i) / kSteps;
    const Knot at = point_on_chain(knots, t), ahead = point_on_chain(knots, t + 0.05f);
    const Knot behind = point_on_chain(knots, t - 0.05f);
    const glm::vec3 along = glm::normalize(ahead.point - behind.point);
    const glm::vec3 side = glm::normalize(glm::cross(along, open));
    const glm::mat3 axes(side, glm::cross(along, side), along);
    shell.push_back(make_ellipsoid(at.point, {at.radius, 0.42f * at.radius + 0.35f, 1.6f}, axes));
    if (i > 3 && i < 4 * kSteps - 2)
      hollow.push_back(make_ellipsoid(at.point + 0.62f * at.radius * glm::normalize(open),
                                      {0.74f * at.radius, 0.5f * at.radius, 1.5f}, axes));
  }
  figure.unite(1.0f, shell, 0.6f);
  figure.cut(0.35f, hollow, 0.5f);
}

}  // namespace

Figure make_hare_figure() {
  Figure figure;
  add_mound(figure);
  add_hare_body(figure);
  add_hare_head(figure);
  add_ear(figure,
          {{{8.4f, 2.6f, 31.4f}, 1.5f},
           {{7, 4.2f, 34.5f}, 2.3f},
           {{4.4f, 6, 38}, 2.7f},
           {{2, 7.4f, 41}, 2.2f},
           {{0.4f, 8, 43.4f}, 0.9f}},
          {0.75f, 0.55f, 0.25f});
  add_ear(figure,
          {{{8, -2.6f, 31.4f}, 1.5f},
           {{5.4f, -3.8f, 34.4f}, 2.3f},
           {{0.6f, -5.2f, 36}, 2.7f},
           {{-4.6f, -6.4f, 34.6f}, 2.2f},
           {{-8.2f, -7, 31.8f}, 0.9f}},
          {0.2f, -0.9f, 0.45f});
  return figure;
}

}  // namespace viewcell
