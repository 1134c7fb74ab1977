#include "base/file.h"
#include "pm/pm_file.h"
#include "pmesh/commands.h"

namespace viewcell {
namespace {

Json base_error(const ProgressiveRecord& record) {
  if (record.splits.empty()) return 0;
  const float error = record.splits.front().error;
  return error < 0 ? Json() : Json(error);
}

}  // namespace

int info(const Tool& tool, const PmeshArguments& a) {
  const ProgressiveRecord record = read_pm(a.pm);
  const Json made_by = record.made_by.empty() ? Json() : Json::parse(record.made_by);
  Json report{{"faces", record.faces.size()},
              {"faces_base", record.faces.size() - record.born.size()},
              {"vertices", record.attributes.positions.size()},
              {"wedges", record.attributes.positions.size() + record.extra_sources.size()},
              {"splits", record.splits.size()},
              {"pieces_vanished_base", count_vanishing_pieces(record)},
              {"placement", record.is_full_edge() ? "full" : "half"},
              {"texture_coordinates", !record.texcoords.empty()},
              {"error_bound_base", base_error(record)},
              {"made_by", made_by}};
  if (const glm::dvec3& at = record.attributes.offset; at != glm::dvec3(0))
    report["offset"] = {at.x, at.y, at.z};
  if (tool.common().json_file != "-") write_file("-", format_json(report));
  tool.report(report);
  return 0;
}

}  // namespace viewcell
