#include "park/relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/random.h"

namespace viewcell {
namespace {

constexpr double kCreaseCosine = 0.85;  // a vertex whose triangles turn more than this is a crease
constexpr double kMaxHeight = 2.2;      // of the random waves, in standard deviations

// What a vertex's triangles say about it.
struct VertexFan {
  glm::dvec3 neighbour_sum{0};
  glm::dvec3 normal_sum{0};  // of unit normals
  double edge_sum = 0;
  int n_triangles = 0;
  bool is_boundary = false;
};

// Each triangle (v, a, b) adds a and b; around an interior vertex each neighbour counts twice.
std::vector<VertexFan> measure_fans(const TriMesh& mesh) {
  std::vector<VertexFan> fans(mesh.positions.size());
  std::vector<std::uint64_t> link(mesh.positions.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    const glm::dvec3 normal = area_normal(mesh, t);
    const double area = glm::length(normal);
    for (std::size_t k = 0; k < 3; ++k) {
      VertexFan& fan = fans[t[k]];
      const std::uint32_t a = t[(k + 1) % 3], b = t[(k + 2) % 3];
      const glm::dvec3 p(mesh.positions[t[k]]), pa(mesh.positions[a]), pb(mesh.positions[b]);
      fan.neighbour_sum += pa + pb;
      if (area > 0) fan.normal_sum += normal / area;
      fan.edge_sum += glm::length(pa - p) + glm::length(pb - p);
      ++fan.n_triangles;
      // Around a closed fan every neighbour comes once as a and once as b, so these cancel.
      link[t[k]] += (static_cast<std::uint64_t>(a) + 1) * 0x9e3779b97f4a7c15u;
      link[t[k]] -= (static_cast<std::uint64_t>(b) + 1) * 0x9e3779b97f4a7c15u;
    }
  }
  for (std::size_t v = 0; v < fans.size(); ++v) fans[v].is_boundary = link[v] != 0;
  return fans;
}

bool is_crease(const VertexFan& fan) {
  return glm::length(fan.normal_sum) < kCreaseCosine * fan.n_triangles;
}

double least_z(const TriMesh& mesh) {
  return bounding_box(mesh).lo.z;
}

// A stationary random function of unit variance whose waves all have the same length.
class RandomWaves {
 public:
  RandomWaves(const glm::dvec3& wavelength, std::uint64_t seed) {
    Random random(seed);
    for (Wave& wave : waves_) {
      const double z = random.uniform(-1, 1), angle = random.uniform(0, 2 * std::numbers::pi);
      const double r = std::sqrt(1 - z * z);
      wave.k = 2 * std::numbers::pi * glm::dvec3(r * std::cos(angle), r * std::sin(angle), z) /
               wavelength;
      wave.phase = random.uniform(0, 2 * std::numbers::pi);
    }
  }
  double value(const glm::dvec3& p) const {
    double sum = 0;
    for (const Wave& wave : waves_) sum += std::cos(glm::dot(wave.k, p) + wave.phase);
    return std::clamp(sum * std::sqrt(2.0 / kWaves), -kMaxHeight, kMaxHeight);
  }

 private:
  static constexpr int kWaves = 32;
  struct Wave {
    glm::dvec3 k{0};
    double phase = 0;
  };
  std::array<Wave, kWaves> waves_;
};

}  // namespace

double mean_edge_length(const TriMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      sum += glm::length(glm::dvec3(mesh.positions[t[k]] - mesh.positions[t[(k + 1) % 3]]));
  return mesh.triangles.empty() ? 0 : sum / static_cast<double>(3 * mesh.triangles.size());
}

void relax_tangentially(TriMesh& mesh, int n, double floor_height) {
  const double floor = least_z(mesh) + floor_height, edge = mean_edge_length(mesh);
  for (int i = 0; i < n; ++i) {
    const std::vector<VertexFan> fans = measure_fans(mesh);
    for (std::size_t v = 0; v < fans.size(); ++v) {
      const VertexFan& fan = fans[v];
      const glm::dvec3 p(mesh.positions[v]);
      if (fan.is_boundary || is_crease(fan) || p.z <= floor ||
          fan.edge_sum > 4 * edge * fan.n_triangles)
        continue;
      const glm::dvec3 normal = glm::normalize(fan.normal_sum);
      const glm::dvec3 step = fan.neighbour_sum / (2.0 * fan.n_triangles) - p;
      mesh.positions[v] = glm::vec3(p + 0.5 * (step - glm::dot(step, normal) * normal));
    }
  }
}

void add_waves(TriMesh& mesh, const Waves& waves, double floor_height) {
  const double edge = mean_edge_length(mesh), floor = least_z(mesh);
  const RandomWaves random(waves.wavelength, waves.seed);
  const std::vector<VertexFan> fans = measure_fans(mesh);
  for (std::size_t v = 0; v < fans.size(); ++v) {
    const VertexFan& fan = fans[v];
    const glm::dvec3 p(mesh.positions[v]);
    const double length = glm::length(fan.normal_sum);
    if (fan.is_boundary || !(length > 0)) continue;
    const double own_edge = fan.edge_sum / (2.0 * fan.n_triangles) / edge;
    const double damping = std::min(own_edge, 1.0) * std::clamp(3 - own_edge, 0.0, 1.0) *
                           std::clamp((p.z - floor) / floor_height - 1, 0.0, 1.0);
    const double height = waves.height * random.value(p);
    mesh.positions[v] = glm::vec3(p + damping * height / length * fan.normal_sum);
  }
}

}  // namespace viewcell
