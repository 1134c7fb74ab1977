// GL memory for textures: one buffer of texels, from which centres take ranges.
#pragma once

#include <map>
#include <optional>

#include "gl/objects.h"
#include "image/image.h"

namespace viewcell {

/// A buffer texture of RGBA8 texels with first-fit ranges. Linear memory fits crops of any size
/// without waste, and the four fetches of a guarded lookup need no 2D addressing.
class TexelPool {
 public:
  TexelPool(const Gl& gl, std::uint32_t n_texels);
  /// The first texel of a free range of n, or nothing when no range is long enough.
  std::optional<std::uint32_t> allocate(std::uint32_t n);
  void release(std::uint32_t first);
  void write(std::uint32_t first, const Rgba8* texels, std::uint32_t n);
  GLuint texture() const { return texture_.id(); }
  std::uint32_t n_texels() const { return n_texels_; }
  std::uint32_t n_used() const { return n_used_; }

 private:
  std::uint32_t n_texels_;
  std::uint32_t n_used_ = 0;
  std::map<std::uint32_t, std::uint32_t> used_;  // first -> n
  GlBuffer buffer_;
  GlTexture texture_;
};

}  // namespace viewcell
