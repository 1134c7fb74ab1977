#include "uvpatch/arguments.h"

#include <algorithm>
#include <charconv>

#include "base/error.h"
#include "common/picture_input.h"

namespace viewcell {
namespace {

using Names = std::vector<std::string>;

const Names kUp = {"x", "y", "z", "-x", "-y", "-z"};
const Names kDistort = {"none", "swirl", "stretch", "uniform"};  // UvDistort's order
const Names kBoundary = {"circle", "square"};                    // UvBoundary's

int place_of(const std::string& name, const Names& names) {
  return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
}

std::size_t parse_faces(const std::string& text) {
  if (text == "all") return kAllFaces;
  std::size_t n = 0;
  const char* end = text.data() + text.size();
  if (std::from_chars(text.data(), end, n) != std::from_chars_result{end, std::errc()} || n == 0 ||
      n == kAllFaces)
    throw UsageError("--faces is neither a number from 1 nor 'all'");
  return n;
}

}  // namespace

void declare_arguments(Tool& tool, UvpatchArguments& a) {
  const auto choice = [&](const char* flag, std::string& value, const Names& names,
                          const char* what) {
    tool.add_option(flag, &value, what).show_default().check(one_of(names));
  };
  const auto number = [&](const char* flag, int& value, int most, const char* what) {
    tool.add_option(flag, &value, what).show_default().check(in_range(2, most));
  };
  tool.add_option("MESH", &a.mesh, "PLY, OBJ, OFF, STL, GLB or 3DS")
      .required()
      .reads("the mesh that is read");
  tool.add_option("--faces", &a.faces, "how many triangles; all: of a component that is a disk")
      .required();
  tool.add_option("--around", &a.patch.around, "vertex of the file, from 0, to grow around");
  choice("--up", a.up, kUp, "without --around: the first vertex farthest along this axis");
  choice("--distort", a.distort, kDistort,
         "swirl: turned about the middle; stretch: u runs exponentially; uniform: Tutte's weights "
         "instead of mean values");
  tool.add_option("--strength", &a.patch.strength,
                  "turns of swirl (1) or exponent of stretch (3); less is used where triangles "
                  "would turn over")
      .check(within(-20, 20));
  choice("--boundary", a.boundary, kBoundary, "what the boundary becomes");
  tool.add_option("--relax", &a.patch.relax_steps,
                  "at most so many steps against stretch (20; uniform: 0)")
      .check(in_range(0, 1000));
  tool.add_option("--texture", &a.texture, "picture to copy instead of a checker board")
      .reads("the texture that is read");
  declare_max_pixels(tool, &a.max_pixels);
  number("--texture-size", a.size_px, kMaxImageSidePx, "pixels a side of the checker board");
  number("--squares", a.n_squares, kMaxImageSidePx, "squares a side of the checker board");
  tool.add_mesh_limit(tool);
  tool.add_output("OBJ to write, MTL and picture beside it (-: the OBJ alone)");
}

void register_beside(Tool& tool, const std::string& extension) {
  std::filesystem::path output = tool.common().output;
  if (output != "-")
    tool.writes(
        {{"the " + extension + " beside -o", output.replace_extension(extension).string()}});
}

void finish_arguments(Tool& tool, UvpatchArguments& a) {
  a.patch.n_faces = parse_faces(a.faces);
  const int up = place_of(a.up, kUp);
  a.patch.up = glm::dvec3(0);
  a.patch.up[up % 3] = up < 3 ? 1 : -1;
  a.patch.distort = static_cast<UvDistort>(place_of(a.distort, kDistort));
  a.patch.boundary = static_cast<UvBoundary>(place_of(a.boundary, kBoundary));
  if (a.patch.strength && a.distort != "swirl" && a.distort != "stretch")
    throw UsageError("--strength is for --distort swirl and stretch");
  if (a.n_squares > a.size_px) throw UsageError("--squares is more than --texture-size");
  check_ending({"-o", tool.common().output}, {".obj"}, "an OBJ");
  register_beside(tool, ".mtl");
  if (a.texture.empty()) register_beside(tool, ".png");
}

}  // namespace viewcell
