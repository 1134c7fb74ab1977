// Indexing maps, EXR and TIFF.
#include <cmath>

#include "fuzz.h"
#include "image/index_map.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t n_bytes) {
  using namespace viewcell;
  const auto file = put_input("in", view_of(data, n_bytes));
  const ImageLimits limits{.max_pixels = 1 << 20};
  IndexMap map;
  if (!is_taken([&] { map = read_index_map(file, nullptr, nullptr, limits); })) return 0;
  for (const glm::vec2& p : map.pixels)
    hold(std::isfinite(p.x) && std::isfinite(p.y), "coordinates are finite");
  write_index_map(fuzz_folder() / "copy.exr", map);
  hold(read_index_map(fuzz_folder() / "copy.exr").pixels == map.pixels,
       "what is written reads back");
  return 0;
}
