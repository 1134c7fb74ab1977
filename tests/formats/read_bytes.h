// Reads bytes as a file, in tests; and what comes out where that is a cube.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "base/remarks.h"
#include "common/temporary_folder.h"
#include "formats/mesh_file.h"
#include "mesh/cube.h"

namespace viewcell {

inline void expect_cube(const TriMesh& mesh) {
  EXPECT_EQ(mesh.positions, cube_positions());
  EXPECT_EQ(mesh.triangles, cube_triangles());
}

struct Read {
  TriMesh mesh;
  Remarks remarks;
};
inline Read read_bytes(const std::string& name, const std::string& bytes) {
  const TemporaryFolder folder;
  MeshSource source;
  TriMesh mesh = read_mesh(folder.add(name, bytes), &source);
  return {std::move(mesh), source.remarks};
}

}  // namespace viewcell
