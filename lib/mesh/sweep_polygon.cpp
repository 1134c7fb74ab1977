#include "mesh/sweep_polygon.h"

#include <algorithm>
#include <numeric>
#include <set>

#include "mesh/polygon_rings.h"

namespace viewcell {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

// Above 0: a, b, c turn to the left.
double turn_of(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// A corner in the chain of an interval, which runs from its lower edge up to its upper one.
struct ChainLink {
  std::uint32_t step, below = kNone, above = kNone;
};

// A stretch of the sweep line that is inside. Edges have the number of the step that they leave.
struct Interval {
  std::uint32_t lower = kNone, upper = kNone;                 // edges
  std::uint32_t bottom = kNone, top = kNone, newest = kNone;  // links: left ends of both, the last
};

class PolygonSweep {
 public:
  PolygonSweep(std::vector<RingStep> steps, std::vector<Triangle>& out)
      : steps_(std::move(steps)), out_(out), interval_of_(steps_.size(), kNone), active_({*this}) {}

  bool run() {
    std::vector<std::uint32_t> order(steps_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return is_before(a, b); });
    return std::all_of(order.begin(), order.end(), [&](std::uint32_t v) { return pass(v); }) &&
           active_.empty();
  }

 private:
  // By their lower edges.
  struct IsBelow {
    using is_transparent = void;
    const PolygonSweep& sweep;
    bool operator()(std::uint32_t a, std::uint32_t b) const {
      return sweep.is_below(sweep.intervals_[a].lower, sweep.intervals_[b].lower);
    }
    struct Edge {
      std::uint32_t id;
    };
    bool operator()(std::uint32_t a, Edge edge) const {
      return sweep.is_below(sweep.intervals_[a].lower, edge.id);
    }
    bool operator()(Edge edge, std::uint32_t a) const {
      return sweep.is_below(edge.id, sweep.intervals_[a].lower);
    }
  };

  const glm::dvec2& at(std::uint32_t step) const { return steps_[step].at; }

  // From left to right; of one x, from below. Equal points by their corners.
  bool is_before(std::uint32_t a, std::uint32_t b) const {
    const glm::dvec2 &p = at(a), &q = at(b);
    return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : a < b;
  }

  // Whether edge e is below f where both are over one x: seen from the one that begins first, where
  // the other begins or, when that is on it, ends.
  bool is_below(std::uint32_t e, std::uint32_t f) const {
    const auto ends = [&](std::uint32_t edge) {
      const std::uint32_t to = steps_[edge].next;
      return is_before(edge, to) ? std::pair(edge, to) : std::pair(to, edge);
    };
    const auto [e_left, e_right] = ends(e);
    const auto [f_left, f_right] = ends(f);
    if (is_before(f_left, e_left)) {
      const double side = turn_of(at(f_left), at(f_right), at(e_left));
      return (side != 0 ? side : turn_of(at(f_left), at(f_right), at(e_right))) < 0;
    }
    const double side = turn_of(at(e_left), at(e_right), at(f_left));
    return (side != 0 ? side : turn_of(at(e_left), at(e_right), at(f_right))) > 0;
  }

  // Moves the sweep line past a step; false: its edges are not where they ought to be.
  bool pass(std::uint32_t v) {
    const auto [point, corner, prev, next] = steps_[v];
    const bool is_from_left = is_before(prev, v), is_to_left = is_before(next, v);
    const bool is_convex = turn_of(at(prev), point, at(next)) >= 0;
    if (is_from_left != is_to_left) return go_on(v, is_from_left ? prev : v, is_from_left);
    if (!is_from_left) return is_convex ? start(v) : split(v);
    return is_convex ? end(v) : merge(v);
  }

  // ---- what a step does to the intervals beside it ----

  bool start(std::uint32_t v) {
    const std::uint32_t link = add_link(v);
    open({v, steps_[v].prev, link, link, link});
    return true;
  }

  // An edge ends, and the next goes on from there.
  bool go_on(std::uint32_t v, std::uint32_t ending, bool is_lower) {
    const std::uint32_t id = interval_of_[ending];
    if (id == kNone || (is_lower ? intervals_[id].lower : intervals_[id].upper) != ending)
      return false;
    Interval& i = intervals_[id];
    is_lower ? cover_from_below(i, v, false) : cover_from_above(i, v);
    const std::uint32_t going_on = is_lower ? v : steps_[v].prev;
    (is_lower ? i.lower : i.upper) = going_on;  // it stays where it was among the others
    interval_of_[going_on] = id;
    return true;
  }

  bool end(std::uint32_t v) {
    const std::uint32_t id = interval_of_[steps_[v].prev];
    if (id == kNone || intervals_[id].lower != steps_[v].prev || intervals_[id].upper != v)
      return false;
    cover_from_below(intervals_[id], v, true);
    close(id);
    return true;
  }

  // v sees the newest corner of its interval, whose chain falls in two there.
  bool split(std::uint32_t v) {
    const std::uint32_t lower_id = interval_under(steps_[v].prev);
    if (lower_id == kNone) return false;
    Interval& lower = intervals_[lower_id];
    const std::uint32_t seen = lower.newest, copy = add_link(links_[seen].step);
    links_[copy].above = links_[seen].above;
    if (links_[copy].above != kNone) links_[links_[copy].above].below = copy;
    links_[seen].above = kNone;
    Interval upper{v, lower.upper, copy, lower.top == seen ? copy : lower.top, copy};
    lower.upper = steps_[v].prev;
    lower.top = seen;
    interval_of_[lower.upper] = lower_id;
    cover_from_above(lower, v);
    cover_from_below(upper, v, false);
    open(upper);
    return true;
  }

  // Two intervals become one, whose chain has v in the middle.
  bool merge(std::uint32_t v) {
    const std::uint32_t lower_id = interval_of_[v], upper_id = interval_of_[steps_[v].prev];
    if (lower_id == kNone || upper_id == kNone || lower_id == upper_id) return false;
    Interval &lower = intervals_[lower_id], &upper = intervals_[upper_id];
    if (lower.upper != v || upper.lower != steps_[v].prev) return false;
    cover_from_above(lower, v);
    cover_from_below(upper, v, false);
    const std::uint32_t rest = links_[upper.bottom].above;
    links_[lower.top].above = rest;
    links_[rest].below = lower.top;
    lower.newest = lower.top;
    lower.top = upper.top;
    lower.upper = upper.upper;
    interval_of_[lower.upper] = lower_id;
    close(upper_id);
    return true;
  }

  // ---- chains ----

  std::uint32_t add_link(std::uint32_t step) {
    links_.push_back({step});
    return static_cast<std::uint32_t>(links_.size() - 1);
  }

  // Cuts off what v sees, from the lower edge that ends at v on up, or all; v becomes the bottom.
  void cover_from_below(Interval& i, std::uint32_t v, bool all) {
    std::uint32_t link = i.bottom;
    for (std::uint32_t above = links_[link].above; above != kNone; above = links_[link].above) {
      if (!emit(links_[link].step, v, links_[above].step) && !all) break;
      link = above;
    }
    i.bottom = i.newest = add_link(v);
    links_[i.bottom].above = link;
    links_[link].below = i.bottom;
  }

  void cover_from_above(Interval& i, std::uint32_t v) {
    std::uint32_t link = i.top;
    for (std::uint32_t below = links_[link].below; below != kNone; below = links_[link].below) {
      if (!emit(links_[below].step, v, links_[link].step)) break;
      link = below;
    }
    i.top = i.newest = add_link(v);
    links_[i.top].below = link;
    links_[link].above = i.top;
  }

  // False when it does not turn to the left.
  bool emit(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (!(turn_of(at(a), at(b), at(c)) > 0)) return false;
    out_.push_back({steps_[a].corner, steps_[b].corner, steps_[c].corner});
    return true;
  }

  // ---- intervals ----

  void open(const Interval& interval) {
    const auto id = static_cast<std::uint32_t>(intervals_.size());
    intervals_.push_back(interval);
    interval_of_[interval.lower] = interval_of_[interval.upper] = id;
    places_.push_back(active_.insert(id));
  }

  void close(std::uint32_t id) { active_.erase(places_[id]); }

  // The interval whose lower edge is the next below one that begins inside it; kNone.
  std::uint32_t interval_under(std::uint32_t edge) const {
    const auto above = active_.lower_bound(IsBelow::Edge{edge});
    return above == active_.begin() ? kNone : *std::prev(above);
  }

  const std::vector<RingStep> steps_;
  std::vector<Triangle>& out_;
  std::vector<ChainLink> links_;
  std::vector<Interval> intervals_;
  std::vector<std::uint32_t> interval_of_;  // by edge
  std::multiset<std::uint32_t, IsBelow> active_;
  std::vector<std::multiset<std::uint32_t, IsBelow>::iterator> places_;  // by interval
};

}  // namespace

bool sweep_polygon(const std::vector<glm::dvec2>& points, std::vector<Triangle>& out) {
  return PolygonSweep(make_rings(points), out).run();
}

}  // namespace viewcell
