#include <algorithm>
#include <cstdio>

#include "report/mesh_info.h"
#include "report/table.h"

namespace viewcell {
namespace {

std::string info_number(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

// Floats show no more digits; coordinates about an offset have more.
std::string info_point(const glm::dvec3& p, int n_digits = 7) {
  char text[120];
  std::snprintf(text, sizeof text, "(%.*g, %.*g, %.*g)", n_digits, p.x, n_digits, p.y, n_digits,
                p.z);
  return text;
}

Json point_json(const glm::dvec3& p) {
  return Json::array({p.x, p.y, p.z});
}

// "3 loops", "1 loop"
std::string count_of(std::size_t n, const std::string& one, const std::string& more) {
  return std::to_string(n) + " " + (n == 1 ? one : more);
}

// Lines of a subject and what there is to say of it.
class InfoLines {
 public:
  void add(const std::string& subject, const std::string& words) {
    constexpr std::size_t kColumn = 15;
    std::string line = "  " + subject;
    line.resize(std::max(line.size() + 1, kColumn), ' ');
    for (std::size_t at = 0; at <= words.size();) {
      const std::size_t end = std::min(words.find('\n', at), words.size());
      if (end > at || at == 0) text_ += line + words.substr(at, end - at) + "\n";
      line = std::string(kColumn, ' ');
      at = end + 1;
    }
  }
  void title(const std::string& words) { text_ += words + "\n"; }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string describe_size(const MeshInfo& info) {
  const glm::dvec3 size = info.box.size();
  return info_number(size.x) + " x " + info_number(size.y) + " x " + info_number(size.z) +
         ", diagonal " + info_number(glm::length(size));
}

std::string describe_area(const MeshInfo& info) {
  std::string words = info_number(info.area);
  if (!info.volume) return words + "; not closed, so without volume";
  words += "; closed, volume " + info_number(*info.volume);
  return words + (*info.volume < 0 ? ": triangles are seen from inside" : "");
}

std::string describe_parts(const MeshInfo& info) {
  const MeshTopology& t = info.topology;
  std::string words = count_of(t.n_components, "part", "parts");
  words += t.n_boundary_edges == 0 ? ", no border"
                                   : ", " + count_of(info.n_border_loops, "border", "borders") +
                                         " of " + count_of(t.n_boundary_edges, "edge", "edges");
  return words;
}

std::string describe_faults(const MeshInfo& info) {
  std::string words;
  const auto add = [&](std::size_t n, const std::string& one, const std::string& more) {
    if (n > 0) words += (words.empty() ? "" : "\n") + count_of(n, one, more);
  };
  add(info.topology.n_nonmanifold_edges, "edge of more than two triangles (non-manifold)",
      "edges of more than two triangles (non-manifold)");
  add(info.topology.n_nonmanifold_vertices, "vertex where several fans meet (non-manifold)",
      "vertices where several fans meet (non-manifold)");
  add(info.topology.n_opposed_edges, "edge between triangles that face opposite ways",
      "edges between triangles that face opposite ways");
  add(info.defects.n_repeated_index, "triangle with two corners at one place",
      "triangles with two corners at one place");
  add(info.defects.n_zero_area, "triangle without area", "triangles without area");
  add(info.defects.n_duplicates, "triangle that is there twice", "triangles that are there twice");
  return words.empty() ? "none" : words;
}

std::string describe_normals(const MeshInfo& info) {
  if (info.has_corner_normals) return "of corners (hard edges)";
  return info.has_normals ? "of vertices" : "none: computed where they are needed";
}

std::string describe_texcoords(const MeshInfo& info) {
  if (!info.has_texcoords) return "none";
  const ChartFindings& c = info.charts;
  std::string words = "u " + info_number(c.uv_lo.x) + " to " + info_number(c.uv_hi.x) + ", v " +
                      info_number(c.uv_lo.y) + " to " + info_number(c.uv_hi.y);
  return words + "\n" + describe(c);
}

std::string describe_materials(const MeshInfo& info) {
  if (info.materials.empty()) return "none";
  constexpr std::size_t kMostListed = 12;
  std::string words;
  for (std::size_t i = 0; i < std::min(kMostListed, info.materials.size()); ++i)
    words += (i == 0 ? "" : "\n") + ("'" + info.materials[i].name + "': ") +
             count_of(info.materials[i].n_triangles, "triangle", "triangles");
  if (info.materials.size() > kMostListed)
    words += "\nand " + std::to_string(info.materials.size() - kMostListed) + " more";
  return words;
}

std::string describe_textures(const MeshInfo& info) {
  if (info.file == "-") return "not looked for in what comes through a pipe";
  if (info.textures.empty()) return "none named";
  std::string words;
  for (const ListedTexture& t : info.textures) {
    words += (words.empty() ? "" : "\n") + t.name + ": ";
    words += t.fault.empty()
                 ? std::to_string(t.width_px) + " x " + std::to_string(t.height_px) + " " + t.format
                 : "cannot be read: " + t.fault;
    if (!t.used_by.empty()) words += ", " + t.used_by;
  }
  return words;
}

std::string describe_remarks(const MeshInfo& info) {
  std::string words;
  for (const Remark& r : info.remarks)
    words += (words.empty() ? "" : "\n") + r.what + " (" + std::to_string(r.count) + ")";
  return words;
}

std::string describe_scene(const MeshInfo& info) {
  const bool is_habit = info.format == "OBJ" || info.format == "GLB" || info.format == "glTF";
  return "\"up\": \"" + info.up + "\", \"scale\": " + info_number(info.scale) +
         (info.scale == 1 ? ": its size suits cells of some 50 units"
                          : ": then its size suits cells of some 50 units") +
         (is_habit ? "; up as is usual in " + info.format : "; which axis is up no such file says");
}

Json report_topology(const MeshInfo& info) {
  const MeshTopology& t = info.topology;
  return {{"parts", t.n_components},
          {"edges", t.n_edges},
          {"border_edges", t.n_boundary_edges},
          {"borders", info.n_border_loops},
          {"nonmanifold_edges", t.n_nonmanifold_edges},
          {"nonmanifold_vertices", t.n_nonmanifold_vertices},
          {"opposed_edges", t.n_opposed_edges},
          {"euler", t.euler_characteristic},
          {"closed", t.is_closed_manifold()},
          {"collapsed_triangles", info.defects.n_repeated_index},
          {"flat_triangles", info.defects.n_zero_area},
          {"doubled_triangles", info.defects.n_duplicates}};
}

Json report_texcoords(const MeshInfo& info) {
  if (!info.has_texcoords) return nullptr;
  const ChartFindings& c = info.charts;
  return {{"u", {c.uv_lo.x, c.uv_hi.x}},
          {"v", {c.uv_lo.y, c.uv_hi.y}},
          {"charts", c.n_charts},
          {"overlapped_charts", c.n_overlapped},
          {"repeating_charts", c.n_repeating},
          {"not_finite", c.n_not_finite},
          {"one_to_one", c.is_one_to_one()}};
}

template <typename Items, typename Report>
Json report_each(const Items& items, const Report& report) {
  Json list = Json::array();
  for (const auto& item : items) list.push_back(report(item));
  return list;
}

Json report_texture(const ListedTexture& t) {
  Json json{{"name", t.name}, {"used_by", t.used_by}};
  if (!t.fault.empty()) {
    json["fault"] = t.fault;
    return json;
  }
  json["format"] = t.format;
  json["width_px"] = t.width_px;
  json["height_px"] = t.height_px;
  return json;
}

}  // namespace

Json report_mesh_info(const MeshInfo& info) {
  const Json format = info.format.empty() ? Json() : Json(info.format);
  const char* normals = info.has_corner_normals ? "corners" : "vertices";
  Json json{{"file", std::filesystem::path(info.file).filename().string()},
            {"format", format},
            {"vertices", info.n_vertices},
            {"places", info.n_places},
            {"triangles", info.n_triangles},
            {"box", {{"lo", point_json(info.box.lo)}, {"hi", point_json(info.box.hi)}}},
            {"size", point_json(info.box.size())},
            {"offset", point_json(info.offset)},
            {"area", info.area},
            {"volume", info.volume ? Json(*info.volume) : Json()},
            {"topology", report_topology(info)}};
  json["normals"] = info.has_normals || info.has_corner_normals ? Json(normals) : Json();
  json["colors"] = info.has_colors;
  json["texture_coordinates"] = report_texcoords(info);
  json["materials"] = report_each(info.materials, [](const MaterialUse& use) {
    return Json{{"name", use.name}, {"triangles", use.n_triangles}};
  });
  json["textures"] = report_each(info.textures, report_texture);
  json["remarks"] = report_each(info.remarks, [](const Remark& remark) {
    return Json{{"what", remark.what}, {"count", remark.count}};
  });
  json["for_scene"] = {{"up", info.up}, {"scale", info.scale}};
  return json;
}

std::string format_mesh_info(const MeshInfo& info) {
  InfoLines lines;
  lines.title(info.file + (info.format.empty() ? "" : ": " + info.format));
  const std::size_t n_equal = info.n_vertices - info.n_places;
  lines.add("vertices", std::to_string(info.n_vertices) +
                            (n_equal == 0 ? ""
                                          : ", at " + std::to_string(info.n_places) +
                                                " places, which count as vertices below"));
  lines.add("triangles", std::to_string(info.n_triangles));
  const int n_digits = info.offset == glm::dvec3(0) ? 7 : 12;
  lines.add("box", info_point(info.box.lo, n_digits) + " to " + info_point(info.box.hi, n_digits));
  lines.add("size", describe_size(info));
  if (info.offset != glm::dvec3(0))
    lines.add("offset", info_point(info.offset, 12) + ": positions are kept about it");
  lines.add("area", describe_area(info));
  lines.add("parts", describe_parts(info));
  lines.add("faults", describe_faults(info));
  lines.add("normals", describe_normals(info));
  lines.add("colours", info.has_colors ? "of vertices" : "none");
  lines.add("texture", describe_texcoords(info));
  lines.add("materials", describe_materials(info));
  lines.add("pictures", describe_textures(info));
  if (!info.remarks.empty()) lines.add("remarks", describe_remarks(info));
  lines.add("for a scene", describe_scene(info));
  return lines.text();
}

std::string format_mesh_table(const std::vector<MeshInfo>& infos) {
  TableRows rows{{"file", "format", "triangles", "vertices", "size x", "y", "z", "parts",
                  "border edges", "non-manifold", "opposed", "charts", "materials", "pictures",
                  "remarks"}};
  for (const MeshInfo& info : infos) {
    const glm::dvec3 size = info.box.size();
    const MeshTopology& t = info.topology;
    std::size_t n_remarks = 0;
    for (const Remark& remark : info.remarks) n_remarks += remark.count;
    rows.push_back({info.file, info.format.empty() ? "?" : info.format,
                    std::to_string(info.n_triangles), std::to_string(info.n_vertices),
                    info_number(size.x), info_number(size.y), info_number(size.z),
                    std::to_string(t.n_components), std::to_string(t.n_boundary_edges),
                    std::to_string(t.n_nonmanifold_edges + t.n_nonmanifold_vertices),
                    std::to_string(t.n_opposed_edges),
                    info.has_texcoords ? std::to_string(info.charts.n_charts) : "-",
                    std::to_string(info.materials.size()), std::to_string(info.textures.size()),
                    std::to_string(n_remarks)});
  }
  return format_table(rows);
}

}  // namespace viewcell
