#include "pm/texture_fold.h"

#include <glm/gtx/exterior_product.hpp>

namespace viewcell {
namespace {

double area2(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c) {
  return glm::cross(glm::dvec2(b) - glm::dvec2(a), glm::dvec2(c) - glm::dvec2(a));
}

}  // namespace

bool turns_over_texture(const CollapseMesh& mesh, const WedgeTable& wedges,
                        std::span<const glm::vec2> texcoords, std::uint32_t u, std::uint32_t v,
                        std::span<const glm::vec2> merged, bool full) {
  bool turns = false;
  const auto check_star = [&](std::uint32_t moved, std::uint32_t other, auto side) {
    mesh.for_each_corner(moved, [&](std::uint32_t c) {
      const std::uint32_t t = 3 * (c / 3), a = t + (c + 1 - t) % 3, b = t + (c + 2 - t) % 3;
      if (turns || mesh.vertex_at(a) == other || mesh.vertex_at(b) == other) return;
      const glm::vec2 &at_a = texcoords[wedges.at(a)], &at_b = texcoords[wedges.at(b)];
      const double before = area2(texcoords[wedges.at(c)], at_a, at_b);
      for (std::size_t i = 0; i < merged.size(); ++i) {
        if (wedges.pairs()[i].*side != wedges.at(c)) continue;
        if (before != 0 && !(before * area2(merged[i], at_a, at_b) > 0)) turns = true;
        return;
      }
    });
  };
  check_star(u, v, &WedgeTable::Pair::from);
  if (full) check_star(v, u, &WedgeTable::Pair::to);
  return turns;
}

}  // namespace viewcell
