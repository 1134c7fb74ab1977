#include "walk/walk.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <string>

#include "base/error.h"

namespace viewcell {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kLookAhead_s = 1.5, kSample_s = 0.2;
constexpr int kRounds = 40;  // of smoothing
// A step beside what stands near costs more: walkers keep to the middle.
constexpr double kCrowded = 2;
// How much more a step costs where there is nothing to see.
constexpr double kDull = 3;

using Route = std::vector<std::size_t>;

struct FixedRoute {
  Route points;
  std::vector<bool> is_fixed;  // the places to pass
};

std::string format_place(const glm::dvec2& p) {
  char text[64];
  std::snprintf(text, sizeof text, "%.6g,%.6g", p.x, p.y);
  return text;
}

class RouteFinder {
 public:
  explicit RouteFinder(const StandingRoom& room) : room_(room), part_(connect_parts(room)) {
    for (std::size_t p = 0; p < part_.size(); ++p)
      if (part_[p] == 0) most_sight_ = std::max(most_sight_, room.sight_at(p));
  }

  const std::vector<int>& parts() const { return part_; }

  // Of the largest part: the first point with the most to see.
  std::size_t best_place() const {
    std::size_t p = 0;
    while (part_[p] != 0 || room_.sight_at(p) < most_sight_) ++p;
    return p;
  }

  // From one point to all of its part: lengths, and where each is come from. strolls: by what there
  // is to see.
  void spread(std::size_t from, bool strolls) {
    length_.assign(part_.size(), kFar), from_.assign(part_.size(), from);
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    length_[from] = 0;
    queue.emplace(0, from);
    while (!queue.empty()) {
      const auto [length, p] = queue.top();
      queue.pop();
      if (length > length_[p]) continue;
      const std::vector<std::size_t> next = room_.neighbours(p);
      const double crowd = (next.size() < 8 ? kCrowded : 1) * (strolls ? dullness(p) : 1);
      for (const std::size_t q : next) {
        const double to = length + crowd * glm::distance(room_.place(p), room_.place(q));
        if (to < length_[q]) length_[q] = to, from_[q] = p, queue.emplace(to, q);
      }
    }
  }
  // Of the points with half the most to see.
  std::size_t farthest() const {
    std::size_t best = 0;
    double most = -1;
    for (std::size_t p = 0; p < length_.size(); ++p)
      if (length_[p] < kFar && length_[p] > most && 2 * room_.sight_at(p) >= most_sight_)
        most = length_[p], best = p;
    return best;
  }
  bool is_reached(std::size_t p) const { return length_[p] < kFar; }
  Route route_to(std::size_t to) const {
    Route out{to};
    while (from_[out.back()] != out.back()) out.push_back(from_[out.back()]);
    std::reverse(out.begin(), out.end());
    return out;
  }

 private:
  double dullness(std::size_t p) const {
    return most_sight_ > 0 ? 1 + kDull * (1 - double(room_.sight_at(p) / most_sight_)) : 1;
  }

  const StandingRoom& room_;
  std::vector<int> part_;
  float most_sight_ = 0;  // in the largest part
  std::vector<double> length_;
  std::vector<std::size_t> from_;
};

// Whether the point nearest to a place is free.
bool is_free_at(const StandingRoom& room, const glm::dvec2& place) {
  const glm::dvec2 at = (place - room.origin) / room.spacing;
  const int column = static_cast<int>(std::lround(at.x)), row = static_cast<int>(std::lround(at.y));
  return column >= 0 && row >= 0 && column < room.columns && row < room.rows &&
         room.is_free[room.index(column, row)] != 0;
}

// Points move to the middle of their neighbours, as long as they stay where one can stand.
std::vector<glm::dvec2> smooth(const StandingRoom& room, const FixedRoute& route) {
  std::vector<glm::dvec2> points;
  for (const std::size_t p : route.points) points.push_back(room.place(p));
  for (int round = 0; round < kRounds; ++round) {
    std::vector<glm::dvec2> next = points;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
      const glm::dvec2 middle = 0.25 * points[i - 1] + 0.5 * points[i] + 0.25 * points[i + 1];
      if (!route.is_fixed[i] && is_free_at(room, middle)) next[i] = middle;
    }
    points = std::move(next);
  }
  return points;
}

// Lengths along a line of points.
std::vector<double> lengths_along(const std::vector<glm::dvec2>& points) {
  std::vector<double> out{0};
  for (std::size_t i = 1; i < points.size(); ++i)
    out.push_back(out.back() + glm::distance(points[i - 1], points[i]));
  return out;
}

struct Line {
  const std::vector<glm::dvec2>& points;
  const std::vector<double>& along;

  glm::dvec2 at(double length) const {
    const auto next = std::upper_bound(along.begin(), along.end(), length);
    if (next == along.end()) return points.back();
    const auto i = static_cast<std::size_t>(next - along.begin());
    if (i == 0) return points.front();
    const double t = (length - along[i - 1]) / (along[i] - along[i - 1]);
    return glm::mix(points[i - 1], points[i], t);
  }
};

double floor_at(const StandingRoom& room, const Route& route, const std::vector<double>& along,
                double length) {
  const auto next = std::upper_bound(along.begin(), along.end(), length);
  const auto i = std::min(static_cast<std::size_t>(next - along.begin()), along.size() - 1);
  if (i == 0) return room.floor_z[route[0]];
  const double t = along[i] > along[i - 1]
                       ? std::min(1.0, (length - along[i - 1]) / (along[i] - along[i - 1]))
                       : 1;
  return glm::mix(double(room.floor_z[route[i - 1]]), double(room.floor_z[route[i]]), t);
}

// Where along the route a stretch of that length begins that has the most to see.
double best_start(const StandingRoom& room, const Route& route, const std::vector<double>& along,
                  double length) {
  std::vector<double> seen{0};  // up to each point: to see, times length
  for (std::size_t i = 1; i < route.size(); ++i)
    seen.push_back(seen.back() + (along[i] - along[i - 1]) * double(room.sight_at(route[i])));
  double best = 0, most = -1;
  std::size_t end = 0;
  for (std::size_t i = 0; i < route.size() && along[i] + length <= along.back(); ++i) {
    while (along[end] < along[i] + length) ++end;
    if (seen[end] - seen[i] > most) most = seen[end] - seen[i], best = along[i];
  }
  return best;
}

FixedRoute choose_route(const StandingRoom& room, RouteFinder& finder, const WalkOptions& options,
                        const std::string& name) {
  if (options.through.empty()) {
    finder.spread(finder.best_place(), true);
    const std::size_t end = finder.farthest();
    finder.spread(end, true);
    FixedRoute out{finder.route_to(finder.farthest()), {}};
    out.is_fixed.resize(out.points.size(), false);
    return out;
  }
  FixedRoute out{{*room.nearest(options.through[0])}, {true}};
  for (std::size_t i = 1; i < options.through.size(); ++i) {
    const std::size_t to = *room.nearest(options.through[i]);
    finder.spread(out.points.back(), false);
    if (!finder.is_reached(to))
      throw InputError(name, "",
                       "no way leads from " + format_place(options.through[i - 1]) + " to " +
                           format_place(options.through[i]));
    const Route leg = finder.route_to(to);
    out.points.insert(out.points.end(), leg.begin() + 1, leg.end());
    out.is_fixed.resize(out.points.size(), false);
    out.is_fixed.back() = true;
  }
  return out;
}

}  // namespace

Walk make_walk(const StandingRoom& room, const WalkOptions& options, const std::string& name) {
  if (std::find(room.is_free.begin(), room.is_free.end(), 1) == room.is_free.end())
    throw InputError(name, "",
                     "nobody can stand anywhere: no floor lies at the eye's height below the "
                     "heights of the cells, with nothing near it");
  RouteFinder finder(room);
  const FixedRoute fixed = choose_route(room, finder, options, name);
  const Route& route = fixed.points;
  const std::vector<glm::dvec2> points = smooth(room, fixed);
  const std::vector<double> along = lengths_along(points);
  const Line line{points, along};
  Walk out;
  out.length = along.back();
  if (options.seconds > 0) out.length = std::min(out.length, options.seconds * options.speed);
  const double start = options.through.empty() ? best_start(room, route, along, out.length) : 0.0;
  const int part = finder.parts()[route[0]];
  out.room_share = double(std::count(finder.parts().begin(), finder.parts().end(), part)) /
                   double(room.is_free.size());
  const double duration = out.length / options.speed;
  const int n = std::max(1, static_cast<int>(std::ceil(duration / kSample_s)));
  glm::dvec2 forward(1, 0);
  for (int i = 0; i <= n; ++i) {
    const double time = duration * i / n, at = start + time * options.speed;
    const glm::dvec2 here = line.at(at), ahead = line.at(at + kLookAhead_s * options.speed) - here;
    if (glm::length(ahead) > 1e-3 * options.speed) forward = glm::normalize(ahead);
    out.path.samples.push_back(
        {time, {here, floor_at(room, route, along, at) + options.eye_height}, {forward, 0}});
  }
  if (n == 1 && duration == 0) out.path.samples.back().time_s = 1;  // it stands
  return out;
}

}  // namespace viewcell
