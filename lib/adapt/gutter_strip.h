// The strip of a gutter along the border of an overlay cell, and where its values come from.
#pragma once

#include <algorithm>
#include <array>
#include <glm/glm.hpp>
#include <glm/gtx/exterior_product.hpp>

#include "image/chart_reach.h"
#include "image/texel_spans.h"

namespace viewcell {

/// kGutter texels beyond an edge and beyond both of its ends, as two triangles; in texels.
struct GutterStrip {
  std::array<TexelTriangle, 2> halves;
  bool is_empty = true;         ///< an edge of no length
  glm::vec2 start, out, along;  ///< of the edge in the source: an end, unit vectors
  float length = 0;             ///< of the edge in the source

  /// The point of the source, no farther from the edge than there are texels of the chart.
  glm::vec2 limit(const glm::vec2& at) const {
    const float beyond = glm::dot(at - start, out), t = glm::dot(at - start, along);
    return at - std::max(beyond - kGutter, 0.0f) * out +
           (std::clamp(t, -kGutter, length + kGutter) - t) * along;
  }
};

/// The unit vector away from a triangle, at right angles to one of its edges.
inline glm::vec2 outward(const glm::vec2& edge, const TexelTriangle& triangle) {
  const float length = glm::length(edge);
  if (!(length > 0)) return glm::vec2(0);
  const bool is_clockwise = glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]) < 0;
  return (is_clockwise ? glm::vec2(-edge.y, edge.x) : glm::vec2(edge.y, -edge.x)) / length;
}

/// Beyond the edge from corner k to the next of `to`; from: the same triangle in the source.
inline GutterStrip make_gutter_strip(const TexelTriangle& from, const TexelTriangle& to,
                                     std::size_t k) {
  GutterStrip strip;
  const glm::vec2 p = to[k], edge = to[(k + 1) % 3] - p;
  const float length = glm::length(edge);
  if (!(length > 0)) return strip;
  strip.is_empty = false;
  const glm::vec2 along = kGutter / length * edge, out = outward(edge, to);
  const glm::vec2 a = p - along, b = p + edge + along;
  const glm::vec2 c = p + edge + along + kGutter * out, d = p - along + kGutter * out;
  strip.halves = {TexelTriangle{a, b, c}, TexelTriangle{a, c, d}};
  const glm::vec2 source_edge = from[(k + 1) % 3] - from[k];
  strip.start = from[k];
  strip.out = outward(source_edge, from);
  strip.length = glm::length(source_edge);
  strip.along = strip.length > 0 ? source_edge / strip.length : glm::vec2(0);
  return strip;
}

}  // namespace viewcell
