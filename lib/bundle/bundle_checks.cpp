#include "bundle/bundle_checks.h"

#include <algorithm>
#include <cmath>

namespace viewcell {
namespace {

constexpr int kLargestCropPx = 1 << 15;
constexpr int kFarthestCropPx = 1 << 20;  // from the source image's corner
constexpr std::uint64_t kMostTexels = 1ULL << 31;
constexpr double kEyeTolerance = 1e-6;  // of coordinates, relative: they were written as text once
constexpr std::uint8_t kAllViews = (1u << kViews) - 1;

void check_object(const BundleObject& o, const Scene& scene, const CellSet& cells, CellId cell,
                  std::vector<bool>& seen, const SectionReader& reader) {
  const std::string name = "object " + std::to_string(o.object);
  if (o.object < 0 || static_cast<std::size_t>(o.object) >= scene.objects.size())
    reader.fail("OBJECTS", "names " + name);
  if (o.kind < 1 || o.kind > 3) reader.fail("OBJECTS", "has an unknown kind of mesh");
  const auto at = static_cast<std::size_t>(o.object);
  if (seen[at]) reader.fail("OBJECTS", "has " + name + " twice");
  seen[at] = true;
  if (is_original(cells, cell, ObjectId(o.object)))
    reader.fail("OBJECTS", "has " + name + ", which is inside the cell or drawn as it is");
  if ((Representation(o.kind) == Representation::unseen) !=
      is_unseen(cells, cell, ObjectId(o.object)))
    reader.fail("OBJECTS", "has " + name + " seen or unseen, and cells.json the other");
  for (int k = 0; k < 3; ++k)
    if (!std::isfinite(o.lo[k]) || !std::isfinite(o.hi[k]) || !(o.lo[k] <= o.hi[k]))
      reader.fail("OBJECTS", "the box of " + name + " is none");
}

void check_counts(const CellGeometry& g, const SectionReader& reader) {
  std::uint64_t n_vertices = 0, n_triangles = 0;
  for (const BundleObject& o : g.objects) {
    n_vertices += o.n_vertices;
    n_triangles += o.n_triangles;
  }
  if (g.source_vertices.size() != n_vertices || g.offsets.size() != n_vertices ||
      g.indices.size() != 3 * n_triangles || g.views.size() != n_triangles)
    reader.fail("OBJECTS", "its counts are not those of the other sections");
}

glm::dvec3 vector_of(const double (&v)[3]) {
  return {v[0], v[1], v[2]};
}

void check_crop(const BundleTile& tile, const SectionReader& reader) {
  if (tile.width_px < 2 || tile.height_px < 2 || tile.width_px > kLargestCropPx ||
      tile.height_px > kLargestCropPx)
    reader.fail("TILES", "has a crop of an absurd size");
  for (const std::int32_t x : {tile.x, tile.y})
    if (x < -kFarthestCropPx || x > kFarthestCropPx)
      reader.fail("TILES", "has a crop far off its picture");
  if (tile.source_px < 1 || tile.source_px > kFarthestCropPx)
    reader.fail("TILES", "has a picture of an absurd size");
}

void check_view(const BundleTile& tile, const glm::dvec3& eye, bool is_masked,
                const SectionReader& reader) {
  if (!(glm::distance(vector_of(tile.eye), eye) <= kEyeTolerance * (1 + glm::length(eye))))
    reader.fail("TILES", "has a view that is not seen from the centre");
  if (!is_view_frame(vector_of(tile.right), vector_of(tile.up), vector_of(tile.forward)))
    reader.fail("TILES", "the axes of a view are no frame of unit vectors at right angles");
  if (!(tile.focal_px >= 1e-3 && tile.focal_px <= 1e9))
    reader.fail("TILES", "has a focal length that is not within 0.001 to 1e9 px");
  if (!(std::isfinite(tile.code_scale) && tile.code_scale >= 0) ||
      !(std::isfinite(tile.code_bias) && tile.code_bias <= (is_masked ? 1 : 0)))
    reader.fail("TILES", "has a depth code that is not finite or does not fall with the depth");
}

}  // namespace

void check_geometry(const CellGeometry& g, const Scene& scene, const CellSet& cells, CellId cell,
                    const SectionReader& reader) {
  std::vector<bool> seen(scene.objects.size());
  for (const BundleObject& o : g.objects) check_object(o, scene, cells, cell, seen, reader);
  if (g.objects.size() + originals_of(cells, cell).size() != scene.objects.size())
    reader.fail("OBJECTS", "lacks objects that are outside the cell");
  check_counts(g, reader);
  std::size_t v = 0, i = 0;
  for (const BundleObject& o : g.objects) {
    const auto& mesh = scene.mesh_of(scene.objects[static_cast<std::size_t>(o.object)]).mesh;
    for (std::uint32_t k = 0; k < o.n_vertices; ++k)
      if (g.source_vertices[v++] >= mesh.positions.size())
        reader.fail("VERTICES", "has a vertex out of its mesh's range");
    for (std::uint64_t k = 0; k < 3 * std::uint64_t{o.n_triangles}; ++k)
      if (g.indices[i++] >= o.n_vertices) reader.fail("INDICES", "has an index out of range");
  }
  if (std::any_of(g.views.begin(), g.views.end(), [](std::uint8_t m) { return m > kAllViews; }))
    reader.fail("VIEWS", "has a mask of more than seven views");
}

std::uint64_t count_texels(const std::vector<BundleTile>& tiles, const SectionReader& reader) {
  std::uint64_t n = 0;
  for (const BundleTile& tile : tiles) {
    check_crop(tile, reader);
    n += static_cast<std::uint64_t>(tile.width_px) * static_cast<std::uint64_t>(tile.height_px);
  }
  if (n > kMostTexels) reader.fail("TILES", "has more texels than a player can hold");
  return n;
}

void check_tiles(const std::vector<BundleTile>& tiles, std::uint64_t n_texels, const Scene& scene,
                 const CellSet& cells, CentreId centre, const SectionReader& reader) {
  if (count_texels(tiles, reader) != n_texels)
    reader.fail("TILES", "its crops have not as many texels as there are");
  const glm::dvec3 eye = eye_of(cells, centre);
  std::uint64_t next = 0;
  std::int32_t last = -1;
  for (const BundleTile& tile : tiles) {
    if (tile.object <= last || static_cast<std::size_t>(tile.object) >= scene.objects.size())
      reader.fail("TILES",
                  "names object " + std::to_string(tile.object) + " out of order or range");
    last = tile.object;
    if (tile.first_texel != next) reader.fail("TILES", "its crops do not follow one another");
    next += static_cast<std::uint64_t>(tile.width_px) * static_cast<std::uint64_t>(tile.height_px);
    const SceneObject& object = scene.objects[static_cast<std::size_t>(tile.object)];
    check_view(tile, eye, scene.is_masked(object), reader);
  }
}

}  // namespace viewcell
