// The reasons for which collapses are refused.
#pragma once

namespace viewcell {

/// Why a collapse was refused.
/// - link: the surface's topology would change
/// - boundary: a boundary vertex would leave its boundary
/// - flip: a normal would turn too far
/// - sliver: a triangle would have next to no height
/// - chart: a vertex would leave its texture chart's boundary
/// - fold: a triangle would turn over in the texture
/// - overlap: a texture chart would grow over another
/// - bound: the distance to the input could pass the bound that was asked for
/// - metric: the metric said no
enum class Refusal { none, link, boundary, flip, sliver, chart, fold, overlap, bound, metric };
inline constexpr int kRefusalKinds = 10;
const char* refusal_name(Refusal refusal);

}  // namespace viewcell
