// Meshes as the bytes of files in formats that the library reads but does not write.
#pragma once

#include <zlib.h>

#include <cstdio>
#include <string>

#include "mesh/cube.h"

namespace viewcell {

inline std::string gzipped(const std::string& bytes) {
  z_stream stream{};
  deflateInit2(&stream, 9, Z_DEFLATED, 16 + MAX_WBITS, 9, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

inline std::string off_bytes(const TriMesh& mesh) {
  std::string out = "OFF\n" + std::to_string(mesh.positions.size()) + " " +
                    std::to_string(mesh.triangles.size()) + " 0\n";
  char line[80];
  for (const glm::vec3& p : mesh.positions) {
    std::snprintf(line, sizeof line, "%.9g %.9g %.9g\n", p.x, p.y, p.z);
    out += line;
  }
  for (const auto& [a, b, c] : mesh.triangles)
    out += "3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
  return out;
}

/// Binary; vertices of no triangle are lost.
inline std::string stl_bytes(const TriMesh& mesh) {
  std::string out(80, ' ');
  append_value(out, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const Triangle& t : mesh.triangles) {
    append_vec3(out, glm::vec3(0));
    for (const std::uint32_t v : t) append_vec3(out, mesh.positions[v]);
    append_value<std::uint16_t>(out, 0);
  }
  return out;
}

/// At most 65535 vertices and triangles.
inline std::string three_ds_bytes(const TriMesh& mesh) {
  std::string vertices, faces;
  append_value(vertices, static_cast<std::uint16_t>(mesh.positions.size()));
  for (const glm::vec3& p : mesh.positions) append_vec3(vertices, p);
  append_value(faces, static_cast<std::uint16_t>(mesh.triangles.size()));
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) append_value(faces, static_cast<std::uint16_t>(v));
    append_value<std::uint16_t>(faces, 7);
  }
  const std::string lists = chunk_3ds(0x4110, vertices) + chunk_3ds(0x4120, faces);
  return cube_3ds(chunk_3ds(0x4000, std::string("model\0", 6) + chunk_3ds(0x4100, lists)));
}

}  // namespace viewcell
