// Source: the STL formats of 3D Systems.
// Differs: not by ADMesh (0.98.4 tried), which reads a text that is cut in its third facet
// as two facets, refuses blank lines and several solids, and opens files by name only.
#include <algorithm>
#include <cctype>
#include <unordered_map>

#include "formats/byte_cursor.h"
#include "formats/face_list.h"
#include "formats/readers.h"
#include "formats/text_cursor.h"

namespace viewcell {
namespace {

constexpr std::size_t kHeaderBytes = 84;  // 80 of comment, and the count
constexpr std::size_t kFacetBytes = 50;   // normal, three positions, two bytes of attributes

struct PositionHash {
  std::size_t operator()(const glm::vec3& p) const { return hash_position(p); }
};

// Vertices at one position become one, in the order of their first appearance. Three vertices a
// triangle come in.
void weld_corners(TriMesh& mesh) {
  std::unordered_map<glm::vec3, std::uint32_t, PositionHash> ids;
  std::vector<glm::vec3> corners = std::move(mesh.positions);
  mesh.positions.clear();
  mesh.triangles.resize(corners.size() / 3);
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const glm::vec3 p = corners[c] + 0.0f;  // no -0
    const auto [found, is_new] =
        ids.try_emplace(p, static_cast<std::uint32_t>(mesh.positions.size()));
    if (is_new) mesh.positions.push_back(p);
    mesh.triangles[c / 3][c % 3] = found->second;
  }
}

// ---- binary ----

std::uint32_t stated_facets(std::string_view bytes) {
  std::uint32_t n;
  std::memcpy(&n, bytes.data() + 80, sizeof n);
  return n;
}

// Programs that write facets as they make them leave 0 or the largest number, which they would have
// replaced at the end. No text has such bytes.
bool is_count_left_open(std::string_view bytes) {
  return bytes.size() > kHeaderBytes &&
         (stated_facets(bytes) == 0 || stated_facets(bytes) == 0xffffffffu);
}

TriMesh parse_binary_stl(std::string_view bytes, const std::string& file, Remarks* remarks) {
  const std::size_t n_bytes = bytes.size() - kHeaderBytes, n_fit = n_bytes / kFacetBytes;
  const std::size_t n = is_count_left_open(bytes) ? n_fit : stated_facets(bytes);
  if (n > n_fit)
    throw InputError(file, "facet " + std::to_string(n_fit),
                     "the file ends inside or before this facet, of " + std::to_string(n));
  if (is_count_left_open(bytes)) {
    if (n * kFacetBytes != n_bytes)
      throw InputError(file, "facet " + std::to_string(n), "the file ends inside this facet");
    add_remark(remarks, "facets, counted by the file's size: its header does not say how many", n);
  } else if (n < n_fit && n_fit * kFacetBytes == n_bytes) {
    throw InputError(file, "header",
                     std::to_string(n) + " facets, and the file has " + std::to_string(n_fit));
  }
  add_remark(remarks, "bytes after the last facet, passed over", n_bytes - n * kFacetBytes);
  TriMesh mesh;
  ByteCursor cursor(bytes, file);
  cursor.take(kHeaderBytes);
  mesh.positions.reserve(3 * n);
  std::size_t n_attributes = 0;
  for (std::size_t f = 0; f < n; ++f) {
    cursor.take(12);  // the normal, which follows from the positions and is often zero
    for (int corner = 0; corner < 3; ++corner) {
      glm::vec3 p;
      for (int k = 0; k < 3; ++k) p[k] = cursor.read<float>();
      // Before welding: NaN equals nothing, and the error should name the facet.
      for (int k = 0; k < 3; ++k)
        if (!(std::abs(p[k]) <= std::numeric_limits<float>::max()))
          throw InputError(file, "facet " + std::to_string(f), "a position is not finite");
      mesh.positions.push_back(p);
    }
    n_attributes += cursor.read<std::uint16_t>() != 0;
  }
  add_remark(remarks, "facets with attributes (colours of VisCAM and Magics), passed over",
             n_attributes);
  choose_offset_of({}, mesh, remarks);
  return mesh;
}

// ---- text ----

// Keywords are written small or in capitals.
bool is_word(std::string_view word, std::string_view wanted) {
  return std::equal(word.begin(), word.end(), wanted.begin(), wanted.end(), [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == b;
  });
}

void expect(TextCursor& text, std::string_view wanted) {
  if (!is_word(text.word(), wanted)) text.fail("expected '" + std::string(wanted) + "'");
}

void parse_facet(TextCursor& text, std::vector<glm::dvec3>& corners) {
  const std::size_t facet = corners.size() / 3;
  expect(text, "normal");
  for (int k = 0; k < 3; ++k) text.word();
  expect(text, "outer");
  expect(text, "loop");
  for (int corner = 0; corner < 3; ++corner) {
    expect(text, "vertex");
    glm::dvec3 p;
    for (int k = 0; k < 3; ++k) p[k] = text.coordinate(text.word(), "facet", facet);
    corners.push_back(p);
  }
  expect(text, "endloop");
  expect(text, "endfacet");
}

TriMesh parse_text_stl(std::string_view bytes, const std::string& file, Remarks* remarks) {
  std::vector<glm::dvec3> corners;
  TextCursor text(bytes, file, 0);
  if (text.at_end() || !is_word(text.word(), "solid"))
    text.fail("is not an STL file: neither 'solid' nor as long as a binary file says it is");
  text.skip_line();  // the solid's name
  while (!text.at_end()) {
    const std::string_view word = text.word();
    if (is_word(word, "facet"))
      parse_facet(text, corners);
    else if (is_word(word, "endsolid") || is_word(word, "solid"))
      text.skip_line();  // a file may hold several solids
    else
      text.fail("expected 'facet' or 'endsolid'");
  }
  TriMesh mesh;
  place_vertices(corners, {}, mesh, remarks);
  return mesh;
}

}  // namespace

// Many binary files begin with "solid" like text, so their size decides.
bool is_binary_stl(std::string_view bytes) {
  return bytes.size() >= kHeaderBytes &&
         bytes.size() == kHeaderBytes + kFacetBytes * std::uint64_t{stated_facets(bytes)};
}

// Text has no byte of 0; what programs leave of the header's 80 bytes, and numbers, have many.
bool has_zeros(std::string_view bytes) {
  return bytes.size() >= kHeaderBytes &&
         bytes.substr(0, kHeaderBytes + kFacetBytes).find('\0') != std::string_view::npos;
}

bool may_be_stl(std::string_view bytes) {
  constexpr std::string_view kSolid = "solid";
  return is_word(bytes.substr(0, kSolid.size()), kSolid) ||
         (is_count_left_open(bytes) && (bytes.size() - kHeaderBytes) % kFacetBytes == 0);
}

TriMesh parse_stl(std::string_view bytes, const std::filesystem::path& file, Remarks* remarks) {
  const bool is_binary = is_binary_stl(bytes) || is_count_left_open(bytes) || has_zeros(bytes);
  TriMesh mesh = is_binary ? parse_binary_stl(bytes, file.string(), remarks)
                           : parse_text_stl(bytes, file.string(), remarks);
  weld_corners(mesh);
  return mesh;
}

}  // namespace viewcell
