#include "pm/collapse_star.h"

#include <algorithm>

namespace viewcell {

bool CollapseStar::gather(std::uint32_t u) {
  if (of_ == u) return is_legal_;
  of_ = u;
  is_legal_ = has_seam_end_ = false;
  spokes_.clear(), rim_.clear(), sectors_.clear(), faces_.clear();
  const bool has_charts = !texcoords_.empty() || wedges_.has_regions();
  mesh_.for_each_sheet_corner(u, [&](std::uint32_t c) {
    const std::uint32_t k = c % 3, a = c + 1 - 3 * (k == 2), b = c - 1 + 3 * (k == 0);
    Spoke& spoke = spokes_.emplace_back();
    spoke.face = c / 3, spoke.a = mesh_.vertex_at(a), spoke.b = mesh_.vertex_at(b);
    spoke.wedge_u = wedges_.at(c), spoke.wedge_a = wedges_.at(a), spoke.wedge_b = wedges_.at(b);
    spoke.chart = has_charts ? wedges_.chart_vertex(spoke.wedge_u) : 0;
  });
  // by texture chart; the order within does not matter
  const auto chart_before = [](const Spoke& x, const Spoke& y) { return x.chart < y.chart; };
  if (!std::is_sorted(spokes_.begin(), spokes_.end(), chart_before))
    std::stable_sort(spokes_.begin(), spokes_.end(), chart_before);
  rim_.reserve(2 * spokes_.size());  // sectors point into it
  for (std::size_t first = 0, last = 0; first < spokes_.size(); first = last) {
    while (last < spokes_.size() && spokes_[last].chart == spokes_[first].chart) ++last;
    const std::size_t n_rim = rim_.size(), n_faces = faces_.size();
    if (order(first, last)) continue;
    rim_.resize(n_rim), faces_.resize(n_faces);
    if (!order_fans(first, last)) return false;
  }
  return is_legal_ = !spokes_.empty();
}

// from_b: the rim goes from b to a.
void CollapseStar::push_rim(const Spoke& spoke, bool from_b) {
  Rim& rim = rim_.emplace_back();
  rim.vertex = from_b ? spoke.b : spoke.a, rim.wedge = from_b ? spoke.wedge_b : spoke.wedge_a;
  rim.face = static_cast<std::uint32_t>(faces_.size());
  faces_.push_back(spoke.face);
}

// The rim from `begin` on is a sector; spoke: one of its.
bool CollapseStar::end_sector(const Spoke& spoke, std::size_t begin, bool is_closed, bool is_cut) {
  if (!meets_each_once(begin) || (is_closed && rim_.size() - begin < 3)) return false;
  fill_rim_vectors(begin, spoke.wedge_u);
  sectors_.push_back({std::span<const Rim>(rim_).subspan(begin), is_closed,
                      texcoords_.empty() ? glm::dvec2(0) : glm::dvec2(texcoords_[spoke.wedge_u]),
                      spoke.wedge_u, spoke.chart, is_cut});
  return true;
}

// Makes a sector of spokes [first, last) if they are one fan.
bool CollapseStar::order(std::size_t first, std::size_t last) {
  const auto find = [&](std::uint32_t Spoke::*side, std::uint32_t vertex) {
    std::size_t i = first;
    while (i < last && spokes_[i].*side != vertex) ++i;
    return i;
  };
  // back to the beginning of an open fan, or once around
  std::size_t at = first;
  for (std::size_t n = first; n < last; ++n) {
    const std::size_t back = find(&Spoke::b, spokes_[at].a);
    if (back == last) break;
    at = back;
  }
  const std::uint32_t start = spokes_[at].a;
  const std::size_t begin = rim_.size();
  bool is_closed = false, has_seam_end = false;
  for (std::size_t n = first; n < last; ++n) {
    const Spoke& spoke = spokes_[at];
    push_rim(spoke);
    if (n + 1 < last) {
      at = find(&Spoke::a, spoke.b);
      if (at == last) return false;  // several fans
      has_seam_end = has_seam_end || differ(spoke.wedge_b, spokes_[at].wedge_a);
    } else {
      is_closed = spoke.b == start;
      has_seam_end = has_seam_end || (is_closed && differ(spoke.wedge_b, rim_[begin].wedge));
      if (!is_closed) rim_.push_back({spoke.b, spoke.wedge_b, 0, {}, {}});
    }
  }
  has_seam_end_ = has_seam_end_ || has_seam_end;
  return end_sector(spokes_[first], begin, is_closed);
}

// Joins spokes at edges of just two of them.
void CollapseStar::link_fans(std::size_t first, std::size_t last) {
  joined_.resize(2 * spokes_.size());
  for (std::size_t i = first; i < last; ++i)
    for (const bool at_b : {false, true}) {
      const std::uint32_t vertex = at_b ? spokes_[i].b : spokes_[i].a;
      std::size_t n_at_edge = 0, other = i;
      for (std::size_t j = first; j < last; ++j) {
        if (spokes_[j].a != vertex && spokes_[j].b != vertex) continue;
        ++n_at_edge;
        if (j != i) other = j;
      }
      joined_[2 * i + at_b] = n_at_edge == 2 ? other : i;
    }
}

// Whether several of the spokes are at the edge to the vertex.
bool CollapseStar::is_shared(std::size_t first, std::size_t last, std::uint32_t vertex) const {
  std::size_t n = 0;
  for (std::size_t i = first; i < last; ++i) n += spokes_[i].a == vertex || spokes_[i].b == vertex;
  return n > 1;
}

// Makes sectors of the fans among spokes [first, last). A fan that ends at the edge where it
// began is closed.
bool CollapseStar::order_fans(std::size_t first, std::size_t last) {
  link_fans(first, last);
  std::vector<bool> is_done(last - first, false);
  const auto walk = [&](std::size_t start, bool from_b) {
    const std::size_t begin = rim_.size();
    const std::uint32_t head = from_b ? spokes_[start].b : spokes_[start].a;
    std::uint32_t vertex = head, wedge = 0;
    for (std::size_t at = start;;) {
      const Spoke& spoke = spokes_[at];
      const bool is_backward = spoke.b == vertex;
      if (is_backward != from_b && !texcoords_.empty()) return false;
      push_rim(spoke, is_backward);
      if (rim_.size() - begin > 1)
        has_seam_end_ = has_seam_end_ || differ(wedge, rim_.back().wedge);
      is_done[at - first] = true;
      vertex = is_backward ? spoke.a : spoke.b, wedge = is_backward ? spoke.wedge_a : spoke.wedge_b;
      const std::size_t next = joined_[2 * at + !is_backward];
      if (next == at || is_done[next - first]) break;
      at = next;
    }
    const bool is_closed = vertex == head;
    if (is_closed)
      has_seam_end_ = has_seam_end_ || differ(wedge, rim_[begin].wedge);
    else
      rim_.push_back({vertex, wedge, 0, {}, {}});
    const bool is_cut =
        !is_closed && (is_shared(first, last, head) || is_shared(first, last, vertex));
    return end_sector(spokes_[start], begin, is_closed, is_cut);
  };
  for (std::size_t i = first; i < last; ++i)
    for (const bool at_b : {false, true})
      if (joined_[2 * i + at_b] == i && !is_done[i - first] && !walk(i, at_b)) return false;
  for (std::size_t i = first; i < last; ++i)
    if (!is_done[i - first] && !walk(i, false)) return false;
  return true;
}

bool CollapseStar::differ(std::uint32_t wedge_a, std::uint32_t wedge_b) const {
  return wedge_a != wedge_b && !texcoords_.empty() && texcoords_[wedge_a] != texcoords_[wedge_b];
}

bool CollapseStar::meets_each_once(std::size_t first) const {
  for (std::size_t i = first; i < rim_.size(); ++i)
    for (std::size_t j = i + 1; j < rim_.size(); ++j)
      if (rim_[i].vertex == rim_[j].vertex) return false;
  return true;
}

void CollapseStar::fill_rim_vectors(std::size_t first, std::uint32_t wedge_u) {
  const glm::dvec3 u(positions_[of_]);
  for (std::size_t i = first; i < rim_.size(); ++i) {
    rim_[i].to = glm::dvec3(positions_[rim_[i].vertex]) - u;
    if (!texcoords_.empty())
      rim_[i].uv = glm::dvec2(texcoords_[rim_[i].wedge]) - glm::dvec2(texcoords_[wedge_u]);
  }
}

std::uint32_t CollapseStar::index_of(std::uint32_t face) {
  const auto found = std::find(faces_.begin(), faces_.end(), face);
  const auto index = static_cast<std::uint32_t>(found - faces_.begin());
  if (found == faces_.end()) faces_.push_back(face);
  return index;
}

}  // namespace viewcell
