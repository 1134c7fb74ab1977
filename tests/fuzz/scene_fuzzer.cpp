// scene.json, beside a mesh.
#include "fuzz.h"
#include "scene/scene.h"
#include "small_bundle.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t n_bytes) {
  using namespace viewcell;
  static const Scene small = write_small_scene(fuzz_folder());  // for its mesh
  const ReadSceneOptions options{.n_threads = 1};
  const auto file = put_input("scene.json", view_of(data, n_bytes));
  Scene scene;
  if (!is_taken([&] { scene = read_scene(file, options); })) return 0;
  const Json json = format_scene(scene, Json::object());
  const Scene again = read_scene(put_input("scene.json", format_json(json)), options);
  hold(format_scene(again, Json::object()) == json, "what is written reads back");
  for (const SceneObject& object : scene.objects) {
    const Box box = world_box(scene, object);
    hold(box.lo.x <= box.hi.x && box.lo.y <= box.hi.y && box.lo.z <= box.hi.z, "boxes are boxes");
  }
  return 0;
}
