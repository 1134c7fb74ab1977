// Capture files: EXR of many parts.
#include <cmath>

#include "fuzz.h"
#include "image/capture_file.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t n_bytes) {
  using namespace viewcell;
  const auto path = put_input("in.exr", view_of(data, n_bytes));
  is_taken([&] {
    CaptureFile file(path);
    for (std::size_t i = 0; i < file.parts().size(); ++i) {
      const CapturePart part = file.read_part(i);
      hold(part.rgba_half.size() == 4 * part.z.size(), "a depth a pixel");
      for (const float z : part.z) hold(std::isfinite(z), "depths are finite");
    }
  });
  return 0;
}
