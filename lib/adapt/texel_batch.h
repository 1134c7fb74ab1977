// The texels that one adaptation writes: sampled first, written when all are known.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "adapt/texel_owners.h"
#include "adapt/texel_samples.h"
#include "image/texel_spans.h"

namespace viewcell {

/// Part of a row: where it starts in the image, its texels, and whose they will be.
struct TexelSpan {
  std::uint32_t offset;
  std::uint16_t n, owner;
};

/// Memory of one thread, for one adaptation at a time; vectors only grow. The values of all spans
/// follow one another.
template <typename Texel>
struct TexelBatch {
  struct Run {  // of values
    std::size_t first, last;
  };
  std::vector<glm::vec2> from, to;  ///< corners of cells, in texels
  std::vector<TexelSpan> spans;     ///< these sizes are room
  std::vector<Texel> values;
  std::vector<float> x, y;                    ///< where the values are sampled
  std::vector<Run> runs;                      ///< of values to be sampled
  std::size_t n_spans = 0, n_values = 0;      ///< in use
  std::size_t n_texels = 0, n_conflicts = 0;  ///< since they were last reset; see AdaptCounts

  void clear() {
    from.clear(), to.clear(), runs.clear();
    n_spans = n_values = 0;
  }
  /// For all texels of a triangle and what is written beyond; returns the first's. Of a triangle
  /// that reaches far out of the image, for those within.
  Texel* make_room(const TexelTriangle& p, int width_px, int height_px);
  void add_span(const TexelSpan& span) { spans[n_spans++] = span; }
  void add_run(std::size_t first, std::size_t last) {
    if (!runs.empty() && runs.back().last == first)
      runs.back().last = last;
    else
      runs.push_back({first, last});
  }
  SamplePoints points(std::size_t first) { return {x.data() + first, y.data() + first}; }

  /// Samples the runs.
  void sample(const View<Texel>& image);
  /// For stars without chart borders: owners do not change.
  void write_inside(Texel* pixels);
  /// For stars with chart borders: texels inside a chart already are left alone.
  void write_border(Texel* pixels, std::uint16_t* owners);
};

template <typename Texel>
Texel* TexelBatch<Texel>::make_room(const TexelTriangle& p, int width_px, int height_px) {
  const auto [x0, x1] = std::minmax({p[0].x, p[1].x, p[2].x});
  const auto [y0, y1] = std::minmax({p[0].y, p[1].y, p[2].y});
  const auto n_rows = static_cast<std::size_t>(std::min(float(height_px), y1 - y0)) + 2;
  const auto n = n_rows * (static_cast<std::size_t>(std::min(float(width_px), x1 - x0)) + 2) + 8;
  if (spans.size() < n_spans + n_rows) spans.resize(2 * (n_spans + n_rows));
  if (values.size() < n_values + n) {
    values.resize(2 * (n_values + n));
    x.resize(values.size()), y.resize(values.size());
  }
  return values.data() + n_values;
}

template <typename Texel>
void TexelBatch<Texel>::sample(const View<Texel>& image) {
  for (const Run& run : runs) {
    // sample_points() may write beyond the run, over values of other spans.
    std::array<Texel, 7> beyond;
    Texel* end = values.data() + run.last;
    std::copy_n(end, beyond.size(), beyond.data());
    sample_points(image, points(run.first), run.last - run.first, values.data() + run.first);
    std::copy_n(beyond.data(), beyond.size(), end);
  }
}

template <typename Texel>
void TexelBatch<Texel>::write_inside(Texel* pixels) {
  const Texel* value = values.data();
  for (const TexelSpan& span : std::span(spans).first(n_spans)) {
    copy_texels(value, span.n, pixels + span.offset);
    value += span.n;
  }
  n_texels += n_values;
}

template <typename Texel>
void TexelBatch<Texel>::write_border(Texel* pixels, std::uint16_t* owners) {
  const Texel* value = values.data();
  for (const TexelSpan& span : std::span(spans).first(n_spans)) {
    std::uint16_t* owner = owners + span.offset;
    Texel* texel = pixels + span.offset;
    const bool is_inside = span.owner & kInsideChart;
    for (int k = 0; k < span.n; ++k, ++value) {
      if (owner[k] & kInsideChart) {
        n_conflicts += is_inside;
        continue;
      }
      texel[k] = *value;
      owner[k] = span.owner;
    }
    if (is_inside) n_texels += std::size_t(span.n);
  }
}

}  // namespace viewcell
