// What Draco packed, behind the numbers of triangles and of vertices (4 bytes each) that a glTF
// would say. Draco itself has no coverage here, and decodes in a process of its own.
#include <cstring>

#include "formats/gltf_draco.h"
#include "fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t n_bytes) {
  using namespace viewcell;
  constexpr std::size_t kHead = 8, kMost = 1 << 16;
  if (n_bytes < kHead) return 0;
  std::uint32_t counts[2];
  std::memcpy(counts, data, kHead);
  const DracoShape shape{counts[0] % kMost, counts[1] % kMost, {{"POSITION", {0, 3}}}};
  const Json json = Json::object();
  const std::filesystem::path file = "in.glb";
  is_taken([&] {
    const DracoMesh mesh =
        decode_draco(view_of(data, n_bytes).substr(kHead), shape, JsonCursor(json, file));
    hold(mesh.triangles.size() == shape.n_triangles, "as many triangles as are said");
    for (const Triangle& t : mesh.triangles)
      for (const std::uint32_t v : t) hold(v < shape.n_vertices, "vertices exist");
    hold(mesh.attributes.at("POSITION").size() == 3 * shape.n_vertices, "a position a vertex");
  });
  return 0;
}
