#include "pm/wedge_mesh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "base/error.h"

namespace viewcell {
namespace {

// A split's pairs are numbered in a byte.
constexpr std::size_t kMostPairs = 256;

// Of the different wedges at a vertex so many are looked through one by one.
constexpr int kLongChain = 32;

// Numbers that are told apart bit by bit, but for 0 and -0.
using Key = std::array<std::uint32_t, 9>;
struct KeyHash {
  std::size_t operator()(const Key& key) const {
    std::uint64_t h = 0;
    for (const std::uint32_t x : key) h = (h ^ (h >> 32) ^ x) * 0x9e3779b97f4a7c15ull;
    return h ^ (h >> 32);
  }
};
std::uint32_t bits_of(float x) {
  return std::bit_cast<std::uint32_t>(x + 0.0f);  // -0 becomes 0
}

// Makes wedges of the faces' corners. The first attributes met at a vertex of the file are those of
// the wedge with its number.
class WedgeMaker {
 public:
  WedgeMaker(const TriMesh& mesh, bool by_material, WedgeMesh& out)
      : mesh_(mesh),
        out_(out),
        by_material_(by_material && !mesh.materials.empty()),
        next_(mesh.positions.size(), kNone),
        is_met_(mesh.positions.size(), false) {
    const std::size_t n = mesh.positions.size();
    if (!mesh.texcoords.empty()) out.texcoords.assign(n, glm::vec2(0));
    if (!mesh.corner_normals.empty()) out.normals.assign(n, glm::vec3(0, 0, 1));
    if (by_material_) materials_.assign(n, 0);
  }

  void make() {
    if (out_.texcoords.empty() && out_.normals.empty() && materials_.empty()) return;
    for (std::size_t f = 0; f < out_.faces.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k)
        out_.faces[f][k] = wedge_of(out_.faces[f][k], 3 * std::size_t{out_.face_source[f]} + k);
  }
  /// Of wedges; empty where they are not told apart by it.
  std::vector<std::int32_t>& materials() { return materials_; }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  bool has(std::uint32_t wedge, std::size_t corner) const {
    return (out_.texcoords.empty() || out_.texcoords[wedge] == mesh_.texcoords[corner]) &&
           (out_.normals.empty() || out_.normals[wedge] == mesh_.corner_normals[corner]) &&
           (materials_.empty() || materials_[wedge] == mesh_.materials[corner / 3]);
  }
  void set(std::uint32_t wedge, std::size_t corner) {
    if (!out_.texcoords.empty()) out_.texcoords[wedge] = mesh_.texcoords[corner];
    if (!out_.normals.empty()) out_.normals[wedge] = mesh_.corner_normals[corner];
    if (!materials_.empty()) materials_[wedge] = mesh_.materials[corner / 3];
  }
  Key key(std::uint32_t source, std::size_t corner) const {
    Key out{source};
    if (!out_.texcoords.empty())
      for (int i = 0; i < 2; ++i) out[1 + i] = bits_of(mesh_.texcoords[corner][i]);
    if (!out_.normals.empty())
      for (int i = 0; i < 3; ++i) out[3 + i] = bits_of(mesh_.corner_normals[corner][i]);
    if (!materials_.empty()) out[6] = static_cast<std::uint32_t>(mesh_.materials[corner / 3]);
    return out;
  }

  std::uint32_t wedge_of(std::uint32_t source, std::size_t corner) {
    if (!is_met_[source]) set(source, corner);
    is_met_[source] = true;
    std::uint32_t w = source;
    int n = 0;
    while (!has(w, corner) && next_[w] != kNone && ++n < kLongChain) w = next_[w];
    if (has(w, corner)) return w;
    const auto made = static_cast<std::uint32_t>(out_.n_wedges());
    if (n == kLongChain) {
      const auto [found, is_new] = chained_.try_emplace(key(source, corner), made);
      if (!is_new) return found->second;
    } else {
      next_[w] = made;
    }
    next_.push_back(kNone);
    if (!out_.texcoords.empty()) out_.texcoords.emplace_back();
    if (!out_.normals.empty()) out_.normals.emplace_back();
    if (!materials_.empty()) materials_.emplace_back();
    set(made, corner);
    out_.wedge_source.push_back(source);
    out_.wedge_vertex.push_back(out_.wedge_vertex[source]);
    return made;
  }

  const TriMesh& mesh_;
  WedgeMesh& out_;
  bool by_material_;
  std::vector<std::int32_t> materials_;
  std::vector<std::uint32_t> next_;  // wedge -> next of its vertex of the file
  std::vector<bool> is_met_;
  std::unordered_map<Key, std::uint32_t, KeyHash> chained_;  // beyond the first kLongChain
};

// Wedge -> the lowest one of its vertex with an equal key(wedge), whose first entry is the vertex.
template <typename KeyOf>
std::vector<std::uint32_t> match_wedges(const WedgeMesh& mesh, KeyOf&& key_of) {
  const auto n = static_cast<std::uint32_t>(mesh.n_wedges());
  std::vector<std::uint32_t> out(n);
  // The lowest wedges of a vertex, one after another.
  std::vector<std::uint32_t> first(n, kNoWedge), next(n, kNoWedge);
  std::unordered_map<Key, std::uint32_t, KeyHash> chained;  // beyond the first kLongChain
  for (std::uint32_t w = 0; w < n; ++w) {
    const Key key = key_of(w);
    std::uint32_t* at = &first[mesh.wedge_vertex[w]];
    for (int i = 0; *at != kNoWedge && key_of(*at) != key; ++i)
      at = i < kLongChain ? &next[*at] : &chained.try_emplace(key, w).first->second;
    if (*at == kNoWedge) *at = w;
    out[w] = *at;
  }
  return out;
}

Key texture_key(const WedgeMesh& mesh, std::uint32_t w) {
  Key out{mesh.wedge_vertex[w]};
  if (mesh.texcoords.empty()) return out;
  out[1] = bits_of(mesh.texcoords[w].x), out[2] = bits_of(mesh.texcoords[w].y);
  return out;
}

// To 8 bits: what differs less is noise.
std::uint32_t colour_key(const glm::vec3& c) {
  std::uint32_t out = 1;
  for (int i = 0; i < 3; ++i)
    out = out << 8 | static_cast<std::uint32_t>(std::lround(255 * std::clamp(c[i], 0.0f, 1.0f)));
  return out;
}

// materials: of wedges; colours: of the file's vertices; empty: they do not matter. Sets
// chart_vertex and region_vertex where vertices have several.
void find_chart_vertices(const std::vector<std::int32_t>& materials,
                         const std::vector<glm::vec3>& colours, WedgeMesh& mesh) {
  if (materials.empty() && colours.empty()) return;
  std::vector<bool> is_drawn(mesh.n_wedges(), false);
  for (const Triangle& face : mesh.faces)
    for (const std::uint32_t w : face) is_drawn[w] = true;
  std::vector<std::uint32_t> drawn(mesh.n_wedges(), kNoWedge);  // vertex -> a wedge of it
  const auto region_of = [&](std::uint32_t w) {
    Key out{mesh.wedge_vertex[w]};
    if (!materials.empty()) out[3] = static_cast<std::uint32_t>(materials[w]);
    if (!colours.empty()) out[4] = colour_key(colours[mesh.wedge_source[w]]);
    return out;
  };
  bool has_several = false;
  for (std::uint32_t w = 0; w < mesh.n_wedges() && !has_several; ++w) {
    if (!is_drawn[w]) continue;
    std::uint32_t& other = drawn[mesh.wedge_vertex[w]];
    if (other == kNoWedge) other = w;
    has_several = region_of(w) != region_of(other);
  }
  if (!has_several) return;
  mesh.region_vertex = match_wedges(mesh, region_of);
  mesh.chart_vertex = match_wedges(mesh, [&](std::uint32_t w) {
    Key out = texture_key(mesh, w);
    const Key region = region_of(w);
    out[3] = region[3], out[4] = region[4];
    return out;
  });
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
  WedgeMaker maker(mesh, options.materials, out);
  maker.make();
  if (out.n_welded > 0 && !mesh.normals.empty())
    for (const std::uint32_t source : out.wedge_source) out.normals.push_back(mesh.normals[source]);
  if (!mesh.texcoords.empty()) find_texture_vertices(out);
  find_chart_vertices(maker.materials(), options.colours ? mesh.colors : std::vector<glm::vec3>(),
                      out);
  out.vertex_source = identity(n);
  out.face_index = identity(static_cast<std::uint32_t>(out.faces.size()));
  if (options.along_curve) order_along_curve(order, out);
  return out;
}

void find_texture_vertices(WedgeMesh& mesh) {
  mesh.texture_vertex = match_wedges(mesh, [&](std::uint32_t w) { return texture_key(mesh, w); });
}

Charts find_joined_charts(const WedgeMesh& mesh) {
  std::vector<Triangle> texture_vertices(mesh.faces);
  for (Triangle& face : texture_vertices)
    for (std::uint32_t& w : face) w = mesh.texture_vertex[w];
  return connect_charts(texture_vertices, mesh.n_wedges(), ChartLink::corner);
}

WedgeTable::WedgeTable(const WedgeMesh& mesh)
    : chart_vertex_(mesh.chart_vertex.empty() ? mesh.texture_vertex : mesh.chart_vertex),
      normals_(mesh.normals),
      has_regions_(!mesh.chart_vertex.empty()) {
  if (has_regions_) texture_vertex_ = mesh.texture_vertex;
  corners_.reserve(3 * mesh.faces.size());
  for (const Triangle& face : mesh.faces) corners_.insert(corners_.end(), face.begin(), face.end());
}

bool WedgeTable::add_pair(const Pair& pair) {
  if (!pairs_.empty() && pairs_.back() == pair) return true;
  const std::uint32_t from = chart_vertex(pair.from), to = chart_vertex(pair.to);
  const auto same = [&](const Pair& p) { return chart_vertex(p.from) == from; };
  const auto met = std::find_if(chart_pairs_.begin(), chart_pairs_.end(), same);
  if (met != chart_pairs_.end()) {
    if (chart_vertex(met->to) != to) return false;
  } else if (keeps_texture(pair)) {
    chart_pairs_.push_back(pair);
  } else {
    return false;
  }
  if (std::none_of(pairs_.begin(), pairs_.end(),
                   [&](const Pair& p) { return p.from == pair.from; }))
    pairs_.push_back(pair);
  return true;
}

// What is one in the texture stays one, whatever else is told apart: texture charts do not tear.
bool WedgeTable::keeps_texture(const Pair& pair) const {
  if (texture_vertex_.empty()) return true;
  return std::none_of(chart_pairs_.begin(), chart_pairs_.end(), [&](const Pair& p) {
    return texture_vertex_[p.from] == texture_vertex_[pair.from] &&
           texture_vertex_[p.to] != texture_vertex_[pair.to];
  });
}

// Of v's wedges in the chart of pair.to the one whose normal is nearest to that of pair.from. Hubs
// are not gone through.
std::uint32_t WedgeTable::find_nearest(const CollapseMesh& mesh, std::uint32_t v,
                                       const Pair& pair) const {
  constexpr float kNearer = 1e-4f;
  if (normals_.empty() || mesh.is_hub(v)) return pair.to;
  std::uint32_t nearest = pair.to;
  float most = glm::dot(normals_[pair.from], normals_[pair.to]);
  mesh.for_each_corner(v, [&](std::uint32_t c) {
    const std::uint32_t w = corners_[c];
    const float cosine = glm::dot(normals_[pair.from], normals_[w]);
    if (!(cosine > most + kNearer) || chart_vertex(w) != chart_vertex(pair.to)) return;
    most = cosine, nearest = w;
  });
  return nearest;
}

void WedgeTable::gather_from(const CollapseMesh& mesh, std::uint32_t u) {
  if (from_.is(u, mesh)) return;
  from_ = {u, mesh.n_triangles()};
  matched_to_ = kNoVertex;
  spokes_.clear(), from_wedges_.clear();
  const auto push = [&](std::uint32_t c) {
    const std::uint32_t k = c % 3, a = c + 1 - 3 * (k == 2), b = c - 1 + 3 * (k == 0);
    const std::uint32_t wedge = corners_[c];
    Spoke& spoke = spokes_.emplace_back();  // in place: a copy would wait for its numbers
    spoke.wedge_u = wedge, spoke.a = mesh.vertex_at(a), spoke.b = mesh.vertex_at(b);
    spoke.wedge_a = corners_[a], spoke.wedge_b = corners_[b];
    if (std::find(from_wedges_.begin(), from_wedges_.end(), wedge) == from_wedges_.end())
      from_wedges_.push_back(wedge);
  };
  mesh.for_each_sheet_corner(u, push);
  n_sheet_spokes_ = spokes_.size();
  if (mesh.has_copies()) mesh.for_each_corner(u, push);
}

bool WedgeTable::pair_up(std::span<const Spoke> spokes, std::uint32_t v) {
  for (const Spoke& s : spokes) {
    if (s.a != v && s.b != v) continue;
    if (!add_pair({s.wedge_u, s.a == v ? s.wedge_a : s.wedge_b})) return false;
  }
  return true;
}

// Pairs the wedges of u that only surviving triangles have.
bool WedgeTable::pair_rest() {
  first_further_ = pairs_.size();
  for (const std::uint32_t from : from_wedges_) {
    if (std::any_of(pairs_.begin(), pairs_.end(), [&](const Pair& p) { return p.from == from; }))
      continue;
    const auto same = [&](const Pair& p) { return chart_vertex(p.from) == chart_vertex(from); };
    const auto met = std::find_if(chart_pairs_.begin(), chart_pairs_.end(), same);
    if (met == chart_pairs_.end() || !add_pair({from, met->to})) return false;
  }
  end_further_ = pairs_.size();
  return true;
}

bool WedgeTable::match(const CollapseMesh& mesh, std::uint32_t u, std::uint32_t v) {
  gather_from(mesh, u);
  if (matched_to_ == v) {
    if (fits_) pairs_.resize(n_matched_);
    return fits_;
  }
  fits_ = find_pairs(v);
  matched_to_ = v, n_matched_ = pairs_.size();
  return fits_;
}

bool WedgeTable::find_pairs(std::uint32_t v) {
  pairs_.clear(), chart_pairs_.clear();
  const std::span<const Spoke> spokes(spokes_);
  const bool sheet_fits = pair_up(spokes.first(n_sheet_spokes_), v);
  n_sheet_pairs_ = chart_pairs_.size();
  return sheet_fits && pair_up(spokes.subspan(n_sheet_spokes_), v) && pair_rest() &&
         pairs_.size() <= kMostPairs;
}

void WedgeTable::gather_to(const CollapseMesh& mesh, std::uint32_t v) {
  if (to_.is(v, mesh)) return;
  to_ = {v, mesh.n_triangles()};
  to_wedges_.clear(), chart_wedges_.clear();
  std::uint32_t last = kNoWedge;
  mesh.for_each_corner(v, [&](std::uint32_t c) {
    const std::uint32_t wedge = corners_[c];
    if (std::exchange(last, wedge) == wedge) return;
    if (std::find(to_wedges_.begin(), to_wedges_.end(), wedge) != to_wedges_.end()) return;
    to_wedges_.push_back(wedge);
    const auto same = [&](std::uint32_t w) { return chart_vertex(w) == chart_vertex(wedge); };
    if (std::none_of(chart_wedges_.begin(), chart_wedges_.end(), same))
      chart_wedges_.push_back(wedge);
  });
}

const std::vector<std::uint32_t>& WedgeTable::chart_wedges(const CollapseMesh& mesh,
                                                           std::uint32_t v) {
  gather_to(mesh, v);
  return chart_wedges_;
}

void WedgeTable::choose_by_normals(const CollapseMesh& mesh, std::uint32_t v) {
  matched_to_ = kNoVertex;
  for (std::size_t i = first_further_; i < end_further_; ++i)
    pairs_[i].to = find_nearest(mesh, v, pairs_[i]);
}

bool WedgeTable::match_both(const CollapseMesh& mesh, std::uint32_t v) {
  if (chart_vertex_.empty()) return true;
  gather_to(mesh, v);
  const std::size_t n_pairs = pairs_.size();
  const auto pair_back = [&](std::uint32_t to) {
    const Pair* met = nullptr;
    for (const Pair& p : chart_pairs_) {
      if (chart_vertex(p.to) != chart_vertex(to)) continue;
      if (met != nullptr) return false;
      met = &p;
    }
    if (met != nullptr &&
        std::none_of(pairs_.begin(), pairs_.end(), [&](const Pair& p) { return p.to == to; }))
      pairs_.push_back({met->from, to});
    return met != nullptr;
  };
  const bool fits = std::all_of(to_wedges_.begin(), to_wedges_.end(), pair_back);
  if (!fits) pairs_.resize(n_pairs);
  return fits;
}

void WedgeTable::apply(const CollapseTrace& trace) {
  from_ = to_ = {};
  for (const std::uint32_t c : trace.moved) {
    const auto found = std::find_if(pairs_.begin(), pairs_.end(),
                                    [&](const Pair& p) { return p.from == corners_[c]; });
    VIEWCELL_CHECK(found != pairs_.end(), c);
    corners_[c] = found->to;
  }
}

}  // namespace viewcell
