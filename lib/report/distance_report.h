// Surface distances for people and programs: a report, a table, a mesh in false colours.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "base/json.h"
#include "mesh/surface_distance.h"

namespace viewcell {

/// {"forward", "backward", "symmetric", "samples", "bbox_diagonal", "unit_cube", ...};
/// docs/formats.md. Of a point cloud "backward" and "symmetric" are null, and "points" says which.
Json report_surface_distance(const SurfaceDistance& distance, const DistanceOptions& options);

/// A line a direction, where each is largest, and the histogram where there is one.
std::string format_surface_distance(const SurfaceDistance& distance);

/// sRGB, [0, 255]: green at share 0, over yellow to red at 0.5, over magenta to blue at 1 [Chen06
/// 4.3]. Clamped outside.
std::array<std::uint8_t, 3> distance_color(double share);

/// The range [0, forward p99], or where that is 0 [0, forward max].
std::array<double, 2> default_color_range(const SurfaceDistance& distance);

/// A, surface or points, where it is and in its own units, as binary PLY: positions, normals where
/// present (vertices of several are split), float
/// `distance` (in the units of `distance`) and uchar red, green, blue by the range. Whole or not at
/// all.
void write_colored_mesh(const std::filesystem::path& file, const TriMesh& a,
                        const SurfaceDistance& distance, const std::array<double, 2>& range,
                        const std::vector<std::string>& comments);

}  // namespace viewcell
