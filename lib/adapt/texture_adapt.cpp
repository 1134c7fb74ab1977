#include "adapt/texture_adapt.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "adapt/adapt_packs.h"
#include "adapt/gutter_strip.h"
#include "adapt/texel_affine.h"
#include "adapt/texel_batch.h"
#include "adapt/texel_owners.h"
#include "base/large_vector.h"
#include "base/parallel.h"
#include "image/chart_reach.h"

namespace viewcell {

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
    for (int x = 0; x < width_px_; ++x)
      own_u_.push_back(own_texcoords(x, 0, width_px_, height_px_).x);
    for (int y = 0; y < height_px_; ++y)
      own_v_.push_back(own_texcoords(0, y, width_px_, height_px_).y);
    threads_.resize(static_cast<std::size_t>(options_.n_threads));
  }

  void go_to(std::size_t n_collapsed);

  const AdaptationLog& log_;
  // Rows are one line of the cache longer than the image: of a power of two, all rows of a star
  // would compete for the same few sets of it.
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
  using Batch = TexelBatch<Texel>;
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
  glm::vec2 texel_position(const glm::vec2& uv) const {
    return to_texels(uv, width_px_, height_px_);
  }
  void fetch(std::size_t step) const;
  bool meets_others(const Adaptation& adaptation, const Batch& batch) const;
  void adapt(std::size_t step, bool is_collapse, Batch& batch);
  void gather_cell(const Cell& cell, Batch& batch) const;
  void add_source_points(const Cell& cell, Batch& batch) const;
  void gather_gutter(const Cell& cell, std::size_t k, Batch& batch) const;
  void release(const Adaptation& adaptation, const Batch& batch);
  void mark_tiles(const Adaptation& adaptation, const Batch& batch);

  std::vector<Batch> threads_;
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
  for (Batch& batch : threads_) {
    counts_.n_texels += std::exchange(batch.n_texels, 0);
    counts_.n_conflicts += std::exchange(batch.n_conflicts, 0);
  }
}

// Prefetches the texels of a star, which may lie anywhere in the map.
template <typename Texel>
void TextureAdapter<Texel>::Engine::fetch(std::size_t step) const {
  glm::vec2 lo(1e30f), hi(-1e30f);
  for (const AdaptationPoint& point : log_.of(step).points) {
    const glm::vec2 p = texel_position(point.before);
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
                                                 const Batch& batch) const {
  glm::vec2 lo(1e30f), hi(-1e30f);
  for (const glm::vec2& p : batch.from) lo = glm::min(lo, p), hi = glm::max(hi, p);
  lo -= float{kGutterReach}, hi += float{kGutterReach};
  return std::any_of(
      adaptation.triangles.begin(), adaptation.triangles.end(),
      [&](const AdaptationTriangle& t) { return tiles_.has_others(lo, hi, owner_name(t.chart)); });
}

template <typename Texel>
void TextureAdapter<Texel>::Engine::adapt(std::size_t step, bool is_collapse, Batch& batch) {
  const Adaptation adaptation = log_.of(step);
  batch.clear();
  batch.from.resize(adaptation.points.size()), batch.to.resize(adaptation.points.size());
  glm::vec2* before = is_collapse ? batch.from.data() : batch.to.data();
  glm::vec2* after = is_collapse ? batch.to.data() : batch.from.data();
  for (const AdaptationPoint& point : adaptation.points)
    *before++ = texel_position(point.before), *after++ = texel_position(point.after);
  bool has_border = false;
  Cell cell;
  cell.from_points = batch.from.data(), cell.to_points = batch.to.data();
  cell.is_guarded = log_.n_charts > 1 && meets_others(adaptation, batch);
  const auto visit_cells = [&](auto&& visit) {
    for (const AdaptationTriangle& t : adaptation.triangles) {
      cell.corners = t.corners;
      cell.name = owner_name(t.chart);
      cell.is_original = kIsIndex<Texel> && !is_collapse && t.is_original();
      visit(t);
    }
  };
  visit_cells([&](const AdaptationTriangle& t) {
    cell.is_original || cell.is_guarded ? gather_cell(cell, batch) : add_source_points(cell, batch);
    has_border = has_border || t.has_border();
  });
  batch.sample(view());
  if (!has_border) return batch.write_inside(pixels_.data());
  visit_cells([&](const AdaptationTriangle& t) {
    for (std::size_t k = 0; k < 3; ++k)
      if (t.is_border(k)) gather_gutter(cell, k, batch);
  });
  release(adaptation, batch);
  batch.write_border(pixels_.data(), owners_.data());
  mark_tiles(adaptation, batch);
}

// Adds the points that the texels of a cell are sampled at. All cells of a star are sampled
// together: rows are short, and their ends cost more than what is between.
template <typename Texel>
void TextureAdapter<Texel>::Engine::add_source_points(const Cell& cell, Batch& batch) const {
  const TexelTriangle to = cell.to();
  const TexelAffine source = make_affine(to, cell.from());
  batch.make_room(to, width_px_, height_px_);
  std::size_t at = batch.n_values;
  TexelSpan* span = batch.spans.data() + batch.n_spans;
  const SamplePoints points = batch.points(0);
  const auto owner = static_cast<std::uint16_t>(kInsideChart | cell.name);
  for_each_row(
      to, width_px_, height_px_, [&](int x0, int x1, int y) __attribute__((always_inline)) {
        const int n = std::max(x1 - x0, 0);
        *span = {static_cast<std::uint32_t>(offset(x0, y)), static_cast<std::uint16_t>(n), owner};
        span += n > 0;
        fill_line(source(glm::vec2(x0, y)), source.x, n, {points.x + at, points.y + at});
        at += static_cast<std::size_t>(n);
      });
  batch.add_run(batch.n_values, at);
  batch.n_values = at;
  batch.n_spans = static_cast<std::size_t>(span - batch.spans.data());
}

template <typename Texel>
void TextureAdapter<Texel>::Engine::gather_cell(const Cell& cell, Batch& batch) const {
  const int w = width_px_, h = height_px_;
  const TexelTriangle to = cell.to();
  const TexelAffine source = make_affine(to, cell.from());
  Texel* values = batch.make_room(to, w, h);
  TexelSpan* span = batch.spans.data() + batch.n_spans;
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
  batch.n_values = static_cast<std::size_t>(values - batch.values.data());
  batch.n_spans = static_cast<std::size_t>(span - batch.spans.data());
}

// The strip beyond the edge from corner k to the next, continued from the cell.
template <typename Texel>
void TextureAdapter<Texel>::Engine::gather_gutter(const Cell& cell, std::size_t k,
                                                  Batch& batch) const {
  const int w = width_px_, h = height_px_;
  const TexelTriangle from = cell.from(), to = cell.to();
  const TexelAffine source = make_affine(to, from);
  const GutterStrip strip = make_gutter_strip(from, to, k);
  if (strip.is_empty) return;
  for (const TexelTriangle& half : strip.halves) {
    batch.make_room(half, w, h);
    for_each_span(half, w, h, [&](int x0, int x1, int y) {
      batch.add_span({static_cast<std::uint32_t>(offset(x0, y)),
                      static_cast<std::uint16_t>(x1 - x0), cell.name});
      Texel* values = batch.values.data() + batch.n_values;
      batch.n_values += static_cast<std::size_t>(x1 - x0);
      if (cell.is_original) return fill_own(x0, y, x1 - x0, values);
      for (int x = x0; x < x1; ++x, ++values)
        store(sample_own(view(), owners_.data(), cell.name, strip.limit(source(glm::vec2(x, y)))),
              *values);
    });
  }
}

// The texels of the star lose their owner until they are written again.
template <typename Texel>
void TextureAdapter<Texel>::Engine::release(const Adaptation& adaptation, const Batch& batch) {
  for (const AdaptationTriangle& t : adaptation.triangles)
    for_each_span(
        TexelTriangle{batch.from[t.corners[0]], batch.from[t.corners[1]], batch.from[t.corners[2]]},
        width_px_, height_px_, [&](int x0, int x1, int y) {
          std::uint16_t* owner = &owners_[offset(x0, y)];
          for (int k = 0; k < x1 - x0; ++k)
            if (owner[k] == (kInsideChart | owner_name(t.chart))) owner[k] = 0;
        });
}

template <typename Texel>
void TextureAdapter<Texel>::Engine::mark_tiles(const Adaptation& adaptation, const Batch& batch) {
  for (const AdaptationTriangle& t : adaptation.triangles) {
    glm::vec2 lo(1e30f), hi(-1e30f);
    for (const std::uint16_t corner : t.corners)
      lo = glm::min(lo, batch.to[corner]), hi = glm::max(hi, batch.to[corner]);
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
      store(load(own_texcoords(x, y, width_px, height_px)), map.at(x, y));
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
