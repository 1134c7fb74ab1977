#include "pm/deviation_moments.h"

#include <algorithm>
#include <cmath>

namespace viewcell {

DeviationMoments::DeviationMoments(std::span<const glm::vec3> positions,
                                   std::span<const Triangle> triangles)
    : moments_(triangles.size()) {
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto at = [&](std::size_t k) { return glm::dvec3(positions[triangles[t][k]]); };
    moments_[t].area = 0.5 * glm::length(glm::cross(at(1) - at(0), at(2) - at(0)));
    area_ += moments_[t].area;
  }
  if (!(area_ > 0)) area_ = 1;
}

const DeviationMoments::Moments& DeviationMoments::moments_of(std::uint32_t face,
                                                              const Change& change) const {
  for (const Next& next : change.faces)
    if (next.face == face) return next.moments;
  return moments_[face];
}

void DeviationMoments::add(const CollapseMap& map, Change& change) {
  const auto faces = map.faces();
  local_.assign(faces.size(), {});
  for (std::size_t i = 0; i < faces.size(); ++i) local_[i].before = moments_of(faces[i], change);
  distribute(map);
  for (const Local& l : local_)
    change.increase += l.after.square - (l.is_old ? l.before.square : 0);
  std::erase_if(change.faces, [&](const Next& next) {  // set below, or its face vanishes
    const auto found = std::find(faces.begin(), faces.end(), next.face) - faces.begin();
    const auto i = static_cast<std::size_t>(found);
    return i < faces.size() && local_[i].is_old;
  });
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (local_[i].is_new) change.faces.push_back({faces[i], local_[i].after});
}

// Each overlay cell adds its area's share of the old face's moments to those of the new face; those
// of a face that has lost all of its area are shared alike.
void DeviationMoments::distribute(const CollapseMap& map) {
  const std::vector<OverlayCell>& cells = map.overlay().cells();
  const std::vector<CellMoments>& moments = map.overlay().moments();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    local_[cells[i].old_face].is_old = true;
    local_[cells[i].old_face].old_area += moments[i].area;
    ++local_[cells[i].old_face].n_cells;
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const CellMoments& cell = moments[i];
    const Local& from = local_[cells[i].old_face];
    const Moments& old = from.before;
    const double share =
        from.old_area > 0 ? cell.area / from.old_area : 1.0 / static_cast<double>(from.n_cells);
    const double area = share * old.area;
    Local& to = local_[cells[i].new_face];
    to.is_new = true;
    to.after.area += area;
    to.after.sum += share * old.sum + area * cell.mean;
    to.after.square += share * (old.square + 2 * glm::dot(old.sum, cell.mean)) + area * cell.square;
  }
}

float DeviationMoments::cost(const Change& change) const {
  return static_cast<float>(std::sqrt(std::max(change.increase, 0.0) / area_));
}

void DeviationMoments::accept(const Change& change) {
  for (const Next& next : change.faces) moments_[next.face] = next.moments;
}

}  // namespace viewcell
