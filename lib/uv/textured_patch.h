// A patch with texture coordinates, and what is measured of it: cut, parameterised, distorted.
#pragma once

#include <optional>
#include <string>

#include "mesh/topology.h"
#include "uv/distort.h"
#include "uv/parameterize.h"
#include "uv/patch.h"
#include "uv/uv_stretch.h"

namespace viewcell {

enum class UvDistort {
  none,
  swirl,    ///< distort.h
  stretch,  ///< distort.h
  uniform,  ///< equal weights instead of mean values
};

struct TexturedPatchOptions {
  std::size_t n_faces = kAllFaces;      ///< kAllFaces: the component, which must be a disk
  std::optional<std::uint32_t> around;  ///< a vertex; none: find_top_vertex along `up`
  glm::dvec3 up{0, 0, 1};
  UvBoundary boundary = UvBoundary::circle;
  UvDistort distort = UvDistort::none;
  std::optional<double> strength;  ///< of swirl (none: 1 turn) or stretch (none: 3)
  std::optional<int> relax_steps;  ///< parameterize.h; none: 20, but 0 for uniform
};

struct TexturedPatch {
  Patch patch;                 ///< its mesh has texture coordinates
  std::uint32_t around = 0;    ///< vertex of the input
  int relax_steps = 0;         ///< done at most
  double strength_asked = 0;   ///< of swirl and stretch
  double strength = 0;         ///< used: that, or less (distort_uv)
  std::size_t n_boundary = 0;  ///< vertices of the boundary, and edges
  MeshTopology topology;       ///< a disk: Euler number 1
  UvStretch stretch;           ///< n_flipped is 0
};

/// Throws InputError(file) when `around` is no corner of a triangle, when the disk cannot get
/// n_faces triangles, and when a triangle has no positive area in texture space in single precision
/// (protrusions shrink exponentially with their length).
TexturedPatch make_textured_patch(const TriMesh& mesh, const TexturedPatchOptions& options,
                                  const std::string& file);

}  // namespace viewcell
