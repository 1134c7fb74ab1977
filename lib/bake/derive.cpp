#include "bake/derive.h"

#include <array>

namespace viewcell {
namespace {

std::vector<ClassifiedView> read_views(std::span<CentreCaptures> centres, ObjectId object,
                                       const CategoryOptions& options) {
  std::vector<ClassifiedView> views;
  for (std::size_t k = 0; k < centres.size(); ++k) {
    std::optional<CaptureTile> tile = centres[k].read(object);
    if (!tile) continue;
    Image<PixelCategory> categories = classify_pixels(*tile, options);
    views.push_back({static_cast<int>(k), std::move(*tile), std::move(categories)});
  }
  return views;
}

void add_counts(const CellMeshCounts& from, CellMeshCounts& to) {
  to.n_original += from.n_original;
  to.n_start += from.n_start;
  to.n_back_facing += from.n_back_facing;
  to.n_out += from.n_out;
  to.collapses.n_collapses += from.collapses.n_collapses;
  for (std::size_t k = 0; k < kRefusalKinds; ++k)
    to.collapses.n_refused[k] += from.collapses.n_refused[k];
}

}  // namespace

void DeriveCounts::add(const DeriveCounts& other) {
  n_meshes += other.n_meshes;
  n_unseen += other.n_unseen;
  n_uncaptured += other.n_uncaptured;
  add_counts(other.triangles, triangles);
}

WeightedMeshes derive_cell(const BakeScene& bake, const std::filesystem::path& captures,
                           const CaptureSettings& settings, CellId cell, Representation kind,
                           const BakeOptions& options, DeriveCounts& counts) {
  const auto ids = views_of(bake.cells.grid, cell);
  std::vector<CentreCaptures> centres;
  for (std::size_t k = 0; k < (kind == Representation::single_view ? 1u : ids.size()); ++k)
    centres.emplace_back(capture_file_of(captures, ids[k]), settings);
  WeightedMeshes out{kind, cell, settings.key(), "", {}};
  for (std::size_t o = 0; o < bake.scene.objects.size(); ++o) {
    CellObject object = choose_representation(bake, cell, ObjectId(o), options);
    const bool is_unseen = object.kind == Representation::unseen;
    if (object.kind != kind && !(is_unseen && kind == Representation::single_view)) continue;
    std::vector<ClassifiedView> views;
    if (!is_unseen) views = read_views(centres, ObjectId(o), options.categories);
    CellMeshCounts mesh_counts;
    out.meshes.push_back(derive_mesh(bake, cell, std::move(object), views, options, mesh_counts));
    ++counts.n_meshes;
    counts.n_unseen += is_unseen;
    counts.n_uncaptured += views.empty() && !is_unseen;
    add_counts(mesh_counts, counts.triangles);
  }
  return out;
}

Json format_options(const BakeOptions& o) {
  const WeightOptions& w = o.weights;
  return {{"ts", o.ts_px},
          {"tl", o.tl_px},
          {"max_drift", o.max_drift_px},
          {"start_error", o.start_error_px},
          {"tc0", o.categories.tc0},
          {"tc1", o.categories.tc1},
          {"weights",
           {w.exterior_silhouette, w.interior_silhouette, w.sharp_edge, w.interior, w.invisible,
            w.back_facing}}};
}

}  // namespace viewcell
