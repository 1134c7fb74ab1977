#include "uv/textured_patch.h"

#include "base/error.h"

namespace viewcell {
namespace {

constexpr int kRelaxSteps = 20;  // they end by themselves before
constexpr double kSwirlTurns = 1, kStretchExponent = 3;

std::uint32_t choose_start(const TriMesh& mesh, const TexturedPatchOptions& options,
                           const std::string& file) {
  if (!options.around) {
    const std::optional<std::uint32_t> top = find_top_vertex(mesh, options.up);
    if (!top) throw InputError(file, "", "has no triangle of three positions");
    return *top;
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
                         "ask for fewer, for another vertex, or for a higher --relax");
}

ParameterizeOptions make_parameterize_options(const TexturedPatchOptions& options) {
  const bool is_uniform = options.distort == UvDistort::uniform;
  ParameterizeOptions out;
  out.weights = is_uniform ? UvWeights::uniform : UvWeights::mean_value;
  out.boundary = options.boundary;
  out.relax_steps = options.relax_steps.value_or(is_uniform ? 0 : kRelaxSteps);
  return out;
}

// Distorts, where it is asked for. Both strengths are 0 elsewhere.
void distort(const TexturedPatchOptions& options, const std::vector<glm::dvec2>& uv,
             TexturedPatch& out) {
  const bool is_swirl = options.distort == UvDistort::swirl;
  if (!is_swirl && options.distort != UvDistort::stretch) return;
  out.strength_asked = options.strength.value_or(is_swirl ? kSwirlTurns : kStretchExponent);
  const DistortedUv distorted =
      distort_uv(out.patch.mesh, uv, is_swirl ? UvDistortion::swirl : UvDistortion::stretch,
                 out.strength_asked);
  set_texcoords(out.patch.mesh, distorted.uv);
  out.strength = distorted.strength;
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
  const ParameterizeOptions parameterize = make_parameterize_options(options);
  out.relax_steps = parameterize.relax_steps;
  const std::vector<glm::dvec2> uv = parameterize_disk(disk, loop, parameterize);
  set_texcoords(disk, uv);
  check_flipped(measure_uv_stretch(disk), disk.triangles.size(), file, place);
  distort(options, uv, out);
  out.stretch = measure_uv_stretch(disk);
  check_flipped(out.stretch, disk.triangles.size(), file, place);
  return out;
}

}  // namespace viewcell
