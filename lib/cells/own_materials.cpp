#include "cells/own_materials.h"

#include <algorithm>
#include <cmath>

#include "cells/self_occluding.h"

namespace viewcell {
namespace {

struct Candidate {
  Box box;  // world
  double n_triangles = 0;
  bool has_detail = false;  // that captures may smear: a picture or colours
};

Candidate make_candidate(const Scene& scene, const SceneObject& object) {
  const SceneMesh& mesh = scene.mesh_of(object);
  Candidate out;
  out.box = world_box(scene, object);
  out.n_triangles = static_cast<double>(mesh.n_triangles);
  out.has_detail = std::any_of(object.materials.begin(), object.materials.end(), [&](int m) {
    const Material& material = scene.materials[static_cast<std::size_t>(m)];
    return !material.base_color_texture.empty() ||
           (material.has_vertex_colors && !mesh.mesh.colors.empty());
  });
  return out;
}

double distance_to(const Box& box, const glm::dvec3& p) {
  return glm::length(glm::max(glm::max(box.lo - p, p - box.hi), glm::dvec3(0)));
}

// Of the box' ball, as captured from the eye.
double captured_px(const Box& box, const glm::dvec3& eye, int resolution_px) {
  const double radius = 0.5 * glm::length(box.size());
  const double distance = std::max(glm::distance(box.centre(), eye), radius);
  const double focal_px = focal_of_face(resolution_px);
  return distance > 0 ? std::acos(-1.0) * std::pow(focal_px * radius / distance, 2) : 0;
}

bool is_own(const Candidate& object, const glm::dvec3& eye, double size,
            const OwnMaterialOptions& options) {
  if (object.has_detail && distance_to(object.box, eye) < 2 * size) return true;
  const double worth =
      captured_px(object.box, eye, options.resolution_px) /
      (object.has_detail ? options.px_per_detailed_triangle : options.px_per_triangle);
  return object.n_triangles <= std::max(worth, static_cast<double>(options.few_triangles));
}

}  // namespace

std::vector<std::vector<ObjectId>> find_own_materials(const Scene& scene, const CellSet& cells,
                                                      const OwnMaterialOptions& options) {
  std::vector<Candidate> candidates;
  for (const SceneObject& object : scene.objects)
    candidates.push_back(make_candidate(scene, object));
  std::vector<std::vector<ObjectId>> out;
  for (int i = 0; i < cells.grid.n_cells(); ++i) {
    const glm::dvec3 eye = eye_of(cells, CellId(i));
    std::vector<ObjectId>& own = out.emplace_back();
    for (std::size_t o = 0; o < candidates.size(); ++o)
      if (!is_inside(cells, CellId(i), ObjectId(o)) &&
          is_own(candidates[o], eye, cells.grid.size, options))
        own.push_back(ObjectId(o));
  }
  return out;
}

}  // namespace viewcell
