#include "base/version.h"

namespace viewcell {

const char* version() {
  return VIEWCELL_VERSION;
}

}  // namespace viewcell
