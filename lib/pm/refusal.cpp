#include "pm/refusal.h"

namespace viewcell {

const char* refusal_name(Refusal refusal) {
  constexpr const char* names[kRefusalKinds] = {"none",  "link", "boundary", "flip",  "sliver",
                                                "chart", "fold", "overlap",  "bound", "metric"};
  return names[static_cast<int>(refusal)];
}

}  // namespace viewcell
