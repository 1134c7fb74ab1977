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
      map_(mesh, wedges, positions, texcoords, options.matching, options.measure == Measure::mean),
      boxes_(options.total && options.measure == Measure::max ? triangles.size() : 0) {
  if (options.measure == Measure::max) return;
  moments_.resize(triangles.size());
  double area = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto at = [&](std::size_t k) { return glm::dvec3(positions[triangles[t][k]]); };
    moments_[t].area = 0.5 * glm::length(glm::cross(at(1) - at(0), at(2) - at(0)));
    area += moments_[t].area;
  }
  if (area > 0) area_ = area;
}

float MappingMetric::add_up() {
  change_.clear();
  boxes_.add(map_, change_);
  return DeviationBoxes::reach(change_);
}

// Each cell takes its share of the old face's points to the new face. Returns the root of what that
// adds to the integral of squares.
float MappingMetric::add_up_moments() {
  const auto faces = map_.faces();
  const std::vector<CellMoments>& cells = map_.overlay().moments();
  next_.assign(faces.size(), {});
  double before = 0, after = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::uint32_t face = map_.overlay().cells()[i].old_face;
    if (!std::exchange(next_[face].is_old, true)) before += moments_[faces[face]].square;
    next_[face].old_area += cells[i].area;
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto& [old_face, new_face, shift] = map_.overlay().cells()[i];
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
  if (!is_bound()) return 0;
  if (!map_.place(u, v)) return std::numeric_limits<float>::infinity();
  return boxes_.least_reach(map_);
}

float MappingMetric::cost(std::uint32_t u, std::uint32_t v) {
  if (!map_.lay(u, v)) return std::numeric_limits<float>::infinity();
  if (options_.measure == Measure::mean) {
    if (options_.total) return add_up_moments();
    double sum = 0;
    for (const CellMoments& cell : map_.overlay().moments()) sum += cell.area * cell.square;
    return static_cast<float>(std::sqrt(sum / area_));
  }
  return options_.total ? add_up() : static_cast<float>(map_.overlay().largest_shift());
}

bool MappingMetric::allows(const CollapseMesh&, std::uint32_t u, std::uint32_t v) {
  if (!map_.lay(u, v)) return false;
  if (is_bound()) add_up();
  if (options_.total && options_.measure == Measure::mean) add_up_moments();
  return true;
}

void MappingMetric::collapsed(std::uint32_t, std::uint32_t) {
  if (is_bound()) boxes_.take(change_);
  const auto faces = map_.faces();
  for (std::size_t i = 0; i < next_.size(); ++i)
    if (next_[i].is_new) moments_[faces[i]] = next_[i].moments;
  map_.forget();
}

}  // namespace viewcell
