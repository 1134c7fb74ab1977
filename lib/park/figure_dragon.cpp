#include <algorithm>
#include <cmath>
#include <numbers>

#include "park/figure_dragon.h"
#include "park/figures.h"

namespace viewcell {
namespace {

// The spine from the tail's tip to the nape.
const std::vector<Knot>& spine() {
  static const std::vector<Knot> knots{
      {{-21, 9, 13.5f}, 0.4f},      {{-25, 8.5f, 16.5f}, 0.9f}, {{-28, 4, 16}, 1.3f},
      {{-27.5f, -2, 11}, 1.8f},     {{-23, -6, 6.4f}, 2.3f},    {{-16.5f, -5.5f, 6.8f}, 3.0f},
      {{-12, -1, 11.5f}, 3.7f},     {{-8.5f, 2.6f, 18}, 4.0f},  {{-3, 3, 22.4f}, 4.1f},
      {{3, 0.6f, 20.5f}, 4.2f},     {{7.6f, -1.6f, 15}, 4.3f},  {{13, -1.4f, 12.4f}, 4.1f},
      {{18, 1, 15}, 3.5f},          {{19, 2.4f, 21}, 3.0f},     {{16, 2.2f, 26.4f}, 2.7f},
      {{14.4f, 0.6f, 31.4f}, 2.5f}, {{17, -0.4f, 35}, 2.4f}};
  return knots;
}

// A frame that follows the spine: which way the back is there.
struct SpineFrame {
  glm::vec3 point, along, back, side;
  float radius;
};

SpineFrame frame_at(float t) {
  const std::vector<Knot>& knots = spine();
  const Knot at = point_on_chain(knots, t);
  const glm::vec3 along = glm::normalize(point_on_chain(knots, t + 0.05f).point -
                                         point_on_chain(knots, t - 0.05f).point);
  // The back looks up, and backwards where the neck rises.
  const float rising = glm::smoothstep(10.6f, 12.2f, t) * (1 - glm::smoothstep(14.6f, 16.0f, t));
  const glm::vec3 hint = glm::mix(glm::vec3(-0.15f, 0, 1), glm::vec3(-1, 0, 0.35f), rising);
  const glm::vec3 side = glm::normalize(glm::cross(hint, along));
  return {at.point, along, glm::cross(along, side), side, at.radius};
}

float last_t() {
  return static_cast<float>(spine().size() - 1);
}

// Steps along the spine by a length that depends on the radius there.
template <typename Visit>
void walk_spine(float from, float to, float step_in_radii, const Visit& visit) {
  int row = 0;
  for (float t = from; t < to; ++row) {
    const SpineFrame frame = frame_at(t);
    visit(frame, row);
    const glm::vec3 ahead = point_on_chain(spine(), t + 0.02f).point;
    const float speed = std::max(glm::length(ahead - frame.point) / 0.02f, 1.0f);
    t += std::max(step_in_radii * frame.radius, 0.35f) / speed;
  }
}

// Overlapping scales in staggered rows over the back and the flanks.
void add_scales(Figure& figure) {
  walk_spine(1.2f, last_t() - 0.2f, 0.27f, [&](const SpineFrame& f, int row) {
    constexpr int kAround = 13;
    std::vector<Solid> scales;
    for (int i = 0; i < kAround; ++i) {
      const float u = (static_cast<float>(i) + (row % 2 == 0 ? 0.25f : 0.75f)) / kAround - 0.5f;
      const float angle = u * 1.5f * std::numbers::pi_v<float>;
      const glm::vec3 out = std::cos(angle) * f.back + std::sin(angle) * f.side;
      const glm::vec3 normal = glm::normalize(out + 0.30f * f.along);  // tips stand off, tailwards
      const glm::vec3 across = glm::normalize(glm::cross(f.along, out));
      const glm::mat3 axes(across, glm::cross(normal, across), normal);
      const float r = f.radius;
      scales.push_back(
          make_ellipsoid(f.point + 0.97f * r * out, {0.235f * r, 0.30f * r, 0.085f * r}, axes));
    }
    figure.unite(0.03f * f.radius, std::move(scales));
  });
}

// Broad plates across the belly.
void add_belly(Figure& figure) {
  walk_spine(1.2f, last_t() - 0.3f, 0.36f, [&](const SpineFrame& f, int) {
    const glm::mat3 axes(f.side, f.back, f.along);
    figure.unite(0.05f * f.radius,
                 {make_ellipsoid(f.point - 0.62f * f.radius * f.back,
                                 {0.74f * f.radius, 0.5f * f.radius, 0.24f * f.radius}, axes)});
  });
}

// A crest of curved spikes along the back.
void add_crest(Figure& figure) {
  walk_spine(1.5f, last_t() - 0.4f, 0.62f, [&](const SpineFrame& f, int row) {
    const float tall = (row % 2 == 0 ? 0.95f : 0.7f) * f.radius;
    const glm::vec3 root = f.point + 0.85f * f.radius * f.back;
    const Knot spike[] = {{root, 0.30f * f.radius},
                          {root + 0.6f * tall * f.back - 0.12f * tall * f.along, 0.2f * f.radius},
                          {root + tall * f.back - 0.55f * tall * f.along, 0.05f * f.radius}};
    figure.unite(0.15f * f.radius, make_chain(spike, 3));
  });
}

void add_tail_tuft(Figure& figure) {
  for (int i = 0; i < 7; ++i) {
    const float s = static_cast<float>(i - 3);
    const Knot lock[] = {{{-21.4f, 9, 13.7f}, 0.55f},
                         {{-19.2f + 0.2f * s, 9.4f + 0.45f * s, 12.6f + 0.6f * s}, 0.7f},
                         {{-16.4f, 9.2f + 0.95f * s, 12.8f + 1.1f * s}, 0.5f},
                         {{-14.2f - 0.3f * std::abs(s), 8.6f + 1.2f * s, 14.2f + 1.3f * s}, 0.12f}};
    figure.unite(0.25f, make_chain(lock, 4));
  }
}

void add_claw(Figure& figure, const glm::vec3& ankle, const glm::vec3& toward) {
  const glm::vec3 ahead = glm::normalize(glm::vec3(toward.x, toward.y, 0));
  const glm::vec3 side(-ahead.y, ahead.x, 0);
  figure.unite(0.8f, {make_ellipsoid({ankle.x + 0.6f * ahead.x, ankle.y + 0.6f * ahead.y, 1.5f},
                                     {2.0f, 1.9f, 1.3f})});
  for (int toe = -2; toe <= 2; ++toe) {
    const bool is_back = toe == -2;  // four toes ahead, one behind
    const float spread = is_back ? 0.0f : 0.55f * (static_cast<float>(toe) - 0.5f);
    const glm::vec3 way = is_back ? -ahead : glm::normalize(ahead + spread * side);
    const glm::vec3 base(ankle.x + 1.0f * way.x, ankle.y + 1.0f * way.y, 1.5f);
    const Knot digit[] = {{base, 1.0f},
                          {base + 1.6f * way + glm::vec3(0, 0, 0.7f), 0.8f},
                          {base + 2.8f * way + glm::vec3(0, 0, -0.5f), 0.75f}};
    figure.unite(0.3f, make_chain(digit, 4));
    const Knot nail[] = {{base + 2.9f * way + glm::vec3(0, 0, -0.1f), 0.55f},
                         {base + 3.9f * way + glm::vec3(0, 0, -0.2f), 0.4f},
                         {base + 4.7f * way + glm::vec3(0, 0, -1.15f), 0.1f}};
    figure.unite(0.08f, make_chain(nail, 4));
  }
}

// A leg from hip to ankle with its claw, and flames at the elbow.
void add_dragon_leg(Figure& figure, const Knot (&knots)[4], const glm::vec3& toward, float flame) {
  figure.unite(1.4f, make_chain(knots, 5));
  add_claw(figure, knots[3].point, toward);
  for (int i = 0; i < 4; ++i) {
    const float s = static_cast<float>(i);
    const glm::vec3 root = glm::mix(knots[1].point, knots[2].point, 0.2f * s);
    const Knot lock[] = {
        {root, 0.8f},
        {root + glm::vec3(-1.8f, flame * 0.9f, 0.7f + 0.3f * s), 0.6f},
        {root + glm::vec3(-3.4f - 0.2f * s, flame * 1.3f, 2.2f + 0.3f * s), 0.12f}};
    figure.unite(0.3f, make_chain(lock, 4));
  }
}

void add_dragon_legs(Figure& figure) {
  add_dragon_leg(figure,
                 {{{-11, -3.4f, 11}, 3.2f},
                  {{-7.4f, -7, 9.5f}, 2.4f},
                  {{-10.6f, -8.4f, 5.2f}, 1.6f},
                  {{-8.6f, -8.6f, 2.4f}, 1.4f}},
                 {1, -0.25f, 0}, -1);
  add_dragon_leg(figure,
                 {{{-11, 3.2f, 13}, 3.2f},
                  {{-8.4f, 7.2f, 9.5f}, 2.4f},
                  {{-12.2f, 8.2f, 5.2f}, 1.6f},
                  {{-10.6f, 8.4f, 2.4f}, 1.4f}},
                 {1, 0.3f, 0}, 1);
  add_dragon_leg(figure,
                 {{{9, -3.6f, 14}, 3.2f},
                  {{7.4f, -8, 10}, 2.2f},
                  {{11, -9.2f, 5.6f}, 1.6f},
                  {{12.6f, -9.2f, 2.4f}, 1.4f}},
                 {1, -0.2f, 0}, -1);
  add_dragon_leg(figure,
                 {{{10, 2.6f, 13.5f}, 3.2f},
                  {{9.6f, 7, 10.4f}, 2.2f},
                  {{14.4f, 8.2f, 6.6f}, 1.6f},
                  {{17.4f, 8.6f, 2.4f}, 1.4f}},
                 {1, 0.25f, 0}, 1);
}

}  // namespace

Figure make_dragon_figure() {
  Figure figure;
  figure.unite(0, make_chain(spine(), 6));
  add_belly(figure);
  add_scales(figure);
  add_dragon_legs(figure);
  add_crest(figure);
  add_tail_tuft(figure);
  figure.add(make_dragon_head(), 1, turn_z(-6) * turn_y(10), {18.2f, -0.4f, 35});
  return figure;
}

}  // namespace viewcell
