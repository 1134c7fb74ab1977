// How far two surfaces are from each other, by sampling.
// Source: [Metro98] Cignoni, Rocchini, Scopigno, Metro: measuring error on simplified surfaces,
// Computer Graphics Forum 17(2), 1998.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "mesh/mesh.h"

namespace viewcell {

struct DistanceOptions {
  std::size_t n_samples = 1'000'000;  ///< on the faces of each mesh; at least 1
  std::uint64_t seed = 0;             ///< shifts the samples on faces
  std::size_t n_bins = 0;             ///< of the histograms; 0: none
  double histogram_most = 0;          ///< where the last bin ends; 0: the larger max
  /// Results in the units of the cube that A's box fits into: one factor for both meshes.
  bool unit_cube = false;
  int n_threads = 0;  ///< 0: all
};

/// Where a distance was found.
struct WorstSample {
  glm::dvec3 point{0};    ///< the sample
  glm::dvec3 nearest{0};  ///< the point of the other surface nearest to it
  double distance = 0;
};

/// From samples of one surface to the nearest points of another.
struct OneSidedDistance {
  double max = 0;  ///< over vertices, samples along edges and samples on faces
  /// Over the area of the surface, by its even samples on faces: independent of tessellation.
  double mean = 0, rms = 0;
  double p50 = 0, p95 = 0, p99 = 0;  ///< that share of the area (%) is no farther
  /// As Metro 4 prints them for n_samples samples of all kinds together: vertices first, then along
  /// edges, and on faces what is left of the number. A fine mesh counts for more where it is finer.
  double mean_pooled = 0, rms_pooled = 0;
  WorstSample worst;
  std::size_t n_vertices = 0, n_edge_samples = 0, n_face_samples = 0;
  /// Samples on faces with distances in equal parts of [0, SurfaceDistance::histogram_most]; those
  /// beyond are in none.
  std::vector<std::uint64_t> histogram;

  std::size_t n_all_samples() const { return n_vertices + n_edge_samples + n_face_samples; }
};

/// Which of A and B is a point cloud.
enum class PointCloud { none, a, b };

struct SurfaceDistance {
  OneSidedDistance forward;   ///< from A to B; from a point cloud to the other
  OneSidedDistance backward;  ///< from B to A; with a point cloud there is none
  PointCloud points = PointCloud::none;
  double bbox_diagonal = 0;             ///< of A, over vertices that a triangle uses
  double units_per_model_unit = 1;      ///< not 1 for unit_cube
  double histogram_most = 0;            ///< where the last bin of both histograms ends
  std::vector<double> vertex_distance;  ///< of each vertex of A, or of the point cloud; 0 where no
                                        ///< triangle uses it

  /// The larger of both directions, for the mean and RMS too. Metro prints only the largest
  /// maximum of both; the rest it leaves to the reader of its two columns.
  struct Symmetric {
    double max = 0, mean = 0, rms = 0;
  };
  Symmetric symmetric() const;
};

/// Offsets of the meshes may differ: places in the result are in the world's coordinates, as their
/// files have them. d(A, A) is below 1e-15 of the largest coordinate, the rounding of samples.
/// Vertices that no triangle uses do not count. Sums are taken in a fixed order: the same for any
/// number of threads. Both meshes must have an area above 0. Memory: 16 bytes a sample. Some 1.5
/// million samples a second and core where the surfaces are near; a tenth of it where they are
/// parallel and far apart for the size of their triangles, since many are then almost the nearest.
SurfaceDistance measure_surface_distance(const TriMesh& a, const TriMesh& b,
                                         const DistanceOptions& options = {},
                                         const Progress& progress = {});

/// From all vertices of a point cloud to a surface, which must have an area above 0. forward has
/// them as vertices; mean, RMS and percentiles are over them, each counts alike. points: which of A
/// and B the cloud is; A's box is that of bbox_diagonal and of the unit cube.
SurfaceDistance measure_point_distance(const TriMesh& cloud, const TriMesh& surface,
                                       PointCloud points, const DistanceOptions& options = {},
                                       const Progress& progress = {});

}  // namespace viewcell
