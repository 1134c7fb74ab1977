// Geometry of a cell, in a bundle.
#include "fuzz.h"
#include "small_bundle.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t n_bytes) {
  using namespace viewcell;
  static const auto bake = write_small_bundle(fuzz_folder() / "b", TextureFormat::rgba8);
  static const Bundle bundle(fuzz_folder() / "b");
  const std::filesystem::path name = cell_name(kFuzzCell);
  std::filesystem::rename(put_input("in.geo", view_of(data, n_bytes)), bake / name);
  CellGeometry g;
  if (!is_taken([&] { g = bundle.read_cell(kFuzzCell); })) return 0;
  hold(g.source_vertices.size() == g.offsets.size(), "an offset a vertex");
  hold(g.indices.size() == 3 * g.views.size(), "a mask a triangle");
  std::size_t i = 0;
  for (const BundleObject& o : g.objects)
    for (std::uint32_t k = 0; k < 3 * o.n_triangles; ++k)
      hold(g.indices[i++] < o.n_vertices, "vertices exist");
  return 0;
}
