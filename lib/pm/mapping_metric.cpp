#include "pm/mapping_metric.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace viewcell {

MappingMetric::MappingMetric(const CollapseMesh& mesh, const WedgeTable& wedges,
                             std::span<const glm::vec3> positions,
                             std::span<const glm::vec2> texcoords, std::size_t n_faces,
                             const MappingOptions& options)
    : options_(options),
      map_(mesh, wedges, positions, texcoords, options.matching),
      boxes_(options.total ? n_faces : 0) {}

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

float MappingMetric::cost(std::uint32_t u, std::uint32_t v) {
  if (!map_.lay(u, v)) return std::numeric_limits<float>::infinity();
  if (!options_.total) return static_cast<float>(map_.largest_shift());
  add_up();
  float reach2 = 0;
  for (const Deviation& d : next_) reach2 = std::max(reach2, d.box.reach2());
  return std::sqrt(reach2);
}

Refusal MappingMetric::allows(const CollapseMesh&, std::uint32_t u, std::uint32_t v) {
  if (!map_.lay(u, v)) return Refusal::metric;
  if (!map_.keeps_texture_orientation()) return Refusal::fold;
  if (options_.total) add_up();
  return Refusal::none;
}

void MappingMetric::collapsed(std::uint32_t, std::uint32_t) {
  if (!options_.total) return;
  for (const Deviation& d : next_) {
    boxes_[d.face] = d.box;
    bound_ = std::max(bound_, std::sqrt(d.box.reach2()));
  }
}

}  // namespace viewcell
