#include "pm/pm_file.h"

#include <cmath>

#include "base/json.h"
#include "base/section_file.h"
#include "mesh/offset.h"

namespace viewcell {
namespace {

constexpr std::uint32_t kKind = 4;
constexpr const char* kFormat = "viewcell-pm";
constexpr int kVersion = 1, kVersionWithPieces = 2;

template <typename Vec>
void check_finite(const SectionReader& reader, const char* tag, const std::vector<Vec>& values) {
  for (const Vec& v : values)
    for (int k = 0; k < Vec::length(); ++k)
      if (!std::isfinite(v[k])) reader.fail(tag, "has a number that is not finite");
}

// As TriMesh has them.
void check_normals(const SectionReader& reader, const char* tag,
                   const std::vector<glm::vec3>& normals) {
  constexpr double kUnitSlack = 1e-3;  // rounded, and perhaps by another program
  for (const glm::vec3& n : normals)
    if (!(std::abs(glm::length(glm::dvec3(n)) - 1) <= kUnitSlack))
      reader.fail(tag, "has a normal that is not of unit length");
}

void check_colors(const SectionReader& reader, const std::vector<glm::vec3>& colors) {
  for (const glm::vec3& c : colors)
    for (int k = 0; k < 3; ++k)
      if (!(c[k] >= 0 && c[k] <= 1))
        reader.fail("COLORS", "has a colour that is not within 0 to 1");
}

void check_costs(const SectionReader& reader, const std::vector<VertexSplit>& splits) {
  for (const VertexSplit& split : splits)
    if (std::isnan(split.cost) || std::isnan(split.error))
      reader.fail("SPLITS", "has a cost or an error that is no number");
}

}  // namespace

void write_pm(const std::filesystem::path& file, const ProgressiveRecord& r) {
  SectionWriter writer(kKind);
  const TriMesh& a = r.attributes;
  Json info{{"format", kFormat},
            {"version", count_vanishing_pieces(r) > 0 ? kVersionWithPieces : kVersion},
            {"material_names", a.material_names},
            {"full_edge", r.is_full_edge()},
            {"made_by", r.made_by.empty() ? Json() : Json::parse(r.made_by)}};
  if (!a.material_libraries.empty()) info["material_libraries"] = a.material_libraries;
  if (a.offset != glm::dvec3(0)) info["offset"] = {a.offset.x, a.offset.y, a.offset.z};
  if (!r.wedge_normals.empty()) info["wedge_normals"] = true;
  // Names as files have them need not be UTF-8, which JSON is.
  writer.add_bytes("INFO", info.dump(-1, ' ', false, Json::error_handler_t::replace));
  writer.add("POSITION", a.positions);
  writer.add("NORMALS", a.normals);
  writer.add("COLORS", a.colors);
  writer.add("VERTEXOF", r.vertex_of);
  writer.add("WEDGES", r.extra_sources);
  writer.add("TEXCOORD", r.texcoords);
  if (!r.wedge_normals.empty()) writer.add("WNORMALS", r.wedge_normals);
  writer.add("FACES", r.faces);
  writer.add("MATERIAL", a.materials);
  writer.add("SPLITS", r.splits);
  writer.add("BORN", r.born);
  writer.add("MOVED", r.moved);
  writer.add("MOVEDBY", r.moved_by);
  writer.add("PAIRS", r.pairs);
  writer.add("OLDPLACE", r.parent_positions);
  writer.add("OLDTEX", r.parent_texcoords);
  writer.write(file);
}

ProgressiveRecord read_pm(const std::filesystem::path& file) {
  const SectionReader reader(file, kKind, "a progressive mesh (.pm)");
  const Json json = reader.read_info(kFormat, kVersion, kVersionWithPieces);
  const JsonCursor info(json, file);
  ProgressiveRecord r;
  TriMesh& a = r.attributes;
  const auto read_names = [&](const char* key, std::vector<std::string>& to) {
    const JsonCursor names = info.at(key);
    for (std::size_t i = 0; i < names.size(); ++i) to.push_back(names.at(i).string());
  };
  read_names("material_names", a.material_names);
  if (info.has("material_libraries")) read_names("material_libraries", a.material_libraries);
  if (info.has("offset")) {
    const std::vector<double> offset = info.at("offset").numbers(3, -kMostOffset, kMostOffset);
    a.offset = {offset[0], offset[1], offset[2]};
  }
  if (json.contains("made_by") && !json["made_by"].is_null()) r.made_by = json["made_by"].dump();
  reader.read("POSITION", a.positions);
  reader.read("NORMALS", a.normals);
  reader.read("COLORS", a.colors);
  reader.read("VERTEXOF", r.vertex_of);
  reader.read("WEDGES", r.extra_sources);
  reader.read("TEXCOORD", r.texcoords);
  if (info.has("wedge_normals")) reader.read("WNORMALS", r.wedge_normals);
  reader.read("FACES", r.faces);
  reader.read("MATERIAL", a.materials);
  reader.read("SPLITS", r.splits);
  reader.read("BORN", r.born);
  reader.read("MOVED", r.moved);
  reader.read("MOVEDBY", r.moved_by);
  reader.read("PAIRS", r.pairs);
  reader.read("OLDPLACE", r.parent_positions);
  reader.read("OLDTEX", r.parent_texcoords);
  check_finite(reader, "POSITION", a.positions);
  check_normals(reader, "NORMALS", a.normals);
  check_normals(reader, "WNORMALS", r.wedge_normals);
  check_colors(reader, a.colors);
  check_finite(reader, "TEXCOORD", r.texcoords);
  check_finite(reader, "OLDPLACE", r.parent_positions);
  check_finite(reader, "OLDTEX", r.parent_texcoords);
  check_costs(reader, r.splits);
  if (a.positions.empty() || r.faces.empty()) reader.fail("FACES", "holds no mesh");
  if (const std::string wrong = check_record(r); !wrong.empty()) reader.fail("SPLITS", wrong);
  if (count_vanishing_pieces(r) > 0 && json["version"] == kVersion)
    reader.fail("SPLITS", "has pieces that vanish, which are of version 2");
  return r;
}

}  // namespace viewcell
