// Writes the first inputs of all fuzzers: fuzz_seeds FOLDER makes FOLDER/NAME/* for each fuzz_NAME.
// All hashes in them are 0 (fuzz.cpp).
#include <cstdio>

#include "adapt/adapt_file.h"
#include "bake/weighted_mesh_file.h"
#include "base/file.h"
#include "formats/mesh_bytes.h"
#include "fuzz.h"
#include "gltf_seeds.h"
#include "picture_seeds.h"
#include "pm/pm_file.h"
#include "seeds.h"
#include "small_bundle.h"
#include "small_record.h"

namespace viewcell {
namespace fs = std::filesystem;

fs::path Seeds::file(const std::string& fuzzer, const std::string& name) const {
  make_folder(folder_ / fuzzer);
  return folder_ / fuzzer / name;
}

void Seeds::add(const std::string& fuzzer, const std::string& name, std::string_view bytes) const {
  write_file(file(fuzzer, name), bytes);
}

namespace {

// With all that a mesh can have.
TriMesh make_rich_cube() {
  TriMesh mesh = make_cube();
  mesh.normals = make_vertex_normals(mesh);
  mesh.colors.assign(mesh.positions.size(), {1, 0.5f, 0});
  for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c)
    mesh.texcoords.emplace_back(c % 4 * 0.25f, c % 3 * 0.5f);
  mesh.material_names = {"clay", "tin"};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    mesh.materials.push_back(static_cast<std::int32_t>(t % 2));
  mesh.material_libraries = {"cube.mtl"};
  return mesh;
}

void add_written_meshes(const Seeds& seeds) {
  TriMesh hard = make_rich_cube(), far = make_cube();
  hard.normals.clear();
  for (const Triangle& t : hard.triangles)
    hard.corner_normals.insert(hard.corner_normals.end(), 3,
                               glm::vec3(glm::normalize(area_normal(hard, t))));
  far.offset = {500016, 4649776, 208};
  const std::pair<const char*, TriMesh> meshes[] = {
      {"plain", make_cube()}, {"rich", make_rich_cube()}, {"hard", hard}, {"far", far}};
  for (std::size_t f = 0; f < kWrittenEndings.size(); ++f)
    for (const auto& [name, mesh] : meshes) {
      const std::string& ending = kWrittenEndings[f];
      const fs::path file = seeds.file(ending.substr(1), name + ending);
      write_mesh(file, static_cast<MeshFormat>(f), mesh);
      seeds.add("any_mesh", name + ending, read_file(file));
    }
}

std::string strips_ply() {
  std::string out =
      "ply\nformat ascii 1.0\ncomment TextureFile a.png\nelement vertex 4\nproperty double x\n"
      "property double y\nproperty double z\nproperty uchar r\nproperty uchar g\nproperty uchar b\n"
      "property float s\nproperty float t\nelement tristrips 1\n"
      "property list int int vertex_indices\nend_header\n";
  for (const char* place : {"0 0 0", "1 0 0", "0 1 0", "1 1 0"})
    out += std::string(place) + " 255 128 0 0.5 0.25\n";
  return out + "7 0 1 2 -1 1 3 2\n";
}

std::string rich_3ds() {
  std::string texcoords, material("tin\0", 4), groups;
  append_value<std::uint16_t>(texcoords, 8);
  for (int v = 0; v < 8; ++v) append_value(texcoords, 0.1f * v), append_value(texcoords, 0.5f);
  append_value<std::uint16_t>(material, 2);
  append_value<std::uint16_t>(material, 0), append_value<std::uint16_t>(material, 11);
  for (std::uint32_t f = 0; f < 12; ++f) append_value(groups, f / 2);
  std::string object =
      cube_3ds_object(chunk_3ds(0x4130, material) + chunk_3ds(0x4150, groups)).substr(11);
  const std::string list = object.substr(6) + chunk_3ds(0x4140, texcoords);
  return cube_3ds(chunk_3ds(0x4000, std::string("cube\0", 5) + chunk_3ds(0x4100, list)));
}

void add_other_meshes(const Seeds& seeds) {
  const std::tuple<const char*, const char*, std::string> files[] = {
      {"obj", "squares.obj", cube_obj()},
      {"obj", "lines.obj",
       "\xef\xbb\xbf# x\r\nv 0 0 0 1 0.5 0\r\nv 1 0 0 \\\r\n 0 1 0\r\nv 0 1 0\r\nv 1 1 1 1\r\n"
       "vt 0 1\r\nvn nan 0 1\r\ng a\r\nusemtl b c\r\nf -4/1/1 2//1 3/1 4\r\nl 1 2\r\ns 1\r\n"
       "f 1 2\r\n"},
      {"off", "squares.off", cube_off()},
      {"off", "all.off",
       "STCNOFF\n3 1 0 # x\n0 0 0 0 0 1 1 0.5 0 1 0 0\n1 0 0 0 0 1 255 128 0 255 1 0\n"
       "0 1 0 0 0 1 0 0 0 0 0 1\n3 0 1 2 0.5 0.5 0.5\n"},
      {"ply", "squares.ply", cube_ply()},
      {"ply", "strips.ply", strips_ply()},
      {"stl", "text.stl", cube_stl_text()},
      {"stl", "binary.stl", cube_stl_binary()},
      {"3ds", "plain.3ds", cube_3ds()},
      {"3ds", "rich.3ds", rich_3ds()},
      {"any_mesh", "gzipped", gzipped(cube_ply())},
      {"any_mesh", "plain.3ds", cube_3ds()}};
  for (const auto& [fuzzer, name, bytes] : files) seeds.add(fuzzer, name, bytes);
  seeds.add("mtl", "all.mtl",
            "newmtl a b\nKd 1 1 1\nmap_Kd -s 1 1 1 -clamp on a picture.png\nbump -bm 0.5 b.png\n"
            "norm in.mtl\ndisp ../c.png\ndecal /d.png\nmap_Ka a picture.png\n");
}

void add_progressive_meshes(const Seeds& seeds) {
  const ProgressiveRecord textured = make_small_record();
  write_pm(seeds.file("pm", "textured.pm"), textured);
  write_adapt(seeds.file("adapt", "half.adapt"), make_adaptation_log(textured), textured);
  BuildOptions full;
  full.metric = MetricKind::mapping, full.placement = Placement::full;
  write_pm(seeds.file("pm", "full.pm"),
           build_progressive_mesh(make_gored_figure(4, 2), full).record);
  TriMesh rich = make_rich_cube();
  rich.offset = {500016, 4649776, 208};
  write_pm(seeds.file("pm", "rich.pm"), build_progressive_mesh(rich, {}).record);
}

void add_bundle(const Seeds& seeds) {
  const fs::path plain = fuzz_folder() / "plain", packed = fuzz_folder() / "packed";
  const fs::path bake = write_small_bundle(plain, TextureFormat::rgba8);
  const auto copy = [&](const char* fuzzer, const char* name, const fs::path& file) {
    seeds.add(fuzzer, name, read_file(file));
  };
  copy("geo", "cell.geo", bake / cell_name(kFuzzCell));
  copy("tex", "rgba8.tex", bake / centre_name(kFuzzCentre));
  std::string bc3 =
      read_file(write_small_bundle(packed, TextureFormat::bc3) / centre_name(kFuzzCentre));
  copy("manifest", "bundle.json", plain / kManifestName);
  copy("scene", "scene.json", bake / "scene.json");
  copy("cells", "cells.json", bake / "cells.json");
  seeds.add("tex", "bc3.tex", bc3);
  seeds.add("path", "path.json",
            format_json(format_path({{{0, {1, 2, 16}, {1, 0, 0}}, {1.5, {2, 2, 17}, {0, 1, 0.5}}}},
                                    Json::object())));
  seeds.add("csv", "a.csv",
            "\xef\xbb\xbf"
            "a,\"b \"\"c\"\"\"\r\n1,nan\r\n\r\n,-2e3\r\n");
}

void add_weighted_meshes(const Seeds& seeds) {
  const TriMesh cube = make_cube();
  const std::size_t n = cube.positions.size();
  CellMesh mesh;
  mesh.vertices.positions = cube.positions;
  mesh.vertices.normals = make_vertex_normals(cube);
  mesh.vertices.weights.assign(n, 0.5f);
  mesh.vertices.views.assign(n, 3);
  for (std::uint32_t v = 0; v < n; ++v) mesh.source_vertex.push_back(v);
  mesh.triangles = cube.triangles;
  mesh.views.assign(cube.triangles.size(), 1);
  CellMesh second = mesh, none;
  second.object = ObjectId(1), none.object = ObjectId(2);
  write_weighted_meshes(
      seeds.file("weighted_mesh", "cell.ply"),
      {Representation::single_view, kFuzzCell, kFuzzKey, kFuzzKey, {mesh, second, none}}, "test");
}

}  // namespace
}  // namespace viewcell

int main(int n_words, char** words) {
  if (n_words != 2) return std::fprintf(stderr, "usage: fuzz_seeds FOLDER\n"), 2;
  const viewcell::Seeds seeds(words[1]);
  viewcell::add_written_meshes(seeds);
  viewcell::add_other_meshes(seeds);
  viewcell::add_gltf_files(seeds);
  viewcell::add_pictures(seeds);
  viewcell::add_progressive_meshes(seeds);
  viewcell::add_bundle(seeds);
  viewcell::add_weighted_meshes(seeds);
  return 0;
}
