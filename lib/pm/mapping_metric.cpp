#include "pm/mapping_metric.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace viewcell {

MappingMetric::MappingMetric(const CollapseMesh& mesh, const WedgeTable& wedges,
                             std::span<const glm::vec3> positions,
                             std::span<const glm::vec2> texcoords,
                             std::span<const Triangle> triangles, const MappingOptions& options)
    : options_(options),
      map_(mesh, wedges, positions, texcoords, options.matching, options.measure == Measure::mean) {
  if (options.measure == Measure::max) {
    boxes_.resize(options.total ? triangles.size() : 0);
    if (options.total) bound_ = 0;
    return;
  }
  moments_.resize(triangles.size());
  double area = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto at = [&](std::size_t k) { return glm::dvec3(positions[triangles[t][k]]); };
    moments_[t].area = 0.5 * glm::length(glm::cross(at(1) - at(0), at(2) - at(0)));
    area += moments_[t].area;
  }
  if (area > 0) area_ = area;
}

// What the new faces of the last map would deviate: each cell's own shift and what its old face
// had.
void MappingMetric::add_up() {
  const auto faces = map_.faces();
  next_.assign(faces.size(), {});
  for (const MapCell& cell : map_.cells()) {
    const VectorBox box = boxes_[faces[cell.old_face]].plus(cell.shift);
    Next& next = next_[cell.new_face];
    next.is_new ? next.box.add(box) : void(next.box = box);
    next.is_new = true;
  }
}

// Each cell takes its share of the old face's points to the new face. Returns the root of what that
// adds to the integral of squares.
float MappingMetric::add_up_moments() {
  const auto faces = map_.faces();
  const std::vector<CellMoments>& cells = map_.moments();
  next_.assign(faces.size(), {});
  double before = 0, after = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::uint32_t face = map_.cells()[i].old_face;
    if (!std::exchange(next_[face].is_old, true)) before += moments_[faces[face]].square;
    next_[face].old_area += cells[i].area;
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto& [old_face, new_face, shift] = map_.cells()[i];
    const CellMoments& cell = cells[i];
    const double whole = next_[old_face].old_area;
    const bool is_whole = old_face == new_face && cell.area == 0 && cell.square == 0;
    const double share = whole > 0 ? cell.area / whole : (is_whole ? 1 : 0);
    const Moments& old = moments_[faces[old_face]];
    Next& next = next_[new_face];
    next.is_new = true;
    const double area = share * old.area;
    next.moments.area += area;
    next.moments.sum += share * old.sum + area * cell.mean;
    const double square =
        share * (old.square + 2 * glm::dot(old.sum, cell.mean)) + area * cell.square;
    next.moments.square += square;
    after += square;
  }
  return static_cast<float>(std::sqrt(std::max(after - before, 0.0) / area_));
}

float MappingMetric::cost_at_least(std::uint32_t u, std::uint32_t v) {
  if (options_.measure == Measure::mean) return 0;
  if (!map_.place(u, v)) return std::numeric_limits<float>::infinity();
  // what the point at u alone would deviate
  float reach2 = 0;
  map_.for_each_place([&](std::uint32_t face, const Double4& shift) {
    const Float4 s = __builtin_convertvector(shift, Float4);
    VectorBox box{s, s};
    if (options_.total) box = box.plus(boxes_[map_.faces()[face]]);
    reach2 = std::max(reach2, box.reach2());
  });
  return std::sqrt(reach2) * (1 - 1e-6f);
}

float MappingMetric::cost(std::uint32_t u, std::uint32_t v) {
  if (!map_.lay(u, v)) return std::numeric_limits<float>::infinity();
  if (options_.measure == Measure::mean) {
    if (options_.total) return add_up_moments();
    double sum = 0;
    for (const CellMoments& cell : map_.moments()) sum += cell.area * cell.square;
    return static_cast<float>(std::sqrt(sum / area_));
  }
  if (!options_.total) return static_cast<float>(map_.largest_shift());
  add_up();
  return next_reach();
}

float MappingMetric::next_reach() const {
  float reach2 = 0;
  for (const Next& next : next_) reach2 = std::max(reach2, next.box.reach2());
  return std::sqrt(reach2);
}

Refusal MappingMetric::allows(const CollapseMesh&, std::uint32_t u, std::uint32_t v) {
  if (!map_.lay(u, v)) return Refusal::metric;
  if (!map_.keeps_texture_orientation()) return Refusal::fold;
  if (options_.total && options_.measure == Measure::max) add_up();
  if (options_.total && options_.measure == Measure::mean) add_up_moments();
  return Refusal::none;
}

void MappingMetric::collapsed(std::uint32_t, std::uint32_t) {
  const auto faces = map_.faces();
  for (std::size_t i = 0; options_.total && i < next_.size(); ++i) {
    if (!next_[i].is_new) continue;
    if (options_.measure == Measure::mean)
      moments_[faces[i]] = next_[i].moments;
    else
      boxes_[faces[i]] = next_[i].box;
  }
  if (options_.total && options_.measure == Measure::max) bound_ = std::max(bound_, next_reach());
  map_.forget();
}

}  // namespace viewcell
