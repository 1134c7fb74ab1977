#include "pm/wedge_mesh.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "base/error.h"

namespace viewcell {
namespace {

// Vertices of the file at one position get the first one's id.
std::vector<std::uint32_t> weld(const std::vector<glm::vec3>& positions) {
  const auto key = [&](std::uint32_t v) {
    const glm::vec3& p = positions[v];
    return std::tuple(p.x, p.y, p.z, v);
  };
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::vector<std::uint32_t> first(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_same = i > 0 && positions[order[i]] == positions[order[i - 1]];
    first[order[i]] = is_same ? first[order[i - 1]] : order[i];
  }
  return first;
}

// Wedges of the faces' corners; the first texture coordinates met at a vertex of the file are those
// of the wedge with its number.
void add_texcoords(const TriMesh& mesh, WedgeMesh& out) {
  constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<std::uint32_t> next(mesh.positions.size(), kNone);  // wedge -> next of its vertex
  std::vector<bool> is_met(mesh.positions.size(), false);
  out.texcoords.assign(mesh.positions.size(), glm::vec2(0));
  const auto wedge_of = [&](std::uint32_t source, const glm::vec2& uv) {
    if (!is_met[source]) out.texcoords[source] = uv;
    is_met[source] = true;
    std::uint32_t w = source;
    while (out.texcoords[w] != uv && next[w] != kNone) w = next[w];
    if (out.texcoords[w] == uv) return w;
    const auto made = static_cast<std::uint32_t>(out.n_wedges());
    next[w] = made;
    next.push_back(kNone);
    out.texcoords.push_back(uv);
    out.wedge_source.push_back(source);
    out.wedge_vertex.push_back(out.wedge_vertex[source]);
    return made;
  };
  for (std::size_t f = 0; f < out.faces.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k)
      out.faces[f][k] =
          wedge_of(out.faces[f][k], mesh.texcoords[3 * std::size_t{out.face_source[f]} + k]);
}

}  // namespace

std::vector<Triangle> WedgeMesh::vertex_triangles() const {
  std::vector<Triangle> out(faces);
  for (Triangle& face : out)
    for (std::uint32_t& w : face) w = wedge_vertex[w];
  return out;
}

WedgeMesh make_wedges(const TriMesh& mesh) {
  WedgeMesh out;
  out.positions = mesh.positions;
  out.wedge_vertex = weld(mesh.positions);
  out.wedge_source.resize(mesh.positions.size());
  std::iota(out.wedge_source.begin(), out.wedge_source.end(), 0u);
  const auto n = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::uint32_t v = 0; v < n; ++v) out.n_welded += out.wedge_vertex[v] != v;
  const auto& vertex = out.wedge_vertex;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    if (vertex[a] == vertex[b] || vertex[b] == vertex[c] || vertex[c] == vertex[a]) {
      ++out.n_dropped;
      continue;
    }
    out.faces.push_back(mesh.triangles[t]);
    out.face_source.push_back(t);
  }
  if (!mesh.texcoords.empty()) add_texcoords(mesh, out);
  return out;
}

WedgeTable::WedgeTable(const WedgeMesh& mesh) : has_charts_(!mesh.texcoords.empty()) {
  corners_.reserve(3 * mesh.faces.size());
  for (const Triangle& face : mesh.faces) corners_.insert(corners_.end(), face.begin(), face.end());
}

bool WedgeTable::add_pair(const Pair& pair, bool full) {
  for (const Pair& p : pairs_) {
    if (p.from == pair.from) return !has_charts_ || p.to == pair.to;
    if (full && has_charts_ && p.to == pair.to) return false;
  }
  pairs_.push_back(pair);
  return true;
}

// Wedges of u at triangles that live on only.
void WedgeTable::pair_rest(const CollapseMesh& mesh, std::uint32_t u) {
  mesh.for_each_corner(u, [&](std::uint32_t c) {
    if (!pairs_.empty()) add_pair({corners_[c], pairs_[0].to}, false);
  });
}

bool WedgeTable::match(const CollapseMesh& mesh, std::uint32_t u, std::uint32_t v, bool full) {
  pairs_.clear();
  bool fits = true;
  mesh.for_each_corner(u, [&](std::uint32_t c) {
    const std::uint32_t t = 3 * (c / 3);
    for (std::uint32_t other = t; other < t + 3; ++other)
      if (mesh.vertex_at(other) == v) fits = fits && add_pair({corners_[c], corners_[other]}, full);
  });
  if (!has_charts_) {
    pair_rest(mesh, u);
    return true;
  }
  const auto all_met = [&](std::uint32_t vertex, std::uint32_t Pair::*side) {
    mesh.for_each_corner(vertex, [&](std::uint32_t c) {
      fits = fits && std::any_of(pairs_.begin(), pairs_.end(),
                                 [&](const Pair& p) { return p.*side == corners_[c]; });
    });
  };
  all_met(u, &Pair::from);
  if (full) all_met(v, &Pair::to);
  return fits;
}

void WedgeTable::apply(const CollapseTrace& trace) {
  for (const std::uint32_t c : trace.moved) {
    const auto found = std::find_if(pairs_.begin(), pairs_.end(),
                                    [&](const Pair& p) { return p.from == corners_[c]; });
    VIEWCELL_CHECK(found != pairs_.end(), c);
    corners_[c] = found->to;
  }
}

}  // namespace viewcell
