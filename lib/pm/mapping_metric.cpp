#include "pm/mapping_metric.h"

#include <cmath>

namespace viewcell {

MappingMetric::MappingMetric(const CollapseMesh& mesh, const WedgeTable& wedges,
                             std::span<const glm::vec3> positions,
                             std::span<const glm::vec2> texcoords,
                             std::span<const Triangle> triangles, const MappingOptions& options)
    : options_(options),
      map_(mesh, wedges, positions, texcoords, options.matching,
           {.moments = options.measure == Measure::mean}),
      boxes_(is_bound() ? triangles.size() : 0),
      moments_(positions,
               options.measure == Measure::mean ? triangles : std::span<const Triangle>()) {}

float MappingMetric::add_up() {
  if (is_bound()) {
    boxes_change_.clear();
    boxes_.add(map_, boxes_change_);
    return boxes_.cost(boxes_change_);
  }
  if (options_.measure == Measure::max) return static_cast<float>(map_.overlay().largest_shift());
  if (options_.total) {
    moments_change_.clear();
    moments_.add(map_, moments_change_);
    return moments_.cost(moments_change_);
  }
  double sum = 0;
  for (const CellMoments& cell : map_.overlay().moments()) sum += cell.area * cell.square;
  return static_cast<float>(std::sqrt(sum / moments_.area()));
}

float MappingMetric::cost_at_least(std::uint32_t u, std::uint32_t v) {
  if (!is_bound()) return 0;
  if (!map_.locate(u, v)) return std::numeric_limits<float>::infinity();
  return boxes_.least_reach(map_);
}

float MappingMetric::cost(std::uint32_t u, std::uint32_t v) {
  return map_.build(u, v) ? add_up() : std::numeric_limits<float>::infinity();
}

bool MappingMetric::allows(const CollapseMesh&, std::uint32_t u, std::uint32_t v) {
  if (!map_.build(u, v)) return false;
  add_up();
  return true;
}

void MappingMetric::collapsed(std::uint32_t, std::uint32_t) {
  if (is_bound()) boxes_.accept(boxes_change_);
  if (options_.total && options_.measure == Measure::mean) moments_.accept(moments_change_);
  map_.forget();
}

}  // namespace viewcell
