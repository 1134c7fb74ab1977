#include "image/picture_size.h"

#include "image/memory_input.h"

namespace viewcell {

PictureSize measure_picture(std::string_view bytes, const std::string& name, Remarks* remarks) {
  const MemoryInput picture = open_memory(bytes, name, {}, remarks);
  return {picture.format, picture.spec.width, picture.spec.height, picture.spec.nchannels};
}

}  // namespace viewcell
