#include "adapt/gl_adapt_batch.h"

#include <algorithm>
#include <cmath>
#include <glm/gtx/exterior_product.hpp>
#include <utility>

#include "adapt/texel_affine.h"
#include "image/chart_reach.h"
#include "mesh/convex_hull.h"

namespace viewcell {
namespace {

constexpr float kUnlimited = 1e9f;
constexpr float kSnap = 1 / 16.0f;  // texels: more than GL rounds positions by

bool is_finite(const TexelTriangle& p) {
  return std::isfinite(p[0].x + p[0].y + p[1].x + p[1].y + p[2].x + p[2].y);
}

float area2(const TexelTriangle& p) {
  return glm::cross(p[1] - p[0], p[2] - p[0]);
}

struct Bounds {
  glm::vec2 lo{1e30f}, hi{-1e30f};
  void add(const std::vector<glm::vec2>& points) {
    for (const glm::vec2& p : points) lo = glm::min(lo, p), hi = glm::max(hi, p);
  }
};

// Moves each edge outwards, as far as the corners are not too sharp for that.
void append_widened(const std::vector<glm::vec2>& hull, float margin, std::vector<glm::vec2>& out) {
  constexpr float kSharpest = 1e-4f;
  const auto normal = [&](std::size_t k) {
    const glm::vec2 edge = hull[(k + 1) % hull.size()] - hull[k % hull.size()];
    return glm::vec2(edge.y, -edge.x) / std::max(glm::length(edge), 1e-20f);
  };
  if (hull.empty()) return;
  glm::vec2 before = normal(hull.size() - 1);
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const glm::vec2 after = normal(k);
    out.push_back(hull[k] +
                  margin / std::max(1 + glm::dot(before, after), kSharpest) * (before + after));
    before = after;
  }
}

// Positions in the triangle's own frame: no limits.
OwnedVertex unlimited(OwnedVertex vertex) {
  vertex.origin = glm::vec2(0), vertex.along = glm::vec2(1, 0), vertex.side = -1;
  vertex.lo = glm::vec2(-kUnlimited), vertex.hi = glm::vec2(kUnlimited);
  return vertex;
}

}  // namespace

std::size_t AdaptBatch::n_bytes() const {
  return vertices.size() * sizeof(AdaptVertex) + indices.size() * sizeof(std::uint32_t) +
         owned.size() * sizeof(OwnedVertex) + star_corners.size() * sizeof(glm::vec2);
}

AdaptBatchBuilder::AdaptBatchBuilder(const AdaptationLog& log, const Image<std::uint16_t>& owners,
                                     bool has_original, bool copies_boxes)
    : log_(log),
      width_px_(owners.width_px),
      height_px_(owners.height_px),
      has_original_(has_original),
      copies_boxes_(copies_boxes),
      tiles_(owners) {}

AdaptBatch AdaptBatchBuilder::take() {
  return std::exchange(batch_, {});
}

void AdaptBatchBuilder::add_pack(std::span<const std::uint32_t> collapses, bool is_collapse) {
  scratch_.sampled.clear(), scratch_.own_texcoords.clear(), scratch_.released.clear();
  PackDraws draws;
  draws.sample_owned.first = batch_.owned.size();
  add_copies(written_owned_, scratch_.released);
  add_copies(written_, scratch_.own_texcoords);
  draws.boxes = {batch_.boxes.size(), written_boxes_.size()};
  batch_.boxes.insert(batch_.boxes.end(), written_boxes_.begin(), written_boxes_.end());
  written_boxes_.clear();
  for (const std::uint32_t collapse : collapses) {
    const Adaptation adaptation = log_.of(collapse);
    read_points(adaptation, is_collapse);
    Bounds from;
    from.add(scratch_.from);
    const glm::vec2 lo = from.lo - float{kGutterReach}, hi = from.hi + float{kGutterReach};
    bool has_border = false, is_guarded = false;
    for (const AdaptationTriangle& t : adaptation.triangles) {
      has_border = has_border || t.has_border();
      is_guarded =
          is_guarded || (log_.n_charts > 1 && tiles_.has_others(lo, hi, owner_name(t.chart)));
    }
    if (has_border || is_guarded)
      add_owned(adaptation, is_collapse, has_border);
    else
      add_plain(adaptation, is_collapse);
  }
  draws.copy_owned = append(scratch_.released);
  draws.copy_values = append(scratch_.own_texcoords);
  draws.sample = append(scratch_.sampled);
  draws.sample_owned.n = batch_.owned.size() - draws.sample_owned.first;
  batch_.packs.push_back(draws);
}

void AdaptBatchBuilder::read_points(const Adaptation& adaptation, bool is_collapse) {
  scratch_.from.clear(), scratch_.to.clear();
  const auto to_gl_texels = [&](const glm::vec2& uv) {
    glm::dvec2 p = to_texels(uv, width_px_, height_px_);
    p.y = height_px_ - 1 - p.y;
    return glm::vec2(p);
  };
  for (const AdaptationPoint& point : adaptation.points) {
    scratch_.from.push_back(to_gl_texels(is_collapse ? point.before : point.after));
    scratch_.to.push_back(to_gl_texels(is_collapse ? point.after : point.before));
  }
}

TexelTriangle AdaptBatchBuilder::corners(const std::vector<glm::vec2>& points,
                                         const AdaptationTriangle& t) const {
  return {points[t.corners[0]], points[t.corners[1]], points[t.corners[2]]};
}

bool AdaptBatchBuilder::is_own_texcoords(const AdaptationTriangle& t, bool is_collapse) const {
  return has_original_ && !is_collapse && t.is_original();
}

void AdaptBatchBuilder::add_plain(const Adaptation& adaptation, bool is_collapse) {
  add_triangles(adaptation, is_collapse, false);
  if (has_original_ && !is_collapse) add_triangles(adaptation, is_collapse, true);
  add_written(adaptation, written_);
}

// Those that are sampled, or those that get their own texture coordinates.
void AdaptBatchBuilder::add_triangles(const Adaptation& adaptation, bool is_collapse,
                                      bool own_texcoords) {
  std::vector<std::uint32_t>& indices = own_texcoords ? scratch_.own_texcoords : scratch_.sampled;
  const auto base = static_cast<std::uint32_t>(batch_.vertices.size());
  const std::size_t n = indices.size();
  for (const AdaptationTriangle& t : adaptation.triangles) {
    if (is_own_texcoords(t, is_collapse) != own_texcoords) continue;
    if (!is_finite(corners(scratch_.to, t)) || !is_finite(corners(scratch_.from, t))) continue;
    for (const std::uint16_t corner : t.corners) indices.push_back(base + corner);
  }
  if (indices.size() == n) return;
  for (std::size_t k = 0; k < scratch_.to.size(); ++k)
    batch_.vertices.push_back({scratch_.to[k], own_texcoords ? glm::vec2(1, 0) : scratch_.from[k]});
}

void AdaptBatchBuilder::add_owned(const Adaptation& adaptation, bool is_collapse, bool has_border) {
  OwnedVertex vertex = unlimited({});
  vertex.first_corner = static_cast<std::uint32_t>(batch_.star_corners.size());
  if (has_border) add_release(adaptation);
  const auto n_corners =
      static_cast<std::uint32_t>(batch_.star_corners.size()) - vertex.first_corner;
  const auto visit_cells = [&](auto&& visit) {
    for (const AdaptationTriangle& t : adaptation.triangles) {
      const TexelTriangle from = corners(scratch_.from, t), to = corners(scratch_.to, t);
      if (!is_finite(from) || !is_finite(to)) continue;
      vertex.name = owner_name(t.chart);
      vertex.n_corners = n_corners | (is_own_texcoords(t, is_collapse) ? kOwnTexcoordsBit : 0);
      visit(t, from, to);
    }
  };
  // Cells lie over gutters, so they are drawn later.
  visit_cells([&](const AdaptationTriangle& t, const TexelTriangle& from, const TexelTriangle& to) {
    vertex.owner = vertex.name;
    for (std::size_t k = 0; k < 3; ++k)
      if (t.is_border(k)) add_gutter(from, to, k, vertex);
  });
  visit_cells([&](const AdaptationTriangle&, const TexelTriangle& from, const TexelTriangle& to) {
    vertex.owner = has_border ? kInsideChart | vertex.name : 0;
    vertex.n_corners &= kOwnTexcoordsBit;
    for (std::size_t k = 0; k < 3; ++k) {
      vertex.to = to[k], vertex.local = from[k];
      batch_.owned.push_back(vertex);
    }
  });
  if (!has_border) return add_written(adaptation, written_owned_);
  Bounds bounds;
  bounds.add(scratch_.from), bounds.add(scratch_.to);
  for (const AdaptationTriangle& t : adaptation.triangles)
    tiles_.mark(bounds.lo - 2 * kGutter, bounds.hi + 2 * kGutter, owner_name(t.chart));
  add_border_written();
}

// The texels of the star lose their owner until they are written again.
void AdaptBatchBuilder::add_release(const Adaptation& adaptation) {
  for (const AdaptationTriangle& t : adaptation.triangles) {
    const TexelTriangle from = corners(scratch_.from, t);
    if (!is_finite(from)) continue;
    for (const glm::vec2& p : from) {
      scratch_.released.push_back(static_cast<std::uint32_t>(batch_.vertices.size()));
      batch_.vertices.push_back({p, glm::vec2(owner_name(t.chart), 0)});
      batch_.star_corners.push_back(p);
    }
  }
}

// A strip beyond the edge from a corner to the next, continued from the cell, but sampled no
// farther from the edge than there are texels of the chart.
void AdaptBatchBuilder::add_gutter(const TexelTriangle& from, const TexelTriangle& to,
                                   std::size_t edge, OwnedVertex vertex) {
  const auto outward = [](const glm::vec2& along, float side) {
    return side * glm::vec2(along.y, -along.x);
  };
  const glm::vec2 p = to[edge], to_edge = to[(edge + 1) % 3] - p;
  const glm::vec2 q = from[edge], from_edge = from[(edge + 1) % 3] - q;
  const float length = glm::length(to_edge), from_length = glm::length(from_edge);
  if (!(length > 0)) return;
  const glm::vec2 along = kGutter / length * to_edge;
  const glm::vec2 out = outward(along, area2(to) < 0 ? -1.0f : 1.0f);
  const std::array<glm::vec2, 4> strip{p - along, p + to_edge + along, p + to_edge + along + out,
                                       p - along + out};
  if (from_length > 0) {
    vertex.origin = q, vertex.along = from_edge / from_length;
    vertex.side = area2(from) < 0 ? -1.0f : 1.0f;
    vertex.lo = {-kGutter, -kUnlimited};
    vertex.hi = {from_length + kGutter, kGutter};
  }
  const glm::vec2 from_out = outward(vertex.along, vertex.side);
  const TexelAffine source = make_affine(to, from);
  for (const std::size_t k : {0, 1, 2, 0, 2, 3}) {
    const glm::vec2 at = source(strip[k]) - vertex.origin;
    vertex.to = strip[k];
    vertex.local = {glm::dot(at, vertex.along), glm::dot(at, from_out)};
    batch_.owned.push_back(vertex);
  }
}

// What an adaptation inside a chart writes. Its box may be much larger where it is oblique.
void AdaptBatchBuilder::add_written(const Adaptation& adaptation, Outlines& outlines) {
  constexpr float kLargest = 4, kSmall = 256;  // times the star's texels; texels
  if (!copies_boxes_) return add_outline(scratch_.to, outlines);
  float texels = 0;
  for (const AdaptationTriangle& t : adaptation.triangles)
    texels += 0.5f * std::abs(area2(corners(scratch_.to, t)));
  Bounds bounds;
  bounds.add(scratch_.to);
  const glm::vec2 size = bounds.hi - bounds.lo;
  if (!(size.x * size.y < kLargest * texels + kSmall)) return add_outline(scratch_.to, outlines);
  add_copied_box(bounds.lo - kSnap, bounds.hi + kSnap, false);
}

// Around what is written inside a chart.
void AdaptBatchBuilder::add_outline(std::vector<glm::vec2>& points, Outlines& outlines) {
  const glm::vec2 size(width_px_, height_px_);
  std::erase_if(points, [](const glm::vec2& p) { return std::isnan(p.x + p.y); });
  for (glm::vec2& p : points) p = glm::clamp(p, -size, 2.0f * size);
  std::vector<glm::vec2> hull = convex_hull(points);
  if (hull.size() < 3) hull.clear();  // no texel
  append_widened(hull, kSnap, outlines.corners);
  outlines.n_corners.push_back(hull.size());
}

// A star at a border, with its gutters.
void AdaptBatchBuilder::add_border_written() {
  const glm::vec2 size(width_px_, height_px_);
  Bounds bounds;
  bounds.add(scratch_.from), bounds.add(scratch_.to);
  const glm::vec2 lo = glm::clamp(bounds.lo - 2 * kGutter, -size, 2.0f * size);
  const glm::vec2 hi = glm::clamp(bounds.hi + 2 * kGutter, -size, 2.0f * size);
  if (copies_boxes_) return add_copied_box(lo, hi, true);
  for (const glm::vec2& p : {lo, glm::vec2(hi.x, lo.y), hi, glm::vec2(lo.x, hi.y)})
    written_owned_.corners.push_back(p);
  written_owned_.n_corners.push_back(4);
}

void AdaptBatchBuilder::add_copied_box(const glm::vec2& lo, const glm::vec2& hi, bool has_owners) {
  const glm::vec2 size(width_px_, height_px_);
  const glm::ivec2 first(glm::ceil(glm::clamp(lo, glm::vec2(0), size)));
  const glm::ivec2 end = glm::ivec2(glm::floor(glm::clamp(hi, glm::vec2(-1), size - 1.0f))) + 1;
  if (first.x < end.x && first.y < end.y)
    written_boxes_.push_back({first.x, first.y, end.x - first.x, end.y - first.y, has_owners});
}

// What the last pack wrote, and a little around it.
void AdaptBatchBuilder::add_copies(Outlines& outlines, std::vector<std::uint32_t>& indices) {
  auto base = static_cast<std::uint32_t>(batch_.vertices.size());
  for (const glm::vec2& p : outlines.corners) batch_.vertices.push_back({p, glm::vec2(0)});
  for (const std::size_t n : outlines.n_corners) {
    for (std::uint32_t k = 2; k < n; ++k)
      for (const std::uint32_t corner : {0u, k - 1, k}) indices.push_back(base + corner);
    base += static_cast<std::uint32_t>(n);
  }
  outlines.corners.clear(), outlines.n_corners.clear();
}

DrawRange AdaptBatchBuilder::append(const std::vector<std::uint32_t>& indices) {
  const std::size_t first = batch_.indices.size();
  batch_.indices.insert(batch_.indices.end(), indices.begin(), indices.end());
  return {first, indices.size()};
}

}  // namespace viewcell
