// Textures of a centre, in a bundle of plain ones or, where it says BC3, of compressed ones.
#include <cmath>

#include "fuzz.h"
#include "small_bundle.h"

namespace viewcell {
namespace {

void hold_laws(const CentreTextures& t) {
  std::uint64_t next = 0;
  for (const BundleTile& tile : t.tiles) {
    hold(tile.first_texel == next, "tiles follow one another");
    next += static_cast<std::uint64_t>(tile.width_px) * static_cast<std::uint64_t>(tile.height_px);
    hold(std::isfinite(tile.code_scale) && std::isfinite(tile.code_bias), "codes are finite");
  }
  hold(next == t.texels.size(), "tiles are all texels");
}

struct OpenBundle {
  std::filesystem::path folder, bake;
  Bundle bundle;
  OpenBundle(const char* name, TextureFormat format)
      : folder(fuzz_folder() / name), bake(write_small_bundle(folder, format)), bundle(folder) {}
};

}  // namespace
}  // namespace viewcell

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t n_bytes) {
  using namespace viewcell;
  static const OpenBundle plain("plain", TextureFormat::rgba8), packed("bc3", TextureFormat::bc3);
  const std::string_view bytes = view_of(data, n_bytes);
  const OpenBundle& b = bytes.find("BC3") != bytes.npos ? packed : plain;
  std::filesystem::rename(put_input("in.tex", bytes), b.bake / centre_name(kFuzzCentre));
  is_taken([&] { hold_laws(b.bundle.read_centre(kFuzzCentre)); });
  return 0;
}
