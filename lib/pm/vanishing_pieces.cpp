#include "pm/vanishing_pieces.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace viewcell {
namespace {

double area_of(std::span<const glm::vec3> positions, const Triangle& t) {
  const glm::dvec3 a(positions[t[0]]), b(positions[t[1]]), c(positions[t[2]]);
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

double radius(std::span<const glm::vec3> positions, std::span<const Triangle> faces,
              std::span<const std::uint32_t> piece) {
  Box box;
  for (const std::uint32_t f : piece)
    for (const std::uint32_t v : faces[f]) box.add(positions[v]);
  double radius2 = 0;
  for (const std::uint32_t f : piece)
    for (const std::uint32_t v : faces[f]) {
      const glm::dvec3 off = glm::dvec3(positions[v]) - box.centre();
      radius2 = std::max(radius2, glm::dot(off, off));
    }
  return std::sqrt(radius2);
}

}  // namespace

VanishingPieces::VanishingPieces(std::span<const glm::vec3> positions,
                                 std::span<const Triangle> faces, const Charts& pieces,
                                 const VanishOptions& options)
    : faces_(fill_buckets<std::uint32_t>(pieces.size(), [&](const auto& emit) {
        for (std::uint32_t f = 0; f < faces.size(); ++f) emit(pieces.of[f], f);
      })) {
  double whole = 0;
  for (const Triangle& t : faces) whole += area_of(positions, t);
  for (std::uint32_t piece = 0; piece < pieces.size(); ++piece) {
    const auto of = faces_.of(piece);
    double cost = radius(positions, faces, of), part = 0;
    if (options.cost == PieceCost::planes) cost *= std::sqrt(3.0 * static_cast<double>(of.size()));
    for (const std::uint32_t f : of) part += area_of(positions, faces[f]);
    if (options.cost == PieceCost::area && whole > 0) cost *= std::sqrt(part / whole);
    costs_.push_back(static_cast<float>(cost));
  }
  order_.resize(pieces.size());
  std::iota(order_.begin(), order_.end(), 0u);
  std::stable_sort(order_.begin(), order_.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return costs_[a] < costs_[b]; });
  if (!order_.empty()) order_.pop_back();
  const auto is_locked = [&](std::uint32_t piece) {
    for (const std::uint32_t f : faces_.of(piece))
      for (const std::uint32_t v : faces[f])
        if (options.locked[v]) return true;
    return false;
  };
  if (!options.locked.empty()) std::erase_if(order_, is_locked);
  set_cost();
}

void VanishingPieces::set_cost() {
  cost_ = at_ < order_.size() ? costs_[order_[at_]] : std::numeric_limits<float>::infinity();
}

bool VanishingPieces::is_small(const CollapseMesh& mesh, bool is_last) {
  const std::size_t n = mesh.n_triangles();
  if (n_when_large_ > 0 && !is_last && 10 * n > 9 * n_when_large_) return false;
  const bool out = live_faces(mesh).size() <= std::max(kFewFaces, n / 10);
  n_when_large_ = out ? 0 : n;
  return out;
}

std::span<const std::uint32_t> VanishingPieces::live_faces(const CollapseMesh& mesh) {
  live_.clear();
  for (const std::uint32_t f : faces())
    if (mesh.lists().is_alive(f)) live_.push_back(f);
  return live_;
}

void VanishingPieces::pop() {
  ++at_;
  set_cost();
}

}  // namespace viewcell
