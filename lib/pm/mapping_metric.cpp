#include "pm/mapping_metric.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
  next_.clear();
  for (const MapCell& cell : map_.cells()) {
    const VectorBox box = boxes_[cell.old_face].plus(cell.shift);
    const auto found = std::find_if(next_.begin(), next_.end(),
                                    [&](const Deviation& d) { return d.face == cell.new_face; });
    if (found != next_.end())
      found->box.add(box);
    else
      next_.push_back({cell.new_face, box});
  }
}

MappingMetric::NextMoments& MappingMetric::moments_of(std::uint32_t face) {
  for (NextMoments& next : next_moments_)
    if (next.face == face) return next;
  return next_moments_.emplace_back(NextMoments{face, {}});
}

// Each cell takes its share of the old face's points to the new face. Returns the root of what that
// adds to the integral of squares.
float MappingMetric::add_up_moments() {
  next_moments_.clear();
  old_areas_.clear();
  double before = 0, after = 0;
  for (const MapCell& cell : map_.cells()) {
    const auto found = std::find_if(old_areas_.begin(), old_areas_.end(),
                                    [&](const OldArea& o) { return o.face == cell.old_face; });
    if (found != old_areas_.end()) {
      found->area += cell.area;
    } else {
      old_areas_.push_back({cell.old_face, cell.area});
      before += moments_[cell.old_face].square;
    }
  }
  for (const MapCell& cell : map_.cells()) {
    const auto whole = std::find_if(old_areas_.begin(), old_areas_.end(),
                                    [&](const OldArea& o) { return o.face == cell.old_face; });
    const bool is_whole = cell.old_face == cell.new_face && cell.area == 0 && cell.square == 0;
    const double share = whole->area > 0 ? cell.area / whole->area : (is_whole ? 1 : 0);
    const Moments& old = moments_[cell.old_face];
    Moments& to = moments_of(cell.new_face).moments;
    const double area = share * old.area;
    to.area += area;
    to.sum += share * old.sum + area * cell.mean;
    const double square =
        share * (old.square + 2 * glm::dot(old.sum, cell.mean)) + area * cell.square;
    to.square += square;
    after += square;
  }
  return static_cast<float>(std::sqrt(std::max(after - before, 0.0) / area_));
}

float MappingMetric::cost(std::uint32_t u, std::uint32_t v) {
  if (!map_.lay(u, v)) return std::numeric_limits<float>::infinity();
  if (options_.measure == Measure::mean) {
    if (options_.total) return add_up_moments();
    double sum = 0;
    for (const MapCell& cell : map_.cells()) sum += cell.area * cell.square;
    return static_cast<float>(std::sqrt(sum / area_));
  }
  if (!options_.total) return static_cast<float>(map_.largest_shift());
  add_up();
  return next_reach();
}

float MappingMetric::next_reach() const {
  float reach2 = 0;
  for (const Deviation& d : next_) reach2 = std::max(reach2, d.box.reach2());
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
  if (!options_.total) return;
  if (options_.measure == Measure::mean) {
    for (const NextMoments& next : next_moments_) moments_[next.face] = next.moments;
    return;
  }
  for (const Deviation& d : next_) boxes_[d.face] = d.box;
  bound_ = std::max(bound_, next_reach());
}

}  // namespace viewcell
