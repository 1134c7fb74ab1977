#include "pm/quadric5.h"

#include <cmath>

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

void Quadric5::add(const Quadric& q) {
  const std::array<double, 15> more{q.xx, q.xy, q.xz, 0, 0, q.yy, q.yz, 0, 0, q.zz, 0, 0, 0, 0, 0};
  for (std::size_t k = 0; k < 15; ++k) a[k] += more[k];
  b[0] += q.x, b[1] += q.y, b[2] += q.z, c += q.c, weight += q.weight;
}

// By Cholesky's decomposition.
Vec5 Quadric5::minimiser(const Vec5& anchor) const {
  double m[5][5];
  std::size_t k = 0;
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = i; j < 5; ++j) m[i][j] = m[j][i] = a[k++];
  double trace = 0;
  for (std::size_t i = 0; i < 5; ++i) trace += m[i][i];
  const double slack = Quadric::kSlack * trace;
  if (!(slack > 0)) return anchor;
  Vec5 x;
  for (std::size_t i = 0; i < 5; ++i) m[i][i] += slack, x[i] = slack * anchor[i] - b[i];
  for (std::size_t i = 0; i < 5; ++i) {
    for (std::size_t j = 0; j < i; ++j) m[i][i] -= m[i][j] * m[i][j], x[i] -= m[i][j] * x[j];
    if (!(m[i][i] > 0)) return anchor;
    m[i][i] = std::sqrt(m[i][i]);
    x[i] /= m[i][i];
    for (std::size_t r = i + 1; r < 5; ++r) {
      for (std::size_t j = 0; j < i; ++j) m[r][i] -= m[r][j] * m[i][j];
      m[r][i] /= m[i][i];
    }
  }
  for (std::size_t i = 5; i-- > 0;) {
    for (std::size_t j = i + 1; j < 5; ++j) x[i] -= m[j][i] * x[j];
    x[i] /= m[i][i];
  }
  return x;
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

}  // namespace viewcell
