#include "report/mesh_info.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "base/disjoint_sets.h"
#include "formats/mesh_file.h"
#include "formats/texture_list.h"
#include "mesh/edges.h"
#include "mesh/surface_samples.h"
#include "mesh/used_vertices.h"

namespace viewcell {
namespace {

namespace fs = std::filesystem;

constexpr double kSceneHeight = 40;  // of the demo's statues, in units of its park

std::string format_by_name(const fs::path& file) {
  std::string name = file.filename().string();
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  struct Row {
    const char* ending;
    const char* format;
  };
  constexpr Row kRows[] = {{".ply", "PLY"},   {".ply.gz", "PLY.GZ"}, {".obj", "OBJ"},
                           {".off", "OFF"},   {".stl", "STL"},       {".glb", "GLB"},
                           {".gltf", "glTF"}, {".3ds", "3DS"}};
  for (const Row& row : kRows)
    if (name.ends_with(row.ending)) return row.format;
  return "";
}

// Positions and triangles alone, equal positions as one vertex.
TriMesh weld(const TriMesh& mesh, std::size_t& n_places) {
  const std::vector<std::uint32_t> first = match_positions(mesh);
  n_places = 0;
  for (std::uint32_t v = 0; v < first.size(); ++v) n_places += first[v] == v;
  TriMesh out;
  out.positions = mesh.positions;
  out.triangles = mesh.triangles;
  for (Triangle& t : out.triangles)
    for (std::uint32_t& v : t) v = first[v];
  return out;
}

std::size_t count_border_loops(const TriMesh& mesh) {
  const EdgeTable edges = build_edge_table(mesh);
  DisjointSets sets(mesh.positions.size());
  std::vector<bool> is_on(mesh.positions.size(), false);
  std::size_t n = 0;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges.halves(e).size() != 1) continue;
    const auto [a, b] = edges.ends(e, mesh);
    for (const std::uint32_t v : {a, b}) {
      n += !is_on[v];
      is_on[v] = true;
    }
    n -= sets.join(a, b);
  }
  return n;
}

// Divergence theorem, about the box's middle.
double signed_volume(const TriMesh& mesh, const glm::dvec3& middle) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const auto at = [&](int k) {
      return glm::dvec3(mesh.positions[t[static_cast<std::size_t>(k)]]) - middle;
    };
    sum += glm::dot(at(0), glm::cross(at(1), at(2)));
  }
  return sum / 6;
}

std::vector<MaterialUse> count_materials(const TriMesh& mesh) {
  std::vector<MaterialUse> out;
  for (const std::string& name : mesh.material_names) out.push_back({name, 0});
  for (const std::int32_t id : mesh.materials) ++out[static_cast<std::size_t>(id)].n_triangles;
  return out;
}

// As people would type it.
double round_to_two_digits(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.2g", x);
  return std::strtod(text, nullptr);
}

void suggest_scene(MeshInfo& info) {
  // As modellers write these formats; others have no habit.
  if (info.format == "OBJ" || info.format == "GLB" || info.format == "glTF") info.up = "y";
  const glm::dvec3 size = info.box.size();
  const double height = info.up == "y" ? size.y : size.z;
  // What is flat or wide is to be no wider than twice as much.
  const double used = std::max(height, std::max({size.x, size.y, size.z}) / 2);
  const bool fits = used >= kSceneHeight / 2 && used <= kSceneHeight * 2;
  if (used > 0 && !fits) info.scale = round_to_two_digits(kSceneHeight / used);
}

void measure_charts(const TriMesh& mesh, int texture_px, MeshInfo& info) {
  int width = texture_px, height = texture_px;
  const auto sized = std::find_if(info.textures.begin(), info.textures.end(),
                                  [](const ListedTexture& t) { return t.width_px > 0; });
  if (sized != info.textures.end()) width = sized->width_px, height = sized->height_px;
  constexpr int kMostSide = 4096;  // time and memory grow with texels
  info.charts = check_charts(mesh, std::min(width, kMostSide), std::min(height, kMostSide));
}

}  // namespace

MeshInfo measure_mesh_file(const fs::path& file, int texture_px) {
  MeshInfo info;
  MeshSource source;
  const TriMesh mesh = read_mesh(file, &source);
  info.file = file.string();
  info.format = format_by_name(file);
  info.remarks = source.remarks;
  info.n_vertices = mesh.positions.size();
  info.n_triangles = mesh.triangles.size();
  info.offset = mesh.offset;
  const Box box = surface_box(mesh);
  info.box = {box.lo + mesh.offset, box.hi + mesh.offset};
  info.area = surface_area(mesh);
  TriMesh welded = weld(mesh, info.n_places);
  info.topology = measure_topology(welded);
  info.n_border_loops = count_border_loops(welded);
  if (info.topology.is_closed_manifold()) info.volume = signed_volume(welded, box.centre());
  info.defects = clean_mesh(welded);
  info.has_normals = !mesh.normals.empty();
  info.has_corner_normals = !mesh.corner_normals.empty();
  info.has_colors = !mesh.colors.empty();
  info.has_texcoords = !mesh.texcoords.empty();
  info.materials = count_materials(mesh);
  if (file != "-") info.textures = list_textures(file);
  if (info.has_texcoords) measure_charts(mesh, texture_px, info);
  suggest_scene(info);
  return info;
}

}  // namespace viewcell
