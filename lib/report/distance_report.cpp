#include "report/distance_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "base/file.h"
#include "formats/ply.h"
#include "formats/split_normals.h"
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

std::string format_number(double x, int n_digits = 6) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", n_digits, x);
  return text;
}

// Digits enough to tell places apart that are a millionth of the diagonal away from each other.
int place_digits(const glm::dvec3& p, double diagonal) {
  constexpr int kDigits = 6, kMostDigits = 17;
  const double most = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  if (!(most > diagonal && diagonal > 0)) return kDigits;
  return std::min(kMostDigits, kDigits + static_cast<int>(std::ceil(std::log10(most / diagonal))));
}

std::string format_percent(double part, double whole) {
  return format_fixed(100 * part / whole, 4, "-");
}

std::string format_point(const glm::dvec3& p, double diagonal) {
  const int n = place_digits(p, diagonal);
  return "(" + format_number(p.x, n) + ", " + format_number(p.y, n) + ", " + format_number(p.z, n) +
         ")";
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

std::string format_worst(const char* name, const WorstSample& worst, double diagonal) {
  return std::string(name) + " is largest at " + format_point(worst.point, diagonal) +
         ", nearest point " + format_point(worst.nearest, diagonal) + "\n";
}

std::string format_share(std::uint64_t part, std::size_t whole) {
  return format_percent(static_cast<double>(part), static_cast<double>(whole));
}

std::string format_histogram(const SurfaceDistance& distance) {
  const OneSidedDistance &forward = distance.forward, &backward = distance.backward;
  const std::size_t n = forward.histogram.size();
  if (n == 0) return "";
  const bool is_cloud = distance.points != PointCloud::none;
  const std::size_t n_samples = is_cloud ? forward.n_vertices : forward.n_face_samples;
  TableRows rows{{"up to", "forward %"}};
  if (!is_cloud) rows[0].push_back("backward %");
  for (std::size_t k = 0; k < n; ++k) {
    rows.push_back({format_number(distance.histogram_most * static_cast<double>(k + 1) /
                                  static_cast<double>(n)),
                    format_share(forward.histogram[k], n_samples)});
    if (!is_cloud)
      rows.back().push_back(format_share(backward.histogram[k], backward.n_face_samples));
  }
  return "\n" + format_table(rows);
}

const char* name_of_side(PointCloud points) {
  return points == PointCloud::a ? "A" : "B";
}

std::string format_point_distance(const SurfaceDistance& distance) {
  const double diagonal = distance.bbox_diagonal;
  const OneSidedDistance& forward = distance.forward;
  const TableRows rows{{"", "max", "mean", "rms", "p50", "p95", "p99", "max/diagonal %", "points"},
                       {"forward", format_number(forward.max), format_number(forward.mean),
                        format_number(forward.rms), format_number(forward.p50),
                        format_number(forward.p95), format_number(forward.p99),
                        format_percent(forward.max, diagonal), std::to_string(forward.n_vertices)}};
  return format_table(rows) + "forward is from the points of " + name_of_side(distance.points) +
         ", a point cloud, to the surface; there is no way back\n" +
         format_worst("forward", forward.worst, diagonal) + format_histogram(distance);
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
  const bool is_cloud = distance.points != PointCloud::none;
  if (is_cloud) {
    json["points"] = name_of_side(distance.points);
    json["backward"] = json["symmetric"] = json["samples"] = json["seed"] = nullptr;
  } else {
    json["backward"] = report_side(distance.backward);
    json["symmetric"] = {{"max", symmetric.max}, {"mean", symmetric.mean}, {"rms", symmetric.rms}};
    json["samples"] = options.n_samples;
    json["seed"] = options.seed;
  }
  if (options.n_bins > 0) json["histogram_to"] = distance.histogram_most;
  json["bbox_diagonal"] = distance.bbox_diagonal;
  json["unit_cube"] = options.unit_cube;
  json["units_per_model_unit"] = distance.units_per_model_unit;
  return json;
}

std::string format_surface_distance(const SurfaceDistance& distance) {
  if (distance.points != PointCloud::none) return format_point_distance(distance);
  const double diagonal = distance.bbox_diagonal;
  const SurfaceDistance::Symmetric symmetric = distance.symmetric();
  const TableRows rows{{"", "max", "mean", "rms", "p50", "p95", "p99", "max/diagonal %", "vertices",
                        "on edges", "on faces"},
                       table_row("forward", distance.forward, diagonal),
                       table_row("backward", distance.backward, diagonal),
                       {"symmetric", format_number(symmetric.max), format_number(symmetric.mean),
                        format_number(symmetric.rms), "", "", "",
                        format_percent(symmetric.max, diagonal), "", "", ""}};
  return format_table(rows) + format_worst("forward", distance.forward.worst, diagonal) +
         format_worst("backward", distance.backward.worst, diagonal) + format_histogram(distance);
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
  std::vector<double> distances = distance.vertex_distance;
  std::optional<NormalSplit> split;
  if (!a.corner_normals.empty()) {
    split = split_by_normals(a, nullptr);
    distances.clear();
    for (const std::uint32_t v : split->source) distances.push_back(distance.vertex_distance[v]);
  }
  const TriMesh& mesh = split ? split->mesh : a;
  PlyDocument ply;
  ply.comments = comments;
  for (const std::string& comment : offset_comments(mesh)) ply.comments.push_back(comment);
  ply.elements.push_back(make_vertices(mesh));
  add_distances(ply.elements.back(), distances, range);
  if (!mesh.triangles.empty()) {
    PlyElement faces{"face", mesh.triangles.size(), {}};
    add_triangles(faces, "vertex_indices", mesh.triangles);
    ply.elements.push_back(std::move(faces));
  }
  write_file(file, format_ply(ply));
}

}  // namespace viewcell
