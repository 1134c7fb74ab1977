// meshshot: pictures of a mesh from all sides.
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/table.h"
#include "common/files.h"
#include "common/provenance.h"
#include "common/stopwatch.h"
#include "common/tool.h"
#include "gl/context.h"
#include "image/index_map.h"
#include "mesh/io.h"
#include "mesh/texture_file.h"
#include "play/mesh_shots.h"

namespace viewcell {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string mesh_file, texture, normal_map, map_file, like_file, box;
  std::string mesh_hash, texture_hash, normal_map_hash, map_hash, like_hash;  // once they are read
  std::string normal_map_y = "up", up = "auto", normals = "mesh", gl = "osmesa", sheet;
  bool unlit = false, fixed_light = false, no_sheet = false;
  MeshStyle style;
  MeshShotOptions shots;
};

void declare(Tool& tool, Options& o) {
  CLI::App& app = tool.app();
  app.add_option("MESH", o.mesh_file, "OBJ, PLY (.gz), OFF, STL, GLB, glTF or 3DS")->required();
  app.add_option(
      "--texture", o.texture,
      "picture for the mesh's texture coordinates, repeated, filtered with mipmaps: a file, a "
      "GLB's "
      "base colour, or model.glb#normal (also #emissive, #occlusion, #metallicRoughness); textures "
      "that MESH names or holds are not read unless they are given here");
  CLI::Option* normal_map = app.add_option(
      "--normal-map", o.normal_map,
      "tangent-space normal map for the same coordinates, named as a texture is: lights relief");
  app.add_option("--normal-map-y", o.normal_map_y,
                 "where its green points: up (OpenGL, glTF) | down (Direct3D)")
      ->capture_default_str()
      ->needs(normal_map)
      ->check(CLI::IsMember({"up", "down"}));
  app.add_option(
      "--index-map", o.map_file,
      "indexing map (.exr, .tif) that the mesh's texture coordinates look up; what it holds looks "
      "up --texture and --normal-map");
  app.add_flag("--flip-v", o.style.flip_v,
               "v = 0 is the texture's top row: for files whose coordinates run that way");
  app.add_option("--views", o.shots.n_views, "number of views, spread evenly over the sphere")
      ->capture_default_str()
      ->check(CLI::Range(std::size_t{1}, kMostViews));
  app.add_option("--size", o.style.size_px, "side of a picture, px")
      ->capture_default_str()
      ->check(CLI::Range(16, kMostSamplesPerSide));
  app.add_option("--samples", o.style.samples, "samples per pixel along each side")
      ->capture_default_str()
      ->check(CLI::Range(1, 8));
  CLI::Option* like =
      app.add_option("--like", o.like_file,
                     "take the frame (box and up axis) from this mesh: pictures of a simplified "
                     "mesh, to be compared, want --like ORIGINAL");
  app.add_option("--box", o.box, "x0,y0,z0:x1,y1,z1, the frame's box in the mesh's coordinates")
      ->excludes(like);
  app.add_option("--up", o.up,
                 "axis that points up: x | y | z | auto (y for OBJ, GLB and glTF, else z; with "
                 "--like, by that file)")
      ->capture_default_str()
      ->check(CLI::IsMember({"x", "y", "z", "auto"}));
  app.add_flag("--unlit", o.unlit, "the surface's colour as it is")->excludes(normal_map);
  app.add_flag("--fixed-light", o.fixed_light,
               "the light stays with the mesh and does not turn with the view");
  app.add_option(
         "--normals", o.normals,
         "mesh (computed where it has none) | computed (by angle; for both, where only one of two "
         "meshes to compare has its own) | flat (of triangles)")
      ->capture_default_str();
  app.add_flag("--wireframe", o.style.wireframe, "draw edges over the surface");
  CLI::Option* sheet = app.add_option(
      "--sheet", o.sheet, "the contact sheet's file (default: DIR.sheet.png, beside the folder)");
  app.add_flag("--no-sheet", o.no_sheet, "write no contact sheet")->excludes(sheet);
  app.add_option("--gl", o.gl, "osmesa | egl")->capture_default_str();
  tool.add_output("folder DIR of pictures to write, view-00.png and on");
}

MeshFrame choose_frame(Options& o, const TriMesh& mesh) {
  const std::string& source = o.like_file.empty() ? o.mesh_file : o.like_file;
  const std::string up = o.up == "auto" ? up_axis_of(source) : o.up;
  if (!o.box.empty()) return make_frame(parse_box(o.box), up, "--box");
  if (o.like_file.empty()) return make_frame(box_of_triangles(mesh), up, source);
  return make_frame(box_of_triangles(read_mesh(o.like_file, &o.like_hash)), up, source);
}

struct Textures {
  std::optional<ImageRgba8> color, normal_map;
  std::optional<IndexMap> index_map;
};

template <typename T>
const T* address_of(const std::optional<T>& value) {
  return value ? &*value : nullptr;
}

Textures read_textures(Options& o, const TriMesh& mesh) {
  Textures textures;
  if (o.texture.empty() && o.normal_map.empty()) return textures;
  if (mesh.texcoords.empty())
    throw InputError(o.mesh_file, "",
                     std::string("has no texture coordinates, which --") +
                         (o.texture.empty() ? "normal-map" : "texture") + " needs");
  if (!o.texture.empty()) textures.color = read_texture(o.texture, &o.texture_hash);
  if (!o.normal_map.empty()) textures.normal_map = read_texture(o.normal_map, &o.normal_map_hash);
  if (!o.map_file.empty()) textures.index_map = read_index_map(o.map_file, &o.map_hash);
  return textures;
}

// What was typed is checked, and what stands in the folder, before anything is read.
void settle_options(const Tool& tool, Options& o) {
  if (o.style.size_px > kMostSamplesPerSide / o.style.samples)
    throw UsageError("--size times --samples is above " + std::to_string(kMostSamplesPerSide));
  if (tool.common().output == "-") throw UsageError("-o names a folder");
  if (!o.map_file.empty() && o.texture.empty() && o.normal_map.empty())
    throw UsageError("--index-map requires --texture or --normal-map");
  if (!o.box.empty()) parse_box(o.box);
  parse_gl_engine(o.gl);
  o.style.lit = !o.unlit;
  o.style.light_follows = !o.fixed_light;
  o.style.normals = parse_normal_source(o.normals);
  o.style.normal_map_y = o.normal_map_y == "up" ? NormalMapY::up : NormalMapY::down;
  o.shots.folder = tool.common().output;
  o.shots.n_threads = tool.common().n_threads;
  if (!o.no_sheet)
    o.shots.sheet = o.sheet.empty() ? sheet_beside(o.shots.folder) : fs::path(o.sheet);
  const std::string sheet = o.shots.sheet.string();
  check_ending({"--sheet", sheet}, {".png"}, "a PNG");
  check_files({{"the mesh that is read", o.mesh_file},
               {"the texture that is read", texture_file(o.texture).string()},
               {"the normal map that is read", texture_file(o.normal_map).string()},
               {"the indexing map that is read", o.map_file},
               {"the mesh of --like", o.like_file}},
              {{"--sheet", sheet}, {"--json", tool.common().json_file}});
  check_shot_folder(o.shots.folder, o.shots.n_views);
}

Json format_provenance(const Tool& tool, const Options& o) {
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

int run(const Tool& tool, Options& o) {
  Stopwatch watch;
  settle_options(tool, o);
  const TriMesh mesh = read_mesh(o.mesh_file, &o.mesh_hash);
  const MeshFrame frame = choose_frame(o, mesh);
  const Textures textures = read_textures(o, mesh);
  const double read_s = watch.lap_s();
  const GlContext context(parse_gl_engine(o.gl));
  const MeshRenderer renderer(context.gl(), mesh, frame, address_of(textures.color), o.style,
                              address_of(textures.index_map), address_of(textures.normal_map));
  const double upload_s = watch.lap_s();
  o.shots.title = fs::path(o.mesh_file).filename().string() + ", " +
                  std::to_string(mesh.triangles.size()) + " triangles";
  const std::vector<MeshShot> shots = write_mesh_shots(renderer, o.shots, tool.progress("views"));
  const double views_s = watch.lap_s();

  const double reach = measure_reach(mesh, frame);
  tool.report({{"made_by", format_provenance(tool, o)},
               {"triangles", mesh.triangles.size()},
               {"frame", format_frame(frame)},
               {"reach", reach},
               {"views", format_shots(shots, frame)},
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
  viewcell::Options options;
  viewcell::declare(tool, options);
  return tool.main(argc, argv, [&] { return viewcell::run(tool, options); });
}
