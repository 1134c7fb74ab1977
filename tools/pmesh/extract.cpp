#include <cstdio>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/version.h"
#include "common/stopwatch.h"
#include "formats/mesh_file.h"
#include "mesh/used_vertices.h"
#include "pm/pm_file.h"
#include "pmesh/commands.h"

namespace viewcell {
namespace {

void write_level(const Tool& tool, const TriMesh& mesh) {
  const std::string& file = tool.common().output;
  Remarks remarks;
  write_mesh(file, written_format(file, MeshFormat::ply), mesh,
             {std::string("made by pmesh ") + version()}, &remarks);
  tool.remark(file, remarks);
}

// mesh: at the input.
void choose_level(const PmeshArguments& a, ProgressiveMesh& mesh) {
  if (!a.within)
    mesh.set_faces(*a.n_faces);
  else if (!mesh.set_error(
               parse_length(*a.within).of(glm::length(surface_box(mesh.extract()).size()))))
    throw InputError(a.pm, "", "has no error bounds; pmesh build --track-error keeps them");
}

// Of the finest mesh's materials those of which no face is left.
std::size_t count_lost_materials(const std::set<std::int32_t>& finest, const TriMesh& level) {
  const std::set<std::int32_t> left(level.materials.begin(), level.materials.end());
  return finest.size() - left.size();
}

}  // namespace

int extract(const Tool& tool, const PmeshArguments& a) {
  ProgressiveRecord record = read_pm(a.pm);
  const std::set<std::int32_t> materials(record.attributes.materials.begin(),
                                         record.attributes.materials.end());
  ProgressiveMesh mesh(std::move(record));
  // From the finest level on, as a program that draws goes.
  mesh.set_level(mesh.n_splits());
  Stopwatch watch;
  choose_level(a, mesh);
  const double level_s = watch.lap_s();
  const TriMesh out = mesh.extract();
  write_level(tool, out);
  const bool is_short = a.n_faces && out.triangles.size() > *a.n_faces;
  if (!is_short) tool.say(std::to_string(out.triangles.size()) + " faces");
  Remarks remarks;
  add_remark(&remarks, "pieces have vanished whole at this level", mesh.n_vanished());
  add_remark(&remarks, "materials have no face left at this level",
             count_lost_materials(materials, out));
  tool.remark(a.pm, remarks);
  tool.report({{"faces", out.triangles.size()},
               {"vertices", out.positions.size()},
               {"cost", mesh.cost()},
               {"pieces_vanished", mesh.n_vanished()},
               {"error_bound", mesh.error() < 0 ? Json() : Json(mesh.error())},
               {"timing", {{"level_s", level_s}}}});
  if (!is_short) return 0;
  std::fprintf(stderr, "pmesh: %s: %zu faces were asked for, its base has %zu\n", a.pm.c_str(),
               *a.n_faces, mesh.n_base_faces());
  return kOverThreshold;
}

}  // namespace viewcell
