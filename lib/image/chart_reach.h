// How many texels around the charts of a texture matter. All follows from one number: a bilinear
// fetch reads texels less than kFetchReach from where it is made, in x and in y.
#pragma once

namespace viewcell {

inline constexpr int kFetchReach = 1;

/// In x and in y from texels whose centres lie in a chart: what fetches at its border may read. A
/// point at the border is less than kFetchReach from such a texel, and reads as far beyond. Charts
/// with fewer texels between them than this are crowded.
inline constexpr int kGutterReach = 2 * kFetchReach;

/// Of the strip that is drawn along a border, at right angles to it: not less than sqrt(2) *
/// kGutterReach, which is the way to a corner of the square above where the border runs slant.
inline constexpr float kGutter = 3;

/// Straight, where charts are continued by their nearest texels, so that fetches through an
/// indexing map find nothing else: the map of a gutter holds texture coordinates up to kGutter off
/// its chart.
inline constexpr int kContinuedReach = static_cast<int>(kGutter) + kFetchReach;

/// Straight, from a triangle, not from texels in it: fetches at its points read texels less than
/// sqrt(2) * kFetchReach away. The least reach that will do, for this one searches each texel.
inline constexpr double kRimTexels = 1.5;

}  // namespace viewcell
