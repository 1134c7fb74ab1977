#include "pm/deviation_boxes.h"

#include <algorithm>
#include <cmath>

namespace viewcell {

const VectorBox& DeviationBoxes::box_of(std::uint32_t face, const Change& change) const {
  for (const Next& next : change)
    if (next.face == face) return next.box;
  return boxes_[face];
}

void DeviationBoxes::add(const CollapseMap& map, Change& change) {
  const auto faces = map.faces();
  local_.assign(faces.size(), {});
  for (std::size_t i = 0; i < faces.size(); ++i) local_[i].before = box_of(faces[i], change);
  for (const OverlayCell& cell : map.overlay().cells()) {
    const VectorBox box = local_[cell.old_face].before.plus(cell.shift);
    local_[cell.old_face].is_old = true;
    Local& to = local_[cell.new_face];
    to.is_new ? to.after.add(box) : void(to.after = box);
    to.is_new = true;
  }
  std::erase_if(change, [&](const Next& next) {  // set below, or its face vanishes
    const auto found = std::find(faces.begin(), faces.end(), next.face) - faces.begin();
    const auto i = static_cast<std::size_t>(found);
    return i < faces.size() && local_[i].is_old;
  });
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (local_[i].is_new) change.push_back({faces[i], local_[i].after});
}

float DeviationBoxes::cost(const Change& change) const {
  float reach2 = 0;
  for (const Next& next : change) reach2 = std::max(reach2, next.box.reach2());
  return std::sqrt(reach2);
}

float DeviationBoxes::least_reach(const CollapseMap& map) const {
  float reach2 = 0;
  map.for_each_location([&](std::uint32_t face, const Double4& shift) {
    const Float4 s = __builtin_convertvector(shift, Float4);
    reach2 = std::max(reach2, boxes_[map.faces()[face]].plus({s, s}).reach2());
  });
  return std::sqrt(reach2) * (1 - 1e-6f);
}

void DeviationBoxes::accept(const Change& change) {
  for (const Next& next : change) boxes_[next.face] = next.box;
  bound_ = std::max(bound_, cost(change));
}

}  // namespace viewcell
