// uvpatch: a disk cut from a mesh, with texture coordinates, good or bad on purpose.
#include <filesystem>
#include <string>

#include "base/error.h"
#include "base/file.h"
#include "common/mesh_input.h"
#include "common/provenance.h"
#include "common/tool.h"
#include "formats/textured_obj.h"
#include "image/checker.h"
#include "image/header.h"
#include "image/io.h"
#include "report/table.h"
#include "uv/textured_patch.h"
#include "uvpatch/arguments.h"

namespace viewcell {
namespace {

namespace fs = std::filesystem;
void write_files(const Tool& tool, const UvpatchArguments& a, const std::string& mesh_hash,
                 const std::string& picture, const std::string& extension,
                 const TexturedPatch& patch) {
  const fs::path output = tool.common().output;
  Json inputs = {{"mesh", mesh_hash}};
  if (!picture.empty()) inputs["texture"] = hash_hex(picture);
  const Json options = {{"faces", a.faces},       {"around", patch.around},
                        {"distort", a.distort},   {"strength", patch.strength},
                        {"boundary", a.boundary}, {"relax", patch.relax_steps}};
  const std::vector<std::string> comments = {make_provenance(tool, options, inputs).dump()};
  if (output == "-") return write_obj(output, patch.patch.mesh, {comments, "", ""});
  const auto write_picture = [&](const fs::path& file) {
    if (!picture.empty()) return write_file(file, picture);
    write_png(file, make_checker(a.size_px, a.n_squares), PngAlpha::drop);
  };
  write_textured_obj(output, patch.patch.mesh, extension, write_picture, comments);
}

Json format_report(const TexturedPatch& patch) {
  return {{"faces", patch.patch.mesh.triangles.size()},
          {"vertices", patch.patch.mesh.positions.size()},
          {"boundary_vertices", patch.n_boundary},
          {"euler", patch.topology.euler_characteristic},
          {"component_faces", patch.patch.n_component_faces},
          {"around", patch.around},
          {"strength", patch.strength},
          {"stretch", {{"l2", patch.stretch.l2}, {"max", patch.stretch.max}}},
          {"flipped", patch.stretch.n_flipped}};
}

int run(Tool& tool, const UvpatchArguments& a) {
  std::string picture, extension = ".png";
  if (!a.texture.empty()) {
    picture = read_file(a.texture);
    const ReadImageOptions options{{a.max_pixels}, nullptr};
    decode_image_rgba8(picture, a.texture, options);  // throws when it is no picture
    extension = extension_of(check_image_header(picture, a.texture, options.limits));
    register_beside(tool, extension);
  }
  std::string hash;
  const TexturedPatch patch =
      make_textured_patch(read_mesh_input(tool, a.mesh, &hash), a.patch, a.mesh);
  write_files(tool, a, hash, picture, extension, patch);
  tool.report(format_report(patch));
  if (patch.strength != patch.strength_asked)
    tool.say("strength lowered from " + format_fixed(patch.strength_asked, 3, "") + " to " +
             format_fixed(patch.strength, 3, "") + ": more turns triangles over");
  tool.say(std::to_string(patch.patch.mesh.triangles.size()) + " triangles, " +
           std::to_string(patch.n_boundary) + " boundary vertices, L2 stretch " +
           format_fixed(patch.stretch.l2, 3, ""));
  return 0;
}

}  // namespace
}  // namespace viewcell

int main(int argc, char** argv) {
  viewcell::Tool tool(
      "uvpatch",
      "Cuts a disk of so many triangles from a mesh and gives it texture coordinates by mean value "
      "coordinates [Floater03], a checker board, and distortions on purpose: test models for "
      "texture adaptation and for metrics of mapping.",
      "uvpatch bunny.ply --up y --faces 17483 -o head.obj\n"
      "  uvpatch bunny.ply --around 1203 --faces 7688 --distort swirl -o swirl.obj --json -");
  viewcell::UvpatchArguments arguments;
  viewcell::declare_arguments(tool, arguments);
  return tool.main(
      argc, argv, [&] { viewcell::finish_arguments(tool, arguments); },
      [&] { return viewcell::run(tool, arguments); });
}
