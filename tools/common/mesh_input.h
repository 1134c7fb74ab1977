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

/// read_mesh (formats/mesh_file.h) within mesh_limits(); its remarks go to the tool. hash: of the
/// file's bytes, if wanted.
inline TriMesh read_mesh_input(const Tool& tool, const std::filesystem::path& file,
                               std::string* hash = nullptr) {
  MeshSource source;
  TriMesh mesh = read_mesh(file, &source, mesh_limits(tool));
  tool.remark(file, source.remarks);
  if (hash != nullptr) *hash = source.hash;
  return mesh;
}

/// read_surface likewise.
inline TriMesh read_surface_input(const Tool& tool, const std::filesystem::path& file,
                                  std::string* hash = nullptr) {
  MeshSource source;
  TriMesh mesh = read_surface(file, &source, mesh_limits(tool));
  tool.remark(file, source.remarks);
  if (hash != nullptr) *hash = source.hash;
  return mesh;
}

/// read_surface_or_points likewise.
inline TriMesh read_surface_or_points_input(const Tool& tool, const std::filesystem::path& file,
                                            std::string* hash = nullptr) {
  MeshSource source;
  TriMesh mesh = read_surface_or_points(file, &source);
  tool.remark(file, source.remarks);
  if (hash != nullptr) *hash = source.hash;
  return mesh;
}

}  // namespace viewcell
