#include "pm/collapse_mesh.h"

#include <utility>

namespace viewcell {
namespace {

LargeVector<std::uint32_t> flatten(std::span<const Triangle> triangles) {
  LargeVector<std::uint32_t> out;
  out.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) out.insert(out.end(), t.begin(), t.end());
  return out;
}

// The triangles that stand in lists: no points and edges, no copies.
std::vector<bool> find_sheet(std::span<const Triangle> triangles, const FaceCopies& copies) {
  std::vector<bool> out(triangles.size(), false);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto [a, b, c] = triangles[t];
    out[t] = a != b && b != c && c != a && (copies.empty() || !copies.is_copy[t]);
  }
  return out;
}

Triangle triangle_at(const LargeVector<std::uint32_t>& vertices, std::uint32_t t) {
  return {vertices[3 * t], vertices[3 * t + 1], vertices[3 * t + 2]};
}

}  // namespace

CollapseMesh::CollapseMesh(std::span<const glm::vec3> positions,
                           std::span<const Triangle> triangles, FaceCopies copies)
    : positions_(positions),
      vertices_(flatten(triangles)),
      copies_(std::move(copies)),
      lists_(vertices_, find_sheet(triangles, copies_), positions.size()) {
  for (std::uint32_t t = 0; t < triangles.size(); ++t) n_sheet_ += lists_.is_alive(t);
  n_triangles_ = n_sheet_;
  for (std::size_t t = 0; t < copies_.is_copy.size(); ++t) {
    n_triangles_ += copies_.is_copy[t];
    if (copies_.is_copy[t]) lists_.revive(static_cast<std::uint32_t>(t));
  }
  if (!lists_.has_hubs()) return;
  for (std::uint32_t v = 0; v < positions.size(); ++v)
    if (lists_.is_hub(v)) set_hub(v, true);
}

// v has become a hub, or is one no more.
void CollapseMesh::set_hub(std::uint32_t v, bool is_hub) {
  const auto for_each = [&](const auto& visit) {
    for (const std::uint32_t c : lists_.visit(v)) visit(triangle_at(vertices_, c / 3));
  };
  is_hub ? links_.start(v, for_each) : links_.end(v, for_each);
}

void CollapseMesh::kill(std::uint32_t corner, CollapseTrace* trace) {
  const std::uint32_t t = corner / 3;
  lists_.kill(t);
  for (std::uint32_t k = 3 * t; k < 3 * t + 3; ++k)
    if (k != corner) lists_.unlink(vertex_at(k), k);
  --n_triangles_, --n_sheet_;
  if (trace) trace->died.push_back(t);
  if (copies_.empty()) return;
  for_each_copy(t, [&](std::uint32_t copy) {
    lists_.kill(copy);
    --n_triangles_;
    if (trace) trace->died.push_back(copy);
  });
}

bool CollapseMesh::is_lone_triangle(std::uint32_t u, std::uint32_t v) const {
  if (lists_.count(u) != 1 || lists_.count(v) != 1) return false;
  bool is_alone = false;
  for_each_triangle(u, [&](std::uint32_t a, std::uint32_t b) {
    is_alone = (a == v && lists_.count(b) == 1) || (b == v && lists_.count(a) == 1);
  });
  return is_alone;
}

void CollapseMesh::move(std::uint32_t corner, std::uint32_t v, CollapseTrace* trace) {
  const std::uint32_t u = std::exchange(vertices_[corner], v);
  if (trace) trace->moved.push_back(corner);
  if (copies_.empty()) return;
  for_each_copy(corner / 3, [&](std::uint32_t copy) {
    const std::uint32_t c = corner_at(copy, u);
    vertices_[c] = v;
    if (trace) trace->moved.push_back(c);
  });
}

void CollapseMesh::collapse(std::uint32_t u, std::uint32_t v, CollapseTrace* trace) {
  if (trace) trace->died.clear(), trace->moved.clear();
  const bool has_hubs = links_.has_hubs();
  if (has_hubs)
    for (const std::uint32_t c : lists_.visit(u)) links_.remove(triangle_at(vertices_, c / 3));
  lists_.merge(u, v, [&](std::uint32_t c) {
    const std::uint32_t t = 3 * (c / 3);
    const bool dies = vertex_at(t) == v || vertex_at(t + 1) == v || vertex_at(t + 2) == v;
    dies ? kill(c, trace) : move(c, v, trace);
    if (has_hubs && !dies) links_.add(triangle_at(vertices_, c / 3));
    return !dies;
  });
  if (has_hubs) {
    links_.forget(u);
    for (const std::uint32_t w : lists_.shrunk()) set_hub(w, false);
  }
  if (lists_.is_hub(v) && !links_.is_hub(v)) set_hub(v, true);
}

void CollapseMesh::remove(std::span<const std::uint32_t> triangles, CollapseTrace& trace) {
  trace.died.assign(triangles.begin(), triangles.end());
  trace.moved.clear();
  for (const std::uint32_t t : triangles) {
    const bool is_copy = !copies_.empty() && copies_.is_copy[t];
    if (links_.has_hubs() && !is_copy) links_.remove(triangle_at(vertices_, t));
    lists_.kill(t);
    --n_triangles_, n_sheet_ -= !is_copy;
  }
  for (const std::uint32_t t : triangles)
    for (std::uint32_t c = 3 * t; c < 3 * t + 3; ++c) {
      lists_.clear(vertices_[c]);
      links_.forget(vertices_[c]);
    }
}

std::vector<std::uint32_t> CollapseMesh::triangle_numbers() const {
  std::vector<std::uint32_t> out;
  out.reserve(n_triangles_);
  for (std::uint32_t t = 0; 3 * t < vertices_.size(); ++t)
    if (lists_.is_alive(t)) out.push_back(t);
  return out;
}

std::vector<Triangle> CollapseMesh::triangles() const {
  std::vector<Triangle> out;
  out.reserve(n_triangles_);
  for (std::uint32_t t = 0; 3 * t < vertices_.size(); ++t)
    if (lists_.is_alive(t)) out.push_back(triangle_at(vertices_, t));
  return out;
}

}  // namespace viewcell
