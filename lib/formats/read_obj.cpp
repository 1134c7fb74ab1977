// Source: Wavefront's Object Files (OBJ) Format, polygons only.
// Differs: not by tinyobjloader (2.0.0~rc10 tried), which reads "v nan 0 0", "v 0,5 0,5 0,5" and
// "v x y z" as zeros without a word, wraps the index 99999999999 to 1215752190, hands out index -6
// for the vertex -9 of three, and keeps a polygon's length in 8 bits: 44 corners of 300.
#include "base/error.h"
#include "base/file.h"
#include "base/srgb.h"
#include "formats/material_ids.h"
#include "formats/readers.h"
#include "formats/text_cursor.h"

namespace viewcell {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

struct Corner {
  std::uint32_t position, texcoord = kNone, normal = kNone;
};

class ObjParser {
 public:
  ObjParser(std::string_view bytes, const std::filesystem::path& file)
      : text_(bytes, file.string()), file_(file) {}

  TriMesh parse() {
    for (; !text_.at_end(); text_.skip_line()) parse_line(text_.word());
    finish_colors();
    finish_normals();
    finish_texcoords();
    material_ids_.finish(std::move(materials_), mesh_);
    return std::move(mesh_);
  }

 private:
  void parse_line(std::string_view keyword) {
    if (keyword == "v")
      parse_vertex();
    else if (keyword == "vt")
      parse_texcoord();
    else if (keyword == "vn")
      normals_.push_back(parse_vec3("normal", normals_.size()));
    else if (keyword == "f")
      parse_face();
    else if (keyword == "usemtl")
      material_ = material_ids_.add(rest_of_line());
    else if (keyword == "mtllib")
      check_libraries();
    // Groups, smoothing, lines, points and free-form surfaces are passed over.
  }

  float parse_number(const char* what, std::uint64_t id) {
    return text_.number(text_.word_in_line(), what, id);
  }

  glm::vec3 parse_vec3(const char* what, std::uint64_t id) {
    glm::vec3 v;
    for (int k = 0; k < 3; ++k) v[k] = parse_number(what, id);
    return v;
  }

  // "v x y z [w] [r g b]".
  void parse_vertex() {
    const std::size_t vertex = mesh_.positions.size();
    mesh_.positions.push_back(parse_vec3("vertex", vertex));
    std::vector<float> more;
    float value;
    while (more.size() < 4 && parse_finite(text_.word_in_line(), value)) more.push_back(value);
    if (more.size() < 3) return;
    mesh_.colors.resize(vertex, glm::vec3(1));
    const float* rgb = more.data() + more.size() - 3;
    mesh_.colors.emplace_back(srgb_decode(rgb[0]), srgb_decode(rgb[1]), srgb_decode(rgb[2]));
  }

  void parse_texcoord() {
    const float u = parse_number("texture coordinate", texcoords_.size());
    float v;
    if (!parse_finite(text_.word_in_line(), v)) v = 0;  // one-dimensional textures
    texcoords_.emplace_back(u, v);
  }

  // From 1, or from -1 backwards. An element must stand before the face that names it.
  std::uint32_t parse_index(std::string_view word, std::size_t count, const char* what) const {
    std::int64_t id;
    if (!parse_integer(word, id) || id == 0)
      text_.fail(std::string("a face's ") + what + " is not a number from 1");
    const auto n = static_cast<std::int64_t>(count);
    if (id > n || id < -n)
      text_.fail(std::string("a face names ") + what + " " + std::to_string(id) + "; there are " +
                 std::to_string(n) + " before it");
    return static_cast<std::uint32_t>(id > 0 ? id - 1 : n + id);
  }

  // "p", "p/t", "p//n" or "p/t/n".
  Corner parse_corner(std::string_view word) const {
    const auto next_part = [&word] {
      const std::size_t end = std::min(word.find('/'), word.size());
      const std::string_view part = word.substr(0, end);
      word.remove_prefix(std::min(end + 1, word.size()));
      return part;
    };
    Corner corner{parse_index(next_part(), mesh_.positions.size(), "vertex")};
    if (const std::string_view part = next_part(); !part.empty())
      corner.texcoord = parse_index(part, texcoords_.size(), "texture coordinate");
    if (!word.empty()) corner.normal = parse_index(word, normals_.size(), "normal");
    return corner;
  }

  void parse_face() {
    polygon_.clear();
    for (std::string_view word = text_.word_in_line(); !word.empty(); word = text_.word_in_line())
      polygon_.push_back(parse_corner(word));
    if (polygon_.size() < 3) text_.fail("a face of fewer than three vertices");
    for (std::size_t k = 1; k + 1 < polygon_.size(); ++k) {
      for (const Corner& c : {polygon_[0], polygon_[k], polygon_[k + 1]}) corners_.push_back(c);
      mesh_.triangles.push_back(
          {polygon_[0].position, polygon_[k].position, polygon_[k + 1].position});
      materials_.push_back(material_);
    }
  }

  // A name may hold blanks.
  std::string rest_of_line() {
    std::string name;
    for (std::string_view word = text_.word_in_line(); !word.empty(); word = text_.word_in_line())
      name += (name.empty() ? "" : " ") + std::string(word);
    return name;
  }

  void check_libraries() {
    for (std::string_view word = text_.word_in_line(); !word.empty(); word = text_.word_in_line())
      resolve_inside(file_, "line " + std::to_string(text_.line()), std::string(word));
  }

  // Vertices without a colour are white.
  void finish_colors() {
    if (!mesh_.colors.empty()) mesh_.colors.resize(mesh_.positions.size(), glm::vec3(1));
  }

  // The file has a normal a corner, a mesh has one a vertex: the mean. Without a normal at every
  // corner there are none.
  void finish_normals() {
    for (const Corner& corner : corners_)
      if (corner.normal == kNone) return;
    mesh_.normals.resize(corners_.empty() ? 0 : mesh_.positions.size(), glm::vec3(0));
    for (const Corner& corner : corners_) mesh_.normals[corner.position] += normals_[corner.normal];
  }

  // Corners without a texture coordinate have (0, 0).
  void finish_texcoords() {
    if (texcoords_.empty()) return;
    for (const Corner& corner : corners_)
      mesh_.texcoords.push_back(corner.texcoord == kNone ? glm::vec2(0)
                                                         : texcoords_[corner.texcoord]);
  }

  TextCursor text_;
  const std::filesystem::path& file_;
  TriMesh mesh_;
  std::vector<glm::vec2> texcoords_;
  std::vector<glm::vec3> normals_;
  std::vector<Corner> corners_;  // three a triangle
  std::vector<Corner> polygon_;
  MaterialIds material_ids_;
  std::vector<std::int32_t> materials_;
  std::int32_t material_ = MaterialIds::kNone;
};

}  // namespace

TriMesh parse_obj(std::string_view bytes, const std::filesystem::path& file, Remarks*) {
  return ObjParser(bytes, file).parse();
}

}  // namespace viewcell
