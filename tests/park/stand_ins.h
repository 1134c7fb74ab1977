// Coarse statues of the table's sizes: quick to make, with the real ones' outlines.
#pragma once

#include <vector>

#include "park/figures.h"
#include "park/polygonise.h"
#include "park/statues.h"
#include "scene/scene.h"

namespace viewcell {

inline std::vector<SceneMesh> make_stand_ins() {
  Figure (*const figures[])() = {make_dragon_figure, make_hare_figure,  make_robed_figure,
                                 make_cattle_figure, make_horse_figure, make_moai_figure,
                                 make_camel_figure,  make_bust_figure};
  std::vector<SceneMesh> meshes(kStatueKinds);
  for (std::size_t k = 0; k < kStatueKinds; ++k) {
    const StatueKind& kind = statue_kinds()[k];
    meshes[k].name = kind.name;
    meshes[k].file = std::string("meshes/") + kind.name + ".ply";
    meshes[k].mesh = polygonise(figures[k](), {.cell = glm::length(kind.size) / 40});
    fit_to_size(meshes[k].mesh, kind.size);
    meshes[k].n_triangles = kind.n_triangles;
  }
  return meshes;
}

}  // namespace viewcell
