// Source: Wavefront's Object Files (OBJ) Format, polygons only.
// Differs: not by tinyobjloader (2.0.0~rc10 tried), which reads "v nan 0 0", "v 0,5 0,5 0,5" and
// "v x y z" as zeros without a word, wraps the index 99999999999 to 1215752190, hands out index -6
// for the vertex -9 of three, and keeps a polygon's length in 8 bits: 44 corners of 300.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "base/srgb.h"
#include "formats/color_range.h"
#include "formats/face_list.h"
#include "formats/material_ids.h"
#include "formats/readers.h"
#include "formats/text_cursor.h"

namespace viewcell {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

// Keywords that say nothing of the surface.
constexpr std::string_view kNamesOnly[] = {"g",   "o",        "mg",       "usemap", "maplib",
                                           "lod", "c_interp", "d_interp", "bevel"};

// Whether a library's name leads out of its file's folder.
bool is_elsewhere(const std::string& name) {
  const bool has_drive = name.size() > 1 && name[1] == ':';
  return name.starts_with("/") || name.starts_with("\\") || has_drive ||
         name.find("..") != std::string::npos;
}

std::size_t count_lines(std::string_view text, std::string_view start) {
  std::size_t n = 0;
  for (std::size_t at = text.find(start); at != std::string_view::npos;
       at = text.find(start, at + 1))
    n += at == 0 || text[at - 1] == '\n' || text[at - 1] == '\r';
  return n;
}

// What faces refer to by numbers: how many there are, and the largest number so far, with its line:
// it may stand below.
struct ObjElements {
  const char* name;
  std::size_t count = 0;
  std::int64_t most = 0, line_of_most = 0;
};

class ObjParser {
 public:
  ObjParser(std::string_view bytes, const std::filesystem::path& file, Remarks* remarks)
      : text_(bytes, file.string()), file_(file), remarks_(remarks) {
    add_remark(remarks, "comments '#MRGB' (colours of ZBrush), passed over",
               count_lines(bytes, "#MRGB "));
  }

  TriMesh parse() {
    for (; !text_.at_end(); text_.skip_line()) parse_line(text_.word());
    for (const ObjElements& elements : {positions_of_, texcoords_of_, normals_of_})
      check_most(elements);
    mend_unused_places(places_, faces_.vertices, file_.string(), remarks_, nowhere_lines_);
    place_vertices(places_, faces_.vertices, mesh_, remarks_);
    cut_faces(faces_, mesh_, &sources_, remarks_);
    finish_colors();
    finish_texcoords();
    finish_normals();
    finish_materials();
    say_counts();
    return std::move(mesh_);
  }

 private:
  // ---- lines ----

  void parse_line(std::string_view keyword) {
    if (keyword == "v")
      parse_vertex();
    else if (keyword == "vt")
      parse_texcoord();
    else if (keyword == "vn")
      parse_normal();
    else if (keyword == "f" || keyword == "fo")
      parse_face();
    else if (keyword == "usemtl")
      material_ = material_ids_.add(rest_of_line());
    else if (keyword == "mtllib")
      parse_libraries();
    else if (keyword == "l" || keyword == "p")
      ++n_lines_and_points_;
    else if (keyword == "s")
      parse_group();
    else if (std::find(std::begin(kNamesOnly), std::end(kNamesOnly), keyword) ==
             std::end(kNamesOnly))
      count_unknown(std::string(keyword.substr(0, 20)));
  }

  // One group for all faces is how they are taken.
  void parse_group() {
    const std::string group = rest_of_line();
    if (n_groups_++ == 0) first_group_ = group;
    has_hard_edges_ |= group != first_group_ || group == "off" || group == "0";
  }

  void count_unknown(const std::string& keyword) {
    constexpr std::size_t kMostNamed = 8;
    const bool is_named = unknown_.size() < kMostNamed || unknown_.contains(keyword);
    ++unknown_[is_named ? keyword : "others"];
  }

  // "v x y z [w] [r g b]", or with seven numbers "v x y z r g b a" (finish_colors).
  void parse_vertex() {
    const std::size_t vertex = places_.size();
    glm::dvec3 place;
    for (int k = 0; k < 3; ++k)
      place[k] = text_.coordinate_or_nan(text_.word_in_line(), "vertex", vertex);
    if (std::isnan(place.x + place.y + place.z)) nowhere_lines_.push_back(text_.line());
    places_.push_back(place);
    positions_of_.count = places_.size();
    std::array<float, 4> more;
    std::size_t n = 0;
    while (n < 4 && parse_finite(text_.word_in_line(), more[n])) ++n;
    if (n < 3) return;
    mesh_.colors.resize(vertex, glm::vec3(-1));
    mesh_.colors.emplace_back(more[n - 3], more[n - 2], more[n - 1]);
    for (std::size_t k = n - 3; k < n; ++k) most_color_ = std::max(most_color_, more[k]);
    if (n < 4) return;
    firsts_.emplace_back(vertex, more[0]);
    n_first_one_ += more[0] == 1;
    n_last_one_ += more[3] == 1 || more[3] == 255;
  }

  // One that is no number is 0.
  void parse_texcoord() {
    const std::string_view word = text_.word_in_line(), second = text_.word_in_line();
    double u = 0, v = 0;
    if (!parse_float_or_nan(word, u)) text_.number(word, "texture coordinate", texcoords_.size());
    if (!parse_float_or_nan(second, v)) v = 0;  // one-dimensional textures
    const glm::vec2 uv(u, v);
    const bool is_finite = std::isfinite(uv.x) && std::isfinite(uv.y);
    n_bad_texcoords_ += !is_finite;
    texcoords_.push_back(is_finite ? uv : glm::vec2(0));
    texcoords_of_.count = texcoords_.size();
  }

  // One that is no three numbers is none, which (0, 0, 0) says.
  void parse_normal() {
    glm::vec3 normal;
    bool is_finite = true;
    for (int k = 0; k < 3; ++k)
      is_finite = parse_finite(text_.word_in_line(), normal[k]) && is_finite;
    n_bad_normals_ += !is_finite;
    normals_.push_back(is_finite ? normal : glm::vec3(0));
    normals_of_.count = normals_.size();
  }

  void parse_face() {
    for (std::string_view word = text_.word_in_line(); !word.empty(); word = text_.word_in_line())
      parse_corner(word);
    faces_.end_face();
    materials_.push_back(material_);
  }

  // "p", "p/t", "p//n" or "p/t/n".
  void parse_corner(std::string_view word) {
    const auto next_part = [&word] {
      const std::size_t end = std::min(word.find('/'), word.size());
      const std::string_view part = word.substr(0, end);
      word.remove_prefix(std::min(end + 1, word.size()));
      return part;
    };
    const std::uint32_t position = parse_index(next_part(), positions_of_);
    if (position == kNone) text_.fail("a face's vertex is not a number from 1");
    faces_.vertices.push_back(position);
    const std::string_view texcoord = next_part();
    corner_texcoords_.push_back(texcoord.empty() ? kNone : parse_index(texcoord, texcoords_of_));
    corner_normals_.push_back(word.empty() ? kNone : parse_index(word, normals_of_));
  }

  // From 1, or from -1 backwards; kNone for 0, by which some programs say that there is none.
  std::uint32_t parse_index(std::string_view word, ObjElements& elements) {
    std::int64_t id;
    if (!parse_integer(word, id))
      text_.fail(std::string("a face's ") + elements.name + " is not a number from 1");
    if (id == 0) return ++n_zeros_, kNone;
    const auto n = static_cast<std::int64_t>(elements.count);
    if (id < -n || id >= kNone) fail_index(elements, id, text_.line(), " before it");
    if (id < 0) return static_cast<std::uint32_t>(n + id);
    if (id > elements.most) elements.most = id, elements.line_of_most = text_.line();
    return static_cast<std::uint32_t>(id - 1);
  }

  [[noreturn]] void fail_index(const ObjElements& elements, std::int64_t id, std::int64_t line,
                               const char* where) const {
    throw InputError(file_.string(), "line " + std::to_string(line),
                     std::string("a face names ") + elements.name + " " + std::to_string(id) +
                         "; there are " + std::to_string(elements.count) + where);
  }

  void check_most(const ObjElements& elements) const {
    if (elements.most > static_cast<std::int64_t>(elements.count))
      fail_index(elements, elements.most, elements.line_of_most, "");
  }

  // A name may hold blanks.
  std::string rest_of_line() {
    std::string name;
    for (std::string_view word = text_.word_in_line(); !word.empty(); word = text_.word_in_line())
      name += (name.empty() ? "" : " ") + std::string(word);
    return name;
  }

  void parse_libraries() {
    const std::string names = rest_of_line();
    std::vector<std::string>& all = mesh_.material_libraries;
    if (names.empty() || std::find(all.begin(), all.end(), names) != all.end()) return;
    all.push_back(names);
    n_libraries_elsewhere_ += is_elsewhere(names);
  }

  // ---- what is left when all is read ----

  // Of seven numbers the fourth is a weight, unless it is none and the last is alpha: full
  // everywhere.
  void move_colors_before_alpha() {
    const bool is_alpha = n_last_one_ == firsts_.size() && n_first_one_ < firsts_.size();
    if (!is_alpha) return;
    for (const auto& [vertex, red] : firsts_) {
      glm::vec3& color = mesh_.colors[vertex];
      color = {red, color.r, color.g};
    }
    most_color_ = 0;
    for (const glm::vec3& c : mesh_.colors) most_color_ = std::max({most_color_, c.r, c.g, c.b});
    add_remark(remarks_, "vertices of seven numbers, taken as x y z r g b a", firsts_.size());
  }

  // Vertices without a colour are white.
  void finish_colors() {
    if (mesh_.colors.empty()) return;
    move_colors_before_alpha();
    mesh_.colors.resize(mesh_.positions.size(), glm::vec3(-1));
    const float full = full_color(most_color_);
    for (glm::vec3& color : mesh_.colors) {
      const bool is_given = color != glm::vec3(-1);
      for (int k = 0; k < 3; ++k) color[k] = is_given ? srgb_decode(color[k] / full) : 1;
    }
  }

  // Corners without a texture coordinate have (0, 0).
  void finish_texcoords() {
    if (texcoords_.empty()) return;
    mesh_.texcoords.reserve(sources_.corners.size());
    for (const std::uint64_t corner : sources_.corners) {
      const std::uint32_t id = corner_texcoords_[corner];
      n_bare_corners_ += id == kNone;
      mesh_.texcoords.push_back(id == kNone ? glm::vec2(0) : texcoords_[id]);
    }
  }

  // Where no corner has a normal the mesh has none.
  void finish_normals() {
    if (normals_.empty()) return;
    mesh_.corner_normals.reserve(sources_.corners.size());
    for (const std::uint64_t corner : sources_.corners) {
      const std::uint32_t id = corner_normals_[corner];
      mesh_.corner_normals.push_back(id == kNone ? glm::vec3(0) : normals_[id]);
    }
    if (std::all_of(mesh_.corner_normals.begin(), mesh_.corner_normals.end(),
                    [](const glm::vec3& n) { return n == glm::vec3(0); }))
      mesh_.corner_normals.clear();
  }

  void finish_materials() {
    std::vector<std::int32_t> materials;
    materials.reserve(sources_.faces.size());
    for (const std::uint32_t face : sources_.faces) materials.push_back(materials_[face]);
    material_ids_.finish(std::move(materials), mesh_);
  }

  void say_counts() const {
    add_remark(remarks_, "normals that are no three finite numbers, passed over", n_bad_normals_);
    add_remark(remarks_, "texture coordinates that are no finite numbers, taken as 0",
               n_bad_texcoords_);
    add_remark(remarks_, "corners without texture coordinates beside others, which get (0, 0)",
               n_bare_corners_);
    add_remark(remarks_, "corners that name texture coordinate or normal 0, taken as none",
               n_zeros_);
    add_remark(remarks_, "lines and points, passed over", n_lines_and_points_);
    for (const auto& [keyword, n] : unknown_)
      add_remark(remarks_, "lines '" + keyword + "', passed over", n);
    add_remark(remarks_, "material libraries outside the file's folder, not looked for",
               n_libraries_elsewhere_);
    if (has_hard_edges_ && mesh_.corner_normals.empty())
      add_remark(remarks_, "smoothing groups, passed over: all edges are smooth", n_groups_);
  }

  TextCursor text_;
  const std::filesystem::path& file_;
  Remarks* remarks_;
  TriMesh mesh_;
  std::vector<glm::dvec3> places_;
  std::vector<std::pair<std::size_t, float>> firsts_;  // of vertices of seven numbers the fourth
  std::size_t n_first_one_ = 0, n_last_one_ = 0;       // of them: whose fourth, whose last is full
  std::vector<std::int64_t> nowhere_lines_;            // of vertices without a position
  std::vector<glm::vec2> texcoords_;
  std::vector<glm::vec3> normals_;
  ObjElements positions_of_{"vertex"}, texcoords_of_{"texture coordinate"}, normals_of_{"normal"};
  FaceList faces_;
  std::vector<std::uint32_t> corner_texcoords_, corner_normals_;  // beside faces_.vertices
  TriangleSources sources_;
  MaterialIds material_ids_;
  std::vector<std::int32_t> materials_;  // of faces
  std::int32_t material_ = MaterialIds::kNone;
  float most_color_ = 0;
  std::size_t n_bad_normals_ = 0, n_bad_texcoords_ = 0, n_bare_corners_ = 0, n_zeros_ = 0,
              n_lines_and_points_ = 0;
  std::size_t n_libraries_elsewhere_ = 0, n_groups_ = 0;
  std::map<std::string, std::size_t> unknown_;  // keywords
  std::string first_group_;
  bool has_hard_edges_ = false;
};

}  // namespace

TriMesh parse_obj(std::string_view bytes, const std::filesystem::path& file, Remarks* remarks) {
  return ObjParser(bytes, file, remarks).parse();
}

}  // namespace viewcell
