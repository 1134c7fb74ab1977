#include "formats/ply.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace viewcell {
namespace {

std::string row_place(std::string_view element, std::uint64_t row) {
  return std::string(element) + " " + std::to_string(row);
}

// The row that holds value i of the column.
std::uint64_t row_of(const PlyColumn& column, std::size_t i) {
  if (!column.is_list) return i;
  const auto after = std::upper_bound(column.starts.begin(), column.starts.end(), i);
  return static_cast<std::uint64_t>(after - column.starts.begin()) - 1;
}

const PlyColumn& column_of_kind(const PlyDocument& document, std::string_view element,
                                std::string_view property, bool is_list) {
  const PlyColumn& column = document.column(element, property);
  if (column.is_list != is_list)
    throw InputError(document.file, std::string(element),
                     "property '" + column.name + "' is " + (is_list ? "not a list" : "a list"));
  return column;
}

std::vector<std::uint32_t> whole_numbers(const PlyDocument& document, std::string_view element,
                                         const PlyColumn& column, double most) {
  std::vector<std::uint32_t> out;
  std::visit(
      [&](const auto& values) {
        out.resize(values.size());
        for (std::size_t i = 0; i < values.size(); ++i) {
          const auto value = static_cast<double>(values[i]);  // exact for every type of the format
          if (!(value >= 0 && value <= most && value == std::floor(value)))
            throw InputError(document.file, row_place(element, row_of(column, i)),
                             "property '" + column.name + "': " + std::to_string(values[i]) +
                                 " is not a whole number from 0 to " +
                                 std::to_string(static_cast<std::uint64_t>(std::max(most, 0.0))));
          out[i] = static_cast<std::uint32_t>(value);
        }
      },
      column.values);
  return out;
}

// ---- format_ply ----

constexpr const char* kTypeNames[] = {"char", "uchar", "short", "ushort",
                                      "int",  "uint",  "float", "double"};
constexpr std::uint64_t kMostListLength[] = {127, 255, 32767, 65535, 2147483647u, 4294967295u};

const char* type_name(PlyType type) {
  return kTypeNames[static_cast<std::size_t>(type)];
}

std::string format_header(const PlyDocument& document) {
  std::string out = "ply\nformat binary_little_endian 1.0\n";
  for (std::string comment : document.comments) {
    std::replace_if(
        comment.begin(), comment.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    out += "comment " + comment + "\n";
  }
  for (const PlyElement& element : document.elements) {
    out += "element " + element.name + " " + std::to_string(element.count) + "\n";
    for (const PlyColumn& column : element.columns)
      out += std::string("property ") +
             (column.is_list ? std::string("list ") + type_name(column.count_type) + " " : "") +
             type_name(column.type()) + " " + column.name + "\n";
  }
  return out + "end_header\n";
}

void check_column(const PlyElement& element, const PlyColumn& column) {
  const std::size_t n_values = std::visit([](const auto& v) { return v.size(); }, column.values);
  if (!column.is_list) {
    VIEWCELL_CHECK(n_values == element.count, column.name, n_values, element.count);
    return;
  }
  VIEWCELL_CHECK(column.count_type <= PlyType::kUint32, column.name);
  VIEWCELL_CHECK(column.starts.size() == element.count + 1, column.name, column.starts.size());
  VIEWCELL_CHECK(column.starts.front() == 0 && column.starts.back() == n_values, column.name);
  const std::uint64_t most = kMostListLength[static_cast<std::size_t>(column.count_type)];
  for (std::size_t r = 0; r < element.count; ++r)
    VIEWCELL_CHECK(
        column.starts[r] <= column.starts[r + 1] && column.starts[r + 1] - column.starts[r] <= most,
        column.name, r);
}

void append_bytes(std::string& out, const void* data, std::size_t n_bytes) {
  out.append(static_cast<const char*>(data), n_bytes);
}

// The low bytes stand first, in memory as in the file.
void append_count(std::string& out, PlyType type, std::uint64_t count) {
  static constexpr std::size_t kBytes[] = {1, 1, 2, 2, 4, 4};
  append_bytes(out, &count, kBytes[static_cast<std::size_t>(type)]);
}

void append_row(std::string& out, const PlyColumn& column, std::size_t row) {
  const std::uint64_t first = column.is_list ? column.starts[row] : row;
  const std::uint64_t last = column.is_list ? column.starts[row + 1] : row + 1;
  if (column.is_list) append_count(out, column.count_type, last - first);
  std::visit(
      [&](const auto& v) { append_bytes(out, v.data() + first, (last - first) * sizeof v[0]); },
      column.values);
}

}  // namespace

const PlyColumn* PlyElement::find(std::string_view property) const {
  for (const PlyColumn& column : columns)
    if (column.name == property) return &column;
  return nullptr;
}

const PlyElement* PlyDocument::find(std::string_view name) const {
  for (const PlyElement& element : elements)
    if (element.name == name) return &element;
  return nullptr;
}

const PlyElement& PlyDocument::element(std::string_view name) const {
  const PlyElement* found = find(name);
  if (!found) throw InputError(file, "header", "has no element '" + std::string(name) + "'");
  return *found;
}

bool PlyDocument::has(std::string_view element_name, std::string_view property) const {
  const PlyElement* found = find(element_name);
  return found && found->find(property);
}

const PlyColumn& PlyDocument::column(std::string_view element_name,
                                     std::string_view property) const {
  const PlyColumn* found = element(element_name).find(property);
  if (!found)
    throw InputError(file, "header",
                     "element '" + std::string(element_name) + "' has no property '" +
                         std::string(property) + "'");
  return *found;
}

std::vector<float> PlyDocument::floats(std::string_view element_name,
                                       std::string_view property) const {
  const PlyColumn& found = column_of_kind(*this, element_name, property, false);
  std::vector<float> out;
  std::visit(
      [&](const auto& values) {
        out.resize(values.size());
        for (std::size_t i = 0; i < values.size(); ++i) {
          out[i] = static_cast<float>(values[i]);  // a double past float's range becomes infinite
          if (!std::isfinite(out[i]))
            throw InputError(file, row_place(element_name, i),
                             "property '" + found.name + "' is not a finite number");
        }
      },
      found.values);
  return out;
}

std::vector<double> PlyDocument::doubles(std::string_view element_name,
                                         std::string_view property) const {
  const PlyColumn& found = column_of_kind(*this, element_name, property, false);
  return std::visit(
      [](const auto& values) { return std::vector<double>(values.begin(), values.end()); },
      found.values);
}

std::vector<std::uint32_t> PlyDocument::uints(std::string_view element_name,
                                              std::string_view property, std::uint32_t most) const {
  return whole_numbers(*this, element_name, column_of_kind(*this, element_name, property, false),
                       most);
}

std::vector<glm::vec3> PlyDocument::vec3s(std::string_view element_name, std::string_view x,
                                          std::string_view y, std::string_view z) const {
  std::vector<glm::vec3> out(element(element_name).count);
  const std::string_view names[] = {x, y, z};
  for (int k = 0; k < 3; ++k) {
    const std::vector<float> values = floats(element_name, names[k]);
    for (std::size_t i = 0; i < out.size(); ++i) out[i][k] = values[i];
  }
  return out;
}

std::vector<std::uint32_t> PlyDocument::list_indices(std::string_view element_name,
                                                     std::string_view property,
                                                     std::uint64_t n_vertices) const {
  return whole_numbers(*this, element_name, column_of_kind(*this, element_name, property, true),
                       static_cast<double>(n_vertices) - 1);
}

std::vector<Triangle> PlyDocument::triangles(std::string_view element_name,
                                             std::string_view property,
                                             std::uint64_t n_vertices) const {
  const PlyColumn& found = column_of_kind(*this, element_name, property, true);
  for (std::size_t r = 0; r + 1 < found.starts.size(); ++r)
    if (found.starts[r + 1] - found.starts[r] != 3)
      throw InputError(file, row_place(element_name, r), "is not a triangle");
  const std::vector<std::uint32_t> indices = list_indices(element_name, property, n_vertices);
  std::vector<Triangle> out(indices.size() / 3);
  for (std::size_t t = 0; t < out.size(); ++t)
    out[t] = {indices[3 * t], indices[3 * t + 1], indices[3 * t + 2]};
  return out;
}

void add_vec3s(PlyElement& element, const std::array<const char*, 3>& names,
               const std::vector<glm::vec3>& values) {
  for (int k = 0; k < 3; ++k) {
    std::vector<float> column(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) column[i] = values[i][k];
    add_column(element, names[static_cast<std::size_t>(k)], std::move(column));
  }
}

void add_triangles(PlyElement& element, const std::string& name,
                   const std::vector<Triangle>& triangles) {
  VIEWCELL_CHECK(triangles.size() == element.count, triangles.size(), element.count);
  PlyColumn column;
  column.name = name;
  column.is_list = true;
  std::vector<std::uint32_t> values(3 * triangles.size());
  if (!triangles.empty()) std::memcpy(values.data(), triangles.data(), 4 * values.size());
  column.values = std::move(values);
  column.starts.resize(triangles.size() + 1);
  for (std::size_t t = 0; t <= triangles.size(); ++t) column.starts[t] = 3 * t;
  element.columns.push_back(std::move(column));
}

std::string format_ply(const PlyDocument& document) {
  std::string out = format_header(document);
  for (const PlyElement& element : document.elements) {
    for (const PlyColumn& column : element.columns) check_column(element, column);
    for (std::size_t row = 0; row < element.count; ++row)
      for (const PlyColumn& column : element.columns) append_row(out, column, row);
  }
  return out;
}

}  // namespace viewcell
