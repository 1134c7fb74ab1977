#include "report/distance_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/file.h"
#include "formats/ply.h"
#include "report/table.h"

namespace viewcell {
namespace {

Json report_point(const glm::dvec3& p) {
  return Json::array({p.x, p.y, p.z});
}

Json report_side(const OneSidedDistance& side) {
  Json json{{"max", side.max},
            {"mean", side.mean},
            {"rms", side.rms},
            {"p50", side.p50},
            {"p95", side.p95},
            {"p99", side.p99},
            {"mean_pooled", side.mean_pooled},
            {"rms_pooled", side.rms_pooled}};
  json["worst"] = {{"point", report_point(side.worst.point)},
                   {"nearest", report_point(side.worst.nearest)},
                   {"distance", side.worst.distance}};
  json["vertices"] = side.n_vertices;
  json["edge_samples"] = side.n_edge_samples;
  json["face_samples"] = side.n_face_samples;
  if (!side.histogram.empty()) json["histogram"] = side.histogram;
  return json;
}

std::string format_number(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

std::string format_percent(double part, double whole) {
  return format_fixed(100 * part / whole, 4, "-");
}

std::string format_point(const glm::dvec3& p) {
  return "(" + format_number(p.x) + ", " + format_number(p.y) + ", " + format_number(p.z) + ")";
}

std::vector<std::string> table_row(const char* name, const OneSidedDistance& side,
                                   double diagonal) {
  return {name,
          format_number(side.max),
          format_number(side.mean),
          format_number(side.rms),
          format_number(side.p50),
          format_number(side.p95),
          format_number(side.p99),
          format_percent(side.max, diagonal),
          std::to_string(side.n_vertices),
          std::to_string(side.n_edge_samples),
          std::to_string(side.n_face_samples)};
}

std::string format_worst(const char* name, const WorstSample& worst) {
  return std::string(name) + " is largest at " + format_point(worst.point) + ", nearest point " +
         format_point(worst.nearest) + "\n";
}

std::string format_share(std::uint64_t part, std::size_t whole) {
  return format_percent(static_cast<double>(part), static_cast<double>(whole));
}

std::string format_histogram(const SurfaceDistance& distance) {
  const OneSidedDistance &forward = distance.forward, &backward = distance.backward;
  const std::size_t n = forward.histogram.size();
  if (n == 0) return "";
  TableRows rows{{"up to", "forward %", "backward %"}};
  for (std::size_t k = 0; k < n; ++k)
    rows.push_back({format_number(distance.histogram_most * static_cast<double>(k + 1) /
                                  static_cast<double>(n)),
                    format_share(forward.histogram[k], forward.n_face_samples),
                    format_share(backward.histogram[k], backward.n_face_samples)});
  return "\n" + format_table(rows);
}

void add_distances(PlyElement& vertices, const std::vector<double>& distances,
                   const std::array<double, 2>& range) {
  const std::size_t n = distances.size();
  std::array<std::vector<std::uint8_t>, 3> channels;
  channels.fill(std::vector<std::uint8_t>(n));
  for (std::size_t v = 0; v < n; ++v) {
    const double span = range[1] - range[0];
    const auto color = distance_color(span > 0 ? (distances[v] - range[0]) / span : 0);
    for (std::size_t k = 0; k < 3; ++k) channels[k][v] = color[k];
  }
  const std::array<const char*, 3> names{"red", "green", "blue"};
  for (std::size_t k = 0; k < 3; ++k) add_column(vertices, names[k], std::move(channels[k]));
  add_column(vertices, "distance", std::vector<float>(distances.begin(), distances.end()));
}

}  // namespace

Json report_surface_distance(const SurfaceDistance& distance, const DistanceOptions& options) {
  const SurfaceDistance::Symmetric symmetric = distance.symmetric();
  Json json;
  json["forward"] = report_side(distance.forward);
  json["backward"] = report_side(distance.backward);
  json["symmetric"] = {{"max", symmetric.max}, {"mean", symmetric.mean}, {"rms", symmetric.rms}};
  if (options.n_bins > 0) json["histogram_to"] = distance.histogram_most;
  json["samples"] = options.n_samples;
  json["seed"] = options.seed;
  json["bbox_diagonal"] = distance.bbox_diagonal;
  json["unit_cube"] = options.unit_cube;
  json["units_per_model_unit"] = distance.units_per_model_unit;
  return json;
}

std::string format_surface_distance(const SurfaceDistance& distance) {
  const double diagonal = distance.bbox_diagonal;
  const SurfaceDistance::Symmetric symmetric = distance.symmetric();
  const TableRows rows{{"", "max", "mean", "rms", "p50", "p95", "p99", "max/diagonal %", "vertices",
                        "on edges", "on faces"},
                       table_row("forward", distance.forward, diagonal),
                       table_row("backward", distance.backward, diagonal),
                       {"symmetric", format_number(symmetric.max), format_number(symmetric.mean),
                        format_number(symmetric.rms), "", "", "",
                        format_percent(symmetric.max, diagonal), "", "", ""}};
  return format_table(rows) + format_worst("forward", distance.forward.worst) +
         format_worst("backward", distance.backward.worst) + format_histogram(distance);
}

// A walk through hues at full saturation: 120 degrees (green), 60, 0 (red), -60, -120 (blue).
std::array<std::uint8_t, 3> distance_color(double share) {
  const double t = 4 * std::clamp(share, 0.0, 1.0);
  const auto level = [](double x) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(x, 0.0, 1.0)));
  };
  return {level(std::min(t, 4 - t)), level(2 - t), level(t - 2)};
}

std::array<double, 2> default_color_range(const SurfaceDistance& distance) {
  const OneSidedDistance& forward = distance.forward;
  return {0, forward.p99 > 0 ? forward.p99 : forward.max};
}

void write_colored_mesh(const std::filesystem::path& file, const TriMesh& a,
                        const SurfaceDistance& distance, const std::array<double, 2>& range,
                        const std::vector<std::string>& comments) {
  VIEWCELL_CHECK(distance.vertex_distance.size() == a.positions.size());
  PlyDocument ply;
  ply.comments = comments;
  PlyElement vertices{"vertex", a.positions.size(), {}};
  add_vec3s(vertices, {"x", "y", "z"}, a.positions);
  if (!a.normals.empty()) add_vec3s(vertices, {"nx", "ny", "nz"}, a.normals);
  add_distances(vertices, distance.vertex_distance, range);
  PlyElement faces{"face", a.triangles.size(), {}};
  add_triangles(faces, "vertex_indices", a.triangles);
  ply.elements = {std::move(vertices), std::move(faces)};
  write_file(file, format_ply(ply));
}

}  // namespace viewcell
