// scenedraw: a picture of a scene, before anything is baked.
#include <algorithm>
#include <cstdio>
#include <optional>

#include "base/error.h"
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

namespace viewcell {
namespace {

struct Options {
  std::string scene_file, cells_file, path_file, from = "corner", eye, toward;
  std::string size = "1280x960", gl = "osmesa";
  double at_s = 0, fov_y_deg = 0;
  int width_px = 0, height_px = 0;
  std::optional<std::size_t> max_pixels;
};

constexpr Rgba8 kCellColor{255, 255, 255, 150}, kTestedColor{255, 210, 60, 230};
constexpr Rgba8 kPathColor{230, 40, 30, 255};

void declare(Tool& tool, Options& o) {
  tool.add_option("scene", &o.scene_file, "scene.json").required().reads("the scene that is read");
  tool.add_option("--from", &o.from,
                  "corner: all of it, from a corner; above: as a map; eye: as --eye or --path say")
      .show_default()
      .check(one_of({"corner", "above", "eye"}));
  tool.add_option("--eye", &o.eye, "X,Y,Z: where the eye is").excludes("--at");
  tool.add_option("--toward", &o.toward, "X,Y,Z: what it looks at").needs("--eye");
  tool.add_option("--path", &o.path_file, "path.json: drawn, or walked by the eye")
      .reads("the path that is read");
  tool.add_option("--at", &o.at_s, "seconds along --path at which the eye is")
      .needs("--path")
      .check(within(-1e9, 1e9));
  tool.add_option("--cells", &o.cells_file, "cells.json: their outlines are drawn")
      .reads("the file of cells that is read");
  tool.add_option("--size", &o.size, "WIDTHxHEIGHT in px").show_default();
  tool.add_option("--fov", &o.fov_y_deg,
                  "vertical field of view in degrees (default: the path's, or 60)")
      .check(within(kLeastFovYDeg, kMostFovYDeg));
  tool.add_option("--gl", &o.gl, "osmesa | egl").show_default();
  declare_max_pixels(tool, &o.max_pixels);
  tool.add_mesh_limit(tool);
  tool.add_output("picture to write, as PNG (-: stdout)");
}

void parse_size(Options& o) {
  char rest = 0;
  if (std::sscanf(o.size.c_str(), "%dx%d%c", &o.width_px, &o.height_px, &rest) != 2 ||
      std::min(o.width_px, o.height_px) < 16 || std::max(o.width_px, o.height_px) > 8192)
    throw UsageError("--size: '" + o.size + "' is not WIDTHxHEIGHT within 16 to 8192");
}

glm::dvec3 parse_place(const char* option, const std::string& text) {
  glm::dvec3 p(0);
  char rest = 0;
  if (std::sscanf(text.c_str(), "%lf,%lf,%lf%c", &p.x, &p.y, &p.z, &rest) != 3 ||
      !(glm::length(p) < 1e8))
    throw UsageError(std::string(option) + ": '" + text + "' is not X,Y,Z");
  return p;
}

// To a hundred thousandth of the path.
Camera camera_at(const CameraPath& path, double time_s) {
  const double last = path.samples.back().time_s, first = path.samples.front().time_s;
  const double share = last > first ? std::clamp((time_s - first) / (last - first), 0.0, 1.0) : 0;
  constexpr std::size_t kSteps = 100000;
  const auto step = static_cast<std::size_t>(std::lround(share * (kSteps - 1)));
  return sample_path(path, kSteps).at(step);
}

Camera choose_eye(const Options& o, const std::optional<CameraPath>& path) {
  if (o.eye.empty()) {
    if (!path) throw UsageError("--from eye: say --eye X,Y,Z and --toward X,Y,Z, or --path");
    return camera_at(*path, o.at_s);
  }
  if (o.toward.empty()) throw UsageError("--eye: say --toward X,Y,Z, too");
  Camera camera;
  camera.eye = parse_place("--eye", o.eye);
  const glm::dvec3 along = parse_place("--toward", o.toward) - camera.eye;
  if (!(glm::length(glm::dvec2(along)) > 1e-9 * glm::length(along)))
    throw UsageError("--toward: is straight above, below or at --eye");
  camera.forward = glm::normalize(along);
  return camera;
}

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

glm::dmat4 choose_clip(const Options& o, const Scene& scene,
                       const std::optional<CameraPath>& path) {
  const double aspect = static_cast<double>(o.width_px) / o.height_px;
  const double fov = o.fov_y_deg > 0 ? o.fov_y_deg : path ? path->fov_y_deg : kFovYDeg;
  if (o.from == "above") return clip_from_above(box_of(scene), aspect);
  if (o.from == "corner") return clip_from_world(look_from_corner(box_of(scene), fov, aspect));
  return clip_from_world(with_frame(choose_eye(o, path), fov, aspect));
}

void draw_cells(const Options& o, const Scene& scene, const glm::dmat4& clip, ImageRgba8& image) {
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

int run(Tool& tool, Options& o) {
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
  viewcell::Options options;
  viewcell::declare(tool, options);
  return tool.main(
      argc, argv, [&] { viewcell::parse_size(options); },
      [&] { return viewcell::run(tool, options); });
}
