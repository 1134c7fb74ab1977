// What would make a texture follow better, where it is not so already.
#pragma once

#include <string>

#include "pm/progressive_mesh.h"

namespace viewcell {

/// " (pmesh build --no-folds ...)", or "" where the progressive mesh was built so, or none of the
/// steps that adapt nothing is a fold.
std::string advise_no_folds(const ProgressiveRecord& record, std::size_t n_folded);
std::string advise_charts_apart(const ProgressiveRecord& record);

/// Why a base has more faces than were asked for, where charts are the reason: each keeps one.
std::string explain_base(std::size_t n_base, std::size_t n_charts);

}  // namespace viewcell
