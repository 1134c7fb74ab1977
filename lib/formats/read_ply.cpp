// PLY documents as triangle meshes.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "base/srgb.h"
#include "formats/color_range.h"
#include "formats/face_list.h"
#include "formats/format_number.h"
#include "formats/ply.h"
#include "formats/readers.h"
#include "formats/text_cursor.h"

namespace viewcell {
namespace {

using Names = std::array<const char*, 3>;

// A property that is no list.
const PlyColumn* find_number(const PlyDocument& ply, const char* element, const char* name) {
  const PlyElement* found = ply.find(element);
  const PlyColumn* column = found == nullptr ? nullptr : found->find(name);
  return column == nullptr || column->is_list ? nullptr : column;
}

bool has_all(const PlyDocument& ply, std::initializer_list<const char*> properties) {
  return std::all_of(properties.begin(), properties.end(),
                     [&](const char* name) { return ply.has("vertex", name); });
}

// ---- positions ----

bool is_float(const PlyDocument& ply, const char* property) {
  return ply.column("vertex", property).type() == PlyType::kFloat;
}

std::vector<glm::dvec3> read_places(const PlyDocument& ply, const FaceList& faces,
                                    Remarks* remarks) {
  std::vector<glm::dvec3> out(ply.element("vertex").count);
  for (int k = 0; k < 3; ++k) {
    const char* names[] = {"x", "y", "z"};
    const std::vector<double> values = ply.doubles("vertex", names[k]);
    for (std::size_t v = 0; v < out.size(); ++v) out[v][k] = values[v];
  }
  mend_unused_places(out, faces.vertices, ply.file, remarks);
  return out;
}

// By the comment of a mesh that we wrote (offset_comments).
std::optional<glm::dvec3> stated_offset(const PlyDocument& ply) {
  for (const std::string& comment : ply.comments) {
    TextCursor words(comment, ply.file, 0);
    if (words.word_in_line() != "offset") continue;
    glm::dvec3 offset;
    bool is_whole = true;
    for (int k = 0; k < 3; ++k)
      is_whole = parse_finite(words.word_in_line(), offset[k]) && is_whole;
    if (is_whole && words.word_in_line().empty()) return offset;
  }
  return std::nullopt;
}

void read_positions(const PlyDocument& ply, const FaceList& faces, TriMesh& mesh,
                    Remarks* remarks) {
  if (is_float(ply, "x") && is_float(ply, "y") && is_float(ply, "z")) {
    try {
      mesh.positions = ply.vec3s("vertex", "x", "y", "z");
      return choose_offset_of(faces.vertices, mesh, remarks);
    } catch (const InputError&) {  // some are nowhere
    }
  }
  place_vertices(read_places(ply, faces, remarks), faces.vertices, mesh, remarks,
                 stated_offset(ply));
}

// Those that are no numbers are none (normalize_normals).
std::vector<glm::vec3> read_normals(const PlyDocument& ply) {
  std::vector<glm::vec3> out(ply.element("vertex").count);
  for (int k = 0; k < 3; ++k) {
    const std::vector<double> values = ply.doubles("vertex", Names{"nx", "ny", "nz"}.at(k));
    for (std::size_t v = 0; v < out.size(); ++v) out[v][k] = static_cast<float>(values[v]);
  }
  return out;
}

// ---- colours ----

// Channels as numbers from 0 to what stands for full.
struct ColorColumns {
  std::array<std::vector<double>, 3> channels;
  double full = 1;
  bool is_guessed = false;  // the type alone does not say what is full
};

std::vector<double> read_channel(const PlyDocument& ply, const PlyColumn& column) {
  std::vector<double> values = ply.doubles("vertex", column.name);
  if (column.type() == PlyType::kInt8)  // bytes
    for (double& value : values) value += value < 0 ? 256 : 0;
  return values;
}

double full_integer(PlyType type, double most) {
  if (most <= 255) return 255;
  switch (type) {
    case PlyType::kInt16:
      return 32767;
    case PlyType::kInt32:
      return most <= 65535 ? 65535 : 2147483647;
    case PlyType::kUint32:
      return most <= 65535 ? 65535 : 4294967295;
    default:
      return 65535;
  }
}

ColorColumns read_channels(const PlyDocument& ply, const Names& names) {
  ColorColumns out;
  double most = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    out.channels[k] = read_channel(ply, *find_number(ply, "vertex", names[k]));
    for (const double value : out.channels[k])
      if (value <= std::numeric_limits<float>::max()) most = std::max(most, value);
  }
  const PlyType type = find_number(ply, "vertex", names[0])->type();
  const bool is_byte = type == PlyType::kInt8 || type == PlyType::kUint8;
  if (type >= PlyType::kFloat)
    out.full = full_color(static_cast<float>(most));
  else
    out.full = is_byte ? 255 : full_integer(type, most);
  out.is_guessed = !is_byte && out.full != 1;
  return out;
}

// Of the vertices that are not opaque.
std::size_t count_translucent(const PlyDocument& ply) {
  for (const char* name : {"alpha", "a", "diffuse_alpha"})
    if (const PlyColumn* column = find_number(ply, "vertex", name)) {
      const std::vector<double> values = read_channel(ply, *column);
      double most = 0;
      for (const double value : values) most = std::max(most, value);
      const double full = column->type() >= PlyType::kFloat ? full_color(static_cast<float>(most))
                                                            : full_integer(column->type(), most);
      return static_cast<std::size_t>(
          std::count_if(values.begin(), values.end(), [&](double value) { return value < full; }));
    }
  return 0;
}

// A channel that is no number stays none: fill_colors().
float decode_channel(double value, double full) {
  return std::isnan(value) ? std::numeric_limits<float>::quiet_NaN()
                           : srgb_decode(static_cast<float>(value / full));
}

std::vector<glm::vec3> read_colors(const PlyDocument& ply, Remarks* remarks) {
  static constexpr Names kNames[] = {
      {"red", "green", "blue"}, {"r", "g", "b"}, {"diffuse_red", "diffuse_green", "diffuse_blue"}};
  const auto has = [&](const char* element, const Names& names) {
    return std::all_of(names.begin(), names.end(), [&](const char* name) {
      return find_number(ply, element, name) != nullptr;
    });
  };
  for (const Names& names : kNames) {
    if (!has("vertex", names)) continue;
    const auto [channels, full, is_guessed] = read_channels(ply, names);
    std::vector<glm::vec3> colors(channels[0].size());
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t v = 0; v < colors.size(); ++v)
        colors[v][static_cast<int>(k)] = decode_channel(channels[k][v], full);
    if (is_guessed)
      add_remark(remarks, "colours, taken as 0 to " + format_number(full), colors.size());
    add_remark(remarks, "vertices that are not opaque: alpha is passed over",
               count_translucent(ply));
    return colors;
  }
  for (const Names& names : kNames)
    if (has("face", names)) {
      add_remark(remarks, "faces with colours of their own, which are passed over",
                 ply.element("face").count);
      break;
    }
  return {};
}

// ---- faces ----

const PlyColumn* find_indices(const PlyDocument& ply, const char* element) {
  const PlyElement* found = ply.find(element);
  for (const char* name : {"vertex_indices", "vertex_index"})
    if (found != nullptr && found->find(name) != nullptr) return found->find(name);
  return nullptr;
}

FaceList read_faces(const PlyDocument& ply, std::size_t n_vertices) {
  FaceList faces;
  const PlyColumn* column = find_indices(ply, "face");
  if (column == nullptr) return faces;
  faces.vertices = ply.list_indices("face", column->name, n_vertices);
  faces.starts = column->starts;
  return faces;
}

// Strips of triangles, -1 between two: each corner from the third on makes a triangle with the two
// before it, every other one turned. Those with two equal corners are there to turn a corner and
// show nothing.
void add_strips(const PlyDocument& ply, std::size_t n_vertices, FaceList& faces) {
  const PlyColumn* column = find_indices(ply, "tristrips");
  if (column == nullptr) return;
  const auto add = [&](double value, std::size_t row, std::vector<std::uint32_t>& strip) {
    if (!(value >= 0 && value < static_cast<double>(n_vertices) && value == std::floor(value)))
      throw InputError(
          ply.file, "tristrips " + std::to_string(row),
          "names a vertex that does not exist; there are " + std::to_string(n_vertices));
    strip.push_back(static_cast<std::uint32_t>(value));
    const std::size_t n = strip.size();
    if (n < 3) return;
    std::uint32_t a = strip[n - 3], b = strip[n - 2];
    const std::uint32_t c = strip[n - 1];
    if (a == b || b == c || c == a) return;
    if (n % 2 == 0) std::swap(a, b);
    faces.vertices.insert(faces.vertices.end(), {a, b, c});
    faces.end_face();
  };
  constexpr double kEnd = -1, kUnsignedEnd = 4294967295;
  std::visit(
      [&](const auto& values) {
        std::vector<std::uint32_t> strip;
        for (std::size_t row = 0; row + 1 < column->starts.size(); ++row) {
          strip.clear();
          for (std::size_t i = column->starts[row]; i < column->starts[row + 1]; ++i) {
            const auto value = static_cast<double>(values[i]);
            if (value == kEnd || value == kUnsignedEnd)
              strip.clear();
            else
              add(value, row, strip);
          }
        }
      },
      column->values);
}

// ---- texture coordinates ----

// MeshLab's list of (s, t) pairs, one a corner of the polygon.
std::vector<glm::vec2> read_corner_texcoords(const PlyDocument& ply, const FaceList& faces,
                                             const TriangleSources& sources) {
  const PlyColumn& lists = ply.column("face", "texcoord");
  if (!lists.is_list) return {};
  for (std::size_t f = 0; f + 1 < lists.starts.size(); ++f)
    if (lists.starts[f + 1] - lists.starts[f] != 2 * (faces.starts[f + 1] - faces.starts[f]))
      throw InputError(ply.file, "face " + std::to_string(f),
                       "has not two texture coordinates a vertex");
  std::vector<glm::vec2> out;
  out.reserve(sources.corners.size());
  const std::size_t n_listed = faces.starts[lists.starts.size() - 1];
  std::visit(
      [&](const auto& values) {
        for (const std::uint64_t corner : sources.corners)
          out.push_back(corner < n_listed ? glm::vec2(values[2 * corner], values[2 * corner + 1])
                                          : glm::vec2(0));
      },
      lists.values);
  return out;
}

std::vector<glm::vec2> read_vertex_texcoords(const PlyDocument& ply, const char* s, const char* t,
                                             const std::vector<Triangle>& triangles) {
  const std::vector<float> us = ply.floats("vertex", s), vs = ply.floats("vertex", t);
  std::vector<glm::vec2> out;
  out.reserve(3 * triangles.size());
  for (const Triangle& triangle : triangles)
    for (const std::uint32_t v : triangle) out.emplace_back(us[v], vs[v]);
  return out;
}

std::vector<glm::vec2> read_texcoords(const PlyDocument& ply, const FaceList& faces,
                                      const TriangleSources& sources,
                                      const std::vector<Triangle>& triangles) {
  if (!sources.corners.empty()) return read_corner_texcoords(ply, faces, sources);
  static constexpr const char* kPairs[][2] = {
      {"s", "t"},   {"u", "v"},   {"texture_u", "texture_v"},  {"texture_s", "texture_t"},
      {"u0", "v0"}, {"s0", "t0"}, {"texcoord_u", "texcoord_v"}};
  for (const auto& [s, t] : kPairs)
    if (has_all(ply, {s, t})) return read_vertex_texcoords(ply, s, t, triangles);
  return {};
}

}  // namespace

TriMesh parse_ply_mesh(std::string_view bytes, const std::filesystem::path& file,
                       Remarks* remarks) {
  const PlyDocument ply = parse_ply(bytes, file.string());
  TriMesh mesh;
  const std::size_t n_vertices = ply.element("vertex").count;
  FaceList faces = read_faces(ply, n_vertices);
  add_strips(ply, n_vertices, faces);
  read_positions(ply, faces, mesh, remarks);
  TriangleSources sources;
  const bool has_lists = find_indices(ply, "face") != nullptr && ply.has("face", "texcoord");
  cut_faces(faces, mesh, has_lists ? &sources : nullptr, remarks);
  if (has_all(ply, {"nx", "ny", "nz"})) mesh.normals = read_normals(ply);
  mesh.colors = read_colors(ply, remarks);
  mesh.texcoords = read_texcoords(ply, faces, sources, mesh.triangles);
  if (ply.has("face", "texnumber"))
    add_remark(remarks, "faces with a picture's number (texnumber), passed over", faces.size());
  return mesh;
}

}  // namespace viewcell
