// Follows: [Metro98 3]: vertices, edges and faces of each surface are sampled, and the nearest
// point of the other is found for each sample. Differs: mean, RMS and percentiles are over samples
// on faces alone. Metro pools all kinds, so that the mean moves with the tessellation and with the
// number of samples.
#include "mesh/surface_distance.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "mesh/closest_point.h"
#include "mesh/offset.h"
#include "mesh/surface_samples.h"
#include "mesh/used_vertices.h"

namespace viewcell {
namespace {

constexpr std::size_t kBlock = 4096;  // samples measured as one; sums are taken block by block

enum Kind { kVertices, kEdges, kFaces, kKinds };

// Sums over samples of one kind, with weights.
struct Sums {
  double weight = 0, distance = 0, squared = 0;

  void add(double w, double d) { weight += w, distance += w * d, squared += w * d * d; }
  void add(const Sums& other) {
    weight += other.weight, distance += other.distance, squared += other.squared;
  }
  double mean() const { return weight > 0 ? distance / weight : 0; }
  double mean_square() const { return weight > 0 ? squared / weight : 0; }
};

struct Block {
  Kind kind = kVertices;
  std::size_t first = 0, n = 0;
  Sums sums;
  WorstSample worst;
};

// One direction: the surface that is sampled, the one that is searched, and what was found.
struct Direction {
  const TriMesh& from;
  SurfaceSamples samples;
  ClosestPointFinder target;
  std::vector<Block> blocks;
  std::vector<double> vertex_distances, face_distances;  // in order of the samples

  Direction(const TriMesh& from_mesh, SurfaceSamples planned, const TriMesh& to, const Box& domain,
            const DistanceOptions& options)
      : from(from_mesh),
        samples(std::move(planned)),
        target(to, domain, options.n_threads),
        vertex_distances(samples.vertices.size()),
        face_distances(samples.n_face_samples) {
    add_blocks(kVertices, samples.vertices.size());
    add_blocks(kEdges, samples.n_edge_samples());
    add_blocks(kFaces, samples.n_face_samples);
  }

  // What mean and percentiles are over.
  Kind main_kind() const { return samples.n_face_samples > 0 ? kFaces : kVertices; }
  const std::vector<double>& main_distances() const {
    return main_kind() == kFaces ? face_distances : vertex_distances;
  }

  void add_blocks(Kind kind, std::size_t n) {
    for (std::size_t first = 0; first < n; first += kBlock)
      blocks.push_back({kind, first, std::min(kBlock, n - first), {}, {}});
  }
};

void make_samples(const Direction& direction, const Block& block, std::span<glm::dvec3> points,
                  std::span<double> weights) {
  const auto& [from, samples, target, blocks, vertices, faces] = direction;
  if (block.kind == kVertices) sample_vertices(samples, from, block.first, points);
  if (block.kind == kEdges) sample_edges(samples, from, block.first, points, weights);
  if (block.kind == kFaces) sample_faces(samples, from, block.first, points);
}

void measure_block(Direction& direction, Block& block) {
  std::vector<glm::dvec3> points(block.n);
  std::vector<double> weights(block.n, 1.0);
  make_samples(direction, block, points, weights);
  std::uint32_t hint = 0;
  for (std::size_t i = 0; i < block.n; ++i) {
    const ClosestPoint found = direction.target.find(points[i], hint);
    hint = found.triangle;
    const double d = found.distance;
    block.sums.add(weights[i], d);
    if (i == 0 || d > block.worst.distance) block.worst = {points[i], found.point, d};
    if (block.kind == kVertices) direction.vertex_distances[block.first + i] = d;
    if (block.kind == kFaces) direction.face_distances[block.first + i] = d;
  }
}

void measure(std::initializer_list<Direction*> directions, int n_threads,
             const Progress& progress) {
  std::vector<std::pair<Direction*, Block*>> blocks;
  for (Direction* direction : directions)
    for (Block& block : direction->blocks) blocks.emplace_back(direction, &block);
  parallel_for(
      blocks.size(), n_threads,
      [&](std::size_t i) { measure_block(*blocks[i].first, *blocks[i].second); }, progress);
}

// How many samples of each kind Metro 4 takes when it is asked for n: every vertex; of what is
// left, one for each sqrt(area / left) of edge; on faces, what is left when the vertices are taken
// off once more and the samples along edges too (that is what its code does).
std::array<double, kKinds> metro_counts(const SurfaceSamples& samples, double n) {
  const auto n_vertices = static_cast<double>(samples.vertices.size());
  const double left = std::max(0.0, n - n_vertices);
  const double n_edges = samples.length * std::sqrt(left / samples.area());
  return {n_vertices, n_edges, std::max(0.0, left - n_vertices - n_edges)};
}

void set_pooled(OneSidedDistance& result, const std::array<Sums, kKinds>& sums,
                const SurfaceSamples& samples) {
  const std::array<double, kKinds> counts =
      metro_counts(samples, static_cast<double>(samples.n_face_samples));
  Sums all;
  for (std::size_t kind = 0; kind < kKinds; ++kind)
    all.add(
        {counts[kind], counts[kind] * sums[kind].mean(), counts[kind] * sums[kind].mean_square()});
  result.mean_pooled = all.mean();
  result.rms_pooled = std::sqrt(all.mean_square());
}

// The smallest of the distances that a share of them does not exceed (nearest rank). Reorders.
double percentile(std::vector<double>& distances, double share) {
  const auto rank =
      static_cast<std::size_t>(std::ceil(share * static_cast<double>(distances.size())));
  const auto nth =
      distances.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1)) - 1;
  std::nth_element(distances.begin(), nth, distances.end());
  return *nth;
}

OneSidedDistance summarise(const Direction& direction) {
  OneSidedDistance result;
  std::array<Sums, kKinds> sums;
  for (const Block& block : direction.blocks) {
    sums[block.kind].add(block.sums);
    if (&block == &direction.blocks.front() || block.worst.distance > result.worst.distance)
      result.worst = block.worst;
  }
  result.max = result.worst.distance;
  const Sums& over = sums[direction.main_kind()];
  result.mean = result.mean_pooled = over.mean();
  result.rms = result.rms_pooled = std::sqrt(over.mean_square());
  if (direction.main_kind() == kFaces) set_pooled(result, sums, direction.samples);
  std::vector<double> distances = direction.main_distances();
  result.p50 = percentile(distances, 0.50);
  result.p95 = percentile(distances, 0.95);
  result.p99 = percentile(distances, 0.99);
  result.n_vertices = direction.samples.vertices.size();
  result.n_edge_samples = direction.samples.n_edge_samples();
  result.n_face_samples = direction.samples.n_face_samples;
  return result;
}

std::vector<std::uint64_t> count_bins(const std::vector<double>& distances, double most,
                                      std::size_t n_bins) {
  std::vector<std::uint64_t> bins(n_bins, 0);
  for (const double d : distances) {
    if (d > most) continue;
    const double bin = most > 0 ? d / most * static_cast<double>(n_bins) : 0;
    ++bins[std::min(static_cast<std::size_t>(bin), n_bins - 1)];
  }
  return bins;
}

std::vector<double> by_vertex(const Direction& direction) {
  std::vector<double> out(direction.from.positions.size(), 0);
  for (std::size_t i = 0; i < direction.samples.vertices.size(); ++i)
    out[direction.samples.vertices[i]] = direction.vertex_distances[i];
  return out;
}

// Of a point cloud, all points.
Box box_of(const TriMesh& mesh) {
  return mesh.triangles.empty() ? bounding_box(mesh) : surface_box(mesh);
}

Box join(const Box& a, const Box& b) {
  return {glm::min(a.lo, b.lo), glm::max(a.hi, b.hi)};
}

// Places: less the origin, times the factor.
void change_units(OneSidedDistance& side, const glm::dvec3& origin, double factor) {
  for (double* x : {&side.max, &side.mean, &side.rms, &side.p50, &side.p95, &side.p99,
                    &side.mean_pooled, &side.rms_pooled, &side.worst.distance})
    *x *= factor;
  side.worst.point = factor * (side.worst.point - origin);
  side.worst.nearest = factor * (side.worst.nearest - origin);
}

double unit_cube_factor(const Box& box) {
  const glm::dvec3 size = box.size();
  return 1 / std::max({size.x, size.y, size.z});
}

// Two meshes about one offset: that of the smaller, whose coordinates are the finer. The other is
// copied where it must move.
struct OneFrame {
  TriMesh copy;
  const TriMesh* a;
  const TriMesh* b;

  OneFrame(const OneFrame&) = delete;
  OneFrame(const TriMesh& first, const TriMesh& second) : a(&first), b(&second) {
    if (first.offset == second.offset) return;
    const auto extent = [](const TriMesh& mesh) { return glm::length(box_of(mesh).size()); };
    const TriMesh*& moved = extent(first) < extent(second) ? b : a;
    const glm::dvec3 offset = (moved == a ? b : a)->offset;
    copy.positions = moved->positions;
    copy.triangles = moved->triangles;
    copy.offset = moved->offset;
    change_offset(copy, offset);
    moved = &copy;
  }
};

// backward: null where there is none.
void add_histograms(const Direction& forward, const Direction* backward, const Box& unit_box,
                    const DistanceOptions& options, SurfaceDistance& result) {
  if (options.n_bins == 0) return;
  const double asked =
      options.histogram_most / (options.unit_cube ? unit_cube_factor(unit_box) : 1);
  const double most = asked > 0 ? asked : result.symmetric().max;
  result.histogram_most = most;
  result.forward.histogram = count_bins(forward.main_distances(), most, options.n_bins);
  if (backward)
    result.backward.histogram = count_bins(backward->main_distances(), most, options.n_bins);
}

// To the units asked for; places are about the offset before.
void finish_units(SurfaceDistance& distance, const Box& unit_box, const glm::dvec3& offset,
                  bool unit_cube) {
  const double factor = unit_cube ? unit_cube_factor(unit_box) : 1;
  const glm::dvec3 origin = unit_cube ? unit_box.lo : -offset;
  change_units(distance.forward, origin, factor);
  change_units(distance.backward, origin, factor);
  for (double& d : distance.vertex_distance) d *= factor;
  distance.bbox_diagonal *= factor;
  distance.histogram_most *= factor;
  distance.units_per_model_unit = factor;
}

SurfaceSamples plan_points(const TriMesh& cloud) {
  SurfaceSamples out;
  out.vertices.resize(cloud.positions.size());
  std::iota(out.vertices.begin(), out.vertices.end(), 0u);
  out.edge_starts = {0};
  out.area_before = {0};
  return out;
}

}  // namespace

SurfaceDistance::Symmetric SurfaceDistance::symmetric() const {
  return {std::max(forward.max, backward.max), std::max(forward.mean, backward.mean),
          std::max(forward.rms, backward.rms)};
}

SurfaceDistance measure_surface_distance(const TriMesh& first, const TriMesh& second,
                                         const DistanceOptions& options, const Progress& progress) {
  const OneFrame frame(first, second);
  const TriMesh &a = *frame.a, &b = *frame.b;
  const Box box = box_of(a), both = join(box, box_of(b));
  const auto plan = [&](const TriMesh& mesh) {
    return plan_surface_samples(mesh, options.n_samples, options.seed);
  };
  Direction forward(a, plan(a), b, both, options), backward(b, plan(b), a, both, options);
  measure({&forward, &backward}, options.n_threads, progress);

  SurfaceDistance result;
  result.forward = summarise(forward);
  result.backward = summarise(backward);
  result.bbox_diagonal = glm::length(box.size());
  result.vertex_distance = by_vertex(forward);
  add_histograms(forward, &backward, box, options, result);
  finish_units(result, box, a.offset, options.unit_cube);
  return result;
}

SurfaceDistance measure_point_distance(const TriMesh& first, const TriMesh& second,
                                       PointCloud points, const DistanceOptions& options,
                                       const Progress& progress) {
  const OneFrame frame(first, second);
  const TriMesh &cloud = *frame.a, &surface = *frame.b;
  const Box box = box_of(points == PointCloud::a ? cloud : surface);
  Direction forward(cloud, plan_points(cloud), surface, join(box_of(cloud), box_of(surface)),
                    options);
  measure({&forward}, options.n_threads, progress);

  SurfaceDistance result;
  result.points = points;
  result.forward = summarise(forward);
  result.bbox_diagonal = glm::length(box.size());
  result.vertex_distance = by_vertex(forward);
  add_histograms(forward, nullptr, box, options, result);
  finish_units(result, box, cloud.offset, options.unit_cube);
  return result;
}

}  // namespace viewcell
