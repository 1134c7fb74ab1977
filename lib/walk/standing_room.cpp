#include "walk/standing_room.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

#include "base/parallel.h"
#include "rays/ray_scene.h"

namespace viewcell {
namespace {

constexpr double kLeastUp = 0.7;      // of a floor's normal: 45 degrees
constexpr int kMostPoints = 1 << 24;  // of the grid: it is made coarser beyond
constexpr int kDirections = 16;       // in which something may stand near: one packet
static_assert(kDirections == RayPacket::kSize);
constexpr double kSightReach = 25;                         // times the eye's height
constexpr std::array<double, 3> kHeights{0.3, 0.65, 1.0};  // of the eye's: knee, chest, eye

class RoomFinder {
 public:
  RoomFinder(const Scene& scene, const CellSet& cells, const WalkerOptions& options, int n_threads)
      : scene_(scene), cells_(cells), options_(options), n_threads_(n_threads) {
    const RayDevice device({n_threads, 0});
    std::vector<RayScene> meshes;
    for (const SceneMesh& mesh : scene.meshes)
      meshes.emplace_back(device, mesh.mesh.positions, mesh.mesh.triangles);
    std::vector<RayScene::Instance> instances;
    for (const SceneObject& object : scene.objects) {
      instances.push_back(
          {&meshes[index(object.mesh)], glm::mat4(object.matrix_world_from_model())});
      turns_.emplace_back(glm::mat3_cast(object.rotation));
    }
    top_ = RayScene(device, instances);
    set_grid();
  }

  StandingRoom find() {
    parallel_for(static_cast<std::size_t>(room_.rows), n_threads_, [&](std::size_t row) {
      for (int column = 0; column < room_.columns; ++column)
        test(room_.index(column, static_cast<int>(row)));
    });
    leave_bare_ground();
    const auto n_blocks = static_cast<std::size_t>(room_.block_columns());
    room_.sight.assign(n_blocks * static_cast<std::size_t>(room_.block_rows()), 0);
    room_.is_open.assign(room_.sight.size(), 0);
    parallel_for(static_cast<std::size_t>(room_.block_rows()), n_threads_, [&](std::size_t row) {
      for (std::size_t column = 0; column < n_blocks; ++column)
        if (const auto point = first_free_in(static_cast<int>(column), static_cast<int>(row))) {
          room_.sight[row * n_blocks + column] = measure_sight(*point);
          room_.is_open[row * n_blocks + column] = is_under_sky(*point);
        }
    });
    return std::move(room_);
  }

 private:
  void set_grid() {
    const glm::dvec2 size = scene_.area.hi - scene_.area.lo;
    room_.spacing = std::max(options_.spacing, std::sqrt(size.x * size.y / kMostPoints));
    room_.origin = scene_.area.lo + 0.5 * room_.spacing;
    room_.columns = std::max(1, static_cast<int>(size.x / room_.spacing));
    room_.rows = std::max(1, static_cast<int>(size.y / room_.spacing));
    room_.step = options_.step;
    const std::size_t n = room_.index(0, room_.rows);
    room_.floor_z.assign(n, 0), room_.is_free.assign(n, 0);
    is_bare_.assign(n, 0);
  }

  void test(std::size_t point) {
    const double eye_z = cells_.eye_height.middle();
    const glm::dvec3 eye(room_.place(point), eye_z);
    const std::optional<Floor> floor = find_floor(eye);
    const double slack = 0.5 * (cells_.eye_height.hi - cells_.eye_height.lo);
    if (!floor || std::abs(floor->z) > slack) return;
    for (const double height : kHeights)
      if (!is_clear({eye.x, eye.y, floor->z + height * eye_z})) return;
    room_.floor_z[point] = static_cast<float>(floor->z);
    is_bare_[point] = floor->is_bare;
    room_.is_free[point] = 1;
  }

  void leave_bare_ground() {
    std::size_t n_free = 0, n_bare = 0;
    for (std::size_t p = 0; p < is_bare_.size(); ++p)
      n_free += room_.is_free[p], n_bare += is_bare_[p];
    if (10 * (n_free - n_bare) < n_free) return;
    for (std::size_t p = 0; p < is_bare_.size(); ++p)
      if (is_bare_[p] != 0) room_.is_free[p] = 0;
  }

  struct Floor {
    double z = 0;
    bool is_bare = false;  // the ground, and no surface
  };

  // What is below, if one can stand on it.
  std::optional<Floor> find_floor(const glm::dvec3& eye) const {
    RayPacket packet;
    packet.start(glm::vec3(eye), 0);
    for (int i = 0; i < RayPacket::kSize; ++i) packet.set_direction(i, {0, 0, -1});
    RayMask mask;
    mask.set(0, true);
    top_.intersect(mask, packet);
    if (!packet.has_hit(0)) return Floor{scene_.ground_z, true};
    const glm::vec3 normal = glm::normalize(turns_[packet.instance[0]] * packet.normal(0));
    if (!(normal.z > static_cast<float>(kLeastUp))) return {};
    return Floor{eye.z - double(packet.far[0]), false};
  }

  static RayMask aim_around(float reach, RayPacket& packet) {
    RayMask mask;
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2 * std::acos(-1.0) * i / kDirections;
      packet.set_direction(i, glm::vec3(std::cos(angle), std::sin(angle), 0));
      packet.far[static_cast<std::size_t>(i)] = reach;
      mask.set(i, true);
    }
    return mask;
  }

  bool is_clear(const glm::dvec3& at) const {
    RayPacket packet;
    packet.start(glm::vec3(at), 0);
    const RayMask mask = aim_around(static_cast<float>(options_.clearance), packet);
    top_.intersect(mask, packet);
    for (int i = 0; i < kDirections; ++i)
      if (packet.has_hit(i)) return false;
    return true;
  }

  std::optional<std::size_t> first_free_in(int block_column, int block_row) const {
    constexpr int kSide = StandingRoom::kSightBlock;
    for (int y = kSide * block_row; y < std::min(kSide * (block_row + 1), room_.rows); ++y)
      for (int x = kSide * block_column; x < std::min(kSide * (block_column + 1), room_.columns);
           ++x)
        if (room_.is_free[room_.index(x, y)] != 0) return room_.index(x, y);
    return {};
  }

  glm::vec3 eye_at(std::size_t point) const {
    return glm::vec3(
        glm::dvec3(room_.place(point), double(room_.floor_z[point]) + cells_.eye_height.middle()));
  }

  bool is_under_sky(std::size_t point) const {
    RayPacket packet;
    packet.start(eye_at(point), 0);
    for (int i = 0; i < RayPacket::kSize; ++i) packet.set_direction(i, {0, 0, 1});
    RayMask mask;
    mask.set(0, true);
    top_.intersect(mask, packet);
    return !packet.has_hit(0);
  }

  // Level rays all around: half for how near what they meet is, half for how many objects that is.
  float measure_sight(std::size_t point) const {
    const double eye_z = cells_.eye_height.middle(), reach = kSightReach * eye_z;
    RayPacket packet;
    packet.start(eye_at(point), 0);
    const RayMask mask = aim_around(static_cast<float>(reach), packet);
    top_.intersect(mask, packet);
    std::set<std::uint32_t> met;
    double nearness = 0;
    for (int i = 0; i < kDirections; ++i) {
      if (!packet.has_hit(i)) continue;
      met.insert(packet.instance[static_cast<std::size_t>(i)]);
      nearness += 1 - double(packet.far[static_cast<std::size_t>(i)]) / reach;
    }
    return static_cast<float>((nearness + double(met.size())) / (2 * kDirections));
  }

  const Scene& scene_;
  const CellSet& cells_;
  WalkerOptions options_;
  int n_threads_;
  RayScene top_;
  std::vector<glm::mat3> turns_;  // by object
  StandingRoom room_;
  std::vector<std::uint8_t> is_bare_;  // of points that are free
};

}  // namespace

WalkerOptions walker_of(double eye_height) {
  const double metre = eye_height / 1.6;
  return {0.25 * metre, 0.35 * metre, 0.3 * metre};
}

glm::dvec2 StandingRoom::place(std::size_t point) const {
  const auto n = static_cast<std::size_t>(columns);
  return origin + spacing * glm::dvec2(double(point % n), double(point / n));
}

std::size_t StandingRoom::block_of(std::size_t point) const {
  const auto n = static_cast<std::size_t>(columns);
  return point / n / kSightBlock * static_cast<std::size_t>(block_columns()) +
         point % n / kSightBlock;
}

std::vector<std::size_t> StandingRoom::neighbours(std::size_t point) const {
  std::vector<std::size_t> out;
  const int column = static_cast<int>(point % static_cast<std::size_t>(columns));
  const int row = static_cast<int>(point / static_cast<std::size_t>(columns));
  const auto leads = [&](int dx, int dy) {
    const int x = column + dx, y = row + dy;
    if (x < 0 || y < 0 || x >= columns || y >= rows) return false;
    const std::size_t to = index(x, y);
    return is_free[to] != 0 && std::abs(floor_z[to] - floor_z[point]) <= step;
  };
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      if (dx == 0 && dy == 0) continue;
      const bool is_straight = dx == 0 || dy == 0;
      if (leads(dx, dy) && (is_straight || (leads(dx, 0) && leads(0, dy))))
        out.push_back(index(column + dx, row + dy));
    }
  return out;
}

std::optional<std::size_t> StandingRoom::nearest(const glm::dvec2& at) const {
  std::optional<std::size_t> best;
  double best2 = 0;
  for (std::size_t p = 0; p < is_free.size(); ++p) {
    if (is_free[p] == 0) continue;
    const glm::dvec2 off = place(p) - at;
    const double off2 = glm::dot(off, off);
    if (!best || off2 < best2) best = p, best2 = off2;
  }
  return best;
}

StandingRoom find_standing_room(const Scene& scene, const CellSet& cells,
                                const WalkerOptions& options, int n_threads) {
  return RoomFinder(scene, cells, options, n_threads).find();
}

std::vector<int> connect_parts(const StandingRoom& room) {
  std::vector<int> part(room.is_free.size(), -1);
  std::vector<std::size_t> sizes, pending;
  for (std::size_t seed = 0; seed < part.size(); ++seed) {
    if (room.is_free[seed] == 0 || part[seed] >= 0) continue;
    const int number = static_cast<int>(sizes.size());
    sizes.push_back(0);
    pending = {seed};
    part[seed] = number;
    while (!pending.empty()) {
      const std::size_t p = pending.back();
      pending.pop_back();
      sizes.back() += room.is_open[room.block_of(p)] != 0 ? 5 : 1;
      for (const std::size_t q : room.neighbours(p))
        if (part[q] < 0) part[q] = number, pending.push_back(q);
    }
  }
  // The largest first; of equal ones the first.
  std::vector<int> order(sizes.size()), rank(sizes.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return sizes[static_cast<std::size_t>(a)] > sizes[static_cast<std::size_t>(b)];
  });
  for (std::size_t i = 0; i < order.size(); ++i)
    rank[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
  for (int& p : part)
    if (p >= 0) p = rank[static_cast<std::size_t>(p)];
  return part;
}

}  // namespace viewcell
