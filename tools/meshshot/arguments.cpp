#include "meshshot/arguments.h"

#include <filesystem>

#include "base/error.h"
#include "common/picture_input.h"
#include "gl/context.h"

namespace viewcell {
namespace {

namespace fs = std::filesystem;

void declare_surface(Command& command, MeshshotArguments& o) {
  command.add_option("MESH", &o.mesh_file, "OBJ, PLY (.gz), OFF, STL, GLB, glTF or 3DS")
      .required()
      .reads("the mesh that is read");
  command
      .add_option(
          "--texture", &o.texture,
          "picture for the mesh's texture coordinates, repeated, filtered with mipmaps: a file, a "
          "GLB's base colour, or model.glb#normal (also #emissive, #occlusion, "
          "#metallicRoughness), or an OBJ's map_Kd; of several materials each shows its own; "
          "textures that MESH names or holds are not read unless they are "
          "given here")
      .reads("the texture that is read", texture_file);
  command
      .add_option("--normal-map", &o.normal_map,
                  "tangent-space normal map for the same coordinates, a file or model.glb#normal "
                  "(of a model "
                  "alone its #normal): lights relief")
      .reads("the normal map that is read", texture_file);
  command
      .add_option("--normal-map-y", &o.normal_map_y,
                  "where its green points: up (OpenGL, glTF) | down (Direct3D)")
      .show_default()
      .needs("--normal-map")
      .check(one_of({"up", "down"}));
  command
      .add_option("--index-map", &o.map_file,
                  "indexing map (.exr, .tif) that the mesh's texture coordinates look up; what it "
                  "holds looks up --texture and --normal-map")
      .reads("the indexing map that is read");
  command.add_flag("--flip-v", &o.style.flip_v,
                   "v = 0 is the texture's top row: for files whose coordinates run that way");
  declare_max_pixels(command, &o.max_pixels);
}

void declare_pictures(Command& command, MeshshotArguments& o) {
  command.add_option("--views", &o.shots.n_views, "number of views, spread evenly over the sphere")
      .show_default()
      .check(in_range(std::size_t{1}, kMostViews));
  command.add_option("--size", &o.style.size_px, "side of a picture, px")
      .show_default()
      .check(in_range(16, kMostSamplesPerSide));
  command.add_option("--samples", &o.style.samples, "samples per pixel along each side")
      .show_default()
      .check(in_range(1, 8));
}

void declare_frame(Command& command, MeshshotArguments& o) {
  command
      .add_option("--like", &o.like_file,
                  "take the frame (box and up axis) from this mesh: pictures of a simplified "
                  "mesh, to be compared, want --like ORIGINAL")
      .reads("the mesh of --like");
  command
      .add_option("--box", &o.box, "x0,y0,z0:x1,y1,z1, the frame's box in the mesh's coordinates")
      .excludes("--like");
  command
      .add_option("--up", &o.up,
                  "axis that points up: x | y | z | -x | -y | -z | auto (y for OBJ, GLB and glTF, "
                  "else z; with "
                  "--like, by that file)")
      .show_default()
      .check(one_of({"x", "y", "z", "-x", "-y", "-z", "auto"}));
}

void declare_look(Command& command, MeshshotArguments& o) {
  command.add_flag("--unlit", &o.unlit, "the surface's colour as it is").excludes("--normal-map");
  command.add_flag("--fixed-light", &o.fixed_light,
                   "the light stays with the mesh and does not turn with the view");
  command
      .add_option(
          "--normals", &o.normals,
          "mesh (computed where it has none) | computed (by angle; for both, where only one of two "
          "meshes to compare has its own) | flat (of triangles)")
      .show_default();
  command.add_flag("--wireframe", &o.style.wireframe, "draw edges over the surface");
}

void declare_outputs(Tool& tool, MeshshotArguments& o) {
  tool.add_option("--sheet", &o.sheet,
                  "the contact sheet's file (default: DIR.sheet.png, beside the folder)");
  tool.add_flag("--no-sheet", &o.no_sheet, "write no contact sheet").excludes("--sheet");
  tool.add_option("--gl", &o.gl, "osmesa | egl").show_default();
  tool.add_mesh_limit(tool);
  tool.add_output_folder("folder DIR of pictures to write, view-00.png and on", {"view-*.png"});
}

}  // namespace

void declare_arguments(Tool& tool, MeshshotArguments& o) {
  declare_surface(tool, o);
  declare_pictures(tool, o);
  declare_frame(tool, o);
  declare_look(tool, o);
  declare_outputs(tool, o);
}

void finish_arguments(Tool& tool, MeshshotArguments& o) {
  if (o.style.size_px > kMostSamplesPerSide / o.style.samples)
    throw UsageError("--size times --samples is above " + std::to_string(kMostSamplesPerSide));
  if (!o.map_file.empty() && o.texture.empty() && o.normal_map.empty())
    throw UsageError("--index-map requires --texture or --normal-map");
  if (!o.box.empty()) parse_box(o.box);
  if (o.normal_map.ends_with(".glb") || o.normal_map.ends_with(".gltf")) o.normal_map += "#normal";
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
  tool.writes({{"--sheet", sheet}});
}

}  // namespace viewcell
