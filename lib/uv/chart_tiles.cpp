#include "uv/chart_tiles.h"

#include <algorithm>

#include "uv/chart_map.h"
#include "uv/uv_rounding.h"

namespace viewcell {
namespace {

// How far a chart may reach out of the picture and be taken for careless, over the picture.
constexpr double kOvershoot = 0.1;
// How much wider than the picture one that fills it may be: some texels, which exporters round to.
constexpr double kWider = 0.02;

bool is_within(const UvRange& range, double slack) {
  return std::min(range.lo.x, range.lo.y) >= -slack &&
         std::max(range.hi.x, range.hi.y) <= 1 + slack;
}

UvRange moved(const UvRange& range, const glm::dvec2& tile) {
  return {range.lo - tile, range.hi - tile};
}

}  // namespace

bool is_repeating(const UvRange& range) {
  const glm::dvec2 size = range.hi - range.lo;
  return std::max(size.x, size.y) > 1 + kWider || !is_within(range, kOvershoot) ||
         std::min(range.hi.x, range.hi.y) < -kUvRounding ||
         std::max(range.lo.x, range.lo.y) > 1 + kUvRounding;
}

glm::ivec2 find_tile(const UvRange& range) {
  constexpr double kMost = 1e6;
  if (is_within(range, kUvRounding)) return glm::ivec2(0);
  const glm::dvec2 own = glm::floor(range.lo + kUvRounding);
  const glm::dvec2 middle = glm::floor((range.lo + range.hi) / 2.0);
  if (glm::length(own) > kMost || glm::length(middle) > kMost) return glm::ivec2(0);
  if (is_within(moved(range, own), kUvRounding)) return glm::ivec2(own);
  if (is_repeating(range) && !is_repeating(moved(range, middle))) return glm::ivec2(middle);
  return glm::ivec2(0);
}

std::vector<glm::ivec2> find_chart_tiles(const TriMesh& mesh) {
  const Charts charts = find_charts(mesh, ChartLink::corner);
  std::vector<UvRange> ranges(charts.size(), {glm::dvec2(1e300), glm::dvec2(-1e300)});
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (charts.of[t] == kNoChart) continue;
    UvRange& range = ranges[charts.of[t]];
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec2 uv(mesh.texcoords[3 * t + k]);
      range.lo = glm::min(range.lo, uv), range.hi = glm::max(range.hi, uv);
    }
  }
  std::vector<glm::ivec2> out(mesh.triangles.size(), glm::ivec2(0));
  for (std::size_t t = 0; t < out.size(); ++t)
    if (charts.of[t] != kNoChart) out[t] = find_tile(ranges[charts.of[t]]);
  const bool stay = std::all_of(out.begin(), out.end(),
                                [](const glm::ivec2& tile) { return tile == glm::ivec2(0); });
  return stay ? std::vector<glm::ivec2>() : out;
}

}  // namespace viewcell
