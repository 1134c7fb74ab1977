#include "image/webp.h"

#include <webp/decode.h>
#include <webp/demux.h>

#include <cstdint>
#include <memory>

#include "base/error.h"

namespace viewcell {
namespace {

struct DeleteDemuxer {
  void operator()(WebPDemuxer* demuxer) const { WebPDemuxDelete(demuxer); }
};

// The first frame of a file. Its members die in the right order.
struct FirstFrame {
  std::unique_ptr<WebPDemuxer, DeleteDemuxer> file;
  WebPIterator frame{};
  FirstFrame() = default;
  FirstFrame(const FirstFrame&) = delete;
  FirstFrame& operator=(const FirstFrame&) = delete;
  ~FirstFrame() { WebPDemuxReleaseIterator(&frame); }
};

bool is_inside(const WebPIterator& frame, int width, int height) {
  return frame.x_offset >= 0 && frame.y_offset >= 0 && frame.width <= width - frame.x_offset &&
         frame.height <= height - frame.y_offset;
}

}  // namespace

ImageRgba8 decode_webp(std::string_view bytes, int width, int height, const std::string& file) {
  const WebPData data{reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
  FirstFrame first;
  first.file.reset(WebPDemux(&data));
  if (!first.file || WebPDemuxGetFrame(first.file.get(), 1, &first.frame) == 0 ||
      first.frame.complete == 0)
    throw InputError(file, "pixels", "the WebP is damaged or cut short");
  const WebPIterator& frame = first.frame;
  if (!is_inside(frame, width, height))
    throw InputError(file, "pixels", "the first picture of the WebP lies outside its canvas");
  ImageRgba8 image(width, height, Rgba8{0, 0, 0, 0});
  const std::size_t before =
      static_cast<std::size_t>(frame.y_offset) * static_cast<std::size_t>(width) +
      static_cast<std::size_t>(frame.x_offset);
  const std::size_t n_bytes = (image.pixels.size() - before) * sizeof(Rgba8);
  if (WebPDecodeRGBAInto(frame.fragment.bytes, frame.fragment.size, image.pixels[before].data(),
                         n_bytes, width * static_cast<int>(sizeof(Rgba8))) == nullptr)
    throw InputError(file, "pixels", "the WebP's pixels cannot be decoded");
  return image;
}

}  // namespace viewcell
