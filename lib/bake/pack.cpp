#include "bake/pack.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <set>

#include "base/error.h"
#include "base/file.h"
#include "base/srgb.h"
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

// The meshes of a cell, both kinds, by object; with every outside object exactly once.
struct CellMeshes {
  std::vector<CellMesh> meshes;
  std::vector<Representation> kinds;
};

CellMeshes read_cell_meshes(const Scene& scene, const CellSet& cells, const PackInputs& inputs,
                            const std::string& captures_key, CellId cell) {
  CellMeshes out;
  std::string made_from;  // of the first file
  std::vector<int> n_times(scene.objects.size(), 0);
  for (const fs::path& folder : {inputs.svmesh, inputs.mvmesh}) {
    const fs::path file = folder / weighted_mesh_name(cell);
    const auto kind =
        folder == inputs.svmesh ? Representation::single_view : Representation::multi_view;
    WeightedMeshes read = read_weighted_meshes(file, scene, kind, cell);
    if (read.captures != captures_key)
      throw InputError(file.string(), "header",
                       "was derived from other captures; run svmesh and mvmesh again");
    if (!made_from.empty() && read.made_from != made_from)
      throw InputError(file.string(), "header",
                       "was derived with other options than its counterpart in svmesh");
    made_from = read.made_from;
    for (CellMesh& mesh : read.meshes) {
      ++n_times[index(mesh.object)];
      optimize_order(mesh);
      out.meshes.push_back(std::move(mesh));
      out.kinds.push_back(kind);
    }
  }
  for (std::size_t o = 0; o < n_times.size(); ++o) {
    const int expected = is_inside(cells, cell, ObjectId(o)) ? 0 : 1;
    if (n_times[o] != expected)
      throw InputError(inputs.svmesh.string(), "cell " + std::to_string(static_cast<int>(cell)),
                       "object " + std::to_string(o) + " is in " + std::to_string(n_times[o]) +
                           " of svmesh and mvmesh, not in " + std::to_string(expected) +
                           "; derive both with the same options");
  }
  return out;
}

BundleObject describe(const CellMesh& mesh, Representation kind) {
  BundleObject out;
  out.object = static_cast<std::int32_t>(mesh.object);
  out.kind = static_cast<std::uint32_t>(kind);
  out.n_vertices = static_cast<std::uint32_t>(mesh.source_vertex.size());
  out.n_triangles = static_cast<std::uint32_t>(mesh.triangles.size());
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

// Which objects' tiles a centre's textures need.
using TilesNeeded = std::map<CentreId, std::set<ObjectId>>;

void add_needed(const CellSet& cells, CellId cell, const CellMeshes& meshes, TilesNeeded& needed) {
  const auto views = views_of(cells.grid, cell);
  for (std::size_t m = 0; m < meshes.meshes.size(); ++m)
    for (std::size_t k = 0; k < views.size(); ++k)
      if (k == 0 || meshes.kinds[m] == Representation::multi_view)
        needed[views[k]].insert(meshes.meshes[m].object);
}

void copy_into(const fs::path& from, const fs::path& to) {
  make_folder(to.parent_path());
  write_file(to, read_file(from));
}

// A .gltf keeps its buffers in other files, which a bundle would lack.
void check_self_contained(const Scene& scene, const fs::path& scene_file) {
  for (const SceneMesh& mesh : scene.meshes)
    if (fs::path(mesh.file).extension() == ".gltf")
      throw InputError(scene_file.string(), "mesh '" + mesh.file + "'",
                       "keeps its buffers in other files; a bundle takes .glb, .ply, .obj, .off");
}

CentreTextures read_textures(const fs::path& captures, const CaptureSettings& settings,
                             CentreId centre, const std::set<ObjectId>& objects) {
  CentreCaptures file(capture_file_of(captures, centre), settings);
  CentreTextures out;
  for (const ObjectId object : objects)
    if (const auto tile = file.read(object)) append_tile(*tile, out);
  return out;
}

std::size_t count_inside(const Scene& scene, const CellSet& cells, CellId cell) {
  std::size_t n = 0;
  for (const ObjectId object : cells.inside[index(cell)])
    n += scene.mesh_of(scene.objects[index(object)]).mesh.triangles.size();
  return n;
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

}  // namespace

void append_tile(const CaptureTile& tile, CentreTextures& textures) {
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
  out.code_scale = *hi > *lo ? 255.0 / (static_cast<double>(*hi) - *lo) : 0.0;
  out.code_bias = -out.code_scale * *lo;
  out.first_texel = textures.texels.size();
  textures.tiles.push_back(out);
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const RgbaFloat& c = tile.color.pixels[i];
    const double code = std::clamp(out.code_scale * depths[i] + out.code_bias, 0.0, 255.0);
    textures.texels.push_back({srgb8_of_half(c[0]), srgb8_of_half(c[1]), srgb8_of_half(c[2]),
                               static_cast<std::uint8_t>(code + 0.5)});
  }
}

PackCounts pack_bundle(const Scene& scene, const CellSet& cells, const PackInputs& inputs,
                       const std::vector<CellId>& list, TextureFormat format, const Json& made_by,
                       const fs::path& bundle, int n_threads, const Progress& progress) {
  const CaptureSettings settings =
      read_settings(inputs.captures, scene, hash_file(inputs.cells_file));
  check_self_contained(scene, inputs.scene_file);
  std::error_code ignored;
  fs::remove(bundle / kManifestName, ignored);  // from here on the folder is no bundle
  make_folder(bundle / "cells");
  make_folder(bundle / "centres");

  PackCounts counts;
  TilesNeeded needed;
  std::mutex mutex;  // guards both
  const auto pack_cell = [&](std::size_t i) {
    const CellMeshes meshes = read_cell_meshes(scene, cells, inputs, settings.key(), list[i]);
    write_cell_geometry(cell_file(bundle, list[i]), make_geometry(scene, meshes));
    const std::lock_guard lock(mutex);
    add_needed(cells, list[i], meshes, needed);
    counts.n_inside += cells.inside[index(list[i])].size();
    counts.n_triangles_inside += count_inside(scene, cells, list[i]);
    for (std::size_t m = 0; m < meshes.meshes.size(); ++m) {
      counts.n_triangles_outside += meshes.meshes[m].triangles.size();
      ++(meshes.kinds[m] == Representation::single_view ? counts.n_single_view
                                                        : counts.n_multi_view);
    }
  };
  parallel_for(list.size(), n_threads, pack_cell, progress);

  BundleManifest manifest{scene.hash, settings.density.resolution_px, format, list, {}, made_by};
  for (const auto& [centre, objects] : needed) manifest.centres.push_back(centre);
  const auto pack_centre = [&](std::size_t i) {
    const CentreId centre = manifest.centres[i];
    const CentreTextures textures =
        read_textures(inputs.captures, settings, centre, needed.at(centre));
    write_centre_textures(centre_file(bundle, centre), textures, format);
    const std::lock_guard lock(mutex);
    counts.texel_bytes += textures.texels.size() * sizeof(Rgba8);
  };
  parallel_for(manifest.centres.size(), n_threads, pack_centre, progress);

  for (const SceneMesh& mesh : scene.meshes)
    copy_into(resolve_inside(inputs.scene_file, "meshes", mesh.file), bundle / mesh.file);
  copy_into(inputs.scene_file, bundle / "scene.json");
  copy_into(inputs.cells_file, bundle / "cells.json");
  write_file(bundle / kManifestName, format_json(format_manifest(manifest)));
  counts.n_cells = list.size();
  counts.n_centres = manifest.centres.size();
  return counts;
}

}  // namespace viewcell
