// Pictures of all formats. OpenImageIO and the libraries below it have no coverage here.
#include "fuzz.h"
#include "image/io.h"
#include "image/picture_size.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t n_bytes) {
  using namespace viewcell;
  const std::string_view bytes = view_of(data, n_bytes);
  const ReadImageOptions options{.limits = {.max_pixels = 1 << 20}};
  PictureSize size;
  const bool is_measured = is_taken([&] { size = measure_picture(bytes, "in"); });
  ImageRgba8 image;
  if (!is_taken([&] { image = decode_image_rgba8(bytes, "in", options); })) return 0;
  hold(is_measured, "what is decoded can be measured");
  hold(image.width_px == size.width_px && image.height_px == size.height_px, "sizes agree");
  hold(image.pixels.size() == image.offset(0, image.height_px), "as many pixels as are said");
  const auto file = put_input("in", bytes);
  is_taken([&] {
    const DeepImage deep = read_deep_image(file, options);
    hold(deep.width_px() == size.width_px && deep.height_px() == size.height_px, "sizes agree");
  });
  return 0;
}
