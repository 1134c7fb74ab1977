// The vertex of everything that is drawn lit from its own normal.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace viewcell {

struct LitVertex {
  glm::vec3 position;
  std::array<std::int16_t, 4> normal;  ///< of 32767; the fourth is padding
};
static_assert(sizeof(LitVertex) == 20);

/// normal: in the precision that it comes in, in which it is rounded.
template <typename Normal>
LitVertex make_lit_vertex(const glm::vec3& position, const Normal& normal) {
  using Real = typename Normal::value_type;
  const auto quantise = [](Real x) {
    return static_cast<std::int16_t>(std::lround(std::clamp(x, Real(-1), Real(1)) * 32767));
  };
  return {position, {quantise(normal.x), quantise(normal.y), quantise(normal.z), 0}};
}

}  // namespace viewcell
