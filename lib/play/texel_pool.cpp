#include "play/texel_pool.h"

#include "base/error.h"

namespace viewcell {

TexelPool::TexelPool(const Gl& gl, std::uint32_t n_texels)
    : n_texels_(n_texels),
      buffer_(gl, sizeof(Rgba8) * static_cast<std::size_t>(n_texels), nullptr,
              GL_DYNAMIC_STORAGE_BIT),
      texture_(GlTexture::make_buffer_texture(gl, GL_RGBA8, buffer_)) {}

std::optional<std::uint32_t> TexelPool::allocate(std::uint32_t n) {
  std::uint32_t start = 0;
  const auto take = [&]() -> std::optional<std::uint32_t> {
    used_[start] = n;
    n_used_ += n;
    return start;
  };
  for (const auto& [first, length] : used_) {
    if (first - start >= n) return take();
    start = first + length;
  }
  if (n_texels_ - start >= n) return take();
  return {};
}

void TexelPool::release(std::uint32_t first) {
  const auto found = used_.find(first);
  VIEWCELL_CHECK(found != used_.end(), first);
  n_used_ -= found->second;
  used_.erase(found);
}

void TexelPool::write(std::uint32_t first, const Rgba8* texels, std::uint32_t n) {
  buffer_.write(sizeof(Rgba8) * static_cast<std::size_t>(first), sizeof(Rgba8) * std::size_t{n},
                texels);
}

}  // namespace viewcell
