#include "play/modes.h"

#include <algorithm>
#include <array>

#include "base/error.h"

namespace viewcell {
namespace {

FramePlan plan_all(const PlanInputs& in) {
  return plan_geometry(in.scene);
}
FramePlan plan_in_frustum(const PlanInputs& in) {
  return plan_frustum(in.scene, in.camera);
}
FramePlan plan_levels(const PlanInputs& in) {
  return plan_lod(in.scene, in.camera, in.height_px);
}
FramePlan plan_levels_as_hybrid(const PlanInputs& in) {
  return plan_lod_within(in.scene, in.camera, in.height_px, in.n_hybrid_triangles);
}

// Colours: Okabe and Ito 2008, told apart by readers who confuse red and green. Two-sided modes are
// dashed, in the colour of the one-sided.
constexpr std::array kRows{
    ModeRow{.mode = Mode::geometry, .name = "geometry", .color = "#d55e00", .plan = plan_all},
    ModeRow{.mode = Mode::frustum, .name = "frustum", .color = "#e69f00", .plan = plan_in_frustum},
    ModeRow{.mode = Mode::lod,
            .name = "lod",
            .color = "#009e73",
            .plan = plan_levels,
            .draws_levels = true},
    ModeRow{
        .mode = Mode::hybrid, .name = "hybrid", .engine = ModeEngine::hybrid, .color = "#0072b2"},
    ModeRow{
        .mode = Mode::raycast, .name = "raycast", .engine = ModeEngine::rays, .color = "#cc79a7"},
    ModeRow{.mode = Mode::lod_equal,
            .name = "lod-equal",
            .color = "#56b4e9",
            .plan = plan_levels_as_hybrid,
            .draws_levels = true,
            .asks_hybrid = true,
            .is_variant = true},
    ModeRow{.mode = Mode::geometry_two_sided,
            .name = "geometry-two-sided",
            .color = "#d55e00",
            .plan = plan_all,
            .culls_back_faces = false,
            .is_dashed = true,
            .is_variant = true},
    ModeRow{.mode = Mode::frustum_two_sided,
            .name = "frustum-two-sided",
            .color = "#e69f00",
            .plan = plan_in_frustum,
            .culls_back_faces = false,
            .is_dashed = true,
            .is_variant = true},
};

constexpr bool are_in_order() {
  for (std::size_t i = 0; i < kRows.size(); ++i)
    if (kRows[i].mode != Mode(i)) return false;
  return true;
}
static_assert(are_in_order());

}  // namespace

std::span<const ModeRow> mode_rows() {
  return kRows;
}

const ModeRow& row_of(Mode mode) {
  return kRows.at(static_cast<std::size_t>(mode));
}

Mode parse_mode(const std::string& name) {
  std::string names;
  for (const ModeRow& row : kRows) {
    if (name == row.name) return row.mode;
    names += (names.empty() ? "" : ", ") + std::string(row.name);
  }
  throw UsageError("'" + name + "' is no mode: " + names);
}

std::string list_modes() {
  std::string out;
  bool were_variants = false;
  for (const ModeRow& row : kRows) {
    if (!out.empty()) out += row.is_variant == were_variants ? "," : ", ";
    out += row.name;
    were_variants = row.is_variant;
  }
  return out;
}

}  // namespace viewcell
