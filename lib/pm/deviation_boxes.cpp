#include "pm/deviation_boxes.h"

#include <algorithm>
#include <cmath>

namespace viewcell {

const VectorBox& DeviationBoxes::box_of(std::uint32_t face, const Change& change) const {
  for (const Next& next : change.faces)
    if (next.face == face) return next.box;
  return boxes_[face];
}

// Of what has vanished at the face, or nothing.
const VectorBox* DeviationBoxes::vanished_box(std::uint32_t face, const Change& change) const {
  for (const Next& next : change.vanished)
    if (next.face == face) return &next.box;
  const auto& passed = change.passed;
  if (std::find(passed.begin(), passed.end(), face) != passed.end()) return nullptr;
  const auto found = vanished_.find(face);
  return found == vanished_.end() ? nullptr : &found->second;
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
  std::erase_if(change.faces, [&](const Next& next) {  // set below, or its face vanishes
    const auto found = std::find(faces.begin(), faces.end(), next.face) - faces.begin();
    const auto i = static_cast<std::size_t>(found);
    return i < faces.size() && local_[i].is_old;
  });
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (local_[i].is_new) change.faces.push_back({faces[i], local_[i].after});
  if (!vanished_.empty()) add_vanished(map, change);
}

// The same for what has vanished at few of the faces, mostly at none.
void DeviationBoxes::add_vanished(const CollapseMap& map, Change& change) {
  const auto faces = map.faces();
  bool is_any = false;
  local_.assign(faces.size(), {});
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (const VectorBox* box = vanished_box(faces[i], change)) {
      local_[i] = {.before = *box, .after = {}, .is_old = true};
      is_any = true;
    }
  if (!is_any) return;
  for (const OverlayCell& cell : map.overlay().cells()) {
    if (!local_[cell.old_face].is_old) continue;
    const VectorBox box = local_[cell.old_face].before.plus(cell.shift);
    Local& to = local_[cell.new_face];
    to.is_new ? to.after.add(box) : void(to.after = box);
    to.is_new = true;
  }
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (!local_[i].is_old && !local_[i].is_new) continue;
    std::erase_if(change.vanished, [&](const Next& next) { return next.face == faces[i]; });
    change.passed.push_back(faces[i]);
  }
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (local_[i].is_new) change.vanished.push_back({faces[i], local_[i].after});
}

float DeviationBoxes::reach(const std::vector<Next>& faces) {
  float reach2 = 0;
  for (const Next& next : faces) reach2 = std::max(reach2, next.box.reach2());
  return std::sqrt(reach2);
}

float DeviationBoxes::vanish_reach(const VanishMap& map) const {
  float reach2 = 0;
  for (const auto& [face, shift] : map.faces) {
    reach2 = std::max(reach2, boxes_[face].plus(shift).reach2());
    if (const auto at = vanished_.find(face); at != vanished_.end())
      reach2 = std::max(reach2, at->second.plus(shift).reach2());
  }
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
  for (const Next& next : change.faces) boxes_[next.face] = next.box;
  for (const std::uint32_t face : change.passed) vanished_.erase(face);
  for (const Next& next : change.vanished) vanished_[next.face] = next.box;
  bound_ = std::max({bound_, cost(change), vanished_reach(change)});
}

void DeviationBoxes::accept(const VanishMap& map) {
  bound_ = std::max(bound_, vanish_reach(map));
  const auto add = [&](const VectorBox& box) {
    const auto [at, is_first] = vanished_.try_emplace(map.onto, box);
    if (!is_first) at->second.add(box);
  };
  for (const auto& [face, shift] : map.faces) {
    add(boxes_[face].plus(shift));
    if (const auto at = vanished_.find(face); at != vanished_.end()) {
      const VectorBox before = at->second;  // the map of boxes may grow
      vanished_.erase(at);
      add(before.plus(shift));
    }
  }
}

}  // namespace viewcell
