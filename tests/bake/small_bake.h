// A park of five objects and some nine cells, baked in a temporary folder.
#pragma once

#include <functional>

#include "bake/derive.h"
#include "bake/pack.h"
#include "base/file.h"
#include "capture/capture_centre.h"
#include "capture/ray_capture.h"
#include "capture/shapes.h"
#include "common/temporary_folder.h"
#include "formats/mesh_file.h"
#include "image/fill.h"
#include "image/io.h"
#include "scene/material_scene.h"
#include "scene/pictures.h"

namespace viewcell {

inline const Json& test_provenance() {
  static const Json json{{"tool", "test"}, {"version", "0"}, {"options", Json::object()}};
  return json;
}

/// Spheres and noisy tori around eye height, in an area of 120 x 120.
inline Scene make_bake_scene() {
  Scene scene = make_scene_of(make_sphere(6, 40, 24));
  scene.area = {{0, 0}, {120, 120}};
  scene.materials.push_back({"bronze", {0.3f, 0.2f, 0.1f}, "", false});
  scene.meshes[0].name = "sphere", scene.meshes[0].file = "sphere.ply";
  SceneMesh torus;
  torus.name = "torus", torus.file = "torus.ply";
  torus.mesh = make_noisy_torus(48, 24, 0.05, 3);
  torus.n_triangles = torus.mesh.triangles.size();
  scene.meshes.push_back(std::move(torus));
  scene.objects.clear();
  const double places[5][2] = {{12, 15}, {62, 58}, {108, 20}, {22, 104}, {112, 110}};
  Random random(5);
  for (int i = 0; i < 5; ++i) {
    SceneObject object;
    object.name = "object " + std::to_string(i);
    object.mesh = MeshId(i % 2);
    object.materials = {i / 2 % 2};
    object.scale = i % 2 ? 0.4 : 1;
    object.translation = {places[i][0], places[i][1], 12 + i};
    object.rotation = random_rotation(random);
    scene.objects.push_back(object);
  }
  return scene;
}

/// A fence of leaves, 60 wide and 30 high, in the middle of the same area; a ball on either side.
inline Scene make_fence_scene() {
  Scene scene = make_scene_of(make_sphere(6, 40, 24));
  scene.area = {{0, 0}, {120, 120}};
  scene.meshes[0].name = "sphere", scene.meshes[0].file = "sphere.ply";
  TriMesh wall;
  wall.positions = {{-30, 0, -15}, {30, 0, -15}, {30, 0, 15}, {-30, 0, 15}};
  wall.triangles = {{0, 1, 2}, {0, 2, 3}};
  wall.texcoords = {{0, 0}, {2, 0}, {2, 1}, {0, 0}, {2, 1}, {0, 1}};
  scene.meshes.push_back(make_dressed_mesh(wall, "fence"));
  scene.materials = {{.base_color = {0.5f, 0.1f, 0.1f}},
                     {.base_color = glm::vec3(1),
                      .base_color_texture = "leaves.png",
                      .double_sided = true,
                      .alpha = AlphaMode::mask}};
  scene.pictures.push_back({"leaves.png", "", 0.5f, {make_spots(64, 3)}});
  scene.objects.clear();
  for (const auto& [mesh, x, y] : {std::tuple(1, 60, 60), {0, 45, 80}, {0, 75, 40}}) {
    SceneObject& object = scene.objects.emplace_back();
    object.mesh = MeshId(mesh);
    object.materials = {mesh};
    object.translation = {x, y, 18};
  }
  return scene;
}

/// Writes scene.json, its meshes and its pictures' finest levels; what read_scene and load_pictures
/// make of them.
inline Scene write_scene(Scene scene, const std::filesystem::path& folder) {
  for (ScenePicture& picture : scene.pictures) {
    write_png(folder / picture.file, picture.mips.at(0));
    picture.hash = hash_file(folder / picture.file);
  }
  for (SceneMesh& mesh : scene.meshes) {
    write_ply(folder / mesh.file, mesh.mesh);
    mesh.hash = hash_file(folder / mesh.file);
  }
  write_file(folder / "scene.json", format_json(format_scene(scene, test_provenance())));
  Scene read = read_scene(folder / "scene.json");
  load_pictures(folder / "scene.json", read, {}, 2);
  return read;
}

/// One object from one eye, filled and classified.
inline std::optional<ClassifiedView> classify_view(const Scene& scene, const RayCapture& rays,
                                                   ObjectId object, const glm::dvec3& eye,
                                                   const CaptureDensity& density, int view = 0) {
  const auto viewed = choose_view(eye, world_points(scene, scene.objects[index(object)]), density);
  if (!viewed) return {};
  ClassifiedView out{view, rays.capture(object, viewed->view, viewed->crop), {}};
  push_pull_fill(out.tile.color, out.tile.inverse_depth);
  out.categories = classify_pixels(out.tile);
  return out;
}

/// Captures and meshes of every cell; nothing is packed yet.
struct SmallBake {
  TemporaryFolder folder;
  Scene scene;
  CellSet cells = make_cells(scene, 40, {});
  BakeOptions options = make_options();
  PackInputs inputs{folder.path() / "scene.json", folder.path() / "cells.json",
                    folder.path() / "captures", folder.path() / "svmesh", folder.path() / "mvmesh"};
  CaptureSettings settings;
  std::vector<CellId> list;
  BakeScene bake = build_bake_scene(scene, cells, 2);

  static BakeOptions make_options() {
    BakeOptions options;
    options.ts_px = 20;  // so that both kinds occur
    options.resolution_px = 256;
    options.max_drift_px = 0.4;  // objects are some 40 px wide
    return options;
  }

  /// edit: changes the cells before they are written.
  explicit SmallBake(Scene made = make_bake_scene(),
                     const std::function<void(const Scene&, CellSet&)>& edit = {})
      : scene(write_scene(std::move(made), folder.path())) {
    for (int i = 0; i < cells.grid.n_cells(); ++i) list.push_back(CellId(i));
    if (edit) edit(scene, cells);
    write_file(inputs.cells_file, format_json(format_cells(cells, test_provenance())));
    cells = read_cells(inputs.cells_file);
    settings = {scene.hash, cells.file_hash, {.resolution_px = 256}, "embree"};
    for (const auto& part : {inputs.captures, inputs.svmesh, inputs.mvmesh}) make_folder(part);
    capture();
    derive(Representation::single_view, inputs.svmesh);
    derive(Representation::multi_view, inputs.mvmesh);
  }

  void capture() const {
    const RayCapture rays(scene, 2);
    const auto centres = centres_of(cells, list);
    const auto points = object_points_world(scene);
    const CaptureEngine engine = [&](ObjectId object, const CaptureView& view, const Crop& crop) {
      return rays.capture(object, view, crop);
    };
    parallel_for(centres.size(), 2, [&](std::size_t i) {
      write_captures(capture_file_of(inputs.captures, centres[i]),
                     capture_centre(cells, centres[i], points, settings.density, engine).tiles,
                     settings);
    });
    write_file(inputs.captures / kCapturesManifest,
               format_json(format_settings(settings, test_provenance())));
  }

  void derive(Representation kind, const std::filesystem::path& to) const {
    derive(kind, to, options);
  }
  void derive(Representation kind, const std::filesystem::path& to, const BakeOptions& with) const {
    parallel_for(list.size(), 2, [&](std::size_t i) {
      DeriveCounts counts;
      WeightedMeshes meshes =
          derive_cell(bake, inputs.captures, settings, list[i], kind, with, counts);
      meshes.made_from = "0123456789abcdef";
      write_weighted_meshes(to / weighted_mesh_name(list[i]), meshes, "test");
    });
  }

  PackCounts pack(const std::filesystem::path& bundle) const { return pack(bundle, inputs, list); }
  PackCounts pack(const std::filesystem::path& bundle, const PackInputs& from,
                  const std::vector<CellId>& which,
                  TextureFormat format = TextureFormat::rgba8) const {
    return pack_bundle(scene, cells, from, which, format, test_provenance(), bundle, 2, {});
  }
};

/// All cells tested; each sees none of the objects outside of which is_unseen says so.
inline void mark_unseen(const Scene& scene, CellSet& cells,
                        const std::function<bool(CellId, ObjectId)>& is_unseen) {
  const auto n = static_cast<std::size_t>(cells.grid.n_cells());
  cells.is_tested.assign(n, true), cells.unseen.assign(n, {});
  cells.seen_by = {{"method", "test"}};
  for (std::size_t c = 0; c < n; ++c)
    for (std::size_t o = 0; o < scene.objects.size(); ++o)
      if (!is_inside(cells, CellId(c), ObjectId(o)) && is_unseen(CellId(c), ObjectId(o)))
        cells.unseen[c].push_back(ObjectId(o));
}

inline const SmallBake& shared_bake() {
  static const SmallBake bake;
  return bake;
}

/// The folder of its bundle.
inline const std::filesystem::path& shared_bundle() {
  static const std::filesystem::path bundle = [] {
    shared_bake().pack(shared_bake().folder.path() / "bundle");
    return shared_bake().folder.path() / "bundle";
  }();
  return bundle;
}

}  // namespace viewcell
