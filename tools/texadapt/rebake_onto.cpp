#include "adapt/rebake.h"
#include "base/error.h"
#include "common/mesh_input.h"
#include "common/stopwatch.h"
#include "mesh/closest_point.h"
#include "mesh/offset.h"
#include "mesh/used_vertices.h"
#include "texadapt/level_writer.h"
#include "texadapt/levels.h"
#include "uv/triangle_atlas.h"

namespace viewcell {
namespace {

constexpr double kFar = 0.1;  // of the diagonal of the finest mesh's box

// What is shown is what is nearest.
void check_place(const TexadaptArguments& a, const Box& onto, const Box& finest) {
  const double slack = kFar * glm::length(finest.size());
  for (int k = 0; k < 3; ++k)
    if (onto.lo[k] > finest.hi[k] + slack || onto.hi[k] < finest.lo[k] - slack)
      throw InputError(a.onto, "", "lies elsewhere than " + a.pm + ": their boxes do not meet");
}

// Where much of the mesh is far from all that it shows: another scale, or other axes.
void remark_far_vertices(const Tool& tool, const TexadaptArguments& a, const TriMesh& onto,
                         const TriMesh& finest) {
  const Box box = surface_box(finest);
  const double far = kFar * glm::length(box.hi - box.lo);
  Box domain = surface_box(onto);
  domain.add(box.lo), domain.add(box.hi);
  const ClosestPointFinder finder(finest, domain, tool.common().n_threads);
  std::size_t n_far = 0;
  const std::size_t n_vertices = onto.positions.size();
  for (const std::uint32_t v : find_used_vertices(onto.triangles, n_vertices).source)
    n_far += finder.find(glm::dvec3(onto.positions[v])).distance > far;
  Remarks remarks;
  add_remark(&remarks,
             "vertices farther than a tenth of the box's diagonal from " + a.pm +
                 ": they show what is nearest (is it of the same scale and axes?)",
             n_far);
  tool.remark(a.onto, remarks);
}

// With texture coordinates; its materials are not those of the picture.
TriMesh read_target(const Tool& tool, const TexadaptArguments& a, const TexadaptInputs& in) {
  TriMesh mesh = read_mesh_input(tool, a.onto);
  mesh.materials.clear(), mesh.material_names.clear();
  change_offset(mesh, in.finest.offset);
  check_place(a, surface_box(mesh), surface_box(in.finest));
  const AdaptLevelsOptions o = options_of(a, in.shown.pictures[0]);
  if (!mesh.texcoords.empty()) {
    const ChartFindings findings = check_charts(mesh, o.width_px, o.height_px);
    check_obstacle(a.onto, "", findings, a.allows_overlap);
    // A chart that folds over itself is as good as the picture of a mesh that has it; of another's
    // a texel can show one of the two places.
    if (!findings.overlaps.empty() && !a.allows_overlap)
      throw InputError(a.onto, "",
                       "a chart lies over itself, the first at triangle " +
                           std::to_string(findings.overlaps.front().first) + ", on " +
                           std::to_string(findings.n_shared) +
                           " texels in all, which show two places (--allow-overlap goes on all "
                           "the same)");
    return mesh;
  }
  if (a.format != LevelFormat::glb && a.mesh.empty())
    throw UsageError(a.onto + " gets texture coordinates, which a .glb or --mesh holds");
  mesh.texcoords = make_triangle_atlas(mesh, o.width_px, o.height_px, a.onto);
  return mesh;
}

}  // namespace

Json rebake_onto(const Tool& tool, const TexadaptArguments& a, const TexadaptInputs& in) {
  const TriMesh mesh = read_target(tool, a, in);
  remark_far_vertices(tool, a, mesh, in.finest);
  Stopwatch watch;
  LevelWriter(tool, a, in).write(0, mesh, nullptr, nullptr, [&](const ImageRgba8& texture) {
    return rebake_texture(mesh, in.finest, texture,
                          {.width_px = a.options.width_px,
                           .height_px = a.options.height_px,
                           .n_threads = tool.common().n_threads,
                           .progress = tool.progress("rows")});
  });
  const std::size_t n = mesh.triangles.size();
  return {{"faces", n}, {"levels", {{{"faces", n}}}}, {"timing", {{"bake_s", watch.lap_s()}}}};
}

}  // namespace viewcell
