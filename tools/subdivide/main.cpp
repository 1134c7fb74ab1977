// subdivide: a mesh with four triangles for each, and a smoother surface.
#include "mesh/subdivide.h"

#include <algorithm>
#include <string>

#include "base/error.h"
#include "common/mesh_input.h"
#include "common/provenance.h"
#include "common/tool.h"
#include "uv/texcoord_drift.h"
#include "uv/uv_stretch.h"

namespace viewcell {
namespace {

struct Arguments {
  std::string mesh;
  std::string scheme = "loop", texcoords = "inside";
  SubdivideOptions options;
};

const std::vector<std::string> kSchemes = {"loop", "midpoint"};              // SubdivisionScheme
const std::vector<std::string> kTexcoords = {"smooth", "inside", "linear"};  // TexcoordRule

void declare(Tool& tool, Arguments& a) {
  tool.add_option("MESH", &a.mesh, "OBJ, PLY (.gz), OFF, STL, GLB, glTF or 3DS")
      .required()
      .reads("the mesh that is read");
  tool.add_option("--times", &a.options.n_times, "how often; each makes four triangles of one")
      .required()
      .check(whole_within(0, 13));
  tool.add_option("--scheme", &a.scheme, "loop: smooth | midpoint: the same surface")
      .show_default()
      .check(one_of(kSchemes));
  tool.add_option("--texcoords", &a.texcoords,
                  "texture coordinates of loop: smooth, outlines of charts too | inside: smooth, "
                  "outlines stay | linear: on each triangle as before")
      .show_default()
      .check(one_of(kTexcoords));
  tool.add_mesh_limit(tool);
  tool.add_output("mesh to write: .obj, .ply, .stl, .off or .glb (-: an OBJ)");
}

int place_of(const std::string& name, const std::vector<std::string>& names) {
  return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
}

Json format_report(const Tool& tool, const Arguments& a, const TriMesh& mesh,
                   const Subdivision& out) {
  Json report = {{"faces_in", mesh.triangles.size()},
                 {"faces", out.mesh.triangles.size()},
                 {"vertices", out.mesh.positions.size()},
                 {"welded", out.n_welded},
                 {"dropped", out.n_dropped}};
  if (mesh.texcoords.empty()) return report;
  SubdivideOptions none = a.options;
  none.n_times = 0;
  const TriMesh before = subdivide(mesh, none, a.mesh).mesh;
  const TexcoordDrift drift = measure_texcoord_drift(before, out.mesh, tool.common().n_threads);
  report["flipped"] = {{"before", measure_uv_stretch(before).n_flipped},
                       {"after", measure_uv_stretch(out.mesh).n_flipped}};
  report["drift"] = {{"rms", drift.rms},
                     {"max", drift.max},
                     {"compared", drift.n_compared},
                     {"elsewhere", drift.n_elsewhere}};
  return report;
}

void finish_arguments(const Tool& tool, Arguments& a) {
  check_ending({"-o", tool.common().output}, kWrittenEndings, "a mesh");
  a.options.scheme = static_cast<SubdivisionScheme>(place_of(a.scheme, kSchemes));
  a.options.texcoords = static_cast<TexcoordRule>(place_of(a.texcoords, kTexcoords));
}

int run(const Tool& tool, const Arguments& a) {
  const std::string& output = tool.common().output;
  std::string hash;
  const TriMesh mesh = read_mesh_input(tool, a.mesh, &hash);
  const Subdivision out = subdivide(mesh, a.options, a.mesh);
  const Json options = {
      {"times", a.options.n_times}, {"scheme", a.scheme}, {"texcoords", a.texcoords}};
  const std::vector<std::string> comments = {
      make_provenance(tool, options, {{"mesh", hash}}).dump()};
  Remarks remarks;
  write_mesh(output, written_format(output, MeshFormat::obj), out.mesh, comments, &remarks);
  tool.remark(output, remarks);
  if (!tool.common().json_file.empty()) tool.report(format_report(tool, a, mesh, out));
  tool.say(std::to_string(out.mesh.triangles.size()) + " triangles, " +
           std::to_string(out.mesh.positions.size()) + " vertices");
  return 0;
}

}  // namespace
}  // namespace viewcell

int main(int argc, char** argv) {
  viewcell::Tool tool(
      "subdivide",
      "Makes four triangles of each, as often as asked, on a smoother surface [Loop "
      "1987] or on the same; texture coordinates go with it.",
      "subdivide spot.obj --times 2 -o spot-fine.obj");
  viewcell::Arguments arguments;
  viewcell::declare(tool, arguments);
  return tool.main(
      argc, argv, [&] { viewcell::finish_arguments(tool, arguments); },
      [&] { return viewcell::run(tool, arguments); });
}
