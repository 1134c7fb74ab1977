#include "adapt/rebake.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/buckets.h"
#include "base/error.h"
#include "image/owner_map.h"
#include "mesh/closest_point.h"
#include "mesh/topology.h"
#include "uv/chart_map.h"
#include "uv/gutter.h"
#include "uv/triangle_map.h"

namespace viewcell {
namespace {

// How much farther than the nearest point one on the facing side may be, over the diagonal of the
// original: more than sheets are thick, less than what is opposite.
constexpr double kSheetShare = 0.01;

// Surface points that are equally near within rounding, and corner weights that are 0, over the
// diagonal and 1.
constexpr double kSameDistance = 1e-7, kZeroWeight = 1e-6;

using Corners3 = std::array<glm::dvec3, 3>;

Corners3 corners_of(const TriMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return {mesh.positions[a], mesh.positions[b], mesh.positions[c]};
}

// ---- What the original shows -------------------------------------------------------------------

Box box_around(const TriMesh& a, const TriMesh& b) {
  Box box;
  for (const TriMesh* mesh : {&a, &b})
    for (const Triangle& t : mesh->triangles)
      for (const std::uint32_t v : t) box.add(glm::dvec3(mesh->positions[v]));
  return box;
}

// Per vertex position: the triangles at it when their texture coordinates there differ.
struct Seams {
  std::vector<std::uint32_t> first_at;  // vertex -> lowest vertex at its position
  Buckets<std::uint32_t> triangles;

  explicit Seams(const TriMesh& mesh);
  std::span<const std::uint32_t> at(std::uint32_t vertex) const {
    return triangles.of(first_at[vertex]);
  }
};

Seams::Seams(const TriMesh& mesh) : first_at(match_positions(mesh)) {
  const std::size_t n_corners = 3 * mesh.triangles.size();
  const auto vertex = [&](std::size_t c) { return first_at[mesh.triangles[c / 3][c % 3]]; };
  std::vector<std::uint32_t> corner(mesh.positions.size(), kNoChart);  // one of each vertex
  std::vector<bool> is_seam(mesh.positions.size(), false);
  for (std::size_t c = 0; c < n_corners; ++c) {
    std::uint32_t& known = corner[vertex(c)];
    if (known == kNoChart) known = static_cast<std::uint32_t>(c);
    if (mesh.texcoords[c] != mesh.texcoords[known]) is_seam[vertex(c)] = true;
  }
  triangles = fill_buckets<std::uint32_t>(mesh.positions.size(), [&](const auto& emit) {
    for (std::size_t c = 0; c < n_corners; ++c)
      if (is_seam[vertex(c)]) emit(vertex(c), static_cast<std::uint32_t>(c / 3));
  });
}

struct Original {
  const TriMesh& mesh;
  const ImageRgba8& texture;
  ClosestPointFinder finder;
  Seams seams;
  Charts charts;
  Image<std::uint32_t> owner;   // 1 + chart, in the charts and their rims
  Image<std::uint32_t> source;  // per texel: the texel whose colour it has
  double diagonal;

  Original(const TriMesh& level, const TriMesh& original, const ImageRgba8& image, int n_threads);
  void find_owners(int n_threads);
};

Original::Original(const TriMesh& level, const TriMesh& original, const ImageRgba8& image,
                   int n_threads)
    : mesh(original),
      texture(image),
      finder(original, box_around(level, original), n_threads),
      seams(original),
      charts(find_charts(original)),
      owner(image.width_px, image.height_px),
      diagonal(glm::length(box_around(original, original).size())) {
  find_owners(n_threads);
}

// What the texture holds outside charts is not trusted: it may be padding or background. Only where
// a chart holds no texel's centre are the texels around it taken as they are.
void Original::find_owners(int n_threads) {
  std::vector<bool> has_texels(charts.size() + 1, false);
  TriangleMap map(owner.width_px, owner.height_px);
  const auto chart = [&](std::size_t i) { return charts.of[map.pixels[i] - 1] + 1; };
  draw_insides(mesh, map);
  Image<std::uint8_t> is_owned = mark_owned(map);
  for (std::size_t i = 0; i < map.pixels.size(); ++i)
    if (is_owned.pixels[i]) has_texels[chart(i)] = true;
  draw_rims(mesh, map);
  for (std::size_t i = 0; i < map.pixels.size(); ++i) {
    if (map.pixels[i] == 0) continue;
    owner.pixels[i] = chart(i);
    if (!has_texels[chart(i)]) is_owned.pixels[i] = 1;
  }
  source = nearest_owned_texels(is_owned, kWholeImage, n_threads);
}

// A point of the original and its texture coordinates in texels of the texture.
struct Hit {
  std::uint32_t triangle = 0;
  glm::dvec3 weights{0};
  glm::dvec2 texel{0};
};

Hit make_hit(const Original& original, std::uint32_t triangle, const glm::dvec3& point) {
  const auto [a, b, c] = corners_of(original.mesh, triangle);
  Hit hit{triangle, corner_weights(point, a, b, c)};
  hit.texel =
      mix(texels_of(original.mesh, triangle, original.texture.width_px, original.texture.height_px),
          hit.weights);
  return hit;
}

// On a seam, the same point seen from the side whose texture coordinates are nearest to `wanted`.
Hit choose_side(const Original& original, const ClosestPoint& found, const glm::dvec3& p,
                const glm::dvec2& wanted) {
  Hit best = make_hit(original, found.triangle, found.point);
  const glm::dvec3 weights = best.weights;
  if (std::min({weights.x, weights.y, weights.z}) > kZeroWeight) return best;
  const double limit = found.distance + kSameDistance * original.diagonal;
  for (int k = 0; k < 3; ++k) {
    if (weights[k] <= kZeroWeight) continue;
    const std::uint32_t v = original.mesh.triangles[found.triangle][static_cast<std::size_t>(k)];
    for (const std::uint32_t t : original.seams.at(v)) {
      const auto [a, b, c] = corners_of(original.mesh, t);
      const glm::dvec3 q = closest_point_on_triangle(p, a, b, c);
      if (glm::distance(p, q) > limit) continue;
      const Hit hit = make_hit(original, t, q);
      if (glm::distance(hit.texel, wanted) < glm::distance(best.texel, wanted)) best = hit;
    }
  }
  return best;
}

// Nearest to p, on the side that faces along normal unless that is much farther.
ClosestPoint find_on_sheet(const Original& original, const glm::dvec3& p, const glm::dvec3& normal,
                           std::uint32_t hint) {
  const ClosestPoint found = original.finder.find(p, hint);
  if (glm::dot(area_normal(original.mesh, original.mesh.triangles[found.triangle]), normal) >= 0)
    return found;
  const double within = found.distance + kSheetShare * original.diagonal;
  return original.finder.find_facing(p, normal, within).value_or(found);
}

// Bilinear among the texels of the chart that was hit, of all where none is of it.
Rgba8 fetch_of_chart(const Original& original, const Hit& hit) {
  const BilinearTexels texels = bilinear_texels(original.texture, hit.texel);
  const std::uint32_t wanted = original.charts.of[hit.triangle] + 1;
  std::array<float, 4> weights = texels.weights;
  float sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (original.owner.pixels[texels.offsets[i]] != wanted) weights[i] = 0;
    sum += weights[i];
  }
  if (!(sum > 0)) weights = texels.weights, sum = 1;
  std::array<float, 4> color{};
  for (std::size_t i = 0; i < 4; ++i) {
    const Rgba8& texel = original.texture.pixels[original.source.pixels[texels.offsets[i]]];
    for (std::size_t k = 0; k < 4; ++k) color[k] += weights[i] / sum * texel[k];
  }
  Rgba8 out;
  for (std::size_t k = 0; k < 4; ++k)
    out[k] = static_cast<std::uint8_t>(std::min(color[k] + 0.5f, 255.0f));
  return out;
}

void rebake_row(const TriMesh& level, const TriangleMap& map, const Original& original, int y,
                ImageRgba8& out) {
  const glm::dvec2 scale(double(original.texture.width_px) / map.width_px,
                         double(original.texture.height_px) / map.height_px);
  std::uint32_t hint = 0;
  for (int x = 0; x < map.width_px; ++x) {
    if (map.at(x, y) == 0) continue;
    const std::uint32_t t = map.at(x, y) - 1;
    const Corners2 uv = texels_of(level, t, map.width_px, map.height_px);
    const glm::dvec3 p = mix(corners_of(level, t), nearest_weights(uv, {x, y}));
    const glm::dvec3 normal = area_normal(level, level.triangles[t]);
    const ClosestPoint found = find_on_sheet(original, p, normal, hint);
    const glm::dvec2 wanted = scale * glm::dvec2(x + 0.5, y + 0.5) - 0.5;
    out.at(x, y) = fetch_of_chart(original, choose_side(original, found, p, wanted));
    hint = found.triangle;
  }
}

}  // namespace

ImageRgba8 rebake_texture(const TriMesh& level, const TriMesh& original, const ImageRgba8& texture,
                          const RebakeOptions& options) {
  VIEWCELL_CHECK(level.texcoords.size() == 3 * level.triangles.size(), level.texcoords.size());
  VIEWCELL_CHECK(!texture.empty() && options.width_px >= 0 && options.height_px >= 0,
                 options.width_px, options.height_px);
  TriangleMap map(options.width_px ? options.width_px : texture.width_px,
                  options.height_px ? options.height_px : texture.height_px);
  draw_insides(level, map);
  draw_rims(level, map);
  const Original source(level, original, texture, options.n_threads);
  ImageRgba8 out(map.width_px, map.height_px);
  parallel_for(
      static_cast<std::size_t>(map.height_px), options.n_threads,
      [&](std::size_t y) { rebake_row(level, map, source, static_cast<int>(y), out); },
      options.progress);
  copy_into_gutter(out, nearest_owned_texels(mark_owned(map), kWholeImage, options.n_threads));
  return out;
}

}  // namespace viewcell
