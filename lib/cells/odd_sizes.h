// Objects whose size does not suit the cells: files in other units, most often.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace viewcell {

/// A line a kind of oddity, each with the first object that has it, its figures and how many more:
/// objects larger than kOddTimes times what suits cells of that circumradius (about its 0.8), and
/// than the area; smaller than that part of it; wholly outside the area. Needs the scene's meshes.
std::vector<std::string> find_odd_sizes(const Scene& scene, double cell_size);

/// Feet for inches, and all that is coarser; what is less may be meant.
inline constexpr double kOddTimes = 12;

}  // namespace viewcell
