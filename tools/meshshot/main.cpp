// meshshot: pictures of a mesh from all sides.
#include <filesystem>
#include <optional>

#include "base/error.h"
#include "common/mesh_input.h"
#include "common/picture_input.h"
#include "common/provenance.h"
#include "common/stopwatch.h"
#include "gl/context.h"
#include "mesh/backs.h"
#include "meshshot/arguments.h"
#include "meshshot/textures.h"
#include "report/table.h"

namespace viewcell {
namespace {

namespace fs = std::filesystem;

Box moved(const Box& box, const glm::dvec3& by) {
  return {box.lo + by, box.hi + by};
}

// In the mesh's coordinates about its offset.
MeshFrame choose_frame(const Tool& tool, MeshshotArguments& o, const TriMesh& mesh) {
  const std::string& source = o.like_file.empty() ? o.mesh_file : o.like_file;
  const std::string up = o.up == "auto" ? up_axis_of(source) : o.up;
  if (!o.box.empty()) return make_frame(moved(parse_box(o.box), -mesh.offset), up, "--box");
  if (o.like_file.empty()) return make_frame(box_of_triangles(mesh), up, source);
  const TriMesh like = read_mesh_input(tool, o.like_file, &o.like_hash);
  return make_frame(moved(box_of_triangles(like), like.offset - mesh.offset), up, source);
}

template <typename T>
const T* address_of(const std::optional<T>& value) {
  return value ? &*value : nullptr;
}

Json format_provenance(const Tool& tool, const MeshshotArguments& o) {
  const auto hash = [](const std::string& digits) {
    return digits.empty() ? Json() : Json(digits);
  };
  return make_provenance(tool, format_style(o.style),
                         {{"mesh", o.mesh_hash},
                          {"texture", hash(o.texture_hash)},
                          {"normal_map", hash(o.normal_map_hash)},
                          {"index_map", hash(o.map_hash)},
                          {"like", hash(o.like_hash)}});
}

int run(const Tool& tool, MeshshotArguments& o) {
  Stopwatch watch;
  check_shot_folder(o.shots.folder, o.shots.n_views);
  TriMesh mesh = read_mesh_input(tool, o.mesh_file, &o.mesh_hash);
  Remarks recut;
  add_remark(&recut, kBacksRecut, cut_backs_alike(mesh));
  tool.remark(o.mesh_file, recut);
  const MeshFrame frame = choose_frame(tool, o, mesh);
  const ShotTextures textures = read_textures(tool, o, mesh);
  const double read_s = watch.lap_s();
  const GlContext context(parse_gl_engine(o.gl));
  const MeshRenderer renderer(context.gl(), mesh, frame, textures.textures(), o.style,
                              address_of(textures.index_map), address_of(textures.normal_map));
  const double upload_s = watch.lap_s();
  o.shots.title = fs::path(o.mesh_file).filename().string() + ", " +
                  std::to_string(mesh.triangles.size()) + " triangles";
  Remarks remarks;
  o.shots.remarks = &remarks;
  const std::vector<MeshShot> shots = write_mesh_shots(renderer, o.shots, tool.progress("views"));
  const double views_s = watch.lap_s();
  tool.remark(o.shots.sheet, remarks);

  const double reach = measure_reach(mesh, frame);
  MeshFrame in_file = frame;
  in_file.centre += mesh.offset;
  tool.report({{"made_by", format_provenance(tool, o)},
               {"triangles", mesh.triangles.size()},
               {"frame", format_frame(in_file)},
               {"reach", reach},
               {"views", format_shots(shots, in_file)},
               {"renderer", context.renderer()},
               {"timing", {{"read_s", read_s}, {"upload_s", upload_s}, {"views_s", views_s}}}});
  if (reach > kViewMargin)
    tool.say("warning: " + o.mesh_file + " reaches " + format_fixed(reach, 2, "-") +
             " radii from the frame's centre: pictures may cut it off");
  tool.say(std::to_string(shots.size()) + " views of " + o.shots.title);
  return 0;
}

}  // namespace
}  // namespace viewcell

int main(int argc, char** argv) {
  viewcell::Tool tool(
      "meshshot",
      "Draw a mesh from directions spread evenly over the sphere, with a texture or without. "
      "Views depend on the frame (a sphere around a box) and on --views alone: give a simplified "
      "mesh the original's frame by --like, and psnr compares the two folders picture by picture. "
      "Alpha is 0 where the mesh is not. Both sides of triangles are drawn.",
      "meshshot original.obj --texture skin.png --views 12 -o a\n"
      "  meshshot simple.ply --texture skin.png --views 12 --like original.obj -o b\n"
      "  psnr a b");
  viewcell::MeshshotArguments arguments;
  viewcell::declare_arguments(tool, arguments);
  return tool.main(
      argc, argv, [&] { viewcell::finish_arguments(tool, arguments); },
      [&] { return viewcell::run(tool, arguments); });
}
