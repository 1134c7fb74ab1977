// The Polygon File Format as a document: typed columns, one per property.
// Source: Greg Turk, The PLY Polygon File Format (1994).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/error.h"
#include "mesh/mesh.h"

namespace viewcell {

/// In the order of PlyValues' alternatives.
enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };
using PlyValues =
    std::variant<std::vector<std::int8_t>, std::vector<std::uint8_t>, std::vector<std::int16_t>,
                 std::vector<std::uint16_t>, std::vector<std::int32_t>, std::vector<std::uint32_t>,
                 std::vector<float>, std::vector<double>>;

/// One property of all rows. A scalar property has one value a row; row r of a list property has
/// values [starts[r], starts[r + 1]).
struct PlyColumn {
  std::string name;
  PlyValues values;
  bool is_list = false;
  PlyType count_type = PlyType::kUint8;  ///< of a list, in the file
  std::vector<std::uint64_t> starts;     ///< of a list: rows + 1 places in values

  PlyType type() const { return static_cast<PlyType>(values.index()); }
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;  ///< rows
  std::vector<PlyColumn> columns;

  const PlyColumn* find(std::string_view property) const;
};

/// The getters throw InputError naming the file, and the row ("vertex 17") at fault.
struct PlyDocument {
  std::string file;  ///< for errors
  std::vector<std::string> comments;
  std::vector<PlyElement> elements;

  const PlyElement* find(std::string_view element) const;
  const PlyElement& element(std::string_view name) const;
  bool has(std::string_view element, std::string_view property) const;
  const PlyColumn& column(std::string_view element, std::string_view property) const;

  /// A scalar column of any type as finite floats.
  std::vector<float> floats(std::string_view element, std::string_view property) const;
  /// A scalar column of any type as it is, NaN too.
  std::vector<double> doubles(std::string_view element, std::string_view property) const;
  /// A scalar column of any type as whole numbers, each at most `most`.
  std::vector<std::uint32_t> uints(std::string_view element, std::string_view property,
                                   std::uint32_t most = 0xffffffffu) const;
  /// Three scalar columns.
  std::vector<glm::vec3> vec3s(std::string_view element, std::string_view x, std::string_view y,
                               std::string_view z) const;
  /// A list column of three indices below n_vertices a row.
  std::vector<Triangle> triangles(std::string_view element, std::string_view property,
                                  std::uint64_t n_vertices) const;
  /// All values of a list column as indices below n_vertices, one list after another.
  std::vector<std::uint32_t> list_indices(std::string_view element, std::string_view property,
                                          std::uint64_t n_vertices) const;
};

/// Adds a scalar column; values has element.count entries.
template <typename T>
void add_column(PlyElement& element, const std::string& name, std::vector<T> values) {
  VIEWCELL_CHECK(values.size() == element.count, values.size(), element.count);
  PlyColumn column;
  column.name = name;
  column.values = std::move(values);
  element.columns.push_back(std::move(column));
}
/// Adds three float columns.
void add_vec3s(PlyElement& element, const std::array<const char*, 3>& names,
               const std::vector<glm::vec3>& values);
/// Adds a list column "list uchar uint" of three indices a row.
void add_triangles(PlyElement& element, const std::string& name,
                   const std::vector<Triangle>& triangles);

/// The element "vertex" of a mesh that we write: x y z, floats or about an offset doubles where the
/// vertices are, and nx ny nz where there are normals by vertex.
PlyElement make_vertices(const TriMesh& mesh);
/// What says the offset of a mesh, if it has one (mesh/offset.h): "offset X Y Z".
std::vector<std::string> offset_comments(const TriMesh& mesh);

/// Parses ASCII, binary little-endian and binary big-endian documents. Comments may stand anywhere
/// in the header. "nan", "inf" and the like are NaN. Every count is checked
/// against the bytes that are left before anything is allocated for it; memory stays within a small
/// multiple of the bytes. Throws InputError (file, line or row).
PlyDocument parse_ply(std::string_view bytes, const std::string& file);

/// Binary little-endian. Line breaks in comments become blanks. Throws BugError when a column's
/// length is not its element's count or a list is longer than its count type can say.
std::string format_ply(const PlyDocument& document);

}  // namespace viewcell
