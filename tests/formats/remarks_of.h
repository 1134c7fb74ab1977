// What a reader said, in tests.
#pragma once

#include <string>

#include "base/remarks.h"

namespace viewcell {

/// The sum of the counts of remarks that begin so.
inline std::size_t count_of(const Remarks& remarks, const std::string& begin) {
  std::size_t n = 0;
  for (const Remark& remark : remarks)
    if (remark.what.starts_with(begin)) n += remark.count;
  return n;
}

}  // namespace viewcell
