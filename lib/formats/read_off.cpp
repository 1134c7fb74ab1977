// Source: the Object File Format of Geomview.
#include "base/error.h"
#include "base/srgb.h"
#include "formats/readers.h"
#include "formats/text_cursor.h"

namespace viewcell {
namespace {

struct OffHeader {
  bool has_texcoords = false, has_colors = false, has_normals = false;
  std::uint64_t n_vertices = 0, n_faces = 0;
};

// "[ST][C][N][4][n]OFF". False when the word is no such thing.
bool parse_magic(std::string_view word, OffHeader& header, const TextCursor& text) {
  if (!word.ends_with("OFF")) return false;
  word.remove_suffix(3);
  if (word.starts_with("ST")) header.has_texcoords = true, word.remove_prefix(2);
  if (word.starts_with("C")) header.has_colors = true, word.remove_prefix(1);
  if (word.starts_with("N")) header.has_normals = true, word.remove_prefix(1);
  if (word == "4" || word == "n" || word == "4n") text.fail("only three dimensions are read");
  return word.empty();
}

std::uint64_t parse_count(std::string_view word, const char* what, const TextCursor& text) {
  std::int64_t count;
  if (!parse_integer(word, count) || count < 0)
    text.fail(std::string("expected the number of ") + what);
  return static_cast<std::uint64_t>(count);
}

// The counts may stand on the magic's line, and the magic may be left out.
OffHeader parse_header(TextCursor& text) {
  OffHeader header;
  std::string_view word = text.word();
  if (parse_magic(word, header, text)) {
    word = text.word();
    if (word == "BINARY") text.fail("binary OFF is not read");
  }
  std::int64_t ignored;
  if (!parse_integer(word, ignored)) text.fail("is not an OFF file: expected 'OFF' and counts");
  header.n_vertices = parse_count(word, "vertices", text);
  header.n_faces = parse_count(text.word(), "faces", text);
  text.skip_line();  // the number of edges, which many writers leave out or get wrong
  return header;
}

// A vertex takes at least "0 0 0\n", a face "3 0 1 2\n"; the last line break may be missing.
void check_counts(const OffHeader& header, const TextCursor& text) {
  const std::uint64_t most = text.bytes_left() + 1;
  if (header.n_vertices > most / 6 || header.n_faces > most / 8 ||
      header.n_vertices * 6 + header.n_faces * 8 > most)
    text.fail("claims " + std::to_string(header.n_vertices) + " vertices and " +
              std::to_string(header.n_faces) + " faces, more than the file can hold");
  if (header.n_vertices > 0xffffffffu) text.fail("has more vertices than 32 bits can number");
}

glm::vec3 read_vec3(TextCursor& text, std::uint64_t vertex) {
  glm::vec3 v;
  for (int k = 0; k < 3; ++k) v[k] = text.number(text.word_in_line(), "vertex", vertex);
  return v;
}

// Whole numbers are 0 to 255, as writers have it; a decimal point makes them 0 to 1.
glm::vec3 read_color(TextCursor& text, std::uint64_t vertex) {
  glm::vec3 color(0);
  for (int k = 0; k < 3; ++k) {
    const std::string_view word = text.word_in_line();
    float value;
    if (!parse_finite(word, value))
      text.fail("vertex " + std::to_string(vertex) + ": expected a colour");
    std::int64_t ignored;
    color[k] = srgb_decode(parse_integer(word, ignored) ? value / 255 : value);
  }
  return color;
}

// A vertex or face a line: reading on past its end would take a wrong count for a right one.
void start_line(TextCursor& text) {
  if (text.at_end()) text.fail("the file ends too early");
}

void read_vertices(TextCursor& text, const OffHeader& header, TriMesh& mesh) {
  mesh.positions.reserve(header.n_vertices);
  for (std::uint64_t v = 0; v < header.n_vertices; ++v) {
    start_line(text);
    mesh.positions.push_back(read_vec3(text, v));
    if (header.has_normals) mesh.normals.push_back(read_vec3(text, v));
    if (header.has_colors) mesh.colors.push_back(read_color(text, v));
    text.skip_line();
  }
}

void read_faces(TextCursor& text, const OffHeader& header, TriMesh& mesh) {
  mesh.triangles.reserve(header.n_faces);
  std::vector<std::uint32_t> polygon;
  const auto read_integer = [&text](std::uint64_t face, std::int64_t lo, std::int64_t hi) {
    return text.integer(text.word_in_line(), "face", face, lo, hi);
  };
  const auto n_vertices = static_cast<std::int64_t>(header.n_vertices);
  for (std::uint64_t f = 0; f < header.n_faces; ++f) {
    start_line(text);
    polygon.clear();
    for (std::int64_t left = read_integer(f, 3, 1 << 24); left > 0; --left)
      polygon.push_back(static_cast<std::uint32_t>(read_integer(f, 0, n_vertices - 1)));
    append_fan(polygon, mesh.triangles);
    text.skip_line();
  }
}

}  // namespace

TriMesh parse_off(std::string_view bytes, const std::filesystem::path& file, Remarks*) {
  TextCursor text(bytes, file.string());
  const OffHeader header = parse_header(text);
  check_counts(header, text);
  TriMesh mesh;
  read_vertices(text, header, mesh);
  read_faces(text, header, mesh);
  return mesh;
}

}  // namespace viewcell
