#include "mesh/textured_patch.h"

#include "base/error.h"

namespace viewcell {
namespace {

std::uint32_t choose_start(const TriMesh& mesh, const TexturedPatchOptions& options,
                           const std::string& file) {
  if (!options.around) {
    if (measure_topology(mesh).n_edges == 0)
      throw InputError(file, "", "has no triangle of three vertices");
    return find_top_vertex(mesh, options.up);
  }
  const std::uint32_t around = *options.around;
  if (around >= mesh.positions.size())
    throw InputError(file, "vertex " + std::to_string(around),
                     "does not exist; there are " + std::to_string(mesh.positions.size()));
  if (!is_patch_start(mesh, around))
    throw InputError(file, "vertex " + std::to_string(around),
                     "is no corner of a triangle with three positions");
  return around;
}

void check_size(const Patch& patch, std::size_t n_faces, const std::string& file,
                const std::string& place) {
  const std::size_t n = patch.mesh.triangles.size();
  const std::string reached = std::to_string(n) + " of the component's " +
                              std::to_string(patch.n_component_faces) + " triangles join a disk";
  if (n_faces == kAllFaces && n < patch.n_component_faces)
    throw InputError(file, place, "the component is no disk: " + reached);
  if (n_faces != kAllFaces && n < n_faces)
    throw InputError(file, place, std::to_string(n_faces) + " were asked for: " + reached);
}

void check_flipped(const UvStretch& stretch, std::size_t n_faces, const std::string& file,
                   const std::string& place) {
  if (stretch.n_flipped > 0)
    throw InputError(file, place,
                     std::to_string(stretch.n_flipped) + " of " + std::to_string(n_faces) +
                         " triangles have no positive area in texture space in single precision: "
                         "ask for fewer, for another vertex, or for --relax");
}

}  // namespace

TexturedPatch make_textured_patch(const TriMesh& mesh, const TexturedPatchOptions& options,
                                  const std::string& file) {
  TexturedPatch out;
  out.around = choose_start(mesh, options, file);
  const std::string place = "around vertex " + std::to_string(out.around);
  out.patch = cut_patch(mesh, out.around, options.n_faces);
  check_size(out.patch, options.n_faces, file, place);

  TriMesh& disk = out.patch.mesh;
  out.topology = measure_topology(disk);
  VIEWCELL_CHECK(out.topology.euler_characteristic == 1 && out.topology.n_components == 1,
                 out.topology.euler_characteristic, out.topology.n_components);
  const std::vector<std::uint32_t> loop = find_boundary_loop(disk);
  out.n_boundary = loop.size();
  std::vector<glm::dvec2> uv = parameterize_disk(disk, loop, options.parameterize);
  set_texcoords(disk, uv);
  check_flipped(measure_uv_stretch(disk), disk.triangles.size(), file, place);
  if (options.distortion) {
    DistortedUv distorted = distort_uv(disk, uv, *options.distortion, options.strength);
    set_texcoords(disk, distorted.uv);
    out.strength = distorted.strength;
  }
  out.stretch = measure_uv_stretch(disk);
  check_flipped(out.stretch, disk.triangles.size(), file, place);
  return out;
}

}  // namespace viewcell
