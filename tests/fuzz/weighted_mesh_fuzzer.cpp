// Weighted meshes of a cell.
#include "bake/weighted_mesh_file.h"
#include "fuzz.h"
#include "small_bundle.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t n_bytes) {
  using namespace viewcell;
  static const Scene scene = write_small_scene(fuzz_folder());
  const auto file = put_input("in.ply", view_of(data, n_bytes));
  WeightedMeshes meshes;
  if (!is_taken([&] { meshes = read_weighted_meshes(file, scene); })) return 0;
  for (const CellMesh& mesh : meshes.meshes) {
    hold(mesh.views.size() == mesh.triangles.size(), "a mask a triangle");
    for (const Triangle& t : mesh.triangles)
      for (const std::uint32_t v : t) hold(v < mesh.source_vertex.size(), "vertices exist");
  }
  const auto copy = fuzz_folder() / "copy.ply";
  write_weighted_meshes(copy, meshes, "");
  hold(read_weighted_meshes(copy, scene).meshes.size() == meshes.meshes.size(),
       "what is written reads back");
  return 0;
}
