#include "bake/texture_adapt.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "bake/adapt_packs.h"
#include "bake/texel_affine.h"
#include "bake/texel_owners.h"
#include "bake/texel_samples.h"
#include "base/large_vector.h"
#include "base/parallel.h"

namespace viewcell {
namespace {

glm::vec2 outward(const glm::vec2& edge, bool is_clockwise) {
  const float length = glm::length(edge);
  if (!(length > 0)) return glm::vec2(0);
  return (is_clockwise ? glm::vec2(-edge.y, edge.x) : glm::vec2(edge.y, -edge.x)) / length;
}

float area2(const TexelTriangle& p) {
  const glm::vec2 a = p[1] - p[0], b = p[2] - p[0];
  return a.x * b.y - a.y * b.x;
}

}  // namespace

template <typename Texel>
class TextureAdapter<Texel>::Engine {
 public:
  Engine(const AdaptationLog& log, const Image<Texel>& image, const Image<std::uint16_t>& owners,
         std::size_t n_collapsed, const AdaptOptions& options)
      : log_(log),
        width_px_(image.width_px),
        height_px_(image.height_px),
        pitch_px_(width_px_ + kLine_px),
        pixels_(pitch_px() * static_cast<std::size_t>(height_px_)),
        owners_(pixels_.size()),
        tiles_(owners),
        n_collapsed_(n_collapsed),
        options_(options) {
    if (options_.n_threads <= 0) options_.n_threads = hardware_threads();
    for (int y = 0; y < height_px_; ++y) {
      std::copy_n(&image.at(0, y), width_px_, &pixels_[offset(0, y)]);
      std::copy_n(&owners.at(0, y), width_px_, &owners_[offset(0, y)]);
    }
    for (int x = 0; x < width_px_; ++x) own_u_.push_back(own_place(x, 0, width_px_, height_px_).x);
    for (int y = 0; y < height_px_; ++y) own_v_.push_back(own_place(0, y, width_px_, height_px_).y);
    threads_.resize(static_cast<std::size_t>(options_.n_threads));
  }

  void go_to(std::size_t n_collapsed);

  const AdaptationLog& log_;
  // Rows are one line of the cache longer than the image: of a power of two, all rows of a star
  // would want the same few places in it.
  static constexpr int kLine_px = 64 / sizeof(Texel);
  int width_px_, height_px_, pitch_px_;
  LargeVector<Texel> pixels_;
  std::vector<float> own_u_, own_v_;  // what texels held at first, by column and row
  LargeVector<std::uint16_t> owners_;
  OwnerTiles tiles_;
  std::size_t n_collapsed_;
  AdaptOptions options_;
  AdaptCounts counts_;

  std::size_t offset(int x, int y) const { return view().offset(x, y); }
  std::size_t pitch_px() const { return static_cast<std::size_t>(pitch_px_); }

 private:
  struct Span {
    std::uint32_t offset;
    std::uint16_t n, owner;  // as it will be
  };
  struct Run {
    std::size_t first, last;
  };
  // Memory of one thread, for one adaptation at a time.
  struct Scratch {
    std::vector<glm::vec2> from, to;
    std::vector<Span> spans;  // these sizes are room
    std::vector<Texel> values;
    std::vector<float> x, y;                // where the values are sampled
    std::vector<Run> runs;                  // of values to be sampled
    std::size_t n_spans = 0, n_values = 0;  // in use
    std::size_t n_texels = 0, n_conflicts = 0;

    void add_span(const Span& span) { spans[n_spans++] = span; }
    // For all texels of a triangle and what is written beyond; returns the first's.
    // Of a triangle that reaches far out of the image, for those within.
    Texel* make_room(const TexelTriangle& p, int width_px, int height_px) {
      const auto [x0, x1] = std::minmax({p[0].x, p[1].x, p[2].x});
      const auto [y0, y1] = std::minmax({p[0].y, p[1].y, p[2].y});
      const auto n_rows = static_cast<std::size_t>(std::min(float(height_px), y1 - y0)) + 2;
      const auto n =
          n_rows * (static_cast<std::size_t>(std::min(float(width_px), x1 - x0)) + 2) + 8;
      if (spans.size() < n_spans + n_rows) spans.resize(2 * (n_spans + n_rows));
      if (values.size() < n_values + n) {
        values.resize(2 * (n_values + n));
        x.resize(values.size()), y.resize(values.size());
      }
      return values.data() + n_values;
    }
    Places places(std::size_t first) { return {x.data() + first, y.data() + first}; }
    void add_run(std::size_t first, std::size_t last) {
      if (!runs.empty() && runs.back().last == first)
        runs.back().last = last;
      else
        runs.push_back({first, last});
    }
  };
  struct Cell {  // and how to read it
    const glm::vec2 *from_points, *to_points;
    std::array<std::uint16_t, 3> corners;
    std::uint16_t name;
    bool is_original, is_guarded;

    TexelTriangle of(const glm::vec2* points) const {
      return {points[corners[0]], points[corners[1]], points[corners[2]]};
    }
    TexelTriangle from() const { return of(from_points); }
    TexelTriangle to() const { return of(to_points); }
  };

  void fill_own(int x, int y, int n, Texel* out) const {
    if constexpr (kIsIndex<Texel>)
      for (int k = 0; k < n; ++k)
        store(Float4{own_u_[static_cast<std::size_t>(x + k)], own_v_[static_cast<std::size_t>(y)]},
              out[k]);
  }
  View<Texel> view() const { return {pixels_.data(), width_px_, height_px_, pitch_px_}; }
  glm::vec2 place_of(const glm::vec2& uv) const { return to_texels(uv, width_px_, height_px_); }
  void fetch(std::size_t step) const;
  bool meets_others(const Adaptation& adaptation, const Scratch& scratch) const;
  void adapt(std::size_t step, bool is_collapse, Scratch& scratch);
  void gather_cell(const Cell& cell, Scratch& scratch) const;
  void place_cell(const Cell& cell, Scratch& scratch) const;
  void sample_runs(Scratch& scratch) const;
  void gather_gutter(const Cell& cell, std::size_t k, Scratch& scratch) const;
  void release(const Adaptation& adaptation, const Scratch& scratch);
  void mark_tiles(const Adaptation& adaptation, const Scratch& scratch);
  void write_inside(Scratch& scratch);
  void write_border(Scratch& scratch);

  std::vector<Scratch> threads_;
};

template <typename Texel>
void TextureAdapter<Texel>::Engine::go_to(std::size_t n_collapsed) {
  const bool is_collapse = n_collapsed > n_collapsed_;
  const AdaptPacks packs =
      pack_adaptations(log_, n_collapsed_ * log_.steps_per_collapse,
                       n_collapsed * log_.steps_per_collapse, width_px_, height_px_, options_.pack);
  const int n_threads = options_.pack ? options_.n_threads : 1;
  const auto ahead = static_cast<std::size_t>(n_threads);
  parallel_rounds(packs.first, n_threads, [&](std::size_t i, int thread) {
    if (i + ahead < packs.order.size()) fetch(packs.order[i + ahead]);
    adapt(packs.order[i], is_collapse, threads_[static_cast<std::size_t>(thread)]);
  });
  n_collapsed_ = n_collapsed;
  counts_.n_adaptations += packs.order.size();
  counts_.n_packs += packs.size();
  for (Scratch& scratch : threads_) {
    counts_.n_texels += std::exchange(scratch.n_texels, 0);
    counts_.n_conflicts += std::exchange(scratch.n_conflicts, 0);
  }
}

// The texels of a star come from all over the map: hints that those of one are wanted soon.
template <typename Texel>
void TextureAdapter<Texel>::Engine::fetch(std::size_t step) const {
  glm::vec2 lo(1e30f), hi(-1e30f);
  for (const AdaptationPoint& point : log_.of(step).points) {
    const glm::vec2 p = place_of(point.before);
    lo = glm::min(lo, p), hi = glm::max(hi, p);
  }
  const int x0 = std::clamp(static_cast<int>(lo.x), 0, width_px_ - 1);
  const int x1 = std::clamp(static_cast<int>(hi.x) + 1, 0, width_px_ - 1);
  const int y0 = std::clamp(static_cast<int>(lo.y), 0, height_px_ - 1);
  const int y1 = std::clamp(static_cast<int>(hi.y) + 1, 0, height_px_ - 1);
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; x += kLine_px) __builtin_prefetch(&pixels_[offset(x, y)]);
}

// Whether another chart's texels are so near that a sample may take one.
template <typename Texel>
bool TextureAdapter<Texel>::Engine::meets_others(const Adaptation& adaptation,
                                                 const Scratch& scratch) const {
  glm::vec2 lo(1e30f), hi(-1e30f);
  for (const glm::vec2& p : scratch.from) lo = glm::min(lo, p), hi = glm::max(hi, p);
  return std::any_of(adaptation.triangles.begin(), adaptation.triangles.end(),
                     [&](const AdaptationTriangle& t) {
                       return tiles_.has_others(lo - 2.0f, hi + 2.0f, owner_name(t.chart));
                     });
}

template <typename Texel>
void TextureAdapter<Texel>::Engine::adapt(std::size_t step, bool is_collapse, Scratch& scratch) {
  const Adaptation adaptation = log_.of(step);
  scratch.from.clear(), scratch.to.clear(), scratch.runs.clear();
  scratch.n_spans = scratch.n_values = 0;
  scratch.from.resize(adaptation.points.size()), scratch.to.resize(adaptation.points.size());
  glm::vec2* before = is_collapse ? scratch.from.data() : scratch.to.data();
  glm::vec2* after = is_collapse ? scratch.to.data() : scratch.from.data();
  for (const AdaptationPoint& point : adaptation.points)
    *before++ = place_of(point.before), *after++ = place_of(point.after);
  bool has_border = false;
  Cell cell;
  cell.from_points = scratch.from.data(), cell.to_points = scratch.to.data();
  cell.is_guarded = log_.n_charts > 1 && meets_others(adaptation, scratch);
  const auto visit_cells = [&](auto&& visit) {
    for (const AdaptationTriangle& t : adaptation.triangles) {
      cell.corners = t.corners;
      cell.name = owner_name(t.chart);
      cell.is_original = kIsIndex<Texel> && !is_collapse && t.is_original();
      visit(t);
    }
  };
  visit_cells([&](const AdaptationTriangle& t) {
    cell.is_original || cell.is_guarded ? gather_cell(cell, scratch) : place_cell(cell, scratch);
    has_border = has_border || t.has_border();
  });
  sample_runs(scratch);
  if (!has_border) return write_inside(scratch);
  visit_cells([&](const AdaptationTriangle& t) {
    for (std::size_t k = 0; k < 3; ++k)
      if (t.is_border(k)) gather_gutter(cell, k, scratch);
  });
  release(adaptation, scratch);
  write_border(scratch);
  mark_tiles(adaptation, scratch);
}

// Where the texels of a cell come from. All cells of a star are sampled together: rows are short,
// and their ends cost more than what is between.
template <typename Texel>
void TextureAdapter<Texel>::Engine::place_cell(const Cell& cell, Scratch& scratch) const {
  const TexelTriangle to = cell.to();
  const TexelAffine source = make_affine(to, cell.from());
  scratch.make_room(to, width_px_, height_px_);
  std::size_t at = scratch.n_values;
  Span* span = scratch.spans.data() + scratch.n_spans;
  const Places places = scratch.places(0);
  const auto owner = static_cast<std::uint16_t>(kInsideChart | cell.name);
  for_each_row(
      to, width_px_, height_px_, [&](int x0, int x1, int y) __attribute__((always_inline)) {
        const int n = std::max(x1 - x0, 0);
        *span = {static_cast<std::uint32_t>(offset(x0, y)), static_cast<std::uint16_t>(n), owner};
        span += n > 0;
        place_line(source(glm::vec2(x0, y)), source.x, n, {places.x + at, places.y + at});
        at += static_cast<std::size_t>(n);
      });
  scratch.add_run(scratch.n_values, at);
  scratch.n_values = at;
  scratch.n_spans = static_cast<std::size_t>(span - scratch.spans.data());
}

template <typename Texel>
void TextureAdapter<Texel>::Engine::sample_runs(Scratch& scratch) const {
  for (const Run& run : scratch.runs) {
    // What is written beyond may be somebody's.
    std::array<Texel, 7> beyond;
    Texel* end = scratch.values.data() + run.last;
    std::copy_n(end, beyond.size(), beyond.data());
    sample_places(view(), scratch.places(run.first), run.last - run.first,
                  scratch.values.data() + run.first);
    std::copy_n(beyond.data(), beyond.size(), end);
  }
}

template <typename Texel>
void TextureAdapter<Texel>::Engine::gather_cell(const Cell& cell, Scratch& scratch) const {
  const int w = width_px_, h = height_px_;
  const TexelTriangle to = cell.to();
  const TexelAffine source = make_affine(to, cell.from());
  Texel* values = scratch.make_room(to, w, h);
  Span* span = scratch.spans.data() + scratch.n_spans;
  const auto owner = static_cast<std::uint16_t>(kInsideChart | cell.name);
  for_each_span(
      to, w, h, [&](int x0, int x1, int y) __attribute__((always_inline)) {
        const int n = x1 - x0;
        *span++ = {static_cast<std::uint32_t>(offset(x0, y)), static_cast<std::uint16_t>(n), owner};
        const glm::vec2 start = source(glm::vec2(x0, y));
        if (cell.is_original)
          fill_own(x0, y, n, values);
        else
          for (int k = 0; k < n; ++k)
            store(sample_own(view(), owners_.data(), cell.name, start + float(k) * source.x),
                  values[k]);
        values += n;
      });
  scratch.n_values = static_cast<std::size_t>(values - scratch.values.data());
  scratch.n_spans = static_cast<std::size_t>(span - scratch.spans.data());
}

// The strip beyond the edge from corner k to the next, continued from the cell.
template <typename Texel>
void TextureAdapter<Texel>::Engine::gather_gutter(const Cell& cell, std::size_t k,
                                                  Scratch& scratch) const {
  const int w = width_px_, h = height_px_;
  const TexelTriangle from = cell.from(), to = cell.to();
  const TexelAffine source = make_affine(to, from);
  const glm::vec2 p = to[k], edge = to[(k + 1) % 3] - p;
  const glm::vec2 out = outward(edge, area2(to) < 0);
  const float length = glm::length(edge);
  if (!(length > 0)) return;
  const glm::vec2 along = kGutter / length * edge;
  const std::array<glm::vec2, 4> strip{p - along, p + edge + along,
                                       p + edge + along + kGutter * out, p - along + kGutter * out};
  const glm::vec2 q = from[k], from_edge = from[(k + 1) % 3] - q;
  const glm::vec2 from_out = outward(from_edge, area2(from) < 0);
  const float from_length = glm::length(from_edge);
  const glm::vec2 from_along = from_length > 0 ? from_edge / from_length : glm::vec2(0);
  // No farther from the edge than there are texels of the chart.
  const auto limit = [&](const glm::vec2& at) {
    const float beyond = glm::dot(at - q, from_out), t = glm::dot(at - q, from_along);
    return at - std::max(beyond - kGutter, 0.0f) * from_out +
           (std::clamp(t, -kGutter, from_length + kGutter) - t) * from_along;
  };
  for (const TexelTriangle& half :
       {TexelTriangle{strip[0], strip[1], strip[2]}, {strip[0], strip[2], strip[3]}}) {
    scratch.make_room(half, w, h);
    for_each_span(half, w, h, [&](int x0, int x1, int y) {
      scratch.add_span({static_cast<std::uint32_t>(offset(x0, y)),
                        static_cast<std::uint16_t>(x1 - x0), cell.name});
      Texel* values = scratch.values.data() + scratch.n_values;
      scratch.n_values += static_cast<std::size_t>(x1 - x0);
      if (cell.is_original) return fill_own(x0, y, x1 - x0, values);
      for (int x = x0; x < x1; ++x, ++values)
        store(sample_own(view(), owners_.data(), cell.name, limit(source(glm::vec2(x, y)))),
              *values);
    });
  }
}

// What the star held is no chart's until it is written again.
template <typename Texel>
void TextureAdapter<Texel>::Engine::release(const Adaptation& adaptation, const Scratch& scratch) {
  for (const AdaptationTriangle& t : adaptation.triangles)
    for_each_span(TexelTriangle{scratch.from[t.corners[0]], scratch.from[t.corners[1]],
                                scratch.from[t.corners[2]]},
                  width_px_, height_px_, [&](int x0, int x1, int y) {
                    std::uint16_t* owner = &owners_[offset(x0, y)];
                    for (int k = 0; k < x1 - x0; ++k)
                      if (owner[k] == (kInsideChart | owner_name(t.chart))) owner[k] = 0;
                  });
}

// Inside a chart the star stays the same.
template <typename Texel>
void TextureAdapter<Texel>::Engine::write_inside(Scratch& scratch) {
  const Texel* value = scratch.values.data();
  for (const Span& span : std::span(scratch.spans).first(scratch.n_spans)) {
    Texel* texel = &pixels_[span.offset];
    copy_texels(value, span.n, texel);
    value += span.n;
  }
  scratch.n_texels += scratch.n_values;
}

template <typename Texel>
void TextureAdapter<Texel>::Engine::write_border(Scratch& scratch) {
  const Texel* value = scratch.values.data();
  for (const Span& span : std::span(scratch.spans).first(scratch.n_spans)) {
    std::uint16_t* owner = &owners_[span.offset];
    Texel* texel = &pixels_[span.offset];
    const bool is_inside = span.owner & kInsideChart;
    for (int k = 0; k < span.n; ++k, ++value) {
      if (owner[k] & kInsideChart) {
        scratch.n_conflicts += is_inside;
        continue;
      }
      texel[k] = *value;
      owner[k] = span.owner;
    }
    if (is_inside) scratch.n_texels += std::size_t(span.n);
  }
}

template <typename Texel>
void TextureAdapter<Texel>::Engine::mark_tiles(const Adaptation& adaptation,
                                               const Scratch& scratch) {
  for (const AdaptationTriangle& t : adaptation.triangles) {
    glm::vec2 lo(1e30f), hi(-1e30f);
    for (const std::uint16_t corner : t.corners)
      lo = glm::min(lo, scratch.to[corner]), hi = glm::max(hi, scratch.to[corner]);
    tiles_.mark(lo - kGutter, hi + kGutter, owner_name(t.chart));
  }
}

template <typename Texel>
TextureAdapter<Texel>::TextureAdapter(const AdaptationLog& log, const Image<Texel>& image,
                                      const LevelCharts& charts, std::size_t n_collapsed,
                                      const AdaptOptions& options)
    : engine_(std::make_unique<Engine>(log, image,
                                       make_texel_owners(charts, image.width_px, image.height_px),
                                       n_collapsed, options)) {}

template <typename Texel>
TextureAdapter<Texel>::~TextureAdapter() = default;
template <typename Texel>
TextureAdapter<Texel>::TextureAdapter(TextureAdapter&&) noexcept = default;

template <typename Texel>
void TextureAdapter<Texel>::go_to(std::size_t n_collapsed) {
  engine_->go_to(n_collapsed);
}
template <typename Texel>
std::size_t TextureAdapter<Texel>::n_collapsed() const {
  return engine_->n_collapsed_;
}
template <typename Texel>
Image<Texel> TextureAdapter<Texel>::image() const {
  Image<Texel> out;
  out.width_px = engine_->width_px_, out.height_px = engine_->height_px_;
  out.pixels.resize(static_cast<std::size_t>(out.width_px) *
                    static_cast<std::size_t>(out.height_px));
  for (int y = 0; y < out.height_px; ++y)
    std::copy_n(&engine_->pixels_[engine_->offset(0, y)], out.width_px, &out.at(0, y));
  return out;
}
template <typename Texel>
bool TextureAdapter<Texel>::is_inside(std::size_t texel) const {
  const auto width = static_cast<std::size_t>(engine_->width_px_);
  return engine_->owners_[texel / width * engine_->pitch_px() + texel % width] & kInsideChart;
}
template <typename Texel>
const AdaptCounts& TextureAdapter<Texel>::counts() const {
  return engine_->counts_;
}

template <typename Texel>
Image<Texel> make_index_map(int width_px, int height_px) {
  Image<Texel> map(width_px, height_px);
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x)
      store(load(own_place(x, y, width_px, height_px)), map.at(x, y));
  return map;
}

template <typename Texel>
IndexMap float_from(const Image<Texel>& map) {
  IndexMap out(map.width_px, map.height_px);
  for (std::size_t i = 0; i < map.pixels.size(); ++i) store(load(map.pixels[i]), out.pixels[i]);
  return out;
}

template <typename Texel>
Image<Texel> from_float(const IndexMap& map) {
  Image<Texel> out(map.width_px, map.height_px);
  for (std::size_t i = 0; i < map.pixels.size(); ++i) store(load(map.pixels[i]), out.pixels[i]);
  return out;
}

template class TextureAdapter<glm::vec2>;
template class TextureAdapter<Unorm16Texel>;
template class TextureAdapter<Unorm8Texel>;
template class TextureAdapter<HalfTexel>;
template class TextureAdapter<Rgba8>;
template Image<glm::vec2> make_index_map(int, int);
template Image<Unorm16Texel> make_index_map(int, int);
template Image<Unorm8Texel> make_index_map(int, int);
template Image<HalfTexel> make_index_map(int, int);
template Image<glm::vec2> from_float(const IndexMap&);
template Image<Unorm16Texel> from_float(const IndexMap&);
template Image<Unorm8Texel> from_float(const IndexMap&);
template Image<HalfTexel> from_float(const IndexMap&);
template IndexMap float_from(const Image<glm::vec2>&);
template IndexMap float_from(const Image<Unorm16Texel>&);
template IndexMap float_from(const Image<Unorm8Texel>&);
template IndexMap float_from(const Image<HalfTexel>&);

}  // namespace viewcell
