#include <cmath>

#include "park/figures.h"

namespace viewcell {
namespace {

void add_socle(Figure& figure) {
  figure.unite(0, {make_drum({0, 0, -1}, 3.5f, {0, 0, 1.1f}, 3.4f, 0.3f)});
  figure.unite(0.5f, {make_drum({0, 0, 0.8f}, 2.5f, {0, 0, 4}, 1.6f, 0.2f)});
  figure.unite(0.3f, {make_drum({0, 0, 3.6f}, 2.2f, {0, 0, 4.3f}, 2.3f, 0.25f)});
}

void add_chest(Figure& figure) {
  figure.unite(0.6f, {make_round_cone({0, 0, 4.6f}, 1.9f, {0, 0.2f, 7.4f}, 3)});
  figure.unite(1.2f, {make_ellipsoid({0, 0.3f, 8.2f}, {4.3f, 2.5f, 2.5f})});
  figure.unite(1, {make_round_cone({-3.5f, 0.5f, 9.4f}, 1.5f, {3.5f, 0.5f, 9.4f}, 1.5f)});
  figure.unite_pair(0, 0.7f, {make_ellipsoid({1.75f, -1.9f, 7.4f}, {1.5f, 1.5f, 1.45f})});
  // a mantle over the left shoulder, its folds falling across the breast
  for (int fold = 0; fold < 3; ++fold) {
    const float d = static_cast<float>(fold);
    const Knot knots[] = {{{4.0f - 0.6f * d, 2.1f, 8.6f + 0.5f * d}, 0.6f},
                          {{4.0f - 0.8f * d, 0.3f, 10.4f + 0.1f * d}, 0.65f},
                          {{2.9f - 0.9f * d, -2.3f, 8.6f - 0.5f * d}, 0.55f},
                          {{0.6f - 0.9f * d, -2.9f, 6.6f - 0.1f * d}, 0.5f},
                          {{-1.6f - 0.5f * d, -1.6f, 5.6f + 0.6f * d}, 0.4f}};
    figure.unite(0.35f, make_chain(knots, 5));
  }
}

void add_bust_head(Figure& figure) {
  figure.unite(0.9f, {make_round_cone({0, 0.6f, 9.6f}, 1.75f, {0, 0.2f, 13.6f}, 1.45f)});
  figure.unite(0.5f, {make_ellipsoid({0, -0.2f, 16.3f}, {2.3f, 2.8f, 3.1f})});
  figure.unite(0.8f, {make_ellipsoid({0, -1.3f, 14.6f}, {1.7f, 1.7f, 1.7f})});
  figure.unite(0.5f, {make_ball({0, -2.5f, 13.6f}, 0.6f)});
  figure.cut_pair(0, 0.5f, {make_ellipsoid({1.1f, -3.1f, 16.3f}, {0.85f, 0.75f, 0.6f})});
  figure.unite_pair(0, 0.15f, {make_ellipsoid({1.0f, -2.3f, 16.25f}, {0.6f, 0.4f, 0.36f})});
  figure.unite(0.3f, {make_round_cone({0, -2.8f, 16.9f}, 0.38f, {0, -3.5f, 15.4f}, 0.46f)});
  figure.unite_pair(0, 0.2f, {make_ball({0.42f, -2.85f, 15.25f}, 0.36f)});
  figure.unite(0.15f, {make_ellipsoid({0, -2.9f, 14.6f}, {0.85f, 0.45f, 0.24f}),
                       make_ellipsoid({0, -2.85f, 14.15f}, {0.7f, 0.45f, 0.26f})});
  figure.unite_pair(0, 0.2f, {make_ellipsoid({2.3f, -0.1f, 15.8f}, {0.25f, 0.5f, 0.8f})});
}

// Waved strands from the parting to the knot at the back, and a lock on the right shoulder.
void add_hair(Figure& figure) {
  figure.unite(0.3f, {make_ellipsoid({0, 0.7f, 17.3f}, {2.5f, 2.75f, 2.55f})});
  for (int strand = 0; strand < 5; ++strand) {
    const float s = static_cast<float>(strand);
    const Knot knots[] = {{{0.15f, -2.35f + 0.75f * s, 18.6f + 0.5f * s - 0.09f * s * s}, 0.4f},
                          {{1.6f, -1.9f + 0.75f * s, 18.1f + 0.3f * s}, 0.55f},
                          {{2.45f, -0.5f + 0.5f * s, 16.5f + 0.45f * s}, 0.5f},
                          {{1.9f, 1.9f + 0.1f * s, 15.6f + 0.5f * s}, 0.5f},
                          {{0.3f, 3.2f, 16.3f + 0.3f * s}, 0.45f}};
    const std::vector<Solid> chain = make_chain(knots, 4);
    figure.unite_pair(0, 0.12f, chain);
  }
  figure.unite(0.2f, {make_ellipsoid({0, 3.3f, 16.8f}, {1.5f, 1.2f, 1.4f})});
  figure.unite(0.2f, {make_ellipsoid({0, 1.1f, 20.2f}, {1.3f, 1.3f, 1.1f})});
  const Knot lock[] = {{{1.6f, 1.8f, 14.8f}, 0.7f},
                       {{2.5f, 0.7f, 12.7f}, 0.65f},
                       {{2.0f, -0.9f, 11.2f}, 0.6f},
                       {{2.6f, -1.9f, 9.6f}, 0.3f}};
  figure.unite_pair(0, 0.2f, make_chain(lock, 4));
}

}  // namespace

Figure make_bust_figure() {
  Figure figure;
  add_socle(figure);
  add_chest(figure);
  add_bust_head(figure);
  add_hair(figure);
  return figure;
}

}  // namespace viewcell
