#include "uv/chart_checks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <span>

#include "base/buckets.h"
#include "base/error.h"
#include "image/chart_reach.h"
#include "image/owner_map.h"
#include "uv/chart_map.h"
#include "uv/triangle_map.h"
#include "uv/uv_rounding.h"
#include "uv/uv_stretch.h"

namespace viewcell {
namespace {

// Area, in texels, that is rounding of coordinates: no chart and no turn of a triangle.
constexpr double kNoArea = 1e-4;

// Where one chart lies over another, or over itself: texels and the other chart.
struct Shared {
  std::uint32_t other;
  std::uint32_t texel;

  auto operator<=>(const Shared&) const = default;
};

// The triangles of each chart, ascending.
Buckets<std::uint32_t> list_members(const Charts& charts) {
  return fill_buckets<std::uint32_t>(charts.size(), [&](const auto& emit) {
    for (std::uint32_t t = 0; t < charts.of.size(); ++t)
      if (charts.of[t] != kNoChart) emit(charts.of[t], t);
  });
}

// Counts one more and keeps the lowest number.
void count(std::size_t& n, std::uint32_t& first, std::uint32_t number) {
  first = n == 0 ? number : std::min(first, number);
  ++n;
}

// ---- Coordinates -------------------------------------------------------------------------------

bool is_outside(const glm::dvec2& uv) {
  return std::min(uv.x, uv.y) < -kUvRounding || std::max(uv.x, uv.y) > 1 + kUvRounding;
}

void check_coordinates(const TriMesh& mesh, ChartFindings& out) {
  bool is_first = true;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    bool is_finite = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec2 uv(mesh.texcoords[3 * t + k]);
      if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) {
        is_finite = false;
        continue;
      }
      out.n_outside += is_outside(uv);
      out.uv_lo = is_first ? uv : glm::min(out.uv_lo, uv);
      out.uv_hi = is_first ? uv : glm::max(out.uv_hi, uv);
      is_first = false;
    }
    if (!is_finite) count(out.n_not_finite, out.first_not_finite, t);
  }
}

UvRange range_of(const TriMesh& mesh, std::span<const std::uint32_t> triangles) {
  UvRange out{glm::dvec2(1e300), glm::dvec2(-1e300)};
  for (const std::uint32_t t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec2 uv(mesh.texcoords[3 * std::size_t{t} + k]);
      out.lo = glm::min(out.lo, uv), out.hi = glm::max(out.hi, uv);
    }
  return out;
}

// The tile of all charts, if they have one.
glm::ivec2 common_tile(const std::vector<glm::ivec2>& tiles) {
  const bool is_one =
      std::adjacent_find(tiles.begin(), tiles.end(), std::not_equal_to<>()) == tiles.end();
  return tiles.empty() || !is_one ? glm::ivec2(0) : tiles[0];
}

// ---- Area and turn -----------------------------------------------------------------------------

void check_areas(const TriMesh& mesh, std::span<const std::uint32_t> triangles, bool has_texels,
                 bool is_inside, ChartFindings& out) {
  double sum = 0, signed_sum = 0;
  std::vector<double> areas;
  for (const std::uint32_t t : triangles) {
    const auto p = texels_of(mesh, t, out.width_px, out.height_px);
    areas.push_back(0.5 * twice_area(p[0], p[1], p[2]));
    sum += std::abs(areas.back());
    signed_sum += areas.back();
  }
  if (!(sum > kNoArea))
    count(out.n_flat, out.first_flat, triangles[0]);
  else
    out.n_tiny += !has_texels && is_inside;
  const double sign = signed_sum < 0 ? -1 : 1;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    if (sign * areas[i] < -kNoArea) count(out.n_turned, out.first_turned, triangles[i]);
}

// ---- Overlaps ----------------------------------------------------------------------------------

// Whether the texels, sorted, hold a square of 2 x 2, none of which spans two ends of a row.
bool hold_square(std::span<const Shared> shared, std::uint32_t width_px) {
  const auto has = [&](std::uint32_t texel) {
    return std::binary_search(shared.begin(), shared.end(), Shared{shared[0].other, texel});
  };
  return std::any_of(shared.begin(), shared.end(), [&](const Shared& s) {
    return (s.texel + 1) % width_px != 0 && has(s.texel + 1) && has(s.texel + width_px) &&
           has(s.texel + width_px + 1);
  });
}

// Per texel 1 + the chart, while one chart after another is drawn.
struct Drawing {
  const TriMesh& mesh;
  const Image<std::uint32_t>& owner;
  Image<std::uint32_t> last;
  std::vector<Shared> shared;
  bool has_texels = false;

  // What the chart shares with the texels' owners, sorted, each texel once.
  void draw(std::span<const std::uint32_t> triangles, std::uint32_t chart);
};

void Drawing::draw(std::span<const std::uint32_t> triangles, std::uint32_t chart) {
  shared.clear();
  has_texels = false;
  for (const std::uint32_t t : triangles)
    for_each_span(texels_of(mesh, t, owner.width_px, owner.height_px), owner.width_px,
                  owner.height_px, [&](int x0, int x1, int y) {
                    has_texels = true;
                    for (int x = x0; x < x1; ++x) {
                      const auto i = static_cast<std::uint32_t>(owner.offset(x, y));
                      const bool is_again = last.pixels[i] == chart + 1;
                      if (is_again) shared.push_back({chart, i});
                      if (!is_again && owner.pixels[i] != chart + 1)
                        shared.push_back({owner.pixels[i] - 1, i});
                      last.pixels[i] = chart + 1;
                    }
                  });
  std::sort(shared.begin(), shared.end());
  shared.erase(std::unique(shared.begin(), shared.end()), shared.end());
}

void add_overlaps(const std::vector<Shared>& shared, std::uint32_t chart, ChartFindings& out) {
  const auto width = static_cast<std::uint32_t>(out.width_px);
  for (std::size_t i = 0, end = 0; i < shared.size(); i = end) {
    while (end < shared.size() && shared[end].other == shared[i].other) ++end;
    const std::span<const Shared> run(shared.data() + i, shared.data() + end);
    if (!hold_square(run, width)) continue;
    const std::uint32_t middle = run[run.size() / 2].texel;
    out.overlaps.push_back({run[0].other, chart, run.size(), static_cast<int>(middle % width),
                            static_cast<int>(middle / width)});
  }
}

void summarise_overlaps(const TriMesh& mesh, const Charts& charts, ChartFindings& out) {
  std::vector<bool> is_in(charts.size(), false);
  const auto material = [&](std::uint32_t t) {
    return mesh.materials.empty() ? 0 : mesh.materials[t];
  };
  for (ChartOverlap& overlap : out.overlaps) {
    is_in[overlap.first] = is_in[overlap.second] = true;
    out.n_shared += overlap.n_texels;
    overlap.first = charts.first[overlap.first];
    overlap.second = charts.first[overlap.second];
    out.n_across_materials += material(overlap.first) != material(overlap.second);
  }
  out.n_overlapped = static_cast<std::size_t>(std::count(is_in.begin(), is_in.end(), true));
  std::stable_sort(out.overlaps.begin(), out.overlaps.end(),
                   [](const auto& a, const auto& b) { return a.n_texels > b.n_texels; });
}

// Of two charts, so near each other that bilinear fetches of both read texels between them.
std::size_t count_crowded(const Image<std::uint32_t>& owner) {
  std::size_t n = 0;
  for (int y = 0; y < owner.height_px; ++y)
    for (int x = 0; x < owner.width_px; ++x)
      n += owner.at(x, y) != 0 && is_near_others(owner, x, y, owner.at(x, y), kGutterReach);
  return n;
}

}  // namespace

ChartFindings check_charts(const TriMesh& input, int width_px, int height_px) {
  VIEWCELL_CHECK(width_px > 0 && height_px > 0, width_px, height_px);
  ChartFindings out;
  out.width_px = width_px, out.height_px = height_px;
  check_coordinates(input, out);
  out.tiles = find_chart_tiles(input);
  out.tile = common_tile(out.tiles);
  TriMesh moved;
  if (!out.tiles.empty()) {
    moved = input;
    for (std::size_t c = 0; c < moved.texcoords.size(); ++c)
      moved.texcoords[c] -= glm::vec2(out.tiles[c / 3]);
  }
  const TriMesh& mesh = moved.triangles.empty() ? input : moved;
  const Charts charts = find_charts(mesh);
  const Buckets<std::uint32_t> members = list_members(charts);
  const Image<std::uint32_t> owner = make_chart_map(mesh, charts, width_px, height_px);
  out.n_charts = charts.size();
  Drawing drawing{mesh, owner, Image<std::uint32_t>(width_px, height_px), {}};
  for (std::uint32_t c = 0; c < charts.size(); ++c) {
    const std::span<const std::uint32_t> triangles = members.of(c);
    const UvRange range = range_of(mesh, triangles);
    const bool repeats = is_repeating(range);
    if (repeats && out.n_repeating == 0) out.repeating = range;  // charts ascend
    if (repeats) count(out.n_repeating, out.first_repeating, charts.first[c]);
    if (!out.tiles.empty() && out.tiles[charts.first[c]] != glm::ivec2(0))
      count(out.n_elsewhere, out.first_elsewhere, charts.first[c]);
    drawing.draw(triangles, c);
    check_areas(mesh, triangles, drawing.has_texels, !repeats, out);
    add_overlaps(drawing.shared, c, out);
  }
  summarise_overlaps(mesh, charts, out);
  out.n_crowded = count_crowded(owner);
  return out;
}

namespace {

std::string number_of(std::size_t n, const std::string& singular, const std::string& plural) {
  return std::to_string(n) + " " + (n == 1 ? singular : plural);
}

std::string triangle(std::uint32_t number) {
  return "triangle " + std::to_string(number);
}

// "u -0.05 to 1, v 0 to 1"
std::string format_range(const UvRange& range) {
  char text[128];
  std::snprintf(text, sizeof text, "u %.4g to %.4g, v %.4g to %.4g", range.lo.x, range.hi.x,
                range.lo.y, range.hi.y);
  return text;
}

std::string describe_not_finite(const ChartFindings& f) {
  return number_of(f.n_not_finite, "triangle has", "triangles have") +
         " texture coordinates that are no numbers, the first is " + triangle(f.first_not_finite);
}

std::string describe_repeating(const ChartFindings& f) {
  const glm::dvec2 size = f.repeating.hi - f.repeating.lo;
  const char* what = std::max(size.x, size.y) > 1 ? "its texels show several places"
                                                  : "it crosses a side of the picture";
  return number_of(f.n_repeating, "chart wants", "charts want") +
         " a picture that repeats, the first at " + triangle(f.first_repeating) + " (" +
         format_range(f.repeating) + "): " + what +
         "; give each place a texel of its own in [0, 1]";
}

std::string describe_elsewhere(const ChartFindings& f) {
  if (f.tile != glm::ivec2(0))
    return "the whole mesh lies in another tile of the picture (" +
           format_range({f.uv_lo, f.uv_hi}) + "): subtract " + std::to_string(f.tile.x) +
           " from u and " + std::to_string(f.tile.y) + " from v";
  const glm::ivec2 tile = f.tiles[f.first_elsewhere];
  return number_of(f.n_elsewhere, "chart lies in another tile", "charts lie in other tiles") +
         " of the picture, the first at " + triangle(f.first_elsewhere) + " in " +
         std::to_string(tile.x) + ", " + std::to_string(tile.y) +
         ": move each by whole tiles into [0, 1]";
}

std::string describe_outside(const ChartFindings& f) {
  if (f.n_elsewhere > 0) return describe_elsewhere(f);
  return number_of(f.n_outside, "corner lies", "corners lie") + " a little outside the picture (" +
         format_range({f.uv_lo, f.uv_hi}) + "): move or shrink the charts into [0, 1]";
}

std::string describe_overlaps(const ChartFindings& f) {
  const ChartOverlap& most = f.overlaps.front();
  const std::string where = " on " + std::to_string(most.n_texels) + " texels around x " +
                            std::to_string(most.x) + ", y " + std::to_string(most.y) + " of " +
                            std::to_string(f.width_px) + " x " + std::to_string(f.height_px);
  const bool is_itself = most.first == most.second;
  const std::string what = is_itself ? "the chart of " + triangle(most.first) + " lies over itself"
                                     : "the charts of " + triangle(most.first) + " and " +
                                           triangle(most.second) + " lie over one another";
  const std::string rest = f.overlaps.size() == 1
                               ? ""
                               : "; " + std::to_string(f.overlaps.size()) + " such overlaps of " +
                                     number_of(f.n_overlapped, "chart", "charts") + ", " +
                                     std::to_string(f.n_shared) + " texels in all";
  const std::string materials =
      f.n_across_materials == 0
          ? ""
          : "; " + std::to_string(f.n_across_materials) + " of " +
                std::to_string(f.overlaps.size()) +
                " are of charts of two materials, which may have a picture each";
  return what + where + rest + ": these texels show two places at once" + materials;
}

}  // namespace

std::string find_obstacle(const ChartFindings& f, bool allows_overlap) {
  if (f.n_not_finite > 0) return describe_not_finite(f);
  if (f.n_repeating > 0) return describe_repeating(f);
  if (f.n_elsewhere > 0) return describe_elsewhere(f);
  ChartFindings several = f;  // a chart that folds over itself shows the same either way
  std::erase_if(several.overlaps, [](const ChartOverlap& o) { return o.first == o.second; });
  return several.overlaps.empty() || allows_overlap ? "" : describe_overlaps(several);
}

std::string describe(const ChartFindings& f) {
  std::string out = number_of(f.n_charts, "chart", "charts");
  const auto add = [&](bool is_found, const auto& line) {
    if (is_found) out += "\n" + line();
  };
  add(f.n_not_finite > 0, [&] { return describe_not_finite(f); });
  add(f.n_repeating > 0, [&] { return describe_repeating(f); });
  add(f.n_repeating == 0 && f.n_outside > 0, [&] { return describe_outside(f); });
  add(!f.overlaps.empty(), [&] { return describe_overlaps(f); });
  add(f.n_turned > 0, [&] {
    return number_of(f.n_turned, "triangle lies", "triangles lie") +
           " face down in the picture, against the rest of the chart, the first is " +
           triangle(f.first_turned) + ": a fold, or a half that mirrors the other";
  });
  add(f.n_flat > 0, [&] {
    return number_of(f.n_flat, "chart has", "charts have") + " no area, the first at " +
           triangle(f.first_flat) + ": all of it shows one point or line of the picture";
  });
  add(f.n_tiny > 0, [&] {
    return number_of(f.n_tiny, "chart is", "charts are") +
           " so small that no texel's centre lies within";
  });
  add(f.n_crowded > 0, [&] {
    return number_of(f.n_crowded, "texel lies", "texels lie") + " within " +
           std::to_string(kGutterReach) +
           " texels of another chart: the colours of both may mix at their borders";
  });
  return out;
}

}  // namespace viewcell
