// Meshes as every format that is written: what it holds comes back, what it does not hold is said.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "base/file.h"
#include "base/json.h"
#include "base/srgb.h"
#include "common/temporary_folder.h"
#include "formats/mesh_file.h"
#include "formats/readers.h"
#include "formats/remarks_of.h"
#include "formats/write_glb.h"
#include "mesh/cube.h"
#include "mesh/offset.h"

namespace viewcell {
namespace {

// A cube with everything: facets, colours of bytes, two materials, texture coordinates.
TriMesh make_full_cube() {
  TriMesh mesh = make_cube();
  for (const Triangle& t : mesh.triangles)
    mesh.corner_normals.insert(mesh.corner_normals.end(), 3,
                               glm::vec3(glm::normalize(area_normal(mesh, t))));
  for (int v = 0; v < 8; ++v)
    mesh.colors.emplace_back(srgb_decode(static_cast<float>(31 * v) / 255), 1,
                             srgb_decode(static_cast<float>(v) / 255));
  for (std::size_t t = 0; t < 12; ++t) {
    mesh.materials.push_back(t < 5 ? 0 : 1);
    for (int k = 0; k < 3; ++k) mesh.texcoords.emplace_back(0.25f * k, t < 6 ? 0 : 0.5f);
  }
  mesh.material_names = {"stone", "moss"};
  mesh.material_libraries = {"a library.mtl", "/far/b.mtl"};
  return mesh;
}

struct Written {
  TriMesh mesh;  // as it is read again
  Remarks remarks;
  std::string bytes;
};
Written write_and_read(const TriMesh& mesh, const std::string& ending) {
  const TemporaryFolder folder;
  const auto file = folder.path() / ("m" + ending);
  Written out;
  write_mesh(file, written_format(file, MeshFormat::ply), mesh, {"made by a test"}, &out.remarks);
  out.bytes = read_file(file);
  out.mesh = read_mesh(file);
  return out;
}

// Where each corner is, in order.
std::vector<glm::dvec3> corners_of(const TriMesh& mesh) {
  std::vector<glm::dvec3> out;
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) out.push_back(place_of(mesh, v));
  return out;
}

std::vector<glm::vec3> normals_of(const TriMesh& mesh) {
  if (!mesh.corner_normals.empty()) return mesh.corner_normals;
  std::vector<glm::vec3> out;
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) out.push_back(mesh.normals.at(v));
  return out;
}

TEST(WriteMesh, EndingsTellTheFormat) {
  EXPECT_EQ(written_format("a.GLB", MeshFormat::ply), MeshFormat::glb);
  EXPECT_EQ(written_format("a.obj", MeshFormat::ply), MeshFormat::obj);
  EXPECT_EQ(written_format("-", MeshFormat::obj), MeshFormat::obj);
  EXPECT_EQ(written_format("/dev/null", MeshFormat::ply), MeshFormat::ply);
}

TEST(WriteMesh, TheSameSurfaceInEveryFormat) {
  const TriMesh cube = make_full_cube();
  for (const std::string& ending : kWrittenEndings) {
    SCOPED_TRACE(ending);
    EXPECT_EQ(corners_of(write_and_read(cube, ending).mesh), corners_of(cube));
  }
}

TEST(WriteMesh, AnObjHoldsAllOfIt) {
  const TriMesh cube = make_full_cube();
  const auto [mesh, remarks, bytes] = write_and_read(cube, ".obj");
  EXPECT_EQ(mesh.positions, cube.positions);
  EXPECT_EQ(mesh.triangles, cube.triangles);
  EXPECT_EQ(mesh.corner_normals, cube.corner_normals);
  EXPECT_EQ(mesh.colors, cube.colors);
  EXPECT_EQ(mesh.texcoords, cube.texcoords);
  EXPECT_EQ(mesh.materials, cube.materials);
  EXPECT_EQ(mesh.material_libraries, cube.material_libraries);
  EXPECT_TRUE(remarks.empty());
  EXPECT_NE(bytes.find("\nmtllib a library.mtl\nmtllib /far/b.mtl\n"), std::string::npos);
  EXPECT_NE(bytes.find("\nv 1 0 0 0.12156863 1 0.003921569\n"), std::string::npos) << bytes;
  std::size_t n_normals = 0;
  for (std::size_t at = 0; (at = bytes.find("\nvn ", at)) != std::string::npos; ++at) ++n_normals;
  EXPECT_EQ(n_normals, 6u);  // each once
}

// Vertices of several normals become several, behind the others.
TEST(WriteMesh, PlyAndGlbSplitByNormals) {
  const TriMesh cube = make_full_cube();
  for (const char* ending : {".ply", ".glb"}) {
    SCOPED_TRACE(ending);
    const auto [mesh, remarks, bytes] = write_and_read(cube, ending);
    EXPECT_EQ(normals_of(mesh), normals_of(cube));
    EXPECT_EQ(count_of(remarks, "vertices added, where normals of corners differ"), 16u);
    EXPECT_EQ(count_of(remarks, "materials, which"), 2u);
    EXPECT_EQ(std::vector(mesh.positions.begin(), mesh.positions.begin() + 8), cube.positions);
  }
  const auto [mesh, remarks, bytes] = write_and_read(cube, ".ply");
  EXPECT_EQ(mesh.positions.size(), 24u);
  EXPECT_NE(bytes.find("comment 16 vertices added at the end, where normals"), std::string::npos);
  for (std::size_t c = 0; c < 36; ++c)
    EXPECT_EQ(mesh.colors[mesh.triangles[c / 3][c % 3]], cube.colors[cube.triangles[c / 3][c % 3]]);
  TriMesh smooth = cube;
  smooth.corner_normals.clear();
  smooth.normals = make_vertex_normals(smooth);
  EXPECT_EQ(write_and_read(smooth, ".ply").mesh.positions, cube.positions);
  EXPECT_EQ(write_and_read(smooth, ".ply").mesh.normals, smooth.normals);
}

TEST(WriteMesh, WhatAnStlAndAnOffLeaveOutIsSaid) {
  const TriMesh cube = make_full_cube();
  const Written stl = write_and_read(cube, ".stl");
  EXPECT_TRUE(is_binary_stl(stl.bytes));
  EXPECT_EQ(stl.bytes.size(), 84 + 12 * 50u);
  EXPECT_EQ(stl.bytes.substr(0, 15), "made by a test ");
  EXPECT_EQ(stl.mesh.positions.size(), 8u);
  EXPECT_EQ(count_of(stl.remarks, "colours of vertices"), 8u);
  EXPECT_EQ(count_of(stl.remarks, "normals of corners"), 36u);
  EXPECT_EQ(count_of(stl.remarks, "texture coordinates of corners"), 36u);
  EXPECT_EQ(count_of(stl.remarks, "materials"), 2u);
  for (std::size_t t = 0; t < 12; ++t) {
    glm::vec3 normal;
    std::memcpy(&normal, stl.bytes.data() + 84 + 50 * t, sizeof normal);
    EXPECT_EQ(normal, cube.corner_normals[3 * t]);
  }
  const Written off = write_and_read(cube, ".off");
  EXPECT_EQ(off.bytes.substr(0, 22), "COFF\n# made by a test\n");
  EXPECT_EQ(off.mesh.colors, cube.colors);
  EXPECT_EQ(off.mesh.triangles, cube.triangles);
  EXPECT_EQ(off.remarks.size(), 3u);
  TriMesh smooth = make_cube();
  smooth.normals = make_vertex_normals(smooth);
  const Written normals = write_and_read(smooth, ".off");
  EXPECT_EQ(normals.mesh.normals, smooth.normals);
  EXPECT_TRUE(normals.remarks.empty());
}

// ---- far from the origin ----

// A sphere of radius 5 m, 500 and 4,649 km east and north of a map's origin.
const glm::dvec3 kCentre(500012.25, 4649776.5, 212.125);
std::vector<glm::dvec3> sphere_places() {
  std::vector<glm::dvec3> out;
  for (int i = 0; i < 400; ++i) {
    const double z = 1 - 2 * (i + 0.5) / 400, a = 2.4 * i, r = std::sqrt(1 - z * z);
    out.push_back(kCentre + 5.0 * glm::dvec3(r * std::cos(a), r * std::sin(a), z));
  }
  return out;
}

TriMesh make_far_mesh() {
  TriMesh mesh;
  const std::vector<glm::dvec3> places = sphere_places();
  Box box;
  for (const glm::dvec3& p : places) box.add(p);
  place_vertices(mesh, places, choose_offset(box));
  for (std::uint32_t v = 0; v + 2 < 400; ++v) mesh.triangles.push_back({v, v + 1, v + 2});
  return mesh;
}

void expect_sphere(const TriMesh& mesh) {
  EXPECT_NE(mesh.offset, glm::dvec3(0));
  for (const glm::dvec3& p : corners_of(mesh)) EXPECT_NEAR(glm::distance(p, kCentre), 5, 1e-5);
}

TEST(FarMesh, IsReadAboutAnOffset) {
  char line[200];
  std::string obj = "v 0 0 0\n", off = "OFF\n401 398 0\n0 0 0\n", stl = "solid s\n";  // 0: unused
  const std::vector<glm::dvec3> places = sphere_places();
  for (const glm::dvec3& p : places) {
    std::snprintf(line, sizeof line, "%.9f %.9f %.9f\n", p.x, p.y, p.z);
    obj += std::string("v ") + line;
    off += line;
  }
  for (int v = 1; v + 2 <= 400; ++v) {
    const std::string a = std::to_string(v), b = std::to_string(v + 1), c = std::to_string(v + 2);
    obj += "f " + std::to_string(v + 1) + " " + std::to_string(v + 2) + " " +
           std::to_string(v + 3) + "\n";
    off += "3 " + a + " " + b + " " + c + "\n";
    stl += "facet normal 0 0 0 outer loop\n";
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3& p = places[static_cast<std::size_t>(v + k - 1)];
      std::snprintf(line, sizeof line, "vertex %.9f %.9f %.9f\n", p.x, p.y, p.z);
      stl += line;
    }
    stl += "endloop endfacet\n";
  }
  for (const auto& [name, bytes] :
       {std::pair("m.obj", obj), std::pair("m.off", off), std::pair("m.stl", stl + "endsolid\n")}) {
    SCOPED_TRACE(name);
    const TemporaryFolder folder;
    MeshSource source;
    const TriMesh mesh = read_mesh(folder.add(name, bytes), &source);
    expect_sphere(mesh);
    EXPECT_GE(count_of(source.remarks, "far from the origin: positions are kept about ("), 400u);
    EXPECT_EQ(mesh.triangles.size(), 398u);
  }
}

TEST(FarMesh, ComesBackFromEveryFormatThatIsText) {
  const TriMesh mesh = make_far_mesh();
  expect_sphere(mesh);
  for (const char* ending : {".ply", ".obj", ".off", ".stl"}) {
    SCOPED_TRACE(ending);
    const auto [back, remarks, bytes] = write_and_read(mesh, ending);
    EXPECT_EQ(back.offset, mesh.offset);
    EXPECT_EQ(corners_of(back), corners_of(mesh));
  }
  const Written ply = write_and_read(mesh, ".ply");
  EXPECT_NE(ply.bytes.find("comment offset 500016 4649776 208\n"), std::string::npos);
  EXPECT_NE(ply.bytes.find("property double x\n"), std::string::npos);
  EXPECT_EQ(count_of(write_and_read(mesh, ".stl").remarks, "facets written as text"), 398u);
}

// Part of it has a box of its own, and the offset of the whole.
TEST(FarMesh, APlyStatesItsOffset) {
  TriMesh mesh = make_far_mesh();
  mesh.triangles.resize(3);
  const TemporaryFolder folder;
  write_ply(folder.path() / "a.ply", mesh);
  EXPECT_EQ(read_mesh(folder.path() / "a.ply").offset, mesh.offset);
  std::string bytes = read_file(folder.path() / "a.ply");
  bytes.replace(bytes.find("offset 500016"), 13, "offset 900016");  // does not serve
  EXPECT_NE(read_mesh(folder.add("b.ply", bytes)).offset.x, 900016);
  EXPECT_EQ(corners_of(read_mesh(folder.path() / "b.ply")), corners_of(mesh));
}

TEST(FarMesh, AGlbHasItAsItsNodesTranslation) {
  const TemporaryFolder folder;
  const TriMesh mesh = make_far_mesh();
  write_glb(folder.path() / "a.glb", mesh);
  const std::string bytes = read_file(folder.path() / "a.glb");
  std::uint32_t n_json = 0;
  std::memcpy(&n_json, bytes.data() + 12, 4);
  const Json json = Json::parse(bytes.substr(20, n_json));
  EXPECT_EQ(json["nodes"][0]["translation"], Json({500016.0, 4649776.0, 208.0}));
  EXPECT_LT(json["accessors"][0]["max"][0].get<double>(), 16);
}

// Binary floats that are far away lose nothing by an offset, and near ones have none.
TEST(FarMesh, FloatsStayWhatTheyAre) {
  TriMesh cube = make_cube();
  for (glm::vec3& p : cube.positions) p += glm::vec3(3000, 0, 0);
  std::string bytes = "made by hand";
  bytes.resize(80, ' ');
  append_value(bytes, std::uint32_t{12});
  for (const Triangle& t : cube.triangles) {
    append_vec3(bytes, glm::vec3(0));
    for (const std::uint32_t v : t) append_vec3(bytes, cube.positions[v]);
    append_value(bytes, std::uint16_t{0});
  }
  const TriMesh far = parse_stl(bytes, "m.stl");
  EXPECT_EQ(far.offset, glm::dvec3(3001, 0, 0));
  EXPECT_EQ(corners_of(far), corners_of(cube));
}

// As far as floats reach: what is written there is read again.
TEST(WriteMesh, AtTheEndOfFloats) {
  TriMesh mesh = make_cube();
  for (glm::vec3& p : mesh.positions) p *= 0x1p99f;
  mesh.offset = {0x1p127, -0x1p127, 0x1p120};
  for (const std::string& ending : kWrittenEndings)
    EXPECT_EQ(corners_of(write_and_read(mesh, ending).mesh), corners_of(mesh)) << ending;
}

}  // namespace
}  // namespace viewcell
