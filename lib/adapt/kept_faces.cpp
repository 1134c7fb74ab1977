#include <algorithm>

#include "adapt/adaptation.h"
#include "base/error.h"
#include "mesh/charts.h"

namespace viewcell {

namespace {

// One that was kept.
void add_face(const ProgressiveRecord& record, const AdaptationLog& log, std::size_t face,
              LevelCharts& out) {
  if (log.charts[face] == kNoChart) return;
  const Triangle& t = record.faces[face];
  out.faces.push_back({record.texcoords[t[0]], record.texcoords[t[1]], record.texcoords[t[2]]});
  out.charts.push_back(log.charts[face]);
}

}  // namespace

LevelCharts make_level_charts(const ProgressiveMesh& mesh, const AdaptationLog& log) {
  LevelCharts out;
  for (std::size_t f = 0; f < mesh.record().faces.size(); ++f)
    if (mesh.has_face(f)) add_face(mesh.record(), log, f, out);
  return out;
}

LevelCharts make_owner_charts(const ProgressiveMesh& mesh, const AdaptationLog& log) {
  LevelCharts out = make_level_charts(mesh, log);
  mesh.for_each_vanished_face([&](std::size_t f) { add_face(mesh.record(), log, f, out); });
  return out;
}

AdaptationLog keep_faces(const AdaptationLog& log, const std::vector<bool>& is_kept) {
  VIEWCELL_CHECK(is_kept.size() == log.charts.size(), is_kept.size(), log.charts.size());
  std::vector<bool> has_kept(log.n_charts, false);
  for (std::size_t f = 0; f < is_kept.size(); ++f)
    if (is_kept[f]) has_kept[log.charts[f]] = true;
  AdaptationLog out = log;
  for (std::size_t f = 0; f < is_kept.size(); ++f) {
    if (is_kept[f]) continue;
    VIEWCELL_CHECK(!has_kept[log.charts[f]], "a chart with faces that are kept and others");
    out.charts[f] = kNoChart;
  }
  out.triangles.clear();
  for (std::size_t step = 0; step < log.n_steps(); ++step) {
    out.first_triangle[step] = static_cast<std::uint32_t>(out.triangles.size());
    for (const AdaptationTriangle& t : log.of(step).triangles)
      if (has_kept[t.chart]) out.triangles.push_back(t);
  }
  out.first_triangle.back() = static_cast<std::uint32_t>(out.triangles.size());
  return out;
}

}  // namespace viewcell
