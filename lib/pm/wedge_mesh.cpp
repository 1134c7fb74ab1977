#include "pm/wedge_mesh.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "base/error.h"

namespace viewcell {
namespace {

// A split's pairs are numbered in a byte.
constexpr std::size_t kMostPairs = 256;

// Of the different texture coordinates at a vertex so many are looked through one by one.
constexpr int kLongChain = 32;

struct WedgeKey {
  std::uint32_t vertex;
  glm::vec2 texcoord;
  bool operator==(const WedgeKey&) const = default;
};
struct WedgeHash {
  std::size_t operator()(const WedgeKey& key) const {
    std::uint64_t h = key.vertex;
    for (const float x : {key.texcoord.x + 0.0f, key.texcoord.y + 0.0f})  // -0 becomes 0
      h = (h ^ (h >> 32) ^ std::bit_cast<std::uint32_t>(x)) * 0x9e3779b97f4a7c15ull;
    return h ^ (h >> 32);
  }
};

// Wedges of the faces' corners; the first texture coordinates met at a vertex of the file are those
// of the wedge with its number.
void add_texcoords(const TriMesh& mesh, WedgeMesh& out) {
  constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<std::uint32_t> next(mesh.positions.size(), kNone);   // wedge -> next of its vertex
  std::unordered_map<WedgeKey, std::uint32_t, WedgeHash> chained;  // beyond the first kLongChain
  std::vector<bool> is_met(mesh.positions.size(), false);
  out.texcoords.assign(mesh.positions.size(), glm::vec2(0));
  const auto wedge_of = [&](std::uint32_t source, const glm::vec2& uv) {
    if (!is_met[source]) out.texcoords[source] = uv;
    is_met[source] = true;
    std::uint32_t w = source;
    int n = 0;
    while (out.texcoords[w] != uv && next[w] != kNone && ++n < kLongChain) w = next[w];
    if (out.texcoords[w] == uv) return w;
    const auto made = static_cast<std::uint32_t>(out.n_wedges());
    if (n == kLongChain) {
      const auto [found, is_new] = chained.try_emplace(WedgeKey{source, uv}, made);
      if (!is_new) return found->second;
    } else {
      next[w] = made;
    }
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

// 21 bits of each coordinate within the box, interleaved [Morton 1966].
std::vector<std::uint64_t> morton_codes(const std::vector<glm::vec3>& positions) {
  Box box;
  for (const glm::vec3& p : positions) box.add(p);
  const glm::dvec3 size = box.size();
  const double longest = std::max({size.x, size.y, size.z});
  const double cells = longest > 0 ? 2097151 / longest : 0;
  const auto spread = [](std::uint64_t x) {
    x = (x | x << 32) & 0x1f00000000ffffull;
    x = (x | x << 16) & 0x1f0000ff0000ffull;
    x = (x | x << 8) & 0x100f00f00f00f00full;
    x = (x | x << 4) & 0x10c30c30c30c30c3ull;
    return (x | x << 2) & 0x1249249249249249ull;
  };
  std::vector<std::uint64_t> codes;
  codes.reserve(positions.size());
  for (const glm::vec3& p : positions) {
    const glm::dvec3 at = (glm::dvec3(p) - box.lo) * cells;
    codes.push_back(spread(static_cast<std::uint64_t>(at.x)) |
                    spread(static_cast<std::uint64_t>(at.y)) << 1 |
                    spread(static_cast<std::uint64_t>(at.z)) << 2);
  }
  return codes;
}

std::vector<std::uint32_t> identity(std::uint32_t n) {
  std::vector<std::uint32_t> out(n);
  std::iota(out.begin(), out.end(), 0u);
  return out;
}

// 0 ... n - 1 by key, then number: sorted by one digit of the key after another, the last one
// first.
template <typename Key>
std::vector<std::uint32_t> sorted_order(const std::vector<Key>& keys) {
  constexpr int kDigitBits = 11;
  const auto n = static_cast<std::uint32_t>(keys.size());
  const Key most = keys.empty() ? 0 : *std::max_element(keys.begin(), keys.end());
  std::vector<std::uint32_t> order = identity(n), next(n);
  for (int shift = 0, n_bits = static_cast<int>(std::bit_width(most)); shift < n_bits;
       shift += kDigitBits) {
    const auto digit = [&](std::uint32_t i) { return keys[i] >> shift & ((1u << kDigitBits) - 1); };
    std::vector<std::uint32_t> first(1u << kDigitBits, 0);
    for (const std::uint32_t i : order) ++first[digit(i)];
    std::exclusive_scan(first.begin(), first.end(), first.begin(), 0u);
    for (const std::uint32_t i : order) next[first[digit(i)]++] = i;
    order.swap(next);
  }
  return order;
}

// Vertices of the file at one position get the first one's id. order: along the curve.
std::vector<std::uint32_t> weld(const std::vector<glm::vec3>& positions,
                                const std::vector<std::uint64_t>& codes,
                                const std::vector<std::uint32_t>& order) {
  std::vector<std::uint32_t> first = identity(static_cast<std::uint32_t>(positions.size()));
  const auto key = [&](std::uint32_t v) {
    const glm::vec3& p = positions[v];
    return std::tuple(p.x, p.y, p.z, v);
  };
  std::vector<std::uint32_t> cell;
  for (std::size_t i = 0, end = 0; i < order.size(); i = end) {
    while (end < order.size() && codes[order[end]] == codes[order[i]]) ++end;
    if (end - i == 1) continue;
    cell.assign(order.begin() + static_cast<std::ptrdiff_t>(i),
                order.begin() + static_cast<std::ptrdiff_t>(end));
    std::sort(cell.begin(), cell.end(),
              [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    for (std::size_t k = 1; k < cell.size(); ++k)
      if (positions[cell[k]] == positions[cell[k - 1]]) first[cell[k]] = first[cell[k - 1]];
  }
  return first;
}

template <typename Vector>
void permute(Vector& values, const std::vector<std::uint32_t>& order) {
  Vector out;
  out.reserve(values.size());
  for (const std::uint32_t i : order) out.push_back(values[i]);
  values = std::move(out);
}

void order_along_curve(const std::vector<std::uint32_t>& order, WedgeMesh& mesh) {
  mesh.vertex_source = order;
  permute(mesh.positions, mesh.vertex_source);
  std::vector<std::uint32_t> new_index(mesh.positions.size());
  for (std::uint32_t v = 0; v < new_index.size(); ++v) new_index[mesh.vertex_source[v]] = v;
  for (std::uint32_t& v : mesh.wedge_vertex) v = new_index[v];
  std::vector<std::uint32_t> lowest;
  lowest.reserve(mesh.faces.size());
  for (const Triangle& f : mesh.faces)
    lowest.push_back(
        std::min({mesh.wedge_vertex[f[0]], mesh.wedge_vertex[f[1]], mesh.wedge_vertex[f[2]]}));
  mesh.face_index = sorted_order(lowest);
  permute(mesh.faces, mesh.face_index);
  permute(mesh.face_source, mesh.face_index);
}

}  // namespace

std::vector<Triangle> WedgeMesh::vertex_triangles() const {
  std::vector<Triangle> out(faces);
  for (Triangle& face : out)
    for (std::uint32_t& w : face) w = wedge_vertex[w];
  return out;
}

WedgeMesh make_wedges(const TriMesh& mesh, const WedgeOptions& options) {
  WedgeMesh out;
  out.positions.assign(mesh.positions.begin(), mesh.positions.end());
  const std::vector<std::uint64_t> codes = morton_codes(mesh.positions);
  const std::vector<std::uint32_t> order = sorted_order(codes);
  out.wedge_vertex = weld(mesh.positions, codes, order);
  out.apart = weld_borders(mesh.positions, mesh.triangles, options.weld, out.wedge_vertex);
  const auto n = static_cast<std::uint32_t>(mesh.positions.size());
  out.wedge_source = identity(n);
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
  if (!mesh.texcoords.empty()) {
    add_texcoords(mesh, out);
    find_texture_vertices(out);
  }
  out.vertex_source = identity(n);
  out.face_index = identity(static_cast<std::uint32_t>(out.faces.size()));
  if (options.along_curve) order_along_curve(order, out);
  return out;
}

void find_texture_vertices(WedgeMesh& mesh) {
  constexpr std::uint32_t kNone = 0xffffffffu;
  const auto n = static_cast<std::uint32_t>(mesh.n_wedges());
  mesh.texture_vertex.resize(n);
  // The texture vertices of a vertex, one after another.
  std::vector<std::uint32_t> first(n, kNone), next(n, kNone);
  std::unordered_map<WedgeKey, std::uint32_t, WedgeHash> chained;  // beyond the first kLongChain
  for (std::uint32_t w = 0; w < n; ++w) {
    const std::uint32_t v = mesh.wedge_vertex[w];
    std::uint32_t* at = &first[v];
    for (int i = 0; *at != kNone && mesh.texcoords[*at] != mesh.texcoords[w]; ++i)
      at = i < kLongChain ? &next[*at]
                          : &chained.try_emplace(WedgeKey{v, mesh.texcoords[w]}, w).first->second;
    if (*at == kNone) *at = w;
    mesh.texture_vertex[w] = *at;
  }
}

Charts find_joined_charts(const WedgeMesh& mesh) {
  std::vector<Triangle> texture_vertices(mesh.faces);
  for (Triangle& face : texture_vertices)
    for (std::uint32_t& w : face) w = mesh.texture_vertex[w];
  return connect_charts(texture_vertices, mesh.n_wedges(), ChartLink::corner);
}

WedgeTable::WedgeTable(const WedgeMesh& mesh) : texture_vertex_(mesh.texture_vertex) {
  corners_.reserve(3 * mesh.faces.size());
  for (const Triangle& face : mesh.faces) corners_.insert(corners_.end(), face.begin(), face.end());
}

bool WedgeTable::add_pair(const Pair& pair) {
  const std::uint32_t from = texture_vertex(pair.from), to = texture_vertex(pair.to);
  const auto same = [&](const Pair& p) { return texture_vertex(p.from) == from; };
  const auto met = std::find_if(texture_pairs_.begin(), texture_pairs_.end(), same);
  if (met == texture_pairs_.end())
    texture_pairs_.push_back(pair);
  else if (texture_vertex(met->to) != to)
    return false;
  if (std::none_of(pairs_.begin(), pairs_.end(),
                   [&](const Pair& p) { return p.from == pair.from; }))
    pairs_.push_back(pair);
  return true;
}

// Pairs the wedges of u that only surviving triangles have.
bool WedgeTable::pair_rest(const CollapseMesh& mesh, std::uint32_t u) {
  bool fits = true;
  mesh.for_each_corner(u, [&](std::uint32_t c) {
    const std::uint32_t from = corners_[c];
    const auto same = [&](const Pair& p) { return texture_vertex(p.from) == texture_vertex(from); };
    const auto met = std::find_if(texture_pairs_.begin(), texture_pairs_.end(), same);
    fits = fits && met != texture_pairs_.end() && add_pair({from, met->to});
  });
  return fits;
}

bool WedgeTable::match(const CollapseMesh& mesh, std::uint32_t u, std::uint32_t v) {
  pairs_.clear(), texture_pairs_.clear();
  bool fits = true;
  const auto pair_up = [&](std::uint32_t c) {
    const std::uint32_t t = 3 * (c / 3);
    for (std::uint32_t other = t; other < t + 3; ++other)
      if (mesh.vertex_at(other) == v) fits = fits && add_pair({corners_[c], corners_[other]});
  };
  mesh.for_each_sheet_corner(u, pair_up);
  n_sheet_pairs_ = texture_pairs_.size();
  if (mesh.has_copies()) mesh.for_each_corner(u, pair_up);
  return fits && pair_rest(mesh, u) && pairs_.size() <= kMostPairs;
}

bool WedgeTable::match_both(const CollapseMesh& mesh, std::uint32_t v) {
  if (texture_vertex_.empty()) return true;
  const std::size_t n_pairs = pairs_.size();
  bool fits = true;
  mesh.for_each_corner(v, [&](std::uint32_t c) {
    const std::uint32_t to = corners_[c], to_vertex = texture_vertex(to);
    const Pair* met = nullptr;
    for (const Pair& p : texture_pairs_) {
      if (texture_vertex(p.to) != to_vertex) continue;
      fits = fits && met == nullptr;
      met = &p;
    }
    fits = fits && met != nullptr;
    if (fits &&
        std::none_of(pairs_.begin(), pairs_.end(), [&](const Pair& p) { return p.to == to; }))
      pairs_.push_back({met->from, to});
  });
  if (!fits) pairs_.resize(n_pairs);
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
