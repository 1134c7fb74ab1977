#include "image/memory_input.h"

#include "image/library.h"

namespace viewcell {
namespace {

constexpr int kMaxChannels = 64;

// What the decoder will allocate, before it does.
void check_spec(const OIIO::ImageSpec& spec, const std::string& file) {
  check_image_size(spec.width, spec.height, file);
  if (spec.tile_width > 0) check_image_size(16LL * spec.tile_width, 16LL * spec.tile_height, file);
  if (spec.depth > 1 || spec.deep) throw InputError(file, "header", "is not a flat picture");
  if (spec.nchannels < 1 || spec.nchannels > kMaxChannels)
    throw InputError(
        file, "header",
        std::to_string(spec.nchannels) + " channels, more than " + std::to_string(kMaxChannels));
}

}  // namespace

MemoryInput open_memory(std::string_view bytes, const std::string& file) {
  configure_openimageio();
  MemoryInput picture;
  picture.format = check_image_header(bytes, file);
  // The reader only reads; its parameter is not const.
  picture.memory = std::make_unique<OIIO::Filesystem::IOMemReader>(const_cast<char*>(bytes.data()),
                                                                   bytes.size());
  picture.input = OIIO::ImageInput::create(name_of(picture.format), false);
  if (!picture.input || !picture.input->set_ioproxy(picture.memory.get()))
    throw MachineError(std::string("OpenImageIO cannot read ") + name_of(picture.format));
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);
  if (!picture.input->open(file, picture.spec, hints))
    throw InputError(file, "", first_line(picture.input->geterror()));
  check_spec(picture.spec, file);
  return picture;
}

}  // namespace viewcell
