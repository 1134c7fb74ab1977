#include "pm/attribute_cost.h"

#include <algorithm>
#include <cmath>

#include "base/srgb.h"
#include "pm/border_edges.h"

namespace viewcell {

void ColourQuadric::add_triangle(const glm::dvec3 (&p)[3], const glm::dvec3 (&colours)[3],
                                 double w) {
  const glm::dvec3 e1 = p[1] - p[0], e2 = p[2] - p[0], n = glm::cross(e1, e2);
  const double n2 = glm::dot(n, n);
  const double longest2 =
      std::max({glm::dot(e1, e1), glm::dot(e2, e2), glm::dot(e2 - e1, e2 - e1)});
  if (!(n2 > 1e-12 * longest2 * longest2)) return;
  const glm::dvec3 along1 = glm::cross(e2, n) / n2, along2 = glm::cross(n, e1) / n2;
  for (int k = 0; k < 3; ++k) {
    const double f0 = colours[0][k];
    const glm::dvec3 g = (colours[1][k] - f0) * along1 + (colours[2][k] - f0) * along2;
    const double d = f0 - glm::dot(g, p[0]);
    a[0] += w * g.x * g.x, a[1] += w * g.y * g.y, a[2] += w * g.z * g.z;
    a[3] += w * g.x * g.y, a[4] += w * g.x * g.z, a[5] += w * g.y * g.z;
    b += w * d * g;
    c += w * d * d;
    gradients[k] += w * g;
    constants[k] += w * d;
  }
  weight += w;
}

void ColourQuadric::add(const ColourQuadric& q) {
  for (std::size_t i = 0; i < 6; ++i) a[i] += q.a[i];
  b += q.b, c += q.c;
  for (int k = 0; k < 3; ++k) gradients[k] += q.gradients[k];
  constants += q.constants, weight += q.weight;
}

double ColourQuadric::value(const glm::dvec3& p, const glm::dvec3& s) const {
  double out = glm::dot(p, times(a, p) + 2.0 * b) + c + weight * glm::dot(s, s);
  for (int k = 0; k < 3; ++k) out -= 2 * s[k] * (glm::dot(gradients[k], p) + constants[k]);
  return out;
}

AttributeCost::AttributeCost(const WedgeMesh& mesh, std::span<const glm::vec3> positions,
                             std::span<const Triangle> triangles,
                             std::span<const glm::vec3> colours,
                             const AttributeCostOptions& options)
    : centre_(box_centre(positions)), scale_(options.scale), fourth_root_(options.fourth_root) {
  if (!mesh.region_vertex.empty()) add_borders(mesh, positions, triangles, options);
  const auto differ = [&](const glm::vec3& c) { return c != colours[0]; };
  if (options.colours && std::any_of(colours.begin(), colours.end(), differ))
    add_colours(mesh, positions, triangles, colours, options);
}

void AttributeCost::add_borders(const WedgeMesh& mesh, std::span<const glm::vec3> positions,
                                std::span<const Triangle> triangles,
                                const AttributeCostOptions& options) {
  const auto region = [&](std::uint32_t t, std::uint32_t v) {
    for (std::size_t k = 0; k < 3; ++k)
      if (triangles[t][k] == v) return mesh.region_vertex[mesh.faces[t][k]];
    return 0xffffffffu;
  };
  const auto are_apart = [&](std::uint32_t a, std::uint32_t b, std::uint32_t s, std::uint32_t t) {
    return region(s, a) != region(t, a) || region(s, b) != region(t, b);
  };
  const std::vector<BorderEdge> edges = find_edges_between(triangles, positions.size(), are_apart);
  n_border_edges_ = edges.size() / 2;
  if (edges.empty() || !options.borders) return;
  QemOptions qem;
  qem.boundary_weight = options.boundary_weight;
  borders_ = sum_border_planes(edges, positions, triangles, centre_, qem);
}

void AttributeCost::add_colours(const WedgeMesh& mesh, std::span<const glm::vec3> positions,
                                std::span<const Triangle> triangles,
                                std::span<const glm::vec3> colours,
                                const AttributeCostOptions& options) {
  const bool has_charts = !mesh.chart_vertex.empty() || !mesh.texture_vertex.empty();
  quadrics_.resize(has_charts ? mesh.n_wedges() : positions.size());
  colours_.resize(quadrics_.size());
  Box box;
  for (const glm::vec3& p : positions) box.add(p);
  const auto scale = static_cast<float>(options.colour_weight * glm::length(box.size()));
  const auto colour_of = [&](std::uint32_t wedge) {
    const glm::vec3& c = colours[mesh.wedge_source[wedge]];
    return scale * glm::vec3(srgb_encode(c.x), srgb_encode(c.y), srgb_encode(c.z));
  };
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    glm::dvec3 corners[3], at_corners[3];
    std::size_t slots[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t wedge = mesh.faces[f][k], vertex = triangles[f][k];
      slots[k] = has_charts ? mesh.chart(wedge) : vertex;
      corners[k] = glm::dvec3(positions[vertex]) - centre_;
      colours_[slots[k]] = colour_of(wedge);
      at_corners[k] = glm::dvec3(colours_[slots[k]]);
    }
    const double area =
        0.5 * glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    ColourQuadric plane;
    plane.add_triangle(corners, at_corners, area / 3);
    for (const std::size_t slot : slots) quadrics_[slot].add(plane);
  }
}

double AttributeCost::square_of_cost(double value, double weight) const {
  if (fourth_root_) return std::sqrt(std::max(value, 0.0));
  const double cost = scale_.cost(value, weight);
  return cost * cost;
}

float AttributeCost::cost(const WedgeTable& table, std::uint32_t u, std::uint32_t v,
                          const glm::vec3& position) const {
  const glm::dvec3 p = glm::dvec3(position) - centre_;
  double squares = 0;
  if (!borders_.empty())
    squares += square_of_cost(borders_[u].value(p) + borders_[v].value(p),
                              borders_[u].weight + borders_[v].weight);
  if (quadrics_.empty()) return static_cast<float>(std::sqrt(squares));
  double value = 0, weight = 0;
  for (const auto& [from, to] : table.chart_pairs()) {
    const std::size_t v_slot = slot(table, to, v);
    for (const std::size_t i : {slot(table, from, u), v_slot}) {
      value += quadrics_[i].value(p, glm::dvec3(colours_[v_slot]));
      weight += quadrics_[i].weight;
    }
  }
  return static_cast<float>(std::sqrt(squares + square_of_cost(value, weight)));
}

bool AttributeCost::has_gradient(const WedgeTable& table, std::uint32_t u, std::uint32_t v) const {
  const auto changes = [&](std::size_t i) {
    const Symmetric3& a = quadrics_[i].a;
    return a[0] + a[1] + a[2] > 0;
  };
  for (const auto& [from, to] : table.chart_pairs())
    if (changes(slot(table, from, u)) || changes(slot(table, to, v))) return true;
  return false;
}

void AttributeCost::merge(const WedgeTable& table, std::uint32_t u, std::uint32_t v) {
  if (!borders_.empty()) borders_[v].add(borders_[u]);
  if (quadrics_.empty()) return;
  for (const auto& [from, to] : table.chart_pairs())
    quadrics_[slot(table, to, v)].add(quadrics_[slot(table, from, u)]);
}

}  // namespace viewcell
