#include "draw/mesh_shots.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "base/error.h"
#include "base/file.h"
#include "image/io.h"
#include "report/contact_sheet.h"

namespace viewcell {
namespace fs = std::filesystem;
namespace {

constexpr int kTile_px = 256;

std::string picture_name(std::size_t i, std::size_t n) {
  const auto n_digits = std::max<std::size_t>(2, std::to_string(n - 1).size());
  const std::string digits = std::to_string(i);
  return "view-" + std::string(n_digits - std::min(n_digits, digits.size()), '0') + digits + ".png";
}

std::size_t count_covered(const ImageRgba8& picture) {
  return static_cast<std::size_t>(std::count_if(picture.pixels.begin(), picture.pixels.end(),
                                                [](const Rgba8& p) { return p[3] > 0; }));
}

std::string describe(std::size_t i, const Camera& view) {
  const ViewAngles angles = angles_of(view);
  char text[64];
  std::snprintf(text, sizeof text, "%02zu az %+.0f el %+.0f", i, angles.azimuth_deg,
                angles.elevation_deg);
  return text;
}

ImageRgba8 make_sheet(const std::vector<MeshShot>& shots, std::vector<ImageRgba8> tiles,
                      const MeshShotOptions& options) {
  const std::size_t n = shots.size();
  const auto n_columns = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(n))));
  std::vector<std::string> columns(n_columns);
  columns[0] = options.title;
  std::vector<SheetRow> rows;
  for (std::size_t i = 0; i < n; ++i) {
    if (i % n_columns == 0) rows.emplace_back();
    rows.back().notes.push_back(describe(i, shots[i].view));
    rows.back().pictures.push_back(std::move(tiles[i]));
  }
  return make_contact_sheet(columns, rows, {.tile_px = kTile_px, .remarks = options.remarks});
}

Json format_vec3(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

}  // namespace

void check_shot_folder(const fs::path& folder, std::size_t n_views) {
  std::set<std::string> ours;
  for (std::size_t i = 0; i < n_views; ++i) ours.insert(picture_name(i, n_views));
  std::set<std::string> others;  // in order: the same message every time
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const std::string name = it->path().filename().string();
    if (name.starts_with("view-") && name.ends_with(".png") && !ours.contains(name))
      others.insert(name);
  }
  if (!others.empty())
    throw InputError(folder.string(), "",
                     "has '" + *others.begin() + "', which is none of the " +
                         std::to_string(n_views) + " to write: remove it or name another folder");
}

fs::path sheet_beside(const fs::path& folder) {
  fs::path path = folder.lexically_normal();
  if (!path.has_filename()) path = path.parent_path();  // "DIR/"
  if (path.empty() || path.filename() == "." || path.filename() == "..")
    path = fs::weakly_canonical(path);
  return path += ".sheet.png";
}

std::vector<MeshShot> write_mesh_shots(const MeshRenderer& renderer, const MeshShotOptions& options,
                                       const Progress& progress) {
  check_shot_folder(options.folder, options.n_views);
  make_folder(options.folder);
  std::vector<MeshShot> shots;
  for (const Camera& view : make_views(options.n_views))
    shots.push_back({picture_name(shots.size(), options.n_views), view});
  // One thread talks to GL; so this many pictures are drawn, then encoded in parallel.
  const auto n_at_once =
      static_cast<std::size_t>(options.n_threads > 0 ? options.n_threads : hardware_threads());
  std::vector<ImageRgba8> tiles(shots.size());
  for (std::size_t first = 0; first < shots.size(); first += n_at_once) {
    std::vector<ImageRgba8> pictures;
    for (std::size_t i = first; i < std::min(first + n_at_once, shots.size()); ++i)
      pictures.push_back(renderer.draw(shots[i].view));
    parallel_for(pictures.size(), options.n_threads, [&](std::size_t k) {
      MeshShot& shot = shots[first + k];
      shot.n_covered = count_covered(pictures[k]);
      write_png(options.folder / shot.name, pictures[k]);
      if (!options.sheet.empty()) tiles[first + k] = shrink_to_width(pictures[k], kTile_px);
    });
    if (progress) progress(first + pictures.size(), shots.size());
  }
  if (!options.sheet.empty())
    write_png(options.sheet, make_sheet(shots, std::move(tiles), options), PngAlpha::drop);
  return shots;
}

Json format_shots(const std::vector<MeshShot>& shots, const MeshFrame& frame) {
  Json out = Json::array();
  for (const MeshShot& shot : shots) {
    const glm::dvec3 right = glm::normalize(glm::cross(shot.view.forward, glm::dvec3(0, 0, 1)));
    const glm::dvec3 up = glm::cross(right, shot.view.forward);
    const ViewAngles angles = angles_of(shot.view);
    out.push_back({{"name", shot.name},
                   {"eye", format_vec3(mesh_from_frame(frame, shot.view.eye))},
                   {"forward", format_vec3(mesh_from_frame_direction(frame, shot.view.forward))},
                   {"up", format_vec3(mesh_from_frame_direction(frame, up))},
                   {"elevation_deg", angles.elevation_deg},
                   {"azimuth_deg", angles.azimuth_deg},
                   {"covered_px", shot.n_covered}});
  }
  return out;
}

Json format_frame(const MeshFrame& frame) {
  return {{"centre", format_vec3(frame.centre)},
          {"radius", frame.radius},
          {"up", frame.up},
          {"fov_y_deg", kViewFovDeg}};
}

Json format_style(const MeshStyle& style) {
  return {{"size_px", style.size_px},
          {"samples", style.samples},
          {"lit", style.lit},
          {"light_follows", style.light_follows},
          {"normals", name_of(style.normals)},
          {"normal_map_y", style.normal_map_y == NormalMapY::up ? "up" : "down"},
          {"flip_v", style.flip_v},
          {"wireframe", style.wireframe}};
}

}  // namespace viewcell
