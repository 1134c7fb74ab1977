// What stands for full in the colours of a file: formats and programs differ.
#pragma once

namespace viewcell {

/// most: the largest of all channels. Colours of [0, 1] may pass 1 a little, by light or rounding.
inline float full_color(float most) {
  constexpr float kMostOfOne = 2, kMostOfBytes = 255, kMostOfShorts = 65535;
  if (most <= kMostOfOne) return 1;
  return most <= kMostOfBytes ? kMostOfBytes : most <= kMostOfShorts ? kMostOfShorts : most;
}

}  // namespace viewcell
