// Textures out of GLB and glTF.
#include "formats/texture_file.h"

#include "formats/texture_list.h"
#include "fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t n_bytes) {
  using namespace viewcell;
  const auto file = put_input("in.glb", view_of(data, n_bytes));
  const ReadImageOptions options{.limits = {.max_pixels = 1 << 20}};
  is_taken([&] {
    for (const ListedTexture& texture : list_textures(file))
      hold(texture.fault.empty() == (texture.width_px > 0), "a size or a fault");
  });
  for (const char* slot : {"", "#normal", "#metallicRoughness"})
    is_taken([&] {
      const ImageRgba8 image = read_texture(file.string() + slot, nullptr, options);
      hold(image.pixels.size() == image.offset(0, image.height_px), "as many pixels as are said");
    });
  return 0;
}
