// A mesh that a tool reads: what its reader passed over is said.
#pragma once

#include <filesystem>
#include <string>

#include "common/tool.h"
#include "formats/mesh_file.h"

namespace viewcell {

/// --max-triangles, where the tool has it (Tool::add_mesh_limit).
inline MeshLimits mesh_limits(const Tool& tool) {
  return {.max_triangles = tool.common().max_triangles};
}

/// What `read` (read_mesh or read_surface_or_points) makes of the file within
/// mesh_limits(); its remarks go to the tool. hash: of the file's bytes, if wanted.
template <typename Read>
TriMesh read_input(const Tool& tool, const std::filesystem::path& file, std::string* hash,
                   const Read& read) {
  MeshSource source;
  TriMesh mesh = read(file, &source, mesh_limits(tool));
  tool.remark(file, source.remarks);
  if (hash != nullptr) *hash = source.hash;
  return mesh;
}

inline TriMesh read_mesh_input(const Tool& tool, const std::filesystem::path& file,
                               std::string* hash = nullptr) {
  return read_input(tool, file, hash, read_mesh);
}
inline TriMesh read_surface_or_points_input(const Tool& tool, const std::filesystem::path& file,
                                            std::string* hash = nullptr) {
  return read_input(tool, file, hash, read_surface_or_points);
}

}  // namespace viewcell
