#include "adapt/adaptation.h"

#include <algorithm>
#include <cmath>
#include <glm/gtx/exterior_product.hpp>
#include <map>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "pm/collapse_map.h"

namespace viewcell {
namespace {

// Corners are 16-bit indices.
constexpr std::size_t kMostPoints = 65535;

// The input as it stands before the first collapse, in the numbers of the record; then, with
// full-edge collapses, as vertices move.
struct Finest {
  WedgeMesh wedges;
  std::vector<Triangle> triangles;    // of vertices
  std::vector<std::uint32_t> charts;  // of faces
  std::size_t n_charts = 0;
};

// Faces of one chart and of different groups get charts of their own.
void split_charts(std::span<const std::int32_t> groups, Finest& finest) {
  std::map<std::pair<std::uint32_t, std::int32_t>, std::uint32_t> numbers;
  for (std::size_t f = 0; f < groups.size(); ++f) {
    const auto next = static_cast<std::uint32_t>(numbers.size());
    finest.charts[f] = numbers.try_emplace({finest.charts[f], groups[f]}, next).first->second;
  }
  finest.n_charts = numbers.size();
}

Finest describe_finest(const ProgressiveMesh& mesh, std::span<const std::int32_t> groups) {
  const ProgressiveRecord& record = mesh.record();
  Finest out;
  out.wedges.positions.assign(record.attributes.positions.begin(),
                              record.attributes.positions.end());
  out.wedges.texcoords = record.texcoords;
  const std::size_t n = record.attributes.positions.size();
  for (std::size_t w = 0; w < record.texcoords.size(); ++w)
    out.wedges.wedge_vertex.push_back(record.vertex_of[w < n ? w : record.extra_sources[w - n]]);
  out.wedges.faces = record.faces;
  find_texture_vertices(out.wedges);
  out.triangles = out.wedges.vertex_triangles();
  Charts charts = find_joined_charts(out.wedges);
  out.n_charts = charts.size();
  out.charts = std::move(charts.of);
  if (!groups.empty()) split_charts(groups, out);
  return out;
}

// -1, 0 or 1: the way that a triangle turns; 0 where rounding to float could have turned it.
int turn_of(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c) {
  constexpr double kRounding = 0x1p-23;
  const glm::dvec2 p(a), q = glm::dvec2(b) - p, r = glm::dvec2(c) - p;
  const double area2 = glm::cross(q, r);
  const double largest = std::max({1.0, std::abs(p.x), std::abs(p.y)});
  const double most = kRounding * largest * (glm::length(q) + glm::length(r));
  return std::abs(area2) <= most ? 0 : area2 > 0 ? 1 : -1;
}

// Maps one collapse after another and appends its overlay cells to the log.
class LogBuilder {
 public:
  LogBuilder(const ProgressiveRecord& record, std::span<const std::int32_t> groups)
      : coarser_(make_finest(record)),
        finest_(describe_finest(coarser_, groups)),
        is_adapted_(finest_.wedges.faces.size(), false),
        mesh_(finest_.wedges.positions, finest_.triangles, FaceCopies{}),
        table_(finest_.wedges),
        map_(mesh_, table_, finest_.wedges.positions, finest_.wedges.texcoords, Matching::nearest,
             {.texture = true}) {
    log_.charts = finest_.charts;
    log_.n_charts = finest_.n_charts;
    log_.steps_per_collapse = record.is_full_edge() ? 2 : 1;
    log_.first_point.reserve(log_.steps_per_collapse * record.splits.size() + 1);
    log_.first_triangle.reserve(log_.first_point.capacity());
    mark_start();
  }

  /// The next one, from fine to coarse.
  void collapse();
  AdaptationLog& log() { return log_; }

 private:
  enum class Step { done, folded, unmapped };
  struct Edge {
    std::uint16_t a, b;  // a < b
    std::uint32_t at;    // 3 * triangle + corner
  };
  void mark_start() {
    log_.first_point.push_back(static_cast<std::uint32_t>(log_.points.size()));
    log_.first_triangle.push_back(static_cast<std::uint32_t>(log_.triangles.size()));
  }
  void find_moves(const VertexSplit& split);
  bool stays(std::uint32_t v, const glm::vec3& position) const;
  void move(std::uint32_t v, const glm::vec3& position, std::span<const WedgeMove> moves);
  void merge(const VertexSplit& split);
  void vanish();
  void collapse_edge(const VertexSplit& split, Step step);
  Step add(bool is_mapped, bool is_move = false);
  void end_step(Step step);
  bool add_points();
  bool add_cells();
  bool add_triangle(const AdaptationTriangle& triangle, int turn);
  void mark_borders();
  const glm::vec2& texcoord_at(std::uint32_t corner) const {
    return finest_.wedges.texcoords[table_.at(corner)];
  }
  bool is_border(const Edge& edge) const;
  bool has_neighbour(std::uint32_t face, std::uint32_t u) const;
  int turn_of_face(std::uint32_t face) const;

  ProgressiveMesh coarser_;  // after the collapse
  Finest finest_;
  std::vector<bool> is_adapted_;  // faces, by some step
  std::vector<WedgeMove> moves_;  // of the last full-edge collapse
  CollapseMesh mesh_;
  WedgeTable table_;
  CollapseMap map_;
  CollapseTrace trace_;
  AdaptationLog log_;
  bool is_move_ = false;  // the last step
  std::vector<Edge> edges_;
  std::vector<std::uint32_t> faces_;  // old ones, of the collapse's triangles
};

int LogBuilder::turn_of_face(std::uint32_t face) const {
  const auto corner = [&](std::uint32_t k) {
    return finest_.wedges.texcoords[table_.at(3 * face + k)];
  };
  return turn_of(corner(0), corner(1), corner(2));
}

// The texture coordinates that the wedges of the vertex that stays have after the collapse.
void LogBuilder::find_moves(const VertexSplit& split) {
  moves_.clear();
  const ProgressiveRecord& record = coarser_.record();
  const std::size_t first = coarser_.first_pair();
  for (std::size_t i = first; i < first + split.n_pairs; ++i) {
    const std::uint32_t wedge = record.pairs[i].parent;
    const auto same = [&](const WedgeMove& m) { return m.wedge == wedge; };
    if (std::none_of(moves_.begin(), moves_.end(), same))
      moves_.push_back({wedge, record.texcoords[wedge]});
  }
}

bool LogBuilder::stays(std::uint32_t v, const glm::vec3& position) const {
  return finest_.wedges.positions[v] == position &&
         std::all_of(moves_.begin(), moves_.end(), [&](const WedgeMove& m) {
           return finest_.wedges.texcoords[m.wedge] == m.texcoord;
         });
}

void LogBuilder::move(std::uint32_t v, const glm::vec3& position,
                      std::span<const WedgeMove> moves) {
  finest_.wedges.positions[v] = position;
  for (const WedgeMove& m : moves) finest_.wedges.texcoords[m.wedge] = m.texcoord;
  map_.forget();
}

// The child is removed; each of its wedges becomes one of the parent's.
void LogBuilder::merge(const VertexSplit& split) {
  if (!table_.match(mesh_, split.child, split.parent))
    throw InputError("progressive mesh", "split " + std::to_string(coarser_.level()),
                     "is no collapse that keeps to the charts of its texture");
  mesh_.collapse(split.child, split.parent, &trace_);
  table_.apply(trace_);
  map_.forget();
}

// Nothing of the texture changes.
void LogBuilder::vanish() {
  std::vector<std::uint32_t> faces;
  const ProgressiveRecord& record = coarser_.record();
  for (std::size_t i = 0; i < record.splits[coarser_.level()].n_born; ++i)
    faces.push_back(record.born[coarser_.first_born() + i]);
  mesh_.remove(faces, trace_);
  map_.forget();
  for (std::size_t i = 0; i < log_.steps_per_collapse; ++i) mark_start();
}

void LogBuilder::collapse() {
  coarser_.coarsen();
  const VertexSplit split = coarser_.record().splits[coarser_.level()];
  if (split.is_piece()) return vanish();
  const Step step = add(map_.build(split.child, split.parent));
  if (log_.steps_per_collapse == 2) return collapse_edge(split, step);
  end_step(step);
  merge(split);
}

// Splits a full-edge collapse into two steps, in the first of three ways in which no face turns
// over: the child collapses into the parent, which then moves (unless it stays); the parent
// collapses into the child, then moves; the parent moves, then the child collapses into it.
void LogBuilder::collapse_edge(const VertexSplit& split, Step step) {
  const std::uint32_t u = split.child, v = split.parent;
  const glm::vec3 position = coarser_.record().attributes.positions[v];
  find_moves(split);
  if (stays(v, position)) {
    end_step(step);
    merge(split);
    return mark_start();
  }
  const auto end_with_move = [&] {
    merge(split);
    end_step(add(map_.build_move(v, glm::dvec3(position), moves_), true));
    move(v, position, moves_);
  };
  if (step == Step::done) {
    end_step(step);
    return end_with_move();
  }
  if (add(map_.build(v, u)) == Step::done) {
    end_step(Step::done);
    // From here on the parent stands where the child is.
    std::vector<WedgeMove> there;
    table_.match(mesh_, u, v);
    for (const WedgeTable::Pair& pair : table_.pairs())
      there.push_back({pair.to, finest_.wedges.texcoords[pair.from]});
    move(v, finest_.wedges.positions[u], there);
    return end_with_move();
  }
  end_step(add(map_.build_move(v, glm::dvec3(position), moves_), true));
  move(v, position, moves_);
  end_step(add(map_.build(u, v)));
  merge(split);
}

void LogBuilder::end_step(Step step) {
  log_.n_folded += step == Step::folded;
  log_.n_unmapped += step == Step::unmapped;
  // Without a map the star's faces change, too; and if the star is no fan, faces() is incomplete.
  mesh_.for_each_corner(map_.u(), [&](std::uint32_t c) { is_adapted_[c / 3] = true; });
  for (const std::uint32_t face : map_.faces()) is_adapted_[face] = true;
  mark_start();
}

// Appends the step of the map built last; nothing unless the result is Step::done.
LogBuilder::Step LogBuilder::add(bool is_mapped, bool is_move) {
  is_move_ = is_move;
  if (!is_mapped || map_.has_seam_end() || map_.overlay().texture_points().size() > kMostPoints)
    return Step::unmapped;
  if (!add_points() || !add_cells()) {
    log_.points.resize(log_.first_point.back());
    log_.triangles.resize(log_.first_triangle.back());
    return Step::folded;
  }
  mark_borders();
  log_.n_moved += map_.overlay().n_moved_points();
  return Step::done;
}

bool LogBuilder::add_points() {
  for (const TexturePoint& point : map_.overlay().texture_points()) {
    log_.points.push_back({glm::vec2(point.before), glm::vec2(point.after)});
    if (!is_within_reach(log_.points.back())) return false;
  }
  return true;
}

// All cells of the collapse; those of a face turn the way that the face does.
bool LogBuilder::add_cells() {
  const FanOverlay& overlay = map_.overlay();
  faces_.clear();
  for (std::size_t i = 0; i < overlay.textures().size(); ++i) {
    const std::uint32_t face = map_.faces()[overlay.cells()[i].old_face];
    const CellCorners& c = overlay.textures()[i];
    const int turn = turn_of_face(face);
    for (std::size_t k = 2; k < 4; ++k) {
      AdaptationTriangle triangle{{}, 0, finest_.charts[face]};
      triangle.flags = is_adapted_[face] ? 0 : 8;
      const std::array<std::uint32_t, 3> corners{c[0], c[k - 1], c[k]};
      if (corners[0] == corners[1] || corners[1] == corners[2] || corners[0] == corners[2])
        continue;
      for (std::size_t j = 0; j < 3; ++j)
        triangle.corners[j] = static_cast<std::uint16_t>(corners[j]);
      if (!add_triangle(triangle, turn)) return false;
      faces_.push_back(face);
    }
  }
  return true;
}

// False when it turns over.
bool LogBuilder::add_triangle(const AdaptationTriangle& triangle, int turn) {
  const AdaptationPoint* p = &log_.points[log_.first_point.back()];
  const auto& [a, b, c] = triangle.corners;
  if (turn_of(p[a].before, p[b].before, p[c].before) * turn < 0) return false;
  if (turn_of(p[a].after, p[b].after, p[c].after) * turn < 0) return false;
  log_.triangles.push_back(triangle);
  return true;
}

// Another face of the chart has the edge opposite to u, with the same texture coordinates.
bool LogBuilder::has_neighbour(std::uint32_t face, std::uint32_t u) const {
  std::uint32_t k = 0;
  while (mesh_.vertex_at(3 * face + k) != u) ++k;
  const std::uint32_t a = 3 * face + (k + 1) % 3, b = 3 * face + (k + 2) % 3;
  bool found = false;
  mesh_.for_each_corner(mesh_.vertex_at(a), [&](std::uint32_t c) {
    if (c / 3 == face || finest_.charts[c / 3] != finest_.charts[face] ||
        texcoord_at(c) != texcoord_at(a))
      return;
    for (std::uint32_t j = 1; j < 3; ++j) {
      const std::uint32_t other = 3 * (c / 3) + (c + j) % 3;
      found = found || (mesh_.vertex_at(other) == mesh_.vertex_at(b) &&
                        texcoord_at(other) == texcoord_at(b));
    }
  });
  return found;
}

// Of an edge of one triangle only: it ends in u, or no face outside the star has it.
bool LogBuilder::is_border(const Edge& edge) const {
  const auto& points = map_.overlay().texture_points();
  const auto is_apex = [&](std::uint16_t point) {
    // The new apex of a collapse is a vertex of the star's rim.
    return points[point].is_old_apex || (is_move_ && points[point].is_new_apex);
  };
  return is_apex(edge.a) || is_apex(edge.b) || !has_neighbour(faces_[edge.at / 3], map_.u());
}

void LogBuilder::mark_borders() {
  AdaptationTriangle* triangles = log_.triangles.data() + log_.first_triangle.back();
  edges_.clear();
  for (std::uint32_t t = 0; t < faces_.size(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto a = triangles[t].corners[k], b = triangles[t].corners[(k + 1) % 3];
      edges_.push_back({std::min(a, b), std::max(a, b), 3 * t + k});
    }
  std::sort(edges_.begin(), edges_.end(), [](const Edge& l, const Edge& r) {
    return std::tie(l.a, l.b, l.at) < std::tie(r.a, r.b, r.at);
  });
  const auto same = [&](std::size_t i, std::size_t j) {
    return edges_[i].a == edges_[j].a && edges_[i].b == edges_[j].b;
  };
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    if ((i > 0 && same(i, i - 1)) || (i + 1 < edges_.size() && same(i, i + 1))) continue;
    AdaptationTriangle& t = triangles[edges_[i].at / 3];
    if (is_border(edges_[i]))
      t.flags = static_cast<std::uint16_t>(t.flags | 1u << edges_[i].at % 3);
  }
}

}  // namespace

bool is_within_reach(const AdaptationPoint& point) {
  constexpr float kReach = 1e4f;  // pictures
  const auto is_near = [](float x) { return std::abs(x) <= kReach; };
  return is_near(point.before.x) && is_near(point.before.y) && is_near(point.after.x) &&
         is_near(point.after.y);
}

AdaptationLog make_adaptation_log(const ProgressiveRecord& record, const Progress& progress,
                                  std::span<const std::int32_t> groups) {
  VIEWCELL_CHECK(!record.texcoords.empty());
  VIEWCELL_CHECK(groups.empty() || groups.size() == record.faces.size(), groups.size());
  LogBuilder builder(record, groups);
  for (std::size_t i = record.splits.size(); i-- > 0;) {
    builder.collapse();
    if (progress && i % 1024 == 0) progress(record.splits.size() - i, record.splits.size());
  }
  return std::move(builder.log());
}

}  // namespace viewcell
