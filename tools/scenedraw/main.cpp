// scenedraw: a picture of a scene, before anything is baked.
#include <algorithm>
#include <optional>

#include "cells/cells.h"
#include "common/mesh_input.h"
#include "common/picture_input.h"
#include "common/scene_inputs.h"
#include "common/tool.h"
#include "draw/scene_picture.h"
#include "draw/scene_renderer.h"
#include "gl/context.h"
#include "image/io.h"
#include "scene/pictures.h"
#include "scenedraw/arguments.h"

namespace viewcell {
namespace {

constexpr Rgba8 kCellColor{255, 255, 255, 150}, kTestedColor{255, 210, 60, 230};
constexpr Rgba8 kPathColor{230, 40, 30, 255};

Box box_of(const Scene& scene) {
  Box box;
  for (const SceneObject& object : scene.objects) {
    const Box own = world_box(scene, object);
    box.add(own.lo), box.add(own.hi);
  }
  if (scene.objects.empty())
    for (const glm::dvec2& corner : {scene.area.lo, scene.area.hi})
      box.add({corner, scene.ground_z});
  return box;
}

glm::dmat4 choose_clip(const ScenedrawArguments& o, const Scene& scene,
                       const std::optional<CameraPath>& path) {
  const double aspect = static_cast<double>(o.width_px) / o.height_px;
  const double fov = o.fov_y_deg > 0 ? o.fov_y_deg : path ? path->fov_y_deg : kFovYDeg;
  if (o.from == "above") return clip_from_above(box_of(scene), aspect);
  if (o.from == "corner") return clip_from_world(look_from_corner(box_of(scene), fov, aspect));
  return clip_from_world(with_frame(choose_eye(o, path), fov, aspect));
}

void draw_cells(const ScenedrawArguments& o, const Scene& scene, const glm::dmat4& clip,
                ImageRgba8& image) {
  const CellSet cells = read_cells(o.cells_file);
  check_cells_of_scene(cells, scene, o.cells_file);
  const auto outline = [&](int i, const Rgba8& color, double width_px) {
    std::vector<glm::dvec3> corners;
    for (const glm::dvec2& p : corners_of(cells.grid, coord_of(cells.grid, CellId(i))))
      corners.emplace_back(p, scene.ground_z);
    draw_over(image, clip, corners, true, color, width_px);
  };
  for (int i = 0; i < cells.grid.n_cells(); ++i) outline(i, kCellColor, 1);
  for (int i = 0; i < cells.grid.n_cells(); ++i)
    if (!cells.is_tested.empty() && cells.is_tested[static_cast<std::size_t>(i)])
      outline(i, kTestedColor, 2);
}

int run(Tool& tool, ScenedrawArguments& o) {
  const int n_threads = tool.common().n_threads;
  Scene scene = read_scene(o.scene_file, {.n_threads = n_threads, .limits = mesh_limits(tool)});
  load_pictures(o.scene_file, scene, {o.max_pixels}, n_threads);
  register_scene_files(tool, scene, o.scene_file);
  std::optional<CameraPath> path;
  if (!o.path_file.empty()) {
    Remarks remarks;
    path = read_path(o.path_file, &remarks);
    tool.remark(o.path_file, remarks);
  }
  const glm::dmat4 clip = choose_clip(o, scene, path);
  const auto levels = build_scene_levels(scene, false, {}, n_threads);
  const FramePlan plan = plan_geometry(make_plan_scene(scene, levels));
  const GlContext context(parse_gl_engine(o.gl));
  const GlFramebuffer target(context.gl(), o.width_px, o.height_px);
  const SceneRenderer renderer(context.gl(), scene, levels);
  renderer.draw_background(target, clip);
  renderer.draw_objects(clip, plan.draws);
  ImageRgba8 image = target.read_rgba8();
  if (!o.cells_file.empty()) draw_cells(o, scene, clip, image);
  if (path && o.from != "eye") {
    std::vector<glm::dvec3> eyes;
    for (const PathSample& sample : path->samples) eyes.push_back(sample.eye);
    draw_over(image, clip, eyes, false, kPathColor, 3);
  }
  for (Rgba8& pixel : image.pixels) pixel[3] = 255;
  write_png(tool.common().output, image, PngAlpha::drop);
  tool.report({{"triangles", plan.n_triangles},
               {"objects", scene.objects.size()},
               {"width_px", o.width_px},
               {"height_px", o.height_px},
               {"renderer", context.renderer()}});
  tool.say(std::to_string(plan.n_triangles) + " triangles of " +
           std::to_string(scene.objects.size()) + " objects");
  return 0;
}

}  // namespace
}  // namespace viewcell

int main(int argc, char** argv) {
  viewcell::Tool tool("scenedraw", "Draw a picture of a scene, before anything is baked.",
                      "scenedraw house/scene.json --cells house/cells.json --path house/path.json "
                      "-o house.png");
  viewcell::ScenedrawArguments options;
  viewcell::declare_arguments(tool, options);
  return tool.main(
      argc, argv, [&] { viewcell::finish_arguments(options); },
      [&] { return viewcell::run(tool, options); });
}
