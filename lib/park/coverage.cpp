#include "park/coverage.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "scene/camera.h"

namespace viewcell {
namespace {

constexpr double kColumnRad = 2 * std::numbers::pi / Panorama::kColumns;
// Squares of half a sample's share of the surface would leave holes where samples happen to be
// sparse, but the surface's far side fills most; found against drawn frames (walk_test).
constexpr double kRadiusInSpacings = 0.33;

// Bits [lo, hi) of 64.
std::uint64_t bits_between(int lo, int hi) {
  lo = std::clamp(lo, 0, 64), hi = std::clamp(hi, 0, 64);
  if (lo >= hi) return 0;
  const std::uint64_t below_hi = hi == 64 ? ~0ULL : (1ULL << hi) - 1;
  return below_hi & ~((1ULL << lo) - 1);
}

}  // namespace

CoverageSamples sample_surface(const TriMesh& mesh, int n) {
  std::vector<double> area_up_to;
  double area = 0;
  for (const Triangle& t : mesh.triangles)
    area_up_to.push_back(area += 0.5 * glm::length(area_normal(mesh, t)));
  CoverageSamples samples;
  Random random(static_cast<std::uint64_t>(n));
  for (int i = 0; i < n; ++i) {  // one in each n-th of the area
    const double at = area * (i + random.uniform()) / n;
    const auto found = std::lower_bound(area_up_to.begin(), area_up_to.end(), at);
    const std::size_t t =
        std::min(static_cast<std::size_t>(found - area_up_to.begin()), mesh.triangles.size() - 1);
    const Triangle& v = mesh.triangles[t];
    const auto r = static_cast<float>(std::sqrt(random.uniform()));
    const auto s = static_cast<float>(random.uniform());
    samples.points.push_back((1 - r) * mesh.positions[v[0]] + r * (1 - s) * mesh.positions[v[1]] +
                             r * s * mesh.positions[v[2]]);
  }
  samples.radius = static_cast<float>(kRadiusInSpacings * std::sqrt(area / n));
  return samples;
}

void Panorama::draw(const CoverageSamples& samples, double yaw_rad, const glm::dvec3& translation) {
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
  const glm::dvec3 offset = translation - eye_;
  for (const glm::vec3& p : samples.points) {
    const double x = c * p.x - s * p.y + offset.x, y = s * p.x + c * p.y + offset.y;
    const double distance = std::max(std::sqrt(x * x + y * y), 1.0);
    const double half = samples.radius / distance;
    cover(std::atan2(y, x), (p.z + offset.z) / distance, half, half);
  }
}

// Sets the bits whose centres are within the half sizes: dense samples cover an unbiased share.
void Panorama::cover(double angle_rad, double slope, double half_angle, double half_slope) {
  const auto row_of = [](double s) {
    return static_cast<int>(std::ceil((s / kMaxSlope + 1) * (0.5 * kRows) - 0.5));
  };
  const int row_lo = row_of(std::clamp(slope - half_slope, -1.0, 1.0));
  const int row_hi = row_of(std::clamp(slope + half_slope, -1.0, 1.0));
  if (row_lo >= row_hi) return;
  const std::uint64_t lower = bits_between(row_lo, row_hi);
  const std::uint64_t upper = bits_between(row_lo - 64, row_hi - 64);
  const auto column_lo = static_cast<int>(std::ceil((angle_rad - half_angle) / kColumnRad - 0.5));
  const auto column_hi = static_cast<int>(std::ceil((angle_rad + half_angle) / kColumnRad - 0.5));
  for (int i = column_lo; i < std::min(column_hi, column_lo + kColumns); ++i) {
    Column& column = columns_[static_cast<std::size_t>((i % kColumns + kColumns) % kColumns)];
    column[0] |= lower;
    column[1] |= upper;
  }
}

// A column at angle a off the frame's centre stands at x = tan a; a slope s of it at y = s / cos a.
double Panorama::coverage(double yaw_rad) const {
  const double half_fov = glm::radians(kFovYDeg) / 2, edge = std::tan(half_fov);
  const auto first = static_cast<int>(std::ceil((yaw_rad - half_fov) / kColumnRad - 0.5));
  double covered = 0, whole = 0;
  for (int i = first; (i + 0.5) * kColumnRad < yaw_rad + half_fov; ++i) {
    const double cosine = std::cos((i + 0.5) * kColumnRad - yaw_rad);
    const double width = 1 / (cosine * cosine);
    whole += width;
    const Column& column = columns_[static_cast<std::size_t>((i % kColumns + kColumns) % kColumns)];
    if ((column[0] | column[1]) == 0) continue;
    const int n_rows = static_cast<int>(edge * cosine / kMaxSlope * (0.5 * kRows));  // up and down
    const int n = std::popcount(column[0] & bits_between(64 - n_rows, 64)) +
                  std::popcount(column[1] & bits_between(0, n_rows));
    covered += width * n / (2.0 * n_rows);
  }
  return covered / whole;
}

}  // namespace viewcell
