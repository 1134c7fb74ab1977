#include "pm/hub_links.h"

#include <algorithm>

namespace viewcell {

HubLinks::Key HubLinks::key(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  Key out{a, b, c};
  std::sort(out.begin(), out.end());
  return out;
}

void HubLinks::change(const Key& at, int by) {
  const auto found = counts_.try_emplace(at, 0).first;
  found->second += by;
  if (found->second == 0) counts_.erase(found);
}

// What the hubs among its corners have in common by it.
void HubLinks::count(const Triangle& t, int by) {
  const bool is[3] = {is_hub(t[0]), is_hub(t[1]), is_hub(t[2])};
  for (std::size_t k = 0; k < 3; ++k)
    if (is[k] && is[(k + 1) % 3]) change(key(t[k], t[(k + 1) % 3]), by);
  if (is[0] && is[1] && is[2]) change(key(t[0], t[1], t[2]), by);
}

// What v, one of its corners, has in common with the others.
void HubLinks::count_at(std::uint32_t v, const Triangle& t, int by) {
  std::uint32_t others[3];
  int n = 0;
  for (const std::uint32_t w : t)
    if (w != v && is_hub(w)) others[n++] = w;
  for (int i = 0; i < n; ++i) change(key(v, others[i]), by);
  if (n == 2) change(key(v, others[0], others[1]), by);
}

}  // namespace viewcell
