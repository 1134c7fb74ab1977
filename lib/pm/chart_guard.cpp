#include "pm/chart_guard.h"

#include <algorithm>
#include <cmath>
#include <glm/gtx/exterior_product.hpp>

#include "image/chart_reach.h"
#include "image/owner_map.h"

namespace viewcell {
namespace {

double area(const TexelTriangle& p) {
  const glm::dvec2 a(p[0]);
  return std::abs(glm::cross(glm::dvec2(p[1]) - a, glm::dvec2(p[2]) - a)) / 2;
}

}  // namespace

ChartGuard::ChartGuard(const WedgeMesh& mesh, int size_px)
    : charts_(find_joined_charts(mesh).of), owners_(size_px, size_px), stamps_(size_px, size_px) {
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    Face face{{}, charts_[f] + 1};
    for (std::size_t k = 0; k < 3; ++k)
      face.corners[k] = to_texels(mesh.texcoords[mesh.faces[f][k]], size_px, size_px);
    claim_texels(face.corners, face.owner, owners_);
  }
}

template <typename Visit>
void ChartGuard::for_each_texel(const Face& face, Visit&& visit) const {
  for_each_span(face.corners, owners_.width_px, owners_.height_px, [&](int x0, int x1, int y) {
    for (int x = x0; x < x1; ++x) visit(x, y);
  });
}

// The faces of a vertex that moves; those of both vertices are gathered with the child's.
void ChartGuard::gather(const CollapseMesh& mesh, const WedgeTable& wedges,
                        std::span<const glm::vec2> texcoords, std::uint32_t moved,
                        std::uint32_t other, bool is_parent, std::span<const glm::vec2> merged) {
  const int size_px = owners_.width_px;
  mesh.for_each_corner(moved, [&](std::uint32_t c) {
    Face face{{}, charts_[c / 3] + 1};
    bool dies = false;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t corner = 3 * (c / 3) + k;
      dies = dies || mesh.vertex_at(corner) == other;
      face.corners[k] = to_texels(texcoords[wedges.at(corner)], size_px, size_px);
    }
    if (dies && is_parent) return;
    const auto& pairs = wedges.pairs();
    const auto is_met = [&](const WedgeTable::Pair& p) {
      return wedges.chart_vertex(is_parent ? p.to : p.from) == wedges.chart_vertex(wedges.at(c));
    };
    while (face.pair < pairs.size() && !is_met(pairs[face.pair])) ++face.pair;
    before_.push_back(face);
    if (dies) return;
    if (face.pair < merged.size())
      face.corners[c % 3] = to_texels(merged[face.pair], size_px, size_px);
    after_.push_back(face);
  });
}

// Where no border of a chart bends, the star covers the same part of the texture as before.
bool ChartGuard::keeps_areas(std::size_t n_pairs) const {
  constexpr double kRounding = 1e-6;
  std::vector<double> before(n_pairs + 1), change(n_pairs + 1);
  for (const Face& face : before_)
    before[face.pair] += area(face.corners), change[face.pair] -= area(face.corners);
  for (const Face& face : after_) change[face.pair] += area(face.corners);
  for (std::size_t i = 0; i <= n_pairs; ++i)
    if (std::abs(change[i]) > kRounding * before[i]) return false;
  return true;
}

bool ChartGuard::comes_near_others(const Face& face) const {
  bool found = false;
  for_each_texel(face, [&](int x, int y) {
    if (!found && stamps_.at(x, y) != stamp_)
      found = is_near_others(owners_, x, y, face.owner, kFetchReach);
  });
  return found;
}

bool ChartGuard::overlaps(const CollapseMesh& mesh, const WedgeTable& wedges,
                          std::span<const glm::vec2> texcoords, std::uint32_t u, std::uint32_t v,
                          std::span<const glm::vec2> merged, bool full) {
  before_.clear(), after_.clear();
  gather(mesh, wedges, texcoords, u, v, false, merged);
  if (full) gather(mesh, wedges, texcoords, v, u, true, merged);
  if (keeps_areas(wedges.pairs().size())) {
    before_.clear(), after_.clear();
    return false;
  }
  ++stamp_;
  for (const Face& face : before_)
    for_each_texel(face, [&](int x, int y) { stamps_.at(x, y) = stamp_; });
  return std::any_of(after_.begin(), after_.end(),
                     [&](const Face& face) { return comes_near_others(face); });
}

void ChartGuard::accept() {
  for (const Face& face : before_) release_texels(face.corners, face.owner, owners_);
  for (const Face& face : after_) claim_texels(face.corners, face.owner, owners_);
  before_.clear(), after_.clear();
}

}  // namespace viewcell
