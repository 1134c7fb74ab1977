// Material libraries, and what lists the textures of a mesh: an OBJ whose library the input is.
#include "formats/texture_list.h"
#include "fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t n_bytes) {
  using namespace viewcell;
  static const auto obj =
      put_input("in.obj", "mtllib in.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  put_input("in.mtl", view_of(data, n_bytes));
  is_taken([&] {
    for (const ListedTexture& texture : list_textures(obj))
      hold(texture.fault.empty() == (texture.width_px > 0), "a size or a fault");
  });
  return 0;
}
