// Builds progressive meshes: a metric, a placement, and where to stop.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include "base/parallel.h"
#include "pm/collapse_loop.h"
#include "pm/lindstrom_turk.h"
#include "pm/mapping_metric.h"
#include "pm/progressive_mesh.h"
#include "pm/qem.h"
#include "pm/texture_qem.h"

namespace viewcell {

enum class MetricKind { qem3, qem5, aps, mapping, lt };
enum class Placement { half, full };
/// Throw UsageError for another name.
MetricKind parse_metric(const std::string& name);
Placement parse_placement(const std::string& name);
const char* metric_name(MetricKind metric);
const char* placement_name(Placement placement);

struct BuildOptions {
  std::string name = "mesh";  ///< for errors: the file
  MetricKind metric = MetricKind::qem3;
  Placement placement = Placement::half;  ///< lt needs full
  /// Vertices of borders up to so far apart are one, mesh units (mesh/weld.h). Nothing:
  /// default_weld_tolerance(), and no triangle loses a corner by it.
  std::optional<double> weld_tolerance;
  std::size_t target_faces = 1;                             ///< stop at or below; at least 1
  float max_cost = std::numeric_limits<float>::infinity();  ///< of a collapse, the metric's unit
  /// Collapses after which the surface might be farther than this from the input, or the input from
  /// it, are refused; mesh units. What welding moved counts.
  float error_bound = std::numeric_limits<float>::infinity();
  /// Vertices of edges with one triangle neither move nor vanish: neighbouring tiles that are built
  /// one by one still fit.
  bool lock_borders = false;
  /// Where materials, or colours at one position, meet are no borders, and colours cost nothing.
  bool ignore_materials = false, ignore_colours = false;
  /// Every piece (a part that neither edges nor vertices join to others) stays. Otherwise one goes
  /// when no collapse costs less than its end (PieceCost), all but the largest, and those with
  /// locked vertices.
  bool keep_pieces = false;
  /// Every level knows its error(), whatever the metric. Levels of aps and mapping do (total, max),
  /// and those of an error bound.
  bool track_error = false;
  /// Refuse what turns a triangle over in the texture, whatever the metric; qem5, aps and mapping
  /// always do (see texture_needs).
  bool refuse_folds = false;
  /// Refuse what makes a texture chart grow over another, on a texture of so many texels a side; 0:
  /// no check. For textures that are adapted (adapt/texture_adapt.h).
  int charts_apart_px = 0;
  bool lazy = true;                ///< changed costs are evaluated again when they come up, see
                                   ///< CollapseLimits
  float min_cosine = 0.2f;         ///< a normal may turn by up to acos of this
  bool total_error = true;         ///< aps, mapping: distance to the input, not to the step before
  Measure measure = Measure::max;  ///< of mapping
  QemOptions qem = {};             ///< of qem3 and qem5
  double texture_weight = 1;       ///< of qem5, see TextureQemOptions
  LindstromTurkOptions lt = {};    ///< of lt
};

/// What a build needs of texture coordinates.
struct TextureNeeds {
  bool coordinates = false;  ///< the metric, with this placement, refuses meshes without them
  bool no_folds = false;     ///< refuses what turns a triangle over in the texture, if there is one
};
TextureNeeds texture_needs(const BuildOptions& options);

/// Parts that neither edges nor vertices join. Collapses never join them.
struct PieceCounts {
  static constexpr std::size_t kMostSmall = 4;
  std::size_t n = 0;
  std::size_t n_small = 0, n_in_small = 0;  ///< those of at most kMostSmall faces; faces in them
};

struct BuildResult {
  ProgressiveRecord record;  ///< made_by is left empty
  CollapseCounts counts;
  std::size_t n_welded = 0;   ///< vertices at the position of an earlier one
  std::size_t n_dropped = 0;  ///< faces with two corners at one position, left out
  double weld_tolerance = 0;  ///< as used
  BorderWeld welded_apart;    ///< vertices not at the position of the one that they are welded to
  PieceCounts pieces;         ///< of the input, welded
  std::size_t n_locked = 0;   ///< vertices
  std::size_t n_recut =
      0;  ///< triangles of backs, cut along their fronts' diagonals (mesh/backs.h)
  std::size_t n_region_edges = 0;  ///< where materials or colours meet
  std::size_t n_charts = 0;        ///< joined charts of the texture (ChartLink::corner)
};

/// Throws InputError when the metric needs what the mesh has not, UsageError for a metric that has
/// no such placement. Costs are in the mesh's units. Memory: with the mesh and the record 250 to
/// 290 bytes a face at most, 400 for qem5.
BuildResult build_progressive_mesh(const TriMesh& input, const BuildOptions& options,
                                   const Progress& progress = {});

}  // namespace viewcell
