#include "pm/texture_qem.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace viewcell {

TextureQuadrics::TextureQuadrics(const WedgeMesh& input, std::span<const glm::vec3> at,
                                 std::span<const Triangle> triangles,
                                 const std::vector<glm::vec2>& uv, const TextureQemOptions& options)
    : positions(at), texcoords(uv), centre(box_centre(at)), of_wedges(input.n_wedges()) {
  cost_scale = make_quadric_scale(positions, triangles, options.qem);
  boundaries = make_boundary_quadrics(positions, triangles, centre, options.qem);
  double area_sum = 0, texture_area_sum = 0;
  const auto area_of = [&](const Triangle& t) {
    const glm::dvec3 a(positions[t[0]]), b(positions[t[1]]), c(positions[t[2]]);
    return 0.5 * glm::length(glm::cross(b - a, c - a));
  };
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const auto& [i, j, k] = input.faces[f];
    if (triangles[f][0] == triangles[f][1]) continue;  // a copy
    const glm::dvec2 a = texcoords[i], b = texcoords[j], c = texcoords[k];
    area_sum += area_of(triangles[f]);
    texture_area_sum += 0.5 * std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
  }
  if (texture_area_sum > 0) scale = options.texture_weight * std::sqrt(area_sum / texture_area_sum);
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const double area = area_of(triangles[f]);
    if (!(area > 0)) continue;
    const auto corner = [&](std::size_t k) { return point(triangles[f][k], input.faces[f][k]); };
    Quadric5 plane;
    plane.add_triangle(corner(0), corner(1), corner(2), options.qem.area_weighted ? area / 3 : 1);
    for (const std::uint32_t w : input.faces[f]) of_wedges[input.chart(w)].add(plane);
  }
}

Vec5 TextureQuadrics::point(std::uint32_t vertex, std::uint32_t wedge) const {
  const glm::dvec3 p = glm::dvec3(positions[vertex]) - centre;
  const glm::dvec2 t = scale * glm::dvec2(texcoords[wedge]);
  return {p.x, p.y, p.z, t.x, t.y};
}

void TextureQuadrics::merge(std::uint32_t u, std::uint32_t v, const WedgeTable& wedges) {
  for (const auto& [from, to] : wedges.chart_pairs())
    of_wedges[wedges.chart_vertex(to)].add(of_wedges[wedges.chart_vertex(from)]);
  boundaries[v].add(boundaries[u]);
}

float TextureQuadrics::cost_at_parent(const CollapseMesh& mesh, WedgeTable& wedges, std::uint32_t u,
                                      std::uint32_t v) const {
  const glm::dvec3 position = glm::dvec3(positions[v]) - centre;
  double value = boundaries[u].value(position) + boundaries[v].value(position);
  double weight = boundaries[u].weight + boundaries[v].weight;
  const auto add_wedge = [&](std::uint32_t of, std::uint32_t at) {
    const Quadric5& quadric = of_wedges[wedges.chart_vertex(of)];
    value += quadric.value(point(v, at));
    weight += quadric.weight;
  };
  const std::span<const WedgeTable::Pair> pairs(wedges.chart_pairs());
  const auto is_met = [&](std::span<const WedgeTable::Pair> before, std::uint32_t wedge) {
    return std::any_of(before.begin(), before.end(), [&](const WedgeTable::Pair& p) {
      return wedges.chart_vertex(p.to) == wedges.chart_vertex(wedge);
    });
  };
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    add_wedge(pairs[i].from, pairs[i].to);
    if (!is_met(pairs.first(i), pairs[i].to)) add_wedge(pairs[i].to, pairs[i].to);
  }
  // of a hub those that are met, for what the others are off does not depend on u
  if (!mesh.is_hub(v))
    for (const std::uint32_t w : wedges.chart_wedges(mesh, v))
      if (!is_met(pairs, w)) add_wedge(w, w);
  return cost_scale.cost(value, weight);
}

float TextureQemMetric::cost(std::uint32_t u, std::uint32_t v) {
  if (!wedges_.match(mesh_, u, v)) return std::numeric_limits<float>::infinity();
  return quadrics_.cost_at_parent(mesh_, wedges_, u, v);
}

float TextureQemFullMetric::cost_at_end(std::uint32_t u, std::uint32_t v) {
  if (!wedges_.match(mesh_, u, v)) return std::numeric_limits<float>::infinity();
  return quadrics_.cost_at_parent(mesh_, wedges_, u, v);
}

const TextureQemFullMetric::Evaluated& TextureQemFullMetric::evaluate(std::uint32_t u,
                                                                      std::uint32_t v) {
  last_ = {std::numeric_limits<float>::infinity(), positions_[v], {}};
  if (!wedges_.match(mesh_, u, v)) return last_;
  if (mesh_.is_hub(v) || !wedges_.match_both(mesh_, v)) {
    last_.cost = quadrics_.cost_at_parent(mesh_, wedges_, u, v);
    return last_;
  }
  if (u > v) {  // the same sums from either side
    std::swap(u, v);
    wedges_.match(mesh_, u, v) && wedges_.match_both(mesh_, v);
  }
  wedges_.chart_pairs().size() == 1 ? place_freely(u, v) : place_on_edge(u, v);
  return last_;
}

void TextureQemFullMetric::place_freely(std::uint32_t u, std::uint32_t v) {
  const auto [from, to] = wedges_.chart_pairs()[0];
  Quadric5 sum = quadrics_.of_wedges[wedges_.chart_vertex(from)];
  sum.add(quadrics_.of_wedges[wedges_.chart_vertex(to)]);
  sum.add(quadrics_.boundaries[u]);
  sum.add(quadrics_.boundaries[v]);
  const Vec5 a = quadrics_.point(u, from), b = quadrics_.point(v, to);
  Vec5 middle;
  for (std::size_t i = 0; i < 5; ++i) middle[i] = 0.5 * (a[i] + b[i]);
  const Vec5 x = sum.minimiser(middle);
  last_.cost = quadrics_.cost_scale.cost(sum.value(x), sum.weight);
  last_.position = glm::vec3(quadrics_.centre + glm::dvec3(x[0], x[1], x[2]));
  if (quadrics_.scale > 0) last_.texcoord = glm::vec2(glm::dvec2(x[3], x[4]) / quadrics_.scale);
}

// The sum is quadratic along the edge: its values at both ends and in the middle determine it.
void TextureQemFullMetric::place_on_edge(std::uint32_t u, std::uint32_t v) {
  double weight = 0;
  const auto value_at = [&](double along) {
    double value = 0;
    weight = 0;
    const auto add = [&](const Quadric5& quadric, const Vec5& x) {
      value += quadric.value(x), weight += quadric.weight;
    };
    for (const auto& [from, to] : wedges_.chart_pairs()) {
      const Vec5 a = quadrics_.point(u, from);
      Vec5 x = quadrics_.point(v, to);
      for (std::size_t i = 0; i < 5; ++i) x[i] += along * (a[i] - x[i]);
      for (const std::uint32_t w : {from, to}) add(quadrics_.of_wedges[wedges_.chart_vertex(w)], x);
    }
    const glm::dvec3 p =
        glm::mix(glm::dvec3(positions_[v]), glm::dvec3(positions_[u]), along) - quadrics_.centre;
    for (const std::uint32_t w : {u, v}) {
      value += quadrics_.boundaries[w].value(p);
      weight += quadrics_.boundaries[w].weight;
    }
    return value;
  };
  const double f0 = value_at(0), f1 = value_at(1), middle = value_at(0.5);
  const double bend = 2 * (f0 + f1 - 2 * middle), slope = f1 - f0 - bend;
  const double along = bend > 0 ? std::clamp(-slope / (2 * bend), 0.0, 1.0) : (f1 < f0 ? 1 : 0);
  last_.cost = quadrics_.cost_scale.cost(value_at(along), weight);
  last_.position = glm::vec3(glm::mix(glm::dvec3(positions_[v]), glm::dvec3(positions_[u]), along));
}

}  // namespace viewcell
