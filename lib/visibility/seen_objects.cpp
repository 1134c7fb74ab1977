#include "visibility/seen_objects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/random.h"
#include "cells/self_occluding.h"
#include "rays/ray_scene.h"

namespace viewcell {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kRaysAround = 512;  // around each eye
constexpr int kLeastRays = 64;    // aimed at an object
// A ray that comes so near to the point that it is aimed at has met nothing before it.
constexpr float kReached = 0.9999f;

}  // namespace

// One object as rays are aimed at it.
struct SeenTarget {
  const SceneObject* object = nullptr;
  const SceneMesh* mesh = nullptr;
  std::vector<double> areas;  // up to each triangle and with it; model units
  glm::dvec3 middle{0};       // world
  double radius = 0;
  bool shows_backs = false, hides_by_backs = false;  // some triangles, all of them
  bool is_lucid = false;                             // hides nothing
};

namespace {

SeenTarget make_target(const Scene& scene, const SceneObject& object) {
  SeenTarget out;
  out.object = &object, out.mesh = &scene.mesh_of(object);
  out.shows_backs = scene.is_double_sided(object), out.is_lucid = scene.is_masked(object);
  out.hides_by_backs = std::all_of(object.materials.begin(), object.materials.end(), [&](int m) {
    return scene.materials[static_cast<std::size_t>(m)].double_sided;
  });
  double sum = 0;
  for (const Triangle& t : out.mesh->mesh.triangles)
    out.areas.push_back(sum += glm::length(area_normal(out.mesh->mesh, t)));
  const Box box = world_box(scene, object);
  out.middle = box.centre(), out.radius = 0.5 * glm::length(box.size());
  return out;
}

struct Aim {
  glm::dvec3 at{0};      // world
  glm::dvec3 normal{0};  // of any length
};

Aim choose_point(const SeenTarget& target, Random& random) {
  const auto found = std::upper_bound(target.areas.begin(), target.areas.end(),
                                      random.uniform(0, target.areas.back()));
  const auto t =
      std::min(static_cast<std::size_t>(found - target.areas.begin()), target.areas.size() - 1);
  const TriMesh& mesh = target.mesh->mesh;
  const Triangle& corners = mesh.triangles[t];
  const auto p = [&](std::size_t k) {
    return target.object->world_from_model(glm::dvec3(mesh.positions[corners[k]]));
  };
  double u = random.uniform(), v = random.uniform();
  if (u + v > 1) u = 1 - u, v = 1 - v;
  const glm::dvec3 a = p(0), ab = p(1) - a, ac = p(2) - a;
  return {a + u * ab + v * ac, glm::cross(ab, ac)};
}

// The prism's corners, drawn in by a thousandth, and its middle; then points of it at random.
std::vector<glm::dvec3> choose_eyes(const CellSet& cells, CellId cell, int n_eyes, Random& random) {
  const glm::dvec3 middle = eye_of(cells, cell);
  std::vector<glm::dvec3> eyes;
  for (const glm::dvec3& corner : prism_of(cells, cell))
    eyes.push_back(glm::mix(corner, middle, 1e-3));
  eyes.push_back(middle);
  const double side = cells.grid.size;
  const HexCoord hex = coord_of(cells.grid, cell);
  while (eyes.size() < static_cast<std::size_t>(n_eyes)) {
    const glm::dvec2 at =
        glm::dvec2(middle) + glm::dvec2(random.uniform(-side, side), random.uniform(-side, side));
    const double z = random.uniform(cells.eye_height.lo, cells.eye_height.hi);
    if (coord_at(cells.grid, at) == hex) eyes.emplace_back(at, z);
  }
  return eyes;
}

// The i-th of n directions spread evenly over a sphere (a Fibonacci lattice), turned by `turn`.
glm::vec3 direction_around(int i, int n, double turn) {
  const double z = 1 - (2 * i + 1.0) / n, r = std::sqrt(1 - z * z);
  const double angle = kPi * (3 - std::sqrt(5.0)) * i + turn;
  return {r * std::cos(angle), r * std::sin(angle), z};
}

}  // namespace

struct SeenFinder::State {
  const CellSet& cells;
  SeenOptions options;
  std::vector<SeenTarget> targets;  // by object
  RayScene all;                     // of what hides
  std::vector<std::uint32_t> object_of_instance;

  State(const Scene& scene, const CellSet& cells_in, const SeenOptions& options_in, int n_threads)
      : cells(cells_in), options(options_in) {
    const RayDevice device({n_threads, 0});
    std::map<std::pair<MeshId, bool>, RayScene> meshes;  // with both sides or fronts alone
    std::vector<RayScene::Instance> instances;
    for (const SceneObject& object : scene.objects) {
      targets.push_back(make_target(scene, object));
      const SeenTarget& target = targets.back();
      if (target.is_lucid) continue;
      RayScene& mesh = meshes[{object.mesh, target.hides_by_backs}];
      if (!mesh)
        mesh = RayScene(device, target.mesh->mesh.positions, target.mesh->mesh.triangles,
                        {.fronts_only = !target.hides_by_backs});
      instances.push_back({&mesh, glm::mat4(object.matrix_world_from_model())});
      object_of_instance.push_back(static_cast<std::uint32_t>(targets.size() - 1));
    }
    all = RayScene(device, instances);
  }

  int rays_for(const SeenTarget& target, const glm::dvec3& eye) const {
    const double distance = std::max(glm::distance(target.middle, eye) - cells.grid.size,
                                     std::max(target.radius, 1e-9));
    const double focal_px = focal_of_face(options.resolution_px);
    const double seen_px = kPi * std::pow(focal_px * target.radius / distance, 2);
    const double wanted = 3 * seen_px / options.patch_px;  // 95 %: 1 - exp(-3)
    return static_cast<int>(std::clamp(wanted, double(kLeastRays), double(options.most_rays)));
  }
};

namespace {

// What one cell has seen so far.
class CellSight {
 public:
  CellSight(const RayScene& all, const std::vector<std::uint32_t>& object_of_instance,
            std::size_t n_objects)
      : all_(all), object_of_instance_(object_of_instance), is_seen_(n_objects) {}

  bool is_seen(std::size_t object) const { return is_seen_[object]; }
  void mark(std::size_t object) { is_seen_[object] = true; }
  std::size_t n_rays() const { return n_rays_; }

  void look_around(const glm::dvec3& eye, double turn) {
    RayPacket packet;
    for (int first = 0; first < kRaysAround; first += RayPacket::kSize) {
      packet.start(glm::vec3(eye), 0);
      for (int i = 0; i < RayPacket::kSize; ++i)
        packet.set_direction(i, direction_around(first + i, kRaysAround, turn));
      cast(packet);
      for (int i = 0; i < RayPacket::kSize; ++i) mark_hit(packet, i);
    }
  }

  // A packet of rays from the eye at points of the object.
  void aim(const SeenTarget& target, std::size_t object, const glm::dvec3& eye, Random& random) {
    RayPacket packet;
    packet.start(glm::vec3(eye), 0);
    std::array<bool, RayPacket::kSize> shows;  // the side that is drawn
    for (int i = 0; i < RayPacket::kSize; ++i) {
      const Aim point = choose_point(target, random);
      const glm::dvec3 ray = point.at - eye;
      packet.set_direction(i, glm::vec3(ray));
      packet.far[static_cast<std::size_t>(i)] = 1;
      shows[static_cast<std::size_t>(i)] = target.shows_backs || glm::dot(point.normal, ray) < 0;
    }
    cast(packet);
    for (int i = 0; i < RayPacket::kSize; ++i) {
      const auto lane = static_cast<std::size_t>(i);
      mark_hit(packet, i);
      if (shows[lane] && (!packet.has_hit(i) || packet.far[lane] > kReached)) mark(object);
    }
  }

 private:
  void cast(RayPacket& packet) {
    RayMask mask;
    for (int i = 0; i < RayPacket::kSize; ++i) mask.set(i, true);
    all_.intersect(mask, packet);
    n_rays_ += RayPacket::kSize;
  }
  void mark_hit(const RayPacket& packet, int i) {
    if (packet.has_hit(i)) mark(object_of_instance_[packet.instance[static_cast<std::size_t>(i)]]);
  }

  const RayScene& all_;
  const std::vector<std::uint32_t>& object_of_instance_;
  std::vector<bool> is_seen_;
  std::size_t n_rays_ = 0;
};

}  // namespace

SeenFinder::SeenFinder(const Scene& scene, const CellSet& cells, const SeenOptions& options,
                       int n_threads)
    : state_(std::make_unique<const State>(scene, cells, options, n_threads)) {}

SeenFinder::~SeenFinder() = default;

SeenFromCell SeenFinder::find(CellId cell) const {
  const State& s = *state_;
  Random random(static_cast<std::uint64_t>(cell) + 1);
  const std::vector<glm::dvec3> eyes = choose_eyes(s.cells, cell, s.options.n_eyes, random);
  CellSight sight(s.all, s.object_of_instance, s.targets.size());
  for (const ObjectId inside : s.cells.inside[index(cell)]) sight.mark(index(inside));
  for (const glm::dvec3& eye : eyes) sight.look_around(eye, random.uniform(0, 2 * kPi));
  SeenFromCell out;
  const glm::dvec3 middle = eye_of(s.cells, cell);
  for (std::size_t o = 0; o < s.targets.size(); ++o) {
    const SeenTarget& target = s.targets[o];
    const int n_rays = s.rays_for(target, middle);
    for (int n = 0; n < n_rays && !sight.is_seen(o); n += RayPacket::kSize)
      sight.aim(target, o, eyes[(static_cast<std::size_t>(n / RayPacket::kSize) + o) % eyes.size()],
                random);
  }
  for (std::size_t o = 0; o < s.targets.size(); ++o)
    if (!sight.is_seen(o)) out.unseen.push_back(ObjectId(o));
  out.n_rays = sight.n_rays();
  return out;
}

}  // namespace viewcell
