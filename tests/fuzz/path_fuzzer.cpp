// path.json.
#include <cmath>

#include "fuzz.h"
#include "scene/camera.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t n_bytes) {
  using namespace viewcell;
  const auto file = put_input("path.json", view_of(data, n_bytes));
  CameraPath path;
  if (!is_taken([&] { path = read_path(file); })) return 0;
  constexpr std::size_t kFrames = 7;
  for (const Camera& camera : sample_path(path, kFrames))
    hold(std::abs(glm::length(camera.forward) - 1) < 1e-6, "directions are of unit length");
  const Json json = format_path(path, Json::object());
  const CameraPath again = read_path(put_input("path.json", format_json(json)));
  hold(again.samples.size() == path.samples.size(), "what is written reads back");
  return 0;
}
