// Random implicit figures for property tests.
#pragma once

#include "base/random.h"
#include "park/implicit.h"

namespace viewcell {

inline glm::vec3 random_point(Random& random, double extent) {
  return {random.uniform(-extent, extent), random.uniform(-extent, extent),
          random.uniform(-extent, extent)};
}

inline Solid random_solid(Random& random) {
  const glm::vec3 a = random_point(random, 6), b = random_point(random, 6);
  const auto size = [&] { return static_cast<float>(random.uniform(0.6, 3.5)); };
  const glm::mat3 axes = axes_along(random_point(random, 1) + glm::vec3(0, 0, 2));
  switch (random.below(4)) {
    case 0:
      return make_round_cone(a, size(), b, size());
    case 1:
      return make_ellipsoid(a, {size(), size(), size()}, axes);
    case 2:
      return make_box(a, {size(), size(), size()}, 0.3f, axes);
    default: {
      Solid drum = make_drum(a, size(), a + glm::vec3(0, 0, 1 + size()), size(), 0.2f, {1, 0.8f});
      drum.n_flutes = 5, drum.flute_depth = 0.3f;
      return drum;
    }
  }
}

/// Up to eight limbs of up to four solids; the first is united, some later ones are cut out.
inline Figure random_figure(std::uint64_t seed) {
  Random random(seed);
  Figure figure;
  const std::uint32_t n_limbs = 1 + random.below(8);
  for (std::uint32_t i = 0; i < n_limbs; ++i) {
    std::vector<Solid> solids;
    for (std::uint32_t n = 1 + random.below(4); n > 0; --n) solids.push_back(random_solid(random));
    const auto blend = static_cast<float>(random.uniform(0, 1.5));
    const auto inner = static_cast<float>(random.uniform(0, 0.5));
    if (i > 0 && random.below(3) == 0)
      figure.cut(blend, solids, inner);
    else
      figure.unite(blend, solids, inner);
  }
  return figure;
}

}  // namespace viewcell
