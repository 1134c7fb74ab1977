#include "pm/adaptation.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "pm/collapse_map.h"

namespace viewcell {
namespace {

// The input as it stands before the first collapse, in the numbers of the record.
struct Finest {
  WedgeMesh wedges;
  std::vector<Triangle> triangles;  // of vertices
};

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
  return out;
}

double area2(const std::array<glm::dvec2, 4>& p, std::size_t j, std::size_t k) {
  const glm::dvec2 a = p[j] - p[0], b = p[k] - p[0];
  return a.x * b.y - a.y * b.x;
}

// Appends the triangles of a cell; false when one turns over.
bool add_pairs(const CellTexture& cell, double sign, std::vector<TexturePair>& out) {
  for (std::size_t k = 2; k < 4; ++k) {
    const double before = area2(cell.before, k - 1, k), after = area2(cell.after, k - 1, k);
    if (before * sign < 0 || after * sign < 0) return false;
    if (before == 0 && after == 0) continue;  // such as the half that a triangle has not
    TexturePair& pair = out.emplace_back();
    const std::array<std::size_t, 3> corners{0, k - 1, k};
    for (std::size_t i = 0; i < 3; ++i) {
      pair.before[i] = glm::vec2(cell.before[corners[i]]);
      pair.after[i] = glm::vec2(cell.after[corners[i]]);
    }
  }
  return true;
}

// All cells of a collapse; those of a face turn the way that the face does.
bool add_cells(const CollapseMap& map, const WedgeTable& table,
               std::span<const glm::vec2> texcoords, std::vector<TexturePair>& out) {
  for (std::size_t i = 0; i < map.overlay().textures().size(); ++i) {
    const std::uint32_t face = map.faces()[map.overlay().cells()[i].old_face];
    std::array<glm::dvec2, 4> corners{};
    for (std::uint32_t k = 0; k < 3; ++k)
      corners[k] = glm::dvec2(texcoords[table.at(3 * face + k)]);
    if (!add_pairs(map.overlay().textures()[i], area2(corners, 1, 2), out)) return false;
  }
  return true;
}

}  // namespace

AdaptationLog make_adaptation_log(const ProgressiveRecord& record, const Progress& progress) {
  VIEWCELL_CHECK(!record.is_full_edge() && !record.texcoords.empty());
  const Finest finest = make_finest(record);
  CollapseMesh mesh(finest.wedges.positions, finest.triangles);
  WedgeTable table(finest.wedges);
  CollapseMap map(mesh, table, finest.wedges.positions, finest.wedges.texcoords, Matching::nearest,
                  {.texture = true});
  AdaptationLog log;
  log.first.reserve(record.splits.size() + 1);
  CollapseTrace trace;
  for (std::size_t i = record.splits.size(); i-- > 0;) {
    const std::uint32_t u = record.splits[i].child, v = record.splits[i].parent;
    log.first.push_back(static_cast<std::uint32_t>(log.pairs.size()));
    if (!map.lay(u, v)) {
      ++log.n_unmapped;
    } else if (!add_cells(map, table, finest.wedges.texcoords, log.pairs)) {
      log.pairs.resize(log.first.back());
      ++log.n_folded;
    }
    table.match(mesh, u, v, false);
    mesh.collapse(u, v, &trace);
    table.apply(trace);
    map.forget();
    if (progress && i % 1024 == 0) progress(record.splits.size() - i, record.splits.size());
  }
  log.first.push_back(static_cast<std::uint32_t>(log.pairs.size()));
  return log;
}

}  // namespace viewcell
