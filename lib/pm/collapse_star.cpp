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
    const std::uint32_t t = 3 * (c / 3), a = t + (c + 1 - t) % 3, b = t + (c + 2 - t) % 3;
    const std::uint32_t wedge = wedges_.at(c);
    spokes_.push_back({c / 3, mesh_.vertex_at(a), mesh_.vertex_at(b),
                       has_charts ? wedges_.chart_vertex(wedge) : 0, wedge, wedges_.at(a),
                       wedges_.at(b)});
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

void CollapseStar::push_rim(const Spoke& spoke) {
  rim_.push_back({spoke.a, spoke.wedge_a, static_cast<std::uint32_t>(faces_.size()), {}, {}});
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

// Joins spokes at edges of just two of them that are wound alike.
void CollapseStar::link_fans(std::size_t first, std::size_t last) {
  next_.resize(spokes_.size()), previous_.resize(spokes_.size());
  for (std::size_t i = first; i < last; ++i) next_[i] = previous_[i] = i;
  for (std::size_t i = first; i < last; ++i) {
    std::size_t n_at_edge = 0, joined = i;
    for (std::size_t j = first; j < last; ++j) {
      n_at_edge += (spokes_[j].a == spokes_[i].b) + (spokes_[j].b == spokes_[i].b);
      if (spokes_[j].a == spokes_[i].b) joined = j;
    }
    if (n_at_edge == 2 && joined != i) next_[i] = joined, previous_[joined] = i;
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
  const auto walk = [&](std::size_t start) {
    const std::size_t begin = rim_.size();
    std::size_t at = start;
    for (;;) {
      push_rim(spokes_[at]);
      is_done[at - first] = true;
      const std::size_t next = next_[at];
      if (next == at || next == start) break;
      has_seam_end_ = has_seam_end_ || differ(spokes_[at].wedge_b, spokes_[next].wedge_a);
      at = next;
    }
    const Spoke &head = spokes_[start], &tail = spokes_[at];
    const bool is_closed = tail.b == head.a;
    if (is_closed)
      has_seam_end_ = has_seam_end_ || differ(tail.wedge_b, head.wedge_a);
    else
      rim_.push_back({tail.b, tail.wedge_b, 0, {}, {}});
    const bool is_cut =
        !is_closed && (is_shared(first, last, head.a) || is_shared(first, last, tail.b));
    return end_sector(head, begin, is_closed, is_cut);
  };
  for (std::size_t i = first; i < last; ++i)
    if (previous_[i] == i && !walk(i)) return false;
  for (std::size_t i = first; i < last; ++i)
    if (!is_done[i - first] && !walk(i)) return false;
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
