#include "bake/pack.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <set>

#include "bake/pack_inputs.h"
#include "base/error.h"
#include "base/file.h"
#include "base/srgb.h"
#include "bundle/bundle_writer.h"
#include "image/half.h"
#include "mesh/optimize.h"

namespace viewcell {
namespace fs = std::filesystem;
namespace {

// Triangles in an order for the vertex cache, vertices in the order of first use.
void optimize_order(CellMesh& mesh) {
  const std::size_t n = mesh.source_vertex.size();
  const std::vector<Triangle> ordered = optimize_index_order(mesh.triangles, n);
  const std::vector<std::uint32_t> new_ids = make_fetch_order(ordered, n);
  CellMesh out = mesh;
  for (std::size_t v = 0; v < n; ++v) {
    out.source_vertex[new_ids[v]] = mesh.source_vertex[v];
    out.vertices.positions[new_ids[v]] = mesh.vertices.positions[v];
    out.vertices.normals[new_ids[v]] = mesh.vertices.normals[v];
  }
  std::map<Triangle, std::uint8_t> views;
  for (std::size_t t = 0; t < ordered.size(); ++t) views[mesh.triangles[t]] = mesh.views[t];
  for (std::size_t t = 0; t < ordered.size(); ++t) {
    const Triangle& old = ordered[t];
    out.views[t] = views.at(old);
    out.triangles[t] = {new_ids[old[0]], new_ids[old[1]], new_ids[old[2]]};
  }
  mesh = std::move(out);
}

BundleObject describe(const CellMesh& mesh, Representation kind) {
  BundleObject out;
  out.object = static_cast<std::int32_t>(mesh.object);
  out.kind = static_cast<std::uint32_t>(kind);
  out.n_vertices = static_cast<std::uint32_t>(mesh.source_vertex.size());
  out.n_triangles = static_cast<std::uint32_t>(mesh.triangles.size());
  if (mesh.source_vertex.empty()) return out;
  glm::vec3 lo(1e30f), hi(-1e30f);
  for (const glm::vec3& p : mesh.vertices.positions) lo = glm::min(lo, p), hi = glm::max(hi, p);
  for (int k = 0; k < 3; ++k) out.lo[k] = lo[k], out.hi[k] = hi[k];
  return out;
}

// How far the mesh's vertices lie off the object's own, along the surface's normals.
void append_offsets(const Scene& scene, const CellMesh& mesh, std::vector<std::int16_t>& offsets) {
  const SceneObject& object = scene.objects[index(mesh.object)];
  const SceneMesh& original = scene.mesh_of(object);
  for (std::size_t v = 0; v < mesh.source_vertex.size(); ++v) {
    const std::uint32_t source = mesh.source_vertex[v];
    const glm::dvec3 at = object.world_from_model(glm::dvec3(original.mesh.positions[source]));
    const glm::dvec3 normal(
        original.weld.is_empty()
            ? mesh.vertices.normals[v]
            : glm::vec3(object.rotation * glm::dvec3(original.weld.normals[source])));
    const double along = glm::dot(glm::dvec3(mesh.vertices.positions[v]) - at, normal);
    offsets.push_back(
        static_cast<std::int16_t>(std::lround(std::clamp(along / kOffsetUnit, -32767.0, 32767.0))));
  }
}

CellGeometry make_geometry(const Scene& scene, const CellMeshes& cell) {
  CellGeometry out;
  for (std::size_t m = 0; m < cell.meshes.size(); ++m) {
    const CellMesh& mesh = cell.meshes[m];
    out.objects.push_back(describe(mesh, cell.kinds[m]));
    out.source_vertices.insert(out.source_vertices.end(), mesh.source_vertex.begin(),
                               mesh.source_vertex.end());
    append_offsets(scene, mesh, out.offsets);
    for (const Triangle& t : mesh.triangles)
      out.indices.insert(out.indices.end(), t.begin(), t.end());
    out.views.insert(out.views.end(), mesh.views.begin(), mesh.views.end());
  }
  return out;
}

CentreTextures read_textures(const Scene& scene, const fs::path& captures,
                             const CaptureSettings& settings, CentreId centre,
                             const std::set<ObjectId>& objects) {
  CentreCaptures file(capture_file_of(captures, centre), settings);
  CentreTextures out;
  for (const ObjectId object : objects)
    if (const auto tile = file.read(object))
      append_tile(*tile, scene.is_masked(scene.objects[index(object)]), out);
  return out;
}

std::size_t count_originals(const Scene& scene, const CellSet& cells, CellId cell) {
  std::size_t n = 0;
  for (const ObjectId object : originals_of(cells, cell))
    n += scene.mesh_of(scene.objects[index(object)]).mesh.triangles.size();
  return n;
}

void add_cell(const Scene& scene, const CellSet& cells, CellId cell, const CellMeshes& meshes,
              PackCounts& counts) {
  counts.n_inside += cells.inside[index(cell)].size();
  counts.n_own += originals_of(cells, cell).size() - cells.inside[index(cell)].size();
  counts.n_triangles_originals += count_originals(scene, cells, cell);
  for (std::size_t m = 0; m < meshes.meshes.size(); ++m) {
    counts.n_triangles_outside += meshes.meshes[m].triangles.size();
    switch (meshes.kinds[m]) {
      case Representation::unseen:
        ++counts.n_unseen;
        break;
      case Representation::single_view:
        ++counts.n_single_view;
        break;
      default:
        ++counts.n_multi_view;
    }
  }
}

// The meshes of the i-th cell, as they were checked, in the order of drawing.
CellMeshes read_again(const Scene& scene, const CellSet& cells, const PackInputs& inputs,
                      const CheckedInputs& checked, const std::vector<CellId>& list,
                      std::size_t i) {
  CellMeshes meshes = read_cell_meshes(scene, cells, inputs, checked.settings.key(), list[i]);
  if (meshes.hash != checked.mesh_hashes[i])
    throw InputError((inputs.svmesh / weighted_mesh_name(list[i])).string(), "",
                     "or its counterpart changed while it was packed; run cellpack again");
  for (CellMesh& mesh : meshes.meshes) optimize_order(mesh);
  return meshes;
}

std::vector<CentreId> centres_with_tiles(const TilesNeeded& tiles) {
  std::vector<CentreId> centres;
  for (const auto& [centre, objects] : tiles) centres.push_back(centre);
  return centres;
}

BundleManifest make_manifest(const Scene& scene, const CellSet& cells, const CheckedInputs& checked,
                             const std::vector<CellId>& list, TextureFormat format,
                             const Json& made_by) {
  BundleManifest manifest;
  manifest.scene_hash = scene.hash;
  manifest.cells_hash = cells.file_hash;
  manifest.captures = checked.settings.key();
  std::string hashes;
  for (const std::string& hash : checked.mesh_hashes) hashes += hash;
  manifest.meshes = hash_hex(hashes);
  manifest.resolution_px = checked.settings.density.resolution_px;
  manifest.texture_format = format;
  manifest.has_masks = scene.has_masks();
  manifest.cells = list;
  manifest.centres = centres_with_tiles(checked.tiles);
  manifest.made_by = made_by;
  return manifest;
}

// What was read stands in memory, or must be as it was.
void copy_inputs(const Scene& scene, const CellSet& cells, const PackInputs& inputs,
                 BundleWriter& writer) {
  for (const SceneMesh& mesh : scene.meshes) {
    const fs::path file = resolve_inside(inputs.scene_file, "meshes", mesh.file);
    writer.write_copy(mesh.file, read_unchanged(file, mesh.hash), mesh.hash);
  }
  std::set<std::string> copied;  // a picture of two cutoffs stands there twice
  for (const ScenePicture& picture : scene.pictures) {
    if (!copied.insert(picture.file).second) continue;
    const fs::path file = resolve_inside(inputs.scene_file, "materials", picture.file);
    writer.write_copy(picture.file, read_unchanged(file, picture.hash), picture.hash);
  }
  writer.write_copy("scene.json", read_unchanged(inputs.scene_file, scene.file_hash));
  writer.write_copy("cells.json", read_unchanged(inputs.cells_file, cells.file_hash));
}

// The curve at every half in [0, 1], by its bits: captures hold halves.
std::uint8_t srgb8_of_half(float linear) {
  static const std::vector<std::uint8_t> table = [] {
    std::vector<std::uint8_t> codes(half_from_float(1.0f) + 1u);
    for (std::size_t bits = 0; bits < codes.size(); ++bits)
      codes[bits] = srgb8_from_linear(float_from_half(static_cast<std::uint16_t>(bits)));
    return codes;
  }();
  return table[half_from_float(std::clamp(linear, 0.0f, 1.0f))];
}

constexpr double kNowhere = -255e3;  // a thousand times the range of codes away

}  // namespace

void append_tile(const CaptureTile& tile, bool is_masked, CentreTextures& textures) {
  const auto& depths = tile.inverse_depth.pixels;
  const auto [lo, hi] = std::minmax_element(depths.begin(), depths.end());
  BundleTile out;
  out.object = static_cast<std::int32_t>(tile.object);
  out.x = tile.crop.x, out.y = tile.crop.y;
  out.width_px = tile.crop.width_px, out.height_px = tile.crop.height_px;
  out.source_px = tile.view.source_px;
  for (int k = 0; k < 3; ++k) {
    out.eye[k] = tile.view.eye[k], out.right[k] = tile.view.right[k];
    out.up[k] = tile.view.up[k], out.forward[k] = tile.view.forward[k];
  }
  out.focal_px = tile.view.focal_px;
  const double farthest = is_masked ? 1 : 0;  // its code
  out.code_scale = *hi > *lo ? (255.0 - farthest) / (static_cast<double>(*hi) - *lo) : 0.0;
  out.code_bias = farthest - out.code_scale * *lo;
  // Of a view that shows nothing of the object, as from behind a wall of one side, no texel is at
  // any depth; with neither scale nor bias all would be at every depth, and black.
  if (!(*hi > 0)) out.code_bias = kNowhere;
  out.first_texel = textures.texels.size();
  textures.tiles.push_back(out);
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const RgbaFloat& c = tile.color.pixels[i];
    const bool shows_nothing = is_masked && !(c[3] > 0.5f);
    const double code =
        shows_nothing ? 0.0
                      : std::clamp(out.code_scale * depths[i] + out.code_bias, farthest, 255.0);
    textures.texels.push_back({srgb8_of_half(c[0]), srgb8_of_half(c[1]), srgb8_of_half(c[2]),
                               static_cast<std::uint8_t>(code + 0.5)});
  }
}

PackCounts pack_bundle(const Scene& scene, const CellSet& cells, const PackInputs& inputs,
                       const std::vector<CellId>& list, TextureFormat format, const Json& made_by,
                       const fs::path& bundle, int n_threads, const Progress& progress) {
  const CheckedInputs checked = check_pack_inputs(scene, cells, inputs, list, n_threads);
  const std::vector<CentreId> centres = centres_with_tiles(checked.tiles);
  BundleWriter writer(bundle, make_manifest(scene, cells, checked, list, format, made_by));

  PackCounts counts;
  counts.n_cells = list.size();
  counts.n_centres = centres.size();
  std::mutex mutex;  // guards the counts
  const auto pack_cell = [&](std::size_t i) {
    const CellMeshes meshes = read_again(scene, cells, inputs, checked, list, i);
    writer.write(list[i], make_geometry(scene, meshes));
    const std::lock_guard lock(mutex);
    add_cell(scene, cells, list[i], meshes, counts);
  };
  parallel_for(list.size(), n_threads, pack_cell, progress);
  const auto pack_centre = [&](std::size_t i) {
    const CentreTextures textures = read_textures(scene, inputs.captures, checked.settings,
                                                  centres[i], checked.tiles.at(centres[i]));
    writer.write(centres[i], textures);
    const std::lock_guard lock(mutex);
    counts.texel_bytes += textures.texels.size() * sizeof(Rgba8);
  };
  parallel_for(centres.size(), n_threads, pack_centre, progress);
  copy_inputs(scene, cells, inputs, writer);
  writer.commit();
  return counts;
}

}  // namespace viewcell
