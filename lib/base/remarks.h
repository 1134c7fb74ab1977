// What a reader passed over, took on trust or did on the side: said once, with a count.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace viewcell {

/// "faces of fewer than three corners, left out", 3 times.
struct Remark {
  std::string what;
  std::size_t count = 0;
};

/// Remarks in the order in which they first came; the counts of equal ones are summed.
using Remarks = std::vector<Remark>;

/// Those on one of several files.
struct FileRemarks {
  std::filesystem::path file;
  Remarks remarks;
};

/// O(kinds of remarks): collect counts first where there may be many. to null: nobody wants them.
inline void add_remark(Remarks* to, const std::string& what, std::size_t count = 1) {
  if (to == nullptr || count == 0) return;
  const auto found =
      std::find_if(to->begin(), to->end(), [&](const Remark& r) { return r.what == what; });
  if (found == to->end())
    to->push_back({what, count});
  else
    found->count += count;
}

}  // namespace viewcell
