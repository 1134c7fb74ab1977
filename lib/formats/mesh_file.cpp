#include "formats/mesh_file.h"

#include <algorithm>
#include <string_view>

#include "base/error.h"
#include "base/file.h"
#include "formats/readers.h"
#include "mesh/surface_samples.h"

namespace viewcell {
namespace {

using Reader = TriMesh (*)(std::string_view bytes, const std::filesystem::path& file,
                           Remarks* remarks);

TriMesh parse_gzipped_ply(std::string_view bytes, const std::filesystem::path& file,
                          Remarks* remarks) {
  return parse_ply_mesh(gunzip(bytes, file), file, remarks);
}

struct Format {
  std::string_view ending;
  Reader reader;
};
constexpr Format kFormats[] = {
    {".obj", parse_obj},   {".ply", parse_ply_mesh}, {".ply.gz", parse_gzipped_ply},
    {".off", parse_off},   {".stl", parse_stl},      {".glb", parse_gltf},
    {".gltf", parse_gltf}, {".3ds", parse_3ds}};

// By the name's ending; none: nullptr.
Reader reader_by_name(const std::filesystem::path& file) {
  std::string name = file.filename().string();
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const auto& [ending, reader] : kFormats)
    if (name.ends_with(ending)) return reader;
  return nullptr;
}

bool starts_as_off(std::string_view bytes) {
  const std::string_view word = bytes.substr(0, bytes.find_first_of(" \t\r\n"));
  return word.size() <= 7 && word.ends_with("OFF");  // STCNOFF has them all
}

// A vertex in a line of its own.
bool has_obj_vertex(std::string_view bytes) {
  return bytes.starts_with("v ") || bytes.find("\nv ") != std::string_view::npos;
}

// By what the file holds; nothing known: nullptr.
Reader reader_by_content(std::string_view bytes) {
  if (bytes.starts_with("ply")) return parse_ply_mesh;
  if (bytes.starts_with("\x1f\x8b")) return parse_gzipped_ply;
  if (bytes.starts_with("glTF") || bytes.starts_with("{")) return parse_gltf;
  if (starts_as_off(bytes)) return parse_off;
  if (is_binary_stl(bytes) || bytes.starts_with("solid")) return parse_stl;
  if (bytes.starts_with("MM")) return parse_3ds;
  if (has_obj_vertex(bytes)) return parse_obj;
  return nullptr;
}

[[noreturn]] void refuse_format(const std::filesystem::path& file) {
  std::string known;
  for (const auto& [ending, reader] : kFormats)
    known += (known.empty() ? "" : ", ") + std::string(ending);
  throw InputError(file.string(), "", "is of no known mesh format (" + known + ")");
}

}  // namespace

TriMesh read_mesh(const std::filesystem::path& file, MeshSource* source) {
  const std::string bytes = read_file(file);
  Reader reader = reader_by_name(file);
  if (reader == nullptr) reader = reader_by_content(bytes);
  if (reader == nullptr) refuse_format(file);
  TriMesh mesh = reader(bytes, file, source == nullptr ? nullptr : &source->remarks);
  if (source != nullptr) source->hash = hash_hex(bytes);
  check_mesh(mesh, file.string());
  normalize_normals(mesh);
  return mesh;
}

TriMesh read_surface(const std::filesystem::path& file, MeshSource* source) {
  TriMesh mesh = read_mesh(file, source);
  if (!(surface_area(mesh) > 0))
    throw InputError(file.string(), "", "has no area: every face is a line or a point");
  return mesh;
}

}  // namespace viewcell
