// Source: the STL formats of 3D Systems.
// Differs: not by ADMesh (0.98.4 tried), which reads a text that is cut in its third facet
// as two facets, refuses blank lines and several solids, and opens files by name only.
#include <bit>
#include <unordered_map>

#include "formats/byte_cursor.h"
#include "formats/readers.h"
#include "formats/text_cursor.h"

namespace viewcell {
namespace {

constexpr std::size_t kHeaderBytes = 84;  // 80 of comment, and the count
constexpr std::size_t kFacetBytes = 50;   // normal, three positions, two bytes of attributes

struct PositionHash {
  std::size_t operator()(const glm::vec3& p) const {
    std::uint64_t h = 0;
    for (int k = 0; k < 3; ++k)
      h = (h ^ std::bit_cast<std::uint32_t>(p[k])) * 0x9e3779b97f4a7c15u, h ^= h >> 29;
    return h;
  }
};

// Numbers positions in the order of their first appearance.
class Welder {
 public:
  explicit Welder(TriMesh& mesh) : mesh_(mesh) {}
  std::uint32_t add(glm::vec3 p) {
    p += 0.0f;  // -0 becomes 0: they are equal, and must hash alike
    const auto [found, is_new] =
        ids_.try_emplace(p, static_cast<std::uint32_t>(mesh_.positions.size()));
    if (is_new) mesh_.positions.push_back(p);
    return found->second;
  }

 private:
  TriMesh& mesh_;
  std::unordered_map<glm::vec3, std::uint32_t, PositionHash> ids_;
};

TriMesh parse_binary_stl(std::string_view bytes, const std::string& file) {
  TriMesh mesh;
  Welder welder(mesh);
  ByteCursor cursor(bytes, file);
  cursor.take(80);
  const auto n = cursor.read<std::uint32_t>();
  mesh.triangles.reserve(n);
  for (std::uint32_t f = 0; f < n; ++f) {
    cursor.take(12);  // the normal, which follows from the positions and is often zero
    Triangle triangle;
    for (std::uint32_t& corner : triangle) {
      glm::vec3 p;
      for (int k = 0; k < 3; ++k) p[k] = cursor.read<float>();
      // Before welding: NaN equals nothing, and the error should name the facet.
      for (int k = 0; k < 3; ++k)
        if (!(std::abs(p[k]) <= std::numeric_limits<float>::max()))
          throw InputError(file, "facet " + std::to_string(f), "a position is not finite");
      corner = welder.add(p);
    }
    mesh.triangles.push_back(triangle);
    cursor.take(2);
  }
  return mesh;
}

void expect(TextCursor& text, std::string_view wanted) {
  if (text.word() != wanted) text.fail("expected '" + std::string(wanted) + "'");
}

Triangle parse_facet(TextCursor& text, std::uint64_t facet, Welder& welder) {
  expect(text, "normal");
  for (int k = 0; k < 3; ++k) text.word();
  expect(text, "outer");
  expect(text, "loop");
  Triangle triangle;
  for (std::uint32_t& corner : triangle) {
    expect(text, "vertex");
    glm::vec3 p;
    for (int k = 0; k < 3; ++k) p[k] = text.number(text.word(), "facet", facet);
    corner = welder.add(p);
  }
  expect(text, "endloop");
  expect(text, "endfacet");
  return triangle;
}

TriMesh parse_text_stl(std::string_view bytes, const std::string& file) {
  TriMesh mesh;
  Welder welder(mesh);
  TextCursor text(bytes, file, 0);
  if (text.at_end() || text.word() != "solid")
    text.fail("is not an STL file: neither 'solid' nor as long as a binary file says it is");
  text.skip_line();  // the solid's name
  while (!text.at_end()) {
    const std::string_view word = text.word();
    if (word == "facet")
      mesh.triangles.push_back(parse_facet(text, mesh.triangles.size(), welder));
    else if (word == "endsolid" || word == "solid")
      text.skip_line();  // a file may hold several solids
    else
      text.fail("expected 'facet' or 'endsolid'");
  }
  return mesh;
}

}  // namespace

// Many binary files begin with "solid" like text, so their size decides.
bool is_binary_stl(std::string_view bytes) {
  if (bytes.size() < kHeaderBytes) return false;
  std::uint32_t n;
  std::memcpy(&n, bytes.data() + 80, sizeof n);
  return bytes.size() == kHeaderBytes + kFacetBytes * std::uint64_t{n};
}

TriMesh parse_stl(std::string_view bytes, const std::filesystem::path& file, Remarks*) {
  return is_binary_stl(bytes) ? parse_binary_stl(bytes, file.string())
                              : parse_text_stl(bytes, file.string());
}

}  // namespace viewcell
