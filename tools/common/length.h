// A length as it is typed: a number in units of the mesh, or with a % behind it a share of the
// diagonal of the mesh's box.
#pragma once

#include <string>

#include "common/command.h"

namespace viewcell {

struct Length {
  double value = 0;       ///< units of the mesh, or percent
  bool is_share = false;  ///< percent
  double of(double diagonal) const { return is_share ? value / 100 * diagonal : value; }
};

/// A number within [lo, hi], not NaN, and a % behind it or not.
Check length_within(double lo, double hi);
/// Of a word that has passed that check.
Length parse_length(const std::string& word);

}  // namespace viewcell
