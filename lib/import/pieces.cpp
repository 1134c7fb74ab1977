#include "import/pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "base/error.h"
#include "mesh/charts.h"
#include "mesh/topology.h"
#include "mesh/used_vertices.h"

namespace viewcell {
namespace {

// A corner with all that it has.
struct Corner {
  glm::vec3 position, normal{0}, color{1};
  glm::vec2 texcoord{0};
};
using Polygon = std::vector<Corner>;

// Where the edge meets a plane; from whichever end it is asked, the same bits.
Corner meet(const Corner& a, const Corner& b, int axis, float plane) {
  const auto key = [](const Corner& c) {
    return std::tuple(c.position.x, c.position.y, c.position.z);
  };
  if (key(b) < key(a)) return meet(b, a, axis, plane);
  const float t = (plane - a.position[axis]) / (b.position[axis] - a.position[axis]);
  Corner out{glm::mix(a.position, b.position, t), glm::mix(a.normal, b.normal, t),
             glm::mix(a.color, b.color, t), glm::mix(a.texcoord, b.texcoord, t)};
  out.position[axis] = plane;
  const float length = glm::length(out.normal);
  if (length > 0) out.normal /= length;
  return out;
}

// The parts below and above a plane; corners on it are of both.
std::pair<Polygon, Polygon> cut(const Polygon& polygon, int axis, float plane) {
  std::pair<Polygon, Polygon> out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const float from = a.position[axis] - plane, to = b.position[axis] - plane;
    if (from <= 0) out.first.push_back(a);
    if (from >= 0) out.second.push_back(a);
    if ((from < 0 && to > 0) || (from > 0 && to < 0)) {
      const Corner at = meet(a, b, axis, plane);
      out.first.push_back(at);
      out.second.push_back(at);
    }
  }
  return out;
}

bool has_area(const Corner& a, const Corner& b, const Corner& c) {
  const glm::dvec3 p(a.position);
  return glm::length(glm::cross(glm::dvec3(b.position) - p, glm::dvec3(c.position) - p)) > 0;
}

// A piece that grows.
class PieceMaker {
 public:
  explicit PieceMaker(const TriMesh& level) : level_(level) {}

  // As a fan.
  void add(const Polygon& polygon, std::int32_t material) {
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      const std::array<const Corner*, 3> corners{&polygon[0], &polygon[k - 1], &polygon[k]};
      if (!has_area(*corners[0], *corners[1], *corners[2])) continue;
      Triangle t;
      for (std::size_t i = 0; i < 3; ++i) {
        const Corner& corner = *corners[i];
        t[i] = vertex_of(corner);
        if (!level_.normals.empty() || !level_.corner_normals.empty())
          mesh_.corner_normals.push_back(corner.normal);
        if (!level_.texcoords.empty()) mesh_.texcoords.push_back(corner.texcoord);
      }
      mesh_.triangles.push_back(t);
      if (!level_.materials.empty()) mesh_.materials.push_back(material);
    }
  }
  bool is_empty() const { return mesh_.triangles.empty(); }

  // With the materials that it has, numbered by first use.
  TriMesh finish() {
    std::map<std::int32_t, std::int32_t> numbers;
    for (std::int32_t& m : mesh_.materials) {
      const auto [at, is_new] = numbers.try_emplace(m, static_cast<std::int32_t>(numbers.size()));
      if (is_new)
        mesh_.material_names.push_back(level_.material_names[static_cast<std::size_t>(m)]);
      m = at->second;
    }
    return std::move(mesh_);
  }

 private:
  using Key = std::array<float, 6>;  // position and colour

  std::uint32_t vertex_of(const Corner& corner) {
    Key key{};
    for (int i = 0; i < 3; ++i) {
      key[static_cast<std::size_t>(i)] = corner.position[i] + 0.0f;  // no negative zero
      key[static_cast<std::size_t>(i) + 3] = level_.colors.empty() ? 0 : corner.color[i];
    }
    const auto [at, is_new] =
        vertices_.try_emplace(key, static_cast<std::uint32_t>(mesh_.positions.size()));
    if (is_new) {
      mesh_.positions.push_back(corner.position);
      if (!level_.colors.empty()) mesh_.colors.push_back(corner.color);
    }
    return at->second;
  }

  const TriMesh& level_;
  TriMesh mesh_;
  std::map<Key, std::uint32_t> vertices_;
};

// Where a piece lies, in whole pieces, and whether it is of cut parts.
struct Place {
  std::array<std::int64_t, 3> cell;
  bool is_merged;
  auto operator<=>(const Place&) const = default;
};

class LevelCutter {
 public:
  LevelCutter(const TriMesh& level, double size) : level_(level), size_(size) {
    VIEWCELL_CHECK(size > 0, size);
    const std::vector<std::uint32_t> places = match_positions(level);
    std::vector<Triangle> welded = level.triangles;
    for (Triangle& t : welded)
      for (std::uint32_t& v : t) v = places[v];
    parts_ = connect_charts(welded, level.positions.size(), ChartLink::corner);
    boxes_.resize(parts_.size());
    for (std::size_t t = 0; t < welded.size(); ++t)
      for (const std::uint32_t v : welded[t]) boxes_[parts_.of[t]].add(level.positions[v]);
  }

  LevelPieces run() {
    LevelPieces out;
    out.n_components = parts_.size();
    for (const Box& box : boxes_) out.n_cut += is_wide(box);
    for (std::size_t t = 0; t < level_.triangles.size(); ++t) {
      const Polygon corners = corners_of(t);
      if (!has_area(corners[0], corners[1], corners[2])) {
        ++out.n_dropped;
        continue;
      }
      const std::int32_t material = level_.materials.empty() ? 0 : level_.materials[t];
      const Box& box = boxes_[parts_.of[t]];
      if (is_wide(box))
        cut_along(corners, material, 0, {});
      else
        maker_at({cell_of(glm::vec3(box.centre())), true}).add(corners, material);
    }
    for (auto& [place, maker] : makers_)
      if (!maker.is_empty()) out.pieces.push_back(maker.finish());
    return out;
  }

 private:
  bool is_wide(const Box& box) const {
    const glm::dvec3 size = box.size();
    return std::max({size.x, size.y, size.z}) > kWideParts * size_;
  }
  float plane(std::int64_t i) const { return static_cast<float>(double(i) * size_); }
  // The number of the last plane at or below x, as floats have the planes: what is cut, and what is
  // not, must not hang on how a quotient is rounded.
  std::int64_t along(float x) const {
    auto i = static_cast<std::int64_t>(std::floor(double(x) / size_));
    while (plane(i) > x) --i;
    while (plane(i + 1) <= x) ++i;
    return i;
  }
  std::array<std::int64_t, 3> cell_of(const glm::vec3& p) const {
    return {along(p.x), along(p.y), along(p.z)};
  }
  PieceMaker& maker_at(const Place& place) {
    return makers_.try_emplace(place, level_).first->second;
  }

  Polygon corners_of(std::size_t t) const {
    Polygon out(3);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = level_.triangles[t][k];
      out[k].position = level_.positions[v];
      if (!level_.corner_normals.empty())
        out[k].normal = level_.corner_normals[3 * t + k];
      else if (!level_.normals.empty())
        out[k].normal = level_.normals[v];
      if (!level_.colors.empty()) out[k].color = level_.colors[v];
      if (!level_.texcoords.empty()) out[k].texcoord = level_.texcoords[3 * t + k];
    }
    return out;
  }

  // Cuts at the planes of an axis, and each part at those of the next.
  void cut_along(Polygon rest, std::int32_t material, std::size_t axis,
                 std::array<std::int64_t, 3> cell) {
    if (rest.size() < 3) return;
    if (axis == 3) {
      maker_at({cell, false}).add(rest, material);
      return;
    }
    const int a = static_cast<int>(axis);
    float lo = rest[0].position[a], hi = lo;
    for (const Corner& c : rest) lo = std::min(lo, c.position[a]), hi = std::max(hi, c.position[a]);
    std::int64_t last = along(hi);
    if (plane(last) == hi && last > along(lo)) --last;  // it ends at that plane
    for (std::int64_t i = along(lo); i < last; ++i) {
      auto [below, above] = cut(rest, a, plane(i + 1));
      cell[axis] = i;
      cut_along(std::move(below), material, axis + 1, cell);
      rest = std::move(above);
    }
    cell[axis] = last;
    cut_along(std::move(rest), material, axis + 1, cell);
  }

  const TriMesh& level_;
  double size_;
  Charts parts_;
  std::vector<Box> boxes_;  // of the parts
  std::map<Place, PieceMaker> makers_;
};

}  // namespace

LevelPieces cut_into_pieces(const TriMesh& level, const PieceOptions& options) {
  return LevelCutter(level, options.size).run();
}

}  // namespace viewcell
