// Source: the Object File Format of Geomview.
#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/error.h"
#include "base/srgb.h"
#include "formats/color_range.h"
#include "formats/face_list.h"
#include "formats/readers.h"
#include "formats/text_cursor.h"

namespace viewcell {
namespace {

struct OffMagic {
  bool is_one = false;
  bool has_texcoords = false, has_colors = false, has_normals = false;
  bool has_other_dimensions = false;
  std::string_view behind;  // "8" of "OFF8"
};

// "[ST][C][N][4][n]OFF"; all in small letters, "noff" has normals.
OffMagic parse_magic(std::string_view word) {
  const auto is_small = [](char c) { return std::islower(static_cast<unsigned char>(c)) != 0; };
  const bool all_small = std::none_of(word.begin(), word.end(), [](char c) {
    return std::isupper(static_cast<unsigned char>(c)) != 0;
  });
  const auto take = [&](std::string_view part, bool any_case = true) {
    const auto equal = [&](char a, char b) {
      return a == b || ((any_case || all_small) && is_small(b) && a == b - 'a' + 'A');
    };
    const bool fits =
        word.size() >= part.size() && std::equal(part.begin(), part.end(), word.begin(), equal);
    if (fits) word.remove_prefix(part.size());
    return fits;
  };
  OffMagic out;
  out.has_texcoords = take("ST");
  out.has_colors = take("C");
  out.has_normals = take("N", false);
  out.has_other_dimensions = take("4");
  out.has_other_dimensions |= take("n");
  out.is_one = take("OFF");
  out.behind = word;
  return out;
}

struct OffHeader {
  OffMagic magic;
  std::uint64_t n_vertices = 0, n_faces = 0;
  bool is_one_line = false;  // lines mean nothing: there are fewer than vertices and faces
};

std::uint64_t parse_count(std::string_view word, const char* what, const TextCursor& text) {
  std::int64_t count;
  if (!parse_integer(word, count) || count < 0)
    text.fail(std::string("expected the number of ") + what);
  return static_cast<std::uint64_t>(count);
}

// Lines with a word that are left, up to so many.
std::uint64_t count_rows(TextCursor text, std::uint64_t most) {
  std::uint64_t n = 0;
  for (; n < most && !text.at_end(); text.skip_line()) ++n;
  return n;
}

// The counts may stand on the magic's line or touch it, and the magic may be left out.
OffHeader parse_header(TextCursor& text) {
  OffHeader header;
  std::string_view word = text.word();
  if (const OffMagic magic = parse_magic(word); magic.is_one) {
    header.magic = magic;
    if (magic.has_other_dimensions) text.fail("only three dimensions are read");
    word = magic.behind.empty() ? text.word() : magic.behind;
    if (word == "BINARY") text.fail("binary OFF is not read");
  }
  std::int64_t ignored;
  if (!parse_integer(word, ignored)) text.fail("is not an OFF file: expected 'OFF' and counts");
  header.n_vertices = parse_count(word, "vertices", text);
  header.n_faces = parse_count(text.word(), "faces", text);
  text.word_in_line();  // the number of edges, which many writers leave out or get wrong
  const TextCursor behind = text;
  header.is_one_line = !text.word_in_line().empty();
  if (header.is_one_line)
    text = behind;
  else
    text.skip_line();
  const std::uint64_t n_rows = header.n_vertices + header.n_faces;
  header.is_one_line = header.is_one_line || count_rows(text, n_rows) < n_rows;
  return header;
}

// A vertex takes at least "0 0 0\n", a face "1 0\n"; the last line break may be missing.
void check_counts(const OffHeader& header, const TextCursor& text) {
  constexpr std::uint64_t kVertexBytes = 6, kFaceBytes = 2;
  const std::uint64_t most = text.bytes_left() + 1;
  if (header.n_vertices > most / kVertexBytes || header.n_faces > most / kFaceBytes ||
      header.n_vertices * kVertexBytes + header.n_faces * kFaceBytes > most)
    text.fail("claims " + std::to_string(header.n_vertices) + " vertices and " +
              std::to_string(header.n_faces) + " faces, more than the file can hold");
  if (header.n_vertices > 0xffffffffu) text.fail("has more vertices than 32 bits can number");
}

// A vertex or face a line: reading on past its end would take a wrong count for a right one.
void start_line(TextCursor& text) {
  if (text.at_end()) text.fail("the file ends too early");
}

class OffParser {
 public:
  OffParser(std::string_view bytes, const std::string& file, Remarks* remarks)
      : text_(bytes, file), file_(file), remarks_(remarks), header_(parse_header(text_)) {
    check_counts(header_, text_);
    const OffMagic& magic = header_.magic;
    if (header_.is_one_line && (magic.has_colors || magic.has_normals || magic.has_texcoords))
      text_.fail("has fewer lines than vertices and faces: then vertices are three coordinates");
  }

  TriMesh parse() {
    read_vertices();
    read_faces();
    mend_unused_places(places_, faces_.vertices, file_, remarks_, nowhere_lines_);
    place_vertices(places_, faces_.vertices, mesh_, remarks_);
    cut_faces(faces_, mesh_, nullptr, remarks_);
    for (const auto& color : colors_) mesh_.colors.push_back(decode(color));
    if (header_.magic.has_texcoords)
      for (const Triangle& t : mesh_.triangles)
        for (const std::uint32_t v : t) mesh_.texcoords.push_back(texcoords_[v]);
    add_remark(remarks_, "faces with colours of their own, which are passed over",
               n_colored_faces_);
    add_remark(remarks_, "vertices with more numbers than the file's first word says, passed over",
               n_longer_);
    return std::move(mesh_);
  }

 private:
  // As in the file; whether a point or an exponent stood in its line.
  struct Color {
    glm::vec3 rgb{0};
    bool has_point = false;
  };

  std::string_view next_word() { return header_.is_one_line ? text_.word() : text_.word_in_line(); }

  // "x y z [nx ny nz] [r g b [a]] [s t]".
  void read_vertices() {
    places_.reserve(header_.n_vertices);
    for (std::uint64_t v = 0; v < header_.n_vertices; ++v) {
      start_line(text_);
      glm::dvec3 place;
      for (int k = 0; k < 3; ++k) place[k] = text_.coordinate_or_nan(next_word(), "vertex", v);
      if (std::isnan(place.x + place.y + place.z)) nowhere_lines_.push_back(text_.line());
      places_.push_back(place);
      if (header_.is_one_line) continue;
      if (header_.magic.has_normals) read_normal(v);
      if (header_.magic.has_colors || header_.magic.has_texcoords)
        read_rest(v);
      else
        n_longer_ += !text_.word_in_line().empty();
      text_.skip_line();
    }
  }

  // One that is not a number is none (normalize_normals).
  void read_normal(std::uint64_t vertex) {
    glm::vec3 normal;
    for (int k = 0; k < 3; ++k) {
      const std::string_view word = text_.word_in_line();
      double value;
      normal[k] = parse_float_or_nan(word, value) ? static_cast<float>(value)
                                                  : text_.number(word, "vertex", vertex);
    }
    mesh_.normals.push_back(normal);
  }

  void read_rest(std::uint64_t vertex) {
    const std::string place = "vertex " + std::to_string(vertex);
    Color color;
    std::vector<float> values;
    for (std::string_view word = text_.word_in_line(); !word.empty(); word = text_.word_in_line()) {
      float value;
      if (!parse_finite(word, value)) text_.fail(place + ": expected a colour");
      color.has_point |= word.find_first_of(".eE") != std::string_view::npos;
      values.push_back(value);
    }
    const std::size_t n_texcoord = header_.magic.has_texcoords ? 2 : 0;
    if (values.size() < n_texcoord) text_.fail(place + ": a texture coordinate is missing");
    const std::size_t n_color = values.size() - n_texcoord;
    if (header_.magic.has_texcoords) texcoords_.emplace_back(values[n_color], values[n_color + 1]);
    if (!header_.magic.has_colors) return;
    if (n_color < 3) text_.fail(place + ": expected a colour");
    for (int k = 0; k < 3; ++k) color.rgb[k] = values[static_cast<std::size_t>(k)];
    for (std::size_t k = 0; k < n_color; ++k) most_color_ = std::max(most_color_, values[k]);
    colors_.push_back(color);
  }

  // Whole numbers are 0 to 255, as writers have it, unless none is above 1; points make them 0 to
  // 1, unless they are above that.
  glm::vec3 decode(const Color& color) const {
    const float own = std::max({color.rgb.r, color.rgb.g, color.rgb.b});
    const bool is_of_one = most_color_ <= 1 || (color.has_point && full_color(own) == 1);
    const float full = is_of_one ? 1 : std::max(255.0f, full_color(most_color_));
    return {srgb_decode(color.rgb.r / full), srgb_decode(color.rgb.g / full),
            srgb_decode(color.rgb.b / full)};
  }

  void read_faces() {
    const auto read_integer = [&](std::uint64_t face, std::int64_t lo, std::int64_t hi) {
      return text_.integer(next_word(), "face", face, lo, hi);
    };
    const auto n_vertices = static_cast<std::int64_t>(header_.n_vertices);
    for (std::uint64_t f = 0; f < header_.n_faces; ++f) {
      start_line(text_);
      for (std::int64_t left = read_integer(f, 0, 1 << 24); left > 0; --left)
        faces_.vertices.push_back(static_cast<std::uint32_t>(read_integer(f, 0, n_vertices - 1)));
      faces_.end_face();
      if (header_.is_one_line) continue;
      n_colored_faces_ += !text_.word_in_line().empty();
      text_.skip_line();
    }
    if (header_.is_one_line && !text_.at_end()) text_.fail("more stands behind the last face");
  }

  TextCursor text_;
  std::string file_;
  Remarks* remarks_;
  OffHeader header_;
  TriMesh mesh_;
  std::size_t n_longer_ = 0;
  std::vector<glm::dvec3> places_;
  std::vector<std::int64_t> nowhere_lines_;  // of vertices without a position
  std::vector<Color> colors_;
  std::vector<glm::vec2> texcoords_;
  FaceList faces_;
  float most_color_ = 0;  // of any channel, alpha too
  std::size_t n_colored_faces_ = 0;
};

}  // namespace

TriMesh parse_off(std::string_view bytes, const std::filesystem::path& file, Remarks* remarks) {
  return OffParser(bytes, file.string(), remarks).parse();
}

bool starts_as_off(std::string_view bytes) {
  const OffMagic magic = parse_magic(bytes.substr(0, bytes.find_first_of(" \t\r\n")));
  std::int64_t ignored;
  return magic.is_one && (magic.behind.empty() || parse_integer(magic.behind, ignored));
}

}  // namespace viewcell
