// The pictures of a scene's materials, decoded.
#pragma once

#include "image/header.h"
#include "scene/scene.h"

namespace viewcell {

/// Reads all pictures of a scene that read_scene gave, with their mips; the scene's own file says
/// where they lie. Throws InputError for one that is none, or is not the one that read_scene met.
void load_pictures(const std::filesystem::path& scene_file, Scene& scene,
                   const ImageLimits& limits = {}, int n_threads = 0);

}  // namespace viewcell
