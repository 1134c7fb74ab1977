#include "capture/captures.h"

#include <cstdio>
#include <set>

#include "base/error.h"
#include "base/file.h"
#include "image/half.h"

namespace viewcell {
namespace fs = std::filesystem;
namespace {

constexpr const char* kFormat = "viewcell-captures";
constexpr const char* kKeyAttribute = "bakeKey";

Json numbers(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

glm::dvec3 vec3_at(const JsonCursor& cursor) {
  const auto x = cursor.numbers(3, -1e12, 1e12);
  return {x[0], x[1], x[2]};
}

// The view in full precision, which EXR's float matrices cannot hold.
std::string format_view(const CaptureView& view) {
  return Json{{"eye", numbers(view.eye)},
              {"right", numbers(view.right)},
              {"up", numbers(view.up)},
              {"forward", numbers(view.forward)},
              {"focal_px", view.focal_px}}
      .dump();
}

CaptureView parse_view(const CapturePartHeader& header, const fs::path& file) {
  const Json json = parse_json(header.note, file);
  const JsonCursor root(json, file, "part " + header.name);
  CaptureView view;
  view.eye = vec3_at(root.at("eye"));
  view.right = vec3_at(root.at("right"));
  view.up = vec3_at(root.at("up"));
  view.forward = vec3_at(root.at("forward"));
  if (!is_view_frame(view.right, view.up, view.forward))
    root.fail("its axes are no frame of unit vectors at right angles");
  view.focal_px = root.at("focal_px").number(1e-3, 1e9);
  view.source_px = header.source_width_px;
  return view;
}

glm::dmat4 camera_matrix(const CaptureView& view) {
  const glm::dmat3 columns(view.right, view.up, -view.forward);
  glm::dmat4 matrix(glm::transpose(columns));
  matrix[3] = glm::dvec4(-(glm::transpose(columns) * view.eye), 1);
  return matrix;
}

// NDC from 0 to 1 over the source image, y down.
glm::dmat4 ndc_matrix(const CaptureView& view) {
  const double scale = view.focal_px / view.source_px;
  glm::dmat4 ndc_from_camera(0);
  ndc_from_camera[0][0] = scale;
  ndc_from_camera[1][1] = -scale;
  ndc_from_camera[2] = glm::dvec4(-0.5, -0.5, -1, -1);
  return ndc_from_camera * camera_matrix(view);
}

CapturePart part_of(const CaptureTile& tile) {
  CapturePart part;
  CapturePartHeader& header = part.header;
  header.name = "object-" + std::to_string(static_cast<int>(tile.object));
  header.source_width_px = header.source_height_px = tile.view.source_px;
  header.x = tile.crop.x, header.y = tile.crop.y;
  header.width_px = tile.crop.width_px, header.height_px = tile.crop.height_px;
  header.world_to_camera = camera_matrix(tile.view);
  header.world_to_ndc = ndc_matrix(tile.view);
  header.note = format_view(tile.view);
  part.rgba_half = half_from_rgba(tile.color);
  part.z.reserve(tile.inverse_depth.pixels.size());
  for (const float w : tile.inverse_depth.pixels) part.z.push_back(w > 0 ? 1 / w : 0.0f);
  return part;
}

CaptureFile open_captures(const fs::path& file) {
  std::error_code ignored;  // what cannot be looked at cannot be opened
  if (!fs::exists(file, ignored))
    throw InputError(file.string(), "", "is not there; run depthcap for the cells around it");
  return CaptureFile(file);
}

}  // namespace

std::string CaptureSettings::key() const {
  return hash_hex(
      scene_hash + " " + cells_hash + " " +
      Json({density.resolution_px, density.far_scale, density.far_distance, density.most_px})
          .dump() +
      " " + engine);
}

Json format_settings(const CaptureSettings& settings, const Json& provenance) {
  return {{"format", kFormat},
          {"version", 1},
          {"made_by", provenance},
          {"scene_hash", settings.scene_hash},
          {"cells_hash", settings.cells_hash},
          {"resolution_px", settings.density.resolution_px},
          {"far_scale", settings.density.far_scale},
          {"far_distance", settings.density.far_distance},
          {"most_px", settings.density.most_px},
          {"engine", settings.engine},
          {"key", settings.key()}};
}

CaptureSettings read_settings(const fs::path& folder, const Scene& scene,
                              const std::string& cells_hash) {
  const fs::path file = folder / kCapturesManifest;
  if (!fs::exists(file))
    throw InputError(file.string(), "", "is not there; depthcap writes it last: run depthcap");
  refuse_special(file);
  const Json json = read_json(file, kFormat, 1);
  const JsonCursor root(json, file);
  CaptureSettings settings;
  settings.scene_hash = root.at("scene_hash").string();
  settings.cells_hash = root.at("cells_hash").string();
  settings.density.resolution_px = static_cast<int>(root.at("resolution_px").integer(1, 1 << 14));
  settings.density.far_scale = root.at("far_scale").number(0.1, 16);
  settings.density.far_distance = root.at("far_distance").number(0, 1e9);
  settings.density.most_px = static_cast<int>(root.at("most_px").integer(1, 1 << 30));
  settings.engine = root.at("engine").string();
  if (settings.scene_hash != scene.hash)
    root.at("scene_hash").fail("these are captures of another scene; run depthcap again");
  if (settings.cells_hash != cells_hash)
    root.at("cells_hash").fail("these are captures of other cells; run depthcap again");
  return settings;
}

fs::path capture_file_of(const fs::path& folder, CentreId centre) {
  char name[32];
  std::snprintf(name, sizeof name, "centre-%05d.exr", static_cast<int>(centre));
  return folder / name;
}

std::vector<ObjectId> objects_seen_from(const CellSet& cells, CentreId centre) {
  const HexCoord hex = coord_of(cells.grid, centre);
  std::set<ObjectId> seen;
  const auto add_outside_of = [&](HexCoord where) {
    const auto cell = cell_at(cells.grid, where);
    if (!cell || (!cells.is_tested.empty() && !cells.is_tested[index(*cell)])) return;
    for (std::size_t o = 0; o < cells.n_objects; ++o)
      if (!is_original(cells, *cell, ObjectId(o)) && !is_unseen(cells, *cell, ObjectId(o)))
        seen.insert(ObjectId(o));
  };
  add_outside_of(hex);
  for (int face = 0; face < 6; ++face) add_outside_of(neighbour(hex, face));
  return {seen.begin(), seen.end()};
}

void write_captures(const fs::path& file, const std::vector<CaptureTile>& tiles,
                    const CaptureSettings& settings) {
  std::vector<CapturePart> parts;
  for (const CaptureTile& tile : tiles) parts.push_back(part_of(tile));
  write_capture_file(file, parts, {{kKeyAttribute, settings.key()}});
}

bool is_captured(const fs::path& file, const CaptureSettings& settings) {
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return false;
  try {
    CentreCaptures(file, settings);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

CentreCaptures::CentreCaptures(const fs::path& file, const CaptureSettings& settings)
    : path_(file), file_(open_captures(file)) {
  const auto key = file_.attributes().find(kKeyAttribute);
  if (key == file_.attributes().end() || key->second != settings.key())
    throw InputError(file.string(), "", "belongs to another bake; run depthcap again");
  for (std::size_t i = 0; i < file_.parts().size(); ++i) {
    int object = -1;
    if (std::sscanf(file_.parts()[i].name.c_str(), "object-%d", &object) == 1)
      part_of_[ObjectId(object)] = i;
  }
}

std::optional<CaptureTile> CentreCaptures::read(ObjectId object) {
  const auto found = part_of_.find(object);
  if (found == part_of_.end()) return {};
  const CapturePart part = file_.read_part(found->second);
  const CapturePartHeader& header = part.header;
  CaptureTile tile;
  tile.object = object;
  tile.view = parse_view(header, path_);
  tile.crop = {header.x, header.y, header.width_px, header.height_px};
  tile.color = rgba_from_half(part.rgba_half, header.width_px, header.height_px);
  tile.inverse_depth = Image<float>(header.width_px, header.height_px);
  for (std::size_t i = 0; i < part.z.size(); ++i)
    tile.inverse_depth.pixels[i] = part.z[i] > 0 ? 1 / part.z[i] : 0.0f;
  return tile;
}

}  // namespace viewcell
