#include "adapt/normal_map.h"

#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/parallel.h"
#include "image/chart_reach.h"
#include "image/owner_map.h"
#include "mesh/tangents.h"
#include "uv/gutter.h"
#include "uv/triangle_grid.h"
#include "uv/triangle_map.h"

namespace viewcell {
namespace {

// A mesh's frames anywhere on its triangles.
struct Frames {
  std::vector<glm::vec3> normals;  // of corners
  std::vector<glm::vec4> tangents;

  explicit Frames(const TriMesh& mesh)
      : normals(make_corner_normals(mesh)), tangents(make_corner_tangents(mesh, normals)) {}
  glm::dmat3 at(std::size_t triangle, const glm::dvec3& weights) const {
    return mix_tangent_frame(&normals[3 * triangle], &tangents[3 * triangle], weights);
  }
};

// ---- What the finest mesh shows -----------------------------------------------------------------

ImageRgba8 continue_triangles(const ImageRgba8& image, const TriMesh& mesh, int n_threads) {
  TriangleMap map(image.width_px, image.height_px);
  draw_insides(mesh, map);
  ImageRgba8 out = image;
  copy_into_gutter(out, nearest_owned_texels(mark_owned(map), kContinuedReach, n_threads));
  return out;
}

struct NormalSource {
  Frames frames;
  TriangleGrid grid;
  const ImageRgba8* normal_map;  // as it is; null: flat
  ImageRgba8 continued;
  NormalMapY y;

  NormalSource(const ChartedMesh& finest, const ImageRgba8* map, const NormalMapOptions& options)
      : frames(finest.mesh), grid(finest.mesh, finest.charts), normal_map(map), y(options.y) {
    if (map) continued = continue_triangles(*map, finest.mesh, options.n_threads);
  }
};

// The map's normal at uv, not unit.
glm::dvec3 fetch_normal(const NormalSource& finest, const glm::vec2& uv) {
  if (!finest.normal_map) return {0, 0, 1};
  const ImageRgba8& image = finest.continued;
  const BilinearTexels at = bilinear_texels(image, to_texels(uv, image.width_px, image.height_px));
  glm::dvec3 sum(0);
  for (std::size_t i = 0; i < 4; ++i)
    sum += double(at.weights[i]) * decode_normal(image.pixels[at.offsets[i]], finest.y);
  return sum;
}

// At texel (x, y) of the index map, which holds uv.
glm::dvec3 fetch_normal_at(const NormalSource& finest, const IndexMap& map, int x, int y) {
  const glm::vec2& uv = map.at(x, y);
  const ImageRgba8* image = finest.normal_map;
  const bool is_own = image && map.width_px == image->width_px &&
                      map.height_px == image->height_px &&
                      uv == own_texcoords(x, y, map.width_px, map.height_px);
  return is_own ? decode_normal(image->at(x, y), finest.y) : fetch_normal(finest, uv);
}

// ---- In the level's frame -----------------------------------------------------------------------

// A frame whose columns span less than this, over the product of their lengths, counts as
// singular: neighbouring normals are opposite.
constexpr double kLeastVolume = 1e-6;

// The direction meant, as long as `length`, in a frame; false: it lies below the surface, and is
// projected into it.
bool express(const glm::dmat3& frame, const glm::dvec3& meant, double length, glm::dvec3& out) {
  out = {0, 0, length};
  const double volume = glm::determinant(frame);
  const double scale = glm::length(frame[0]) * glm::length(frame[1]) * glm::length(frame[2]);
  if (!(std::abs(volume) > kLeastVolume * scale)) return false;
  glm::dvec3 local = glm::inverse(frame) * meant;
  const bool is_above = local.z >= 0;
  if (!is_above) local.z = 0;
  const double l = glm::length(local);
  if (!(l > 0)) return false;
  out = length / l * local;
  return is_above;
}

// The normals of one row; clamped: of how many texels.
void bake_row(const IndexMap& map, const TriangleMap& triangles, const NormalSource& finest,
              const Frames& frames, const ChartedMesh& level, int y, BakedNormalMap& out,
              std::size_t& n_clamped) {
  for (int x = 0; x < map.width_px; ++x) {
    if (triangles.at(x, y) == 0) continue;
    const std::uint32_t t = triangles.at(x, y) - 1;
    glm::dvec3 normal = fetch_normal_at(finest, map, x, y);
    const TriangleGrid::Nearest from = finest.grid.find(glm::dvec2(map.at(x, y)), level.charts[t]);
    if (from.triangle != TriangleGrid::kNone) {
      const Corners2 corners = texels_of(level.mesh, t, map.width_px, map.height_px);
      const glm::dmat3 frame = frames.at(t, nearest_weights(corners, {x, y}));
      const glm::dvec3 meant = finest.frames.at(from.triangle, from.weights) * normal;
      if (!express(frame, meant, glm::length(normal), normal)) ++n_clamped;
    }
    out.image.at(x, y) = encode_normal(normal);
  }
}

void check_input(const IndexMap& map, const ImageRgba8* normal_map, const ChartedMesh& mesh) {
  VIEWCELL_CHECK(!map.empty() && !(normal_map && normal_map->empty()));
  VIEWCELL_CHECK(mesh.charts.size() == mesh.mesh.triangles.size() &&
                     mesh.mesh.texcoords.size() == 3 * mesh.charts.size(),
                 mesh.charts.size(), mesh.mesh.triangles.size());
}

}  // namespace

BakedNormalMap bake_normal_map(const IndexMap& map, const ImageRgba8* normal_map,
                               const ChartedMesh& finest, const ChartedMesh& level,
                               const NormalMapOptions& options) {
  check_input(map, normal_map, finest);
  check_input(map, normal_map, level);
  const NormalSource source(finest, normal_map, options);
  const Frames frames(level.mesh);
  TriangleMap triangles(map.width_px, map.height_px);
  draw_insides(level.mesh, triangles);
  draw_rims(level.mesh, triangles);
  BakedNormalMap out{ImageRgba8(map.width_px, map.height_px, encode_normal({0, 0, 1}))};
  std::vector<std::size_t> n_clamped(static_cast<std::size_t>(map.height_px), 0);
  parallel_for(n_clamped.size(), options.n_threads, [&](std::size_t y) {
    bake_row(map, triangles, source, frames, level, static_cast<int>(y), out, n_clamped[y]);
  });
  const Image<std::uint8_t> is_shown = mark_owned(triangles);
  for (const std::uint8_t shown : is_shown.pixels) out.n_texels += shown;
  for (const std::size_t n : n_clamped) out.n_clamped += n;
  copy_into_gutter(out.image, nearest_owned_texels(is_shown, kWholeImage, options.n_threads));
  return out;
}

}  // namespace viewcell
