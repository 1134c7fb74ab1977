// Numbers as text that reads back the same. Private to this room.
#pragma once

#include <charconv>
#include <cstdio>
#include <string>

#include "mesh/offset.h"

namespace viewcell {

/// A blank and the shortest digits that read back to x.
template <typename Real>
void append_number(std::string& out, Real x) {
  char digits[32];
  out += ' ';
  out.append(digits, std::to_chars(digits, digits + sizeof digits, x).ptr);
}

/// As %g has it, with as many digits as a whole number of 32 bits takes.
inline std::string format_number(double x) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.10g", x);
  return digits;
}

/// Three numbers that read back the same, for people: an offset's are whole, or end soon.
inline std::string format_offset(const glm::dvec3& offset, const char* between) {
  std::string out;
  for (int k = 0; k < 3; ++k) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.17g", offset[k]);
    out += (k == 0 ? "" : between) + std::string(digits);
  }
  return out;
}

/// A vertex' three coordinates: floats, or about an offset doubles.
inline void append_place(std::string& out, const TriMesh& mesh, std::size_t vertex) {
  for (int k = 0; k < 3; ++k)
    if (mesh.offset == glm::dvec3(0))
      append_number(out, mesh.positions[vertex][k]);
    else
      append_number(out, place_of(mesh, vertex)[k]);
}

}  // namespace viewcell
