#include "park/figures.h"

namespace viewcell {
namespace {

void add_moai_body(Figure& figure) {
  figure.unite(0, {make_drum({0, 0.4f, -1}, 5.2f, {0, 0.4f, 9.2f}, 5.5f, 1.8f, {1, 0.84f})});
  figure.unite(2, {make_round_cone({0, 0.2f, 8}, 4, {0, 0.3f, 13}, 3.3f)});
  // arms laid along the body, long fingers meeting under the navel
  figure.unite_pair(0, 0.6f,
                    {make_round_cone({4.9f, 0.2f, 8.2f}, 1.35f, {5.2f, -0.4f, 4.4f}, 1.2f),
                     make_round_cone({5.2f, -0.4f, 4.4f}, 1.2f, {4, -3.2f, 2.1f}, 1.0f)},
                    0.4f);
  for (int finger = 0; finger < 4; ++finger) {
    const float z = 1.2f + 0.62f * static_cast<float>(finger);
    figure.unite_pair(0, 0.15f, {make_round_cone({3.8f, -3.3f, 2}, 0.5f, {0.8f, -4.3f, z}, 0.34f)});
  }
}

void add_moai_head(Figure& figure) {
  figure.unite(1.5f, {make_box({0, 0.6f, 17.6f}, {3.5f, 3.7f, 8.4f}, 2.4f, turn_x(-5))});
  figure.unite(1.2f, {make_ellipsoid({0, 1.6f, 21}, {4.1f, 3.8f, 5.5f})});      // the skull
  figure.unite(1.2f, {make_box({0, -1.9f, 11.6f}, {3.1f, 2.5f, 2.2f}, 1.3f)});  // the jaw
  figure.cut(1.6f, {make_ellipsoid({0, -6.9f, 16.2f}, {8, 3.5f, 5.2f})});       // the face
  figure.unite(1.1f, {make_round_cone({-3, -2.6f, 21.2f}, 0.95f, {0, -3.5f, 21.7f}, 1.0f),
                      make_round_cone({0, -3.5f, 21.7f}, 1.0f, {3, -2.6f, 21.2f}, 0.95f)});
  figure.cut_pair(0, 0.4f, {make_ellipsoid({1.9f, -3.6f, 19.7f}, {1.35f, 1.3f, 0.95f})});
  figure.unite_pair(0, 0.2f, {make_ellipsoid({1.85f, -2.2f, 19.5f}, {1, 0.55f, 0.6f})});
  figure.unite(0.9f, {make_round_cone({0, -2.7f, 21.3f}, 1.0f, {0, -3.9f, 16.2f}, 1.2f)});
  figure.unite_pair(0, 0.4f, {make_ellipsoid({1.05f, -3.7f, 15.9f}, {0.85f, 1.1f, 0.75f})});
  figure.cut_pair(0, 0.15f, {make_ellipsoid({0.7f, -4.3f, 15.1f}, {0.35f, 0.45f, 0.4f})});
}

void add_mouth_and_ears(Figure& figure) {
  figure.unite(0.6f, {make_ellipsoid({0, -3.6f, 13.3f}, {2.3f, 1.2f, 0.62f})});
  figure.unite(0.3f, {make_ellipsoid({0, -3.6f, 12.2f}, {2.1f, 1.2f, 0.55f})});
  figure.cut(0.15f, {make_ellipsoid({0, -4.9f, 12.74f}, {2.2f, 0.9f, 0.2f})});
  figure.unite(0.6f, {make_ellipsoid({0, -3.6f, 10.3f}, {2.2f, 1.2f, 0.9f})});  // the chin
  figure.unite_pair(0, 0.5f,
                    {make_box({4.1f, 0.9f, 18}, {0.75f, 1.3f, 3.4f}, 0.6f, turn_x(-5)),
                     make_box({4.2f, 0.4f, 12.9f}, {0.7f, 0.85f, 2.2f}, 0.6f)},
                    0.5f);
  figure.cut_pair(0, 0.3f, {make_ellipsoid({5.2f, 0.7f, 18}, {0.8f, 0.75f, 2.6f})});
  figure.cut_pair(0, 0.2f, {make_ellipsoid({5.1f, 0.4f, 12.6f}, {0.6f, 0.4f, 0.7f})});
}

}  // namespace

Figure make_moai_figure() {
  Figure figure;
  add_moai_body(figure);
  add_moai_head(figure);
  add_mouth_and_ears(figure);
  figure.unite(0.2f, {make_drum({0, 1.4f, 25.2f}, 4.4f, {0, 1.4f, 28.8f}, 4.7f, 1.0f)});
  figure.unite(0.5f, {make_drum({0, 1.4f, 28}, 2.2f, {0, 1.4f, 30.8f}, 1.8f, 0.7f)});
  return figure;
}

}  // namespace viewcell
