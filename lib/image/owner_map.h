// Who owns the texels of a texture: triangles drawn into an image of owners. An owner is a number
// from 1 on, of a triangle or of a chart; 0 is none.
#pragma once

#include <algorithm>
#include <cstdint>

#include "image/image.h"
#include "image/texel_spans.h"

namespace viewcell {

/// Who has a texel whose centre lies in several triangles.
enum class Claim { first_drawn, lowest_owner };

/// Draws one more triangle.
template <typename Owner, typename Real>
void claim_texels(const TexelTriangleOf<Real>& triangle, Owner owner, Image<Owner>& owners,
                  Claim claim = Claim::first_drawn) {
  for_each_span(triangle, owners.width_px, owners.height_px, [&](int x0, int x1, int y) {
    Owner* row = &owners.at(0, y);
    for (int x = x0; x < x1; ++x)
      if (row[x] == 0 || (claim == Claim::lowest_owner && owner < row[x])) row[x] = owner;
  });
}

/// Texels of the triangle that are the owner's get no owner.
template <typename Owner, typename Real>
void release_texels(const TexelTriangleOf<Real>& triangle, Owner owner, Image<Owner>& owners) {
  for_each_span(triangle, owners.width_px, owners.height_px, [&](int x0, int x1, int y) {
    Owner* row = &owners.at(0, y);
    for (int x = x0; x < x1; ++x)
      if (row[x] == owner) row[x] = 0;
  });
}

/// Nobody's texels within reach_px, in x and in y, of others become theirs; of several owners one
/// step away, the greatest's. `inside`: bits that only those have that were there before.
template <typename Owner>
void widen_owners(Image<Owner>& owners, int reach_px, Owner inside = 0) {
  const int w = owners.width_px, h = owners.height_px;
  for (int step = 0; step < reach_px; ++step) {
    const Image<Owner> last = owners;
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        Owner& owner = owners.at(x, y);
        if (owner != 0) continue;
        for (int j = std::max(y - 1, 0); j <= std::min(y + 1, h - 1); ++j)
          for (int i = std::max(x - 1, 0); i <= std::min(x + 1, w - 1); ++i)
            owner = std::max(owner, static_cast<Owner>(last.at(i, j) & ~inside));
      }
  }
}

/// Per texel 1 where it has an owner, else 0.
template <typename Owner>
Image<std::uint8_t> mark_owned(const Image<Owner>& owners) {
  Image<std::uint8_t> out(owners.width_px, owners.height_px);
  for (std::size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] = owners.pixels[i] != 0;
  return out;
}

/// Whether a texel within reach_px, in x and in y, is another owner's.
template <typename Owner>
bool is_near_others(const Image<Owner>& owners, int x, int y, Owner owner, int reach_px) {
  const int x1 = std::min(x + reach_px, owners.width_px - 1);
  const int y1 = std::min(y + reach_px, owners.height_px - 1);
  for (int j = std::max(0, y - reach_px); j <= y1; ++j) {
    const Owner* row = &owners.at(0, j);
    for (int i = std::max(0, x - reach_px); i <= x1; ++i)
      if (row[i] != 0 && row[i] != owner) return true;
  }
  return false;
}

}  // namespace viewcell
