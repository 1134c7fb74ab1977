#include "pm/adaptation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "base/error.h"
#include "pm/collapse_map.h"

namespace viewcell {
namespace {

// Corners are 16-bit places.
constexpr std::size_t kMostPoints = 65535;

// The input as it stands before the first collapse, in the numbers of the record.
struct Finest {
  WedgeMesh wedges;
  std::vector<Triangle> triangles;    // of vertices
  std::vector<std::uint32_t> charts;  // of faces
  std::size_t n_charts = 0;
};

// Charts: faces that are connected by wedges; numbers in the order of the faces.
void find_charts(Finest& mesh) {
  std::vector<std::uint32_t> parent(mesh.wedges.n_wedges());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t w) {
    while (parent[w] != w) w = parent[w] = parent[parent[w]];
    return w;
  };
  for (const Triangle& f : mesh.wedges.faces)
    for (std::size_t k = 1; k < 3; ++k) {
      const std::uint32_t a = root(f[0]), b = root(f[k]);
      parent[std::max(a, b)] = std::min(a, b);
    }
  constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<std::uint32_t> chart_of(parent.size(), kNone);
  for (const Triangle& f : mesh.wedges.faces) {
    std::uint32_t& chart = chart_of[root(f[0])];
    if (chart == kNone) chart = static_cast<std::uint32_t>(mesh.n_charts++);
    mesh.charts.push_back(chart);
  }
}

Finest make_finest(const ProgressiveRecord& record) {
  ProgressiveMesh mesh(record);
  mesh.set_level(mesh.n_splits());
  Finest out;
  out.wedges.positions.assign(record.attributes.positions.begin(),
                              record.attributes.positions.end());
  out.wedges.texcoords = record.texcoords;
  const std::size_t n = record.attributes.positions.size();
  for (std::size_t w = 0; w < record.texcoords.size(); ++w)
    out.wedges.wedge_vertex.push_back(record.vertex_of[w < n ? w : record.extra_sources[w - n]]);
  out.wedges.faces = mesh.record().faces;
  out.triangles = out.wedges.vertex_triangles();
  find_charts(out);
  return out;
}

// -1, 0 or 1: the way that a triangle turns; 0 where rounding to float could have turned it.
int turn_of(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c) {
  constexpr double kRounding = 0x1p-23;
  const glm::dvec2 p(a), q = glm::dvec2(b) - p, r = glm::dvec2(c) - p;
  const double area2 = q.x * r.y - q.y * r.x;
  const double largest = std::max({1.0, std::abs(p.x), std::abs(p.y)});
  const double most = kRounding * largest * (glm::length(q) + glm::length(r));
  return std::abs(area2) <= most ? 0 : area2 > 0 ? 1 : -1;
}

// Lays one collapse after another.
class LogBuilder {
 public:
  explicit LogBuilder(const ProgressiveRecord& record)
      : finest_(make_finest(record)),
        mesh_(finest_.wedges.positions, finest_.triangles),
        table_(finest_.wedges),
        map_(mesh_, table_, finest_.wedges.positions, finest_.wedges.texcoords, Matching::nearest,
             {.texture = true}) {
    log_.charts = finest_.charts;
    log_.n_charts = finest_.n_charts;
    log_.first_point.reserve(record.splits.size() + 1);
    log_.first_triangle.reserve(record.splits.size() + 1);
    mark_start();
  }

  void collapse(std::uint32_t u, std::uint32_t v) {
    if (!map_.lay(u, v) || map_.overlay().texture_points().size() > kMostPoints) {
      ++log_.n_unmapped;
    } else if (!add_points() || !add_cells()) {
      log_.points.resize(log_.first_point.back());
      log_.triangles.resize(log_.first_triangle.back());
      ++log_.n_folded;
    } else {
      mark_borders();
      log_.n_moved += map_.overlay().n_moved_points();
    }
    table_.match(mesh_, u, v, false);
    mesh_.collapse(u, v, &trace_);
    table_.apply(trace_);
    map_.forget();
    mark_start();
  }
  AdaptationLog& log() { return log_; }

 private:
  struct Edge {
    std::uint16_t a, b;  // a < b
    std::uint32_t at;    // 3 * triangle + place
  };
  void mark_start() {
    log_.first_point.push_back(static_cast<std::uint32_t>(log_.points.size()));
    log_.first_triangle.push_back(static_cast<std::uint32_t>(log_.triangles.size()));
  }
  bool add_points();
  bool add_cells();
  bool add_triangle(const AdaptationTriangle& triangle, int turn);
  void mark_borders();
  bool is_border(const Edge& edge) const;
  bool has_neighbour(std::uint32_t face, std::uint32_t u) const;
  int turn_of_face(std::uint32_t face) const;
  bool is_original(std::uint32_t face) const;

  Finest finest_;
  CollapseMesh mesh_;
  WedgeTable table_;
  CollapseMap map_;
  CollapseTrace trace_;
  AdaptationLog log_;
  std::vector<Edge> edges_;
  std::vector<std::uint32_t> faces_;  // old ones, of the collapse's triangles
};

int LogBuilder::turn_of_face(std::uint32_t face) const {
  const auto corner = [&](std::uint32_t k) {
    return finest_.wedges.texcoords[table_.at(3 * face + k)];
  };
  return turn_of(corner(0), corner(1), corner(2));
}

bool LogBuilder::is_original(std::uint32_t face) const {
  const Triangle& f = finest_.wedges.faces[face];
  return table_.at(3 * face) == f[0] && table_.at(3 * face + 1) == f[1] &&
         table_.at(3 * face + 2) == f[2];
}

bool LogBuilder::add_points() {
  for (const TexturePoint& point : map_.overlay().texture_points()) {
    log_.points.push_back({glm::vec2(point.before), glm::vec2(point.after)});
    const glm::vec2 sum = log_.points.back().before + log_.points.back().after;
    if (!std::isfinite(sum.x + sum.y)) return false;
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
      triangle.flags = is_original(face) ? 8 : 0;
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

// Another face has the edge opposite to u, with the same texture coordinates.
bool LogBuilder::has_neighbour(std::uint32_t face, std::uint32_t u) const {
  std::uint32_t k = 0;
  while (mesh_.vertex_at(3 * face + k) != u) ++k;
  const std::uint32_t a = 3 * face + (k + 1) % 3, b = 3 * face + (k + 2) % 3;
  bool found = false;
  mesh_.for_each_corner(mesh_.vertex_at(a), [&](std::uint32_t c) {
    if (c / 3 == face || table_.at(c) != table_.at(a)) return;
    for (std::uint32_t j = 1; j < 3; ++j)
      found = found || table_.at(3 * (c / 3) + (c + j) % 3) == table_.at(b);
  });
  return found;
}

// Of an edge of one triangle only: it ends in u, or no face outside the star has it.
bool LogBuilder::is_border(const Edge& edge) const {
  const auto& points = map_.overlay().texture_points();
  return points[edge.a].is_old_apex || points[edge.b].is_old_apex ||
         !has_neighbour(faces_[edge.at / 3], map_.u());
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

LevelCharts make_level_charts(const ProgressiveMesh& mesh, const AdaptationLog& log) {
  LevelCharts out;
  const ProgressiveRecord& record = mesh.record();
  for (std::size_t f = 0; f < record.faces.size(); ++f) {
    if (!mesh.has_face(f)) continue;
    const Triangle& t = record.faces[f];
    out.faces.push_back({record.texcoords[t[0]], record.texcoords[t[1]], record.texcoords[t[2]]});
    out.charts.push_back(log.charts[f]);
  }
  return out;
}

AdaptationLog make_adaptation_log(const ProgressiveRecord& record, const Progress& progress) {
  VIEWCELL_CHECK(!record.is_full_edge() && !record.texcoords.empty());
  LogBuilder builder(record);
  for (std::size_t i = record.splits.size(); i-- > 0;) {
    builder.collapse(record.splits[i].child, record.splits[i].parent);
    if (progress && i % 1024 == 0) progress(record.splits.size() - i, record.splits.size());
  }
  return std::move(builder.log());
}

}  // namespace viewcell
