#include "image/library.h"

#include <OpenImageIO/imageio.h>

namespace viewcell {

void configure_openimageio() {
  static const bool once = [] {
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);  // 0 would mean all cores
    OIIO::attribute("debug", 0);
    return true;
  }();
  static_cast<void>(once);
}

std::string first_line(const std::string& text) {
  return text.empty() ? "no reason given" : text.substr(0, text.find('\n'));
}

}  // namespace viewcell
