// uvpatch: a disk cut from a mesh, with texture coordinates, good or bad on purpose.
#include <charconv>
#include <filesystem>
#include <optional>
#include <string>

#include "base/error.h"
#include "base/file.h"
#include "base/table.h"
#include "common/provenance.h"
#include "common/tool.h"
#include "image/checker.h"
#include "image/header.h"
#include "image/io.h"
#include "mesh/io.h"
#include "mesh/textured_obj.h"
#include "mesh/textured_patch.h"

namespace viewcell {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::string mesh, faces, distort = "none", up = "z", boundary = "circle", texture, sources;
  std::optional<std::uint32_t> around;
  std::optional<double> strength;
  TexturedPatchOptions patch;
  int size_px = 1024, n_squares = 16;
};

void declare(Tool& tool, Arguments& a) {
  CLI::App& app = tool.app();
  app.add_option("MESH", a.mesh, "PLY, OBJ, OFF, STL, GLB or 3DS")->required();
  app.add_option("--faces", a.faces, "how many triangles, or 'all', of a mesh that is a disk")
      ->required();
  app.add_option("--around", a.around, "vertex of the file, from 0, that the patch grows around");
  app.add_option("--up", a.up, "without --around: the first vertex farthest along this axis")
      ->capture_default_str()
      ->check(CLI::IsMember({"x", "y", "z", "-x", "-y", "-z"}));
  app.add_option("--distort", a.distort,
                 "swirl: turned about the middle; stretch: u runs exponentially; uniform: Tutte's "
                 "weights instead of mean values")
      ->capture_default_str()
      ->check(CLI::IsMember({"none", "swirl", "stretch", "uniform"}));
  app.add_option("--strength", a.strength,
                 "most turns of swirl (1), exponent of stretch (3); less where triangles would "
                 "turn over")
      ->check(within(-20, 20));
  app.add_option("--boundary", a.boundary, "what the boundary becomes")
      ->capture_default_str()
      ->check(CLI::IsMember({"circle", "square"}));
  app.add_option("--relax", a.patch.parameterize.relax_steps,
                 "at most so many steps against stretch [Yoshizawa 2004]")
      ->capture_default_str()
      ->check(CLI::Range(0, 1000));
  app.add_option("--texture", a.texture, "a picture to copy, instead of a checker board");
  app.add_option("--texture-size", a.size_px, "pixels a side of the checker board")
      ->capture_default_str()
      ->check(CLI::Range(2, kMaxImageSidePx));
  app.add_option("--squares", a.n_squares, "squares a side of the checker board")
      ->capture_default_str()
      ->check(CLI::Range(2, kMaxImageSidePx));
  app.add_option("--sources", a.sources,
                 "write the file's vertex number of each vertex of the patch, one a line");
  tool.add_output("OBJ to write; MTL and picture come beside it (-: the OBJ alone)");
}

std::size_t parse_faces(const std::string& text) {
  if (text == "all") return kAllFaces;
  std::size_t n = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
  if (error != std::errc() || end != text.data() + text.size() || n == 0 || n == kAllFaces)
    throw UsageError("--faces is neither a number from 1 nor 'all': '" + text + "'");
  return n;
}

TexturedPatchOptions make_options(const Arguments& a) {
  TexturedPatchOptions out = a.patch;
  out.n_faces = parse_faces(a.faces);
  out.around = a.around;
  out.up = glm::dvec3(0);
  out.up[a.up.back() - 'x'] = a.up.size() == 1 ? 1 : -1;
  if (a.boundary == "square") out.parameterize.boundary = UvBoundary::square;
  if (a.distort == "uniform") out.parameterize.weights = UvWeights::uniform;
  if (a.distort == "swirl") out.distortion = UvDistortion::swirl;
  if (a.distort == "stretch") out.distortion = UvDistortion::stretch;
  if (a.strength && !out.distortion) throw UsageError("--strength is for swirl and stretch");
  out.strength = a.strength.value_or(a.distort == "stretch" ? 3 : 1);
  return out;
}

void check_output(const Arguments& a, const fs::path& output) {
  if (output == "-") return;
  if (output.extension() != ".obj") throw UsageError("-o does not end in .obj");
  std::error_code ignored;  // it need not exist
  if (fs::equivalent(a.mesh, output, ignored)) throw UsageError("-o is the mesh that is read");
  if (a.n_squares > a.size_px) throw UsageError("--squares is more than --texture-size");
}

std::string extension_of(ImageFormat format) {
  switch (format) {
    case ImageFormat::jpeg:
      return ".jpg";
    case ImageFormat::openexr:
      return ".exr";
    case ImageFormat::tiff:
      return ".tif";
    default:
      return std::string(".") + name_of(format);
  }
}

void write_patch(const Tool& tool, const Arguments& a, const TexturedPatch& patch, Json options) {
  const fs::path output = tool.common().output;
  Json inputs = {{"mesh", hash_file(a.mesh)}};
  if (!a.texture.empty()) inputs["texture"] = hash_file(a.texture);
  const std::vector<std::string> comments = {make_provenance(tool, options, inputs).dump()};
  if (output == "-") return write_obj(output, patch.patch.mesh, {comments, "", ""});
  if (a.texture.empty())
    return write_textured_obj(
        output, patch.patch.mesh, ".png",
        [&](const fs::path& file) {
          write_png(file, make_checker(a.size_px, a.n_squares), PngAlpha::drop);
        },
        comments);
  const std::string bytes = read_file(a.texture);
  write_textured_obj(
      output, patch.patch.mesh, extension_of(check_image_header(bytes, a.texture)),
      [&](const fs::path& file) { write_file(file, bytes); }, comments);
}

std::string format_sources(const Patch& patch) {
  std::string out;
  for (const std::uint32_t v : patch.source_vertex) out += std::to_string(v) + "\n";
  return out;
}

int run(const Tool& tool, const Arguments& a) {
  const TexturedPatchOptions options = make_options(a);
  check_output(a, tool.common().output);
  if (!a.texture.empty()) read_image_rgba8(a.texture);  // throws when it is no picture
  const TexturedPatch patch = make_textured_patch(read_mesh(a.mesh), options, a.mesh);
  const TriMesh& mesh = patch.patch.mesh;
  if (!a.sources.empty()) write_file(a.sources, format_sources(patch.patch));
  write_patch(tool, a, patch,
              {{"faces", a.faces},
               {"around", patch.around},
               {"distort", a.distort},
               {"strength", patch.strength},
               {"boundary", a.boundary},
               {"relax", options.parameterize.relax_steps}});
  tool.report({{"faces", mesh.triangles.size()},
               {"vertices", mesh.positions.size()},
               {"boundary_vertices", patch.n_boundary},
               {"euler", patch.topology.euler_characteristic},
               {"component_faces", patch.patch.n_component_faces},
               {"around", patch.around},
               {"strength", patch.strength},
               {"stretch", {{"l2", patch.stretch.l2}, {"max", patch.stretch.max}}},
               {"flipped", patch.stretch.n_flipped}});
  if (options.distortion && patch.strength != options.strength)
    tool.say("strength lowered from " + format_fixed(options.strength, 3, "") + " to " +
             format_fixed(patch.strength, 3, "") + ", beyond which triangles turn over");
  tool.say(std::to_string(mesh.triangles.size()) + " triangles, " +
           std::to_string(mesh.positions.size()) + " vertices, " +
           std::to_string(patch.n_boundary) + " of them on the boundary; L2 stretch " +
           format_fixed(patch.stretch.l2, 3, ""));
  return 0;
}

}  // namespace
}  // namespace viewcell

int main(int argc, char** argv) {
  viewcell::Tool tool(
      "uvpatch",
      "Cuts a disk of so many triangles from a mesh and gives it texture coordinates by mean value "
      "coordinates [Floater 2003], a checker board, and distortions on purpose: test models for "
      "texture adaptation and for metrics of mapping.",
      "uvpatch bunny.ply --up y --faces 17483 -o head.obj\n"
      "  uvpatch bunny.ply --around 1203 --faces 7688 --distort swirl -o swirl.obj --json -");
  viewcell::Arguments arguments;
  viewcell::declare(tool, arguments);
  return tool.main(argc, argv, [&] { return viewcell::run(tool, arguments); });
}
