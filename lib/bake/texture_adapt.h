// Indexing maps: texture coordinates of the original texture, which follow the collapses of a mesh.
#pragma once

#include <span>
#include <vector>

#include "image/index_map.h"
#include "pm/adaptation.h"

namespace viewcell {

/// Every texel holds its own place [Chen06 3.2.4].
IndexMap make_index_map(int width_px, int height_px);

/// Takes a map through the collapses of a log, one at a time, by bilinear samples. Texels whose
/// centre lies in no cell stay. Follows: [Chen06 3.2.3].
class TextureAdapter {
 public:
  struct Counts {
    std::size_t n_adaptations = 0, n_texels = 0;
  };

  /// From before the collapse to after it, or back.
  void collapse(IndexMap& map, std::span<const TexturePair> pairs) { adapt(map, pairs, true); }
  void split(IndexMap& map, std::span<const TexturePair> pairs) { adapt(map, pairs, false); }
  const Counts& counts() const { return counts_; }

 private:
  struct Sample {
    std::size_t texel;
    glm::vec2 value;
  };
  void adapt(IndexMap& map, std::span<const TexturePair> pairs, bool is_collapse);

  std::vector<Sample> samples_;  // of one adaptation, until all are taken
  Counts counts_;
};

/// The texture as an index map shows it: an ordinary texture of the map's size.
ImageRgba8 bake_texture(const IndexMap& map, const ImageRgba8& texture);

}  // namespace viewcell
