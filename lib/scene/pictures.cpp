#include "scene/pictures.h"

#include "base/error.h"
#include "base/file.h"
#include "formats/texture_file.h"

namespace viewcell {

void load_pictures(const std::filesystem::path& scene_file, Scene& scene, const ImageLimits& limits,
                   int n_threads) {
  for (ScenePicture& picture : scene.pictures) {
    if (!picture.mips.empty()) continue;
    const auto file = resolve_inside(scene_file, "base_color_texture", picture.file);
    std::string hash;
    Remarks remarks;
    ImageRgba8 image = read_texture(file.string(), &hash, {.limits = limits, .remarks = &remarks});
    if (hash != picture.hash)
      throw InputError(file.string(), "", "picture changed while the scene was read");
    picture.mips = make_mips(std::move(image), picture.cutoff, n_threads);
    if (!remarks.empty()) scene.remarks.push_back({file, std::move(remarks)});
  }
}

}  // namespace viewcell
