// Textures, and indexing maps used instead of them, that follow the collapses of a progressive
// mesh.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "adapt/adaptation.h"
#include "image/index_map.h"

namespace viewcell {

/// Coordinates of less precision: whole numbers / 65535, / 255, and 16-bit floats.
struct Unorm16Texel {
  std::array<std::uint16_t, 2> uv;
};
struct Unorm8Texel {
  std::array<std::uint8_t, 2> uv;
};
struct HalfTexel {
  std::array<std::uint16_t, 2> uv;
};

/// The identity: every texel holds its own texture coordinates [Chen06 3.2.4]. Texel: glm::vec2 or
/// one of the above.
template <typename Texel>
Image<Texel> make_index_map(int width_px, int height_px);
/// Exact.
template <typename Texel>
IndexMap float_from(const Image<Texel>& map);
/// Rounded.
template <typename Texel>
Image<Texel> from_float(const IndexMap& map);

struct AdaptOptions {
  int n_threads = 0;  ///< 0: all; the result does not depend on it
  bool pack = true;   ///< disjoint collapses in parallel; false: one after another
};

struct AdaptCounts {
  std::size_t n_adaptations = 0;
  std::size_t n_packs = 0;      ///< groups of disjoint adaptations, made in parallel
  std::size_t n_texels = 0;     ///< written inside charts
  std::size_t n_conflicts = 0;  ///< texels of another chart that a chart grew over
};

/// A texture at some level of a progressive mesh, which follows it both ways. Texel: glm::vec2 and
/// its like for an indexing map, Rgba8 for the texture itself, which blurs more.
///
/// Each texel of a star whose centre lies in an overlay cell is sampled, bilinearly, where the
/// point was before; all others stay. A split writes faces that are as in the finest mesh from the
/// original instead of sampling them (indexing maps only), so after all splits the map is exactly
/// the original. Around charts kGutter texels are continued beyond the border; samples take texels
/// of their own chart alone. Follows: [Chen06 3.2.3, 3.3]. Differs: gutters, and charts kept apart.
template <typename Texel>
class TextureAdapter {
 public:
  /// image, charts: as they are after n_collapsed collapses of the log, which is kept by reference.
  TextureAdapter(const AdaptationLog& log, const Image<Texel>& image, const LevelCharts& charts,
                 std::size_t n_collapsed = 0, const AdaptOptions& options = {});
  ~TextureAdapter();
  TextureAdapter(TextureAdapter&&) noexcept;

  /// Collapses or splits until just the first n_collapsed collapses are made.
  void go_to(std::size_t n_collapsed);

  std::size_t n_collapsed() const;
  Image<Texel> image() const;  ///< a copy
  /// Per texel 0 outside of all charts, and chart + 1 inside.
  bool is_inside(std::size_t texel) const;
  const AdaptCounts& counts() const;

 private:
  class Engine;
  std::unique_ptr<Engine> engine_;
};

}  // namespace viewcell
