// What there is to know of a mesh file before anything is done with it (`meshinfo`).
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/json.h"
#include "base/remarks.h"
#include "formats/texture_list.h"
#include "mesh/mesh.h"
#include "mesh/topology.h"
#include "uv/chart_checks.h"

namespace viewcell {

struct MaterialUse {
  std::string name;
  std::size_t n_triangles = 0;
};

struct MeshInfo {
  std::string file;    ///< as it was named
  std::string format;  ///< "PLY", by the name's ending; empty where that says nothing
  std::size_t n_vertices = 0, n_triangles = 0;
  std::size_t n_places = 0;  ///< different positions of vertices
  Box box;                   ///< of vertices that triangles use; the offset added
  glm::dvec3 offset{0};
  double area = 0;
  std::optional<double> volume;  ///< of closed surfaces; below 0 where they are inside out
  /// Vertices at one position count as one here.
  MeshTopology topology;
  std::size_t n_border_loops = 0;  ///< connected parts of the border's edges
  MeshDefects defects;             ///< triangles that show nothing
  bool has_normals = false, has_corner_normals = false, has_colors = false, has_texcoords = false;
  ChartFindings charts;  ///< where there are texture coordinates
  std::vector<MaterialUse> materials;
  std::vector<ListedTexture> textures;
  Remarks remarks;  ///< of the reader: what it left out or did
  /// What scene.json would say to have it some 40 units high, as the demo's statues are, or
  /// some 80 wide where it is wider.
  std::string up = "z";
  double scale = 1;
};

/// texture_px: the side of the texture that charts are checked on, where none of the file's own has
/// a size. O(n log n).
MeshInfo measure_mesh_file(const std::filesystem::path& file, int texture_px = 1024);

/// docs/formats.md.
Json report_mesh_info(const MeshInfo& info);

/// A line a subject.
std::string format_mesh_info(const MeshInfo& info);
/// A line a file.
std::string format_mesh_table(const std::vector<MeshInfo>& infos);

}  // namespace viewcell
