#include "formats/mesh_file.h"

#include <algorithm>
#include <cstdio>
#include <string_view>

#include "base/error.h"
#include "base/file.h"
#include "formats/mesh_limits.h"
#include "formats/readers.h"
#include "formats/text_cursor.h"
#include "mesh/surface_samples.h"

namespace viewcell {
namespace {

using Reader = TriMesh (*)(std::string_view bytes, const std::filesystem::path& file,
                           Remarks* remarks, const MeshLimits& limits);

TriMesh parse_gzipped_ply(std::string_view bytes, const std::filesystem::path& file,
                          Remarks* remarks) {
  return parse_ply_mesh(gunzip(bytes, file), file, remarks);
}

// Of a format in which no file grows.
template <TriMesh (*parse)(std::string_view, const std::filesystem::path&, Remarks*)>
TriMesh plain(std::string_view bytes, const std::filesystem::path& file, Remarks* remarks,
              const MeshLimits&) {
  return parse(bytes, file, remarks);
}

struct Format {
  std::string_view ending;
  Reader reader;
};
constexpr Format kFormats[] = {{".obj", plain<parse_obj>},
                               {".ply", plain<parse_ply_mesh>},
                               {".ply.gz", plain<parse_gzipped_ply>},
                               {".off", plain<parse_off>},
                               {".stl", plain<parse_stl>},
                               {".glb", parse_gltf},
                               {".gltf", parse_gltf},
                               {".3ds", plain<parse_3ds>}};

// By the name's ending; none: nullptr.
Reader reader_by_name(const std::filesystem::path& file) {
  std::string name = file.filename().string();
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const auto& [ending, reader] : kFormats)
    if (name.ends_with(ending)) return reader;
  return nullptr;
}

// A vertex in a line of its own.
bool has_obj_vertex(std::string_view bytes) {
  return bytes.starts_with("v ") || bytes.find("\nv ") != std::string_view::npos ||
         bytes.find("\rv ") != std::string_view::npos;
}

// By what the file holds; nothing known: nullptr.
Reader reader_by_content(std::string_view bytes) {
  if (bytes.starts_with("ply")) return plain<parse_ply_mesh>;
  if (bytes.starts_with("\x1f\x8b")) return plain<parse_gzipped_ply>;
  if (bytes.starts_with("glTF") || bytes.starts_with("{")) return parse_gltf;
  if (starts_as_off(bytes)) return plain<parse_off>;
  if (is_binary_stl(bytes)) return plain<parse_stl>;
  if (bytes.starts_with("MM")) return plain<parse_3ds>;
  if (may_be_stl(bytes)) return plain<parse_stl>;
  if (has_obj_vertex(bytes)) return plain<parse_obj>;
  return nullptr;
}

[[noreturn]] void refuse_format(const std::filesystem::path& file) {
  std::string known;
  for (const auto& [ending, reader] : kFormats)
    known += (known.empty() ? "" : ", ") + std::string(ending);
  throw InputError(file.string(), "", "is of no known mesh format (" + known + ")");
}

// What the file holds; there may be no faces.
TriMesh read_any(const std::filesystem::path& file, MeshSource* source, const MeshLimits& limits) {
  const std::string bytes = read_file(file);
  Remarks* remarks = source == nullptr ? nullptr : &source->remarks;
  // The comment of a binary STL may begin with any bytes.
  const std::string_view content =
      is_binary_stl(bytes) ? bytes : skip_byte_order_mark(bytes, file.string());
  Reader reader = reader_by_name(file);
  if (reader == nullptr) reader = reader_by_content(content);
  if (reader == nullptr) refuse_format(file);
  TriMesh mesh = reader(content, file, remarks, limits);
  const auto n = static_cast<double>(mesh.triangles.size());
  if (const double most = most_triangles(limits, bytes.size()); n > most)
    throw InputError(file.string(), "", describe_growth(n, "triangles", most));
  if (source != nullptr) source->hash = hash_hex(bytes);
  check_mesh(mesh, file.string());
  fill_colors(mesh, remarks);
  normalize_normals(mesh, remarks);
  return mesh;
}

void check_area(const TriMesh& mesh, const std::filesystem::path& file) {
  if (!(surface_area(mesh) > 0))
    throw InputError(file.string(), "", "has no area: every face is a line or a point");
}

}  // namespace

std::string describe_growth(double n, const char* of_what, double most) {
  char text[160];
  std::snprintf(text, sizeof text, "would be %.0f %s; at most %.0f are read (--max-triangles N)", n,
                of_what, most);
  return text;
}

TriMesh read_mesh(const std::filesystem::path& file, MeshSource* source, const MeshLimits& limits) {
  TriMesh mesh = read_any(file, source, limits);
  if (mesh.triangles.empty()) throw InputError(file.string(), "", "has no faces");
  return mesh;
}

TriMesh read_surface(const std::filesystem::path& file, MeshSource* source,
                     const MeshLimits& limits) {
  TriMesh mesh = read_mesh(file, source, limits);
  check_area(mesh, file);
  return mesh;
}

TriMesh read_surface_or_points(const std::filesystem::path& file, MeshSource* source,
                               const MeshLimits& limits) {
  TriMesh mesh = read_any(file, source, limits);
  if (mesh.positions.empty()) throw InputError(file.string(), "", "has no vertices");
  if (!mesh.triangles.empty()) check_area(mesh, file);
  return mesh;
}

}  // namespace viewcell
