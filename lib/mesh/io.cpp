#include "mesh/io.h"

#include <algorithm>
#include <string_view>

#include "base/error.h"
#include "base/file.h"
#include "mesh/readers.h"

namespace viewcell {
namespace {

using Reader = TriMesh (*)(std::string_view bytes, const std::filesystem::path& file);

TriMesh parse_gzipped_ply(std::string_view bytes, const std::filesystem::path& file) {
  return parse_ply_mesh(gunzip(bytes, file), file);
}

struct Format {
  std::string_view ending;
  Reader reader;
};
constexpr Format kFormats[] = {
    {".obj", parse_obj},   {".ply", parse_ply_mesh}, {".ply.gz", parse_gzipped_ply},
    {".off", parse_off},   {".stl", parse_stl},      {".glb", parse_gltf},
    {".gltf", parse_gltf}, {".3ds", parse_3ds}};

Reader find_reader(const std::filesystem::path& file) {
  std::string name = file.filename().string();
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::string known;
  for (const auto& [ending, reader] : kFormats) {
    if (name.ends_with(ending)) return reader;
    known += (known.empty() ? "" : ", ") + std::string(ending);
  }
  throw InputError(file.string(), "", "is of no known mesh format (" + known + ")");
}

}  // namespace

TriMesh read_mesh(const std::filesystem::path& file) {
  const Reader reader = find_reader(file);
  TriMesh mesh = reader(read_file(file), file);
  check_mesh(mesh, file.string());
  normalize_normals(mesh);
  return mesh;
}

}  // namespace viewcell
