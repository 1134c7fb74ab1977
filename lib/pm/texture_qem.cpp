#include "pm/texture_qem.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace viewcell {
namespace {

double dot(const Vec5& a, const Vec5& b) {
  double sum = 0;
  for (std::size_t i = 0; i < 5; ++i) sum += a[i] * b[i];
  return sum;
}

Vec5 plus(const Vec5& a, double s, const Vec5& b) {
  Vec5 out = a;
  for (std::size_t i = 0; i < 5; ++i) out[i] += s * b[i];
  return out;
}

// Scales to length 1; false when there is none.
bool normalise(Vec5& a) {
  const double length = std::sqrt(dot(a, a));
  if (!(length > 0)) return false;
  for (double& x : a) x /= length;
  return true;
}

}  // namespace

void Quadric5::add_triangle(const Vec5& p, const Vec5& q, const Vec5& r, double w) {
  Vec5 e1 = plus(q, -1, p), e2 = plus(r, -1, p);
  if (!normalise(e1)) return;
  e2 = plus(e2, -dot(e1, e2), e1);
  if (!normalise(e2)) return;
  const double p1 = dot(p, e1), p2 = dot(p, e2);
  std::size_t k = 0;
  for (std::size_t i = 0; i < 5; ++i) {
    for (std::size_t j = i; j < 5; ++j, ++k)
      a[k] += w * ((i == j ? 1 : 0) - e1[i] * e1[j] - e2[i] * e2[j]);
    b[i] += w * (p1 * e1[i] + p2 * e2[i] - p[i]);
  }
  c += w * (dot(p, p) - p1 * p1 - p2 * p2);
  weight += w;
}

void Quadric5::add(const Quadric5& q) {
  for (std::size_t k = 0; k < 15; ++k) a[k] += q.a[k];
  for (std::size_t i = 0; i < 5; ++i) b[i] += q.b[i];
  c += q.c, weight += q.weight;
}

double Quadric5::value(const Vec5& x) const {
  double sum = c;
  std::size_t k = 0;
  for (std::size_t i = 0; i < 5; ++i) {
    sum += x[i] * (a[k++] * x[i] + 2 * b[i]);
    for (std::size_t j = i + 1; j < 5; ++j) sum += 2 * a[k++] * x[i] * x[j];
  }
  return sum;
}

TextureQemMetric::TextureQemMetric(const CollapseMesh& mesh, const WedgeMesh& input,
                                   WedgeTable& wedges, std::span<const glm::vec3> positions,
                                   const TextureQemOptions& options)
    : mesh_(mesh),
      wedges_(wedges),
      positions_(positions),
      texcoords_(input.texcoords),
      options_(options),
      centre_(box_centre(positions)),
      quadrics_(input.n_wedges()),
      boundaries_(positions.size()) {
  add_faces(input);
  const std::vector<Triangle> triangles = input.vertex_triangles();
  cost_scale_ = make_quadric_scale(positions, triangles, options.qem);
  boundaries_ = make_boundary_quadrics(positions, triangles, centre_, options.qem);
}

Vec5 TextureQemMetric::point(std::uint32_t vertex, std::uint32_t wedge) const {
  const glm::dvec3 p = glm::dvec3(positions_[vertex]) - centre_;
  const glm::dvec2 t = scale_ * glm::dvec2(texcoords_[wedge]);
  return {p.x, p.y, p.z, t.x, t.y};
}

void TextureQemMetric::add_faces(const WedgeMesh& input) {
  double area_sum = 0, texture_area_sum = 0;
  const auto area_of = [&](const Triangle& f) {
    const auto at = [&](std::size_t k) { return glm::dvec3(positions_[input.wedge_vertex[f[k]]]); };
    return 0.5 * glm::length(glm::cross(at(1) - at(0), at(2) - at(0)));
  };
  for (const Triangle& f : input.faces) {
    const glm::dvec2 a = texcoords_[f[0]], b = texcoords_[f[1]], c = texcoords_[f[2]];
    area_sum += area_of(f);
    texture_area_sum += 0.5 * std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
  }
  if (texture_area_sum > 0)
    scale_ = options_.texture_weight * std::sqrt(area_sum / texture_area_sum);
  for (const Triangle& f : input.faces) {
    const double area = area_of(f);
    if (!(area > 0)) continue;
    const auto at = [&](std::size_t k) { return point(input.wedge_vertex[f[k]], f[k]); };
    Quadric5 plane;
    plane.add_triangle(at(0), at(1), at(2), options_.qem.area_weighted ? area / 3 : 1);
    for (const std::uint32_t w : f) quadrics_[w].add(plane);
  }
}

float TextureQemMetric::cost(std::uint32_t u, std::uint32_t v) {
  if (!wedges_.match(mesh_, u, v, false)) return std::numeric_limits<float>::infinity();
  const glm::dvec3 place = glm::dvec3(positions_[v]) - centre_;
  double value = boundaries_[u].value(place) + boundaries_[v].value(place);
  double weight = boundaries_[u].weight + boundaries_[v].weight;
  const auto add_wedge = [&](std::uint32_t of, std::uint32_t at) {
    value += quadrics_[of].value(point(v, at));
    weight += quadrics_[of].weight;
  };
  others_.clear();
  for (const auto& [from, to] : wedges_.pairs()) {
    add_wedge(from, to);
    if (std::find(others_.begin(), others_.end(), to) != others_.end()) continue;
    add_wedge(to, to);
    others_.push_back(to);
  }
  mesh_.for_each_corner(v, [&](std::uint32_t c) {
    const std::uint32_t w = wedges_.at(c);
    if (std::find(others_.begin(), others_.end(), w) != others_.end()) return;
    add_wedge(w, w);
    others_.push_back(w);
  });
  return cost_scale_.cost(value, weight);
}

// The table's pairs are those of the collapse that was just made.
void TextureQemMetric::traced(std::uint32_t u, std::uint32_t v, const CollapseTrace&) {
  for (const auto& [from, to] : wedges_.pairs()) quadrics_[to].add(quadrics_[from]);
  boundaries_[v].add(boundaries_[u]);
}

}  // namespace viewcell
