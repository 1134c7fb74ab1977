// Files as programs write them, not quite as formats have it: the same cube comes out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <limits>

#include "base/srgb.h"
#include "common/expect_input_error.h"
#include "common/mutate.h"
#include "common/temporary_folder.h"
#include "formats/mesh_bytes.h"
#include "formats/mesh_file.h"
#include "formats/readers.h"
#include "formats/remarks_of.h"
#include "mesh/cube.h"

namespace viewcell {
namespace {

const std::string kMark = "\xef\xbb\xbf";

void expect_cube(const TriMesh& mesh) {
  EXPECT_EQ(mesh.positions, cube_positions());
  EXPECT_EQ(mesh.triangles, cube_triangles());
}

struct Read {
  TriMesh mesh;
  Remarks remarks;
};
Read read_bytes(const std::string& name, const std::string& bytes) {
  const TemporaryFolder folder;
  MeshSource source;
  TriMesh mesh = read_mesh(folder.add(name, bytes), &source);
  return {std::move(mesh), source.remarks};
}

std::string capitals(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

// ---- byte order marks ----

TEST(ByteOrderMark, StandsBeforeTextOfAnyFormat) {
  for (const std::string ending : {"obj", "off", "ply", "stl", "gltf", "ply.gz", "unknown"})
    for (const std::string& text : {cube_obj(), cube_off(), cube_ply(), cube_stl_text()}) {
      const bool fits =
          (ending == "obj" && text == cube_obj()) || (ending == "off" && text == cube_off()) ||
          (ending == "ply" && text == cube_ply()) || (ending == "stl" && text == cube_stl_text()) ||
          (ending == "ply.gz" && text == cube_ply()) || ending == "unknown";
      if (!fits) continue;
      SCOPED_TRACE(ending + " " + text.substr(0, 5));
      const std::string marked = ending == "ply.gz" ? gzipped(kMark + text) : kMark + text;
      const std::string plain = ending == "ply.gz" ? gzipped(text) : text;
      EXPECT_EQ(read_bytes("m." + ending, marked).mesh.positions,
                read_bytes("m." + ending, plain).mesh.positions);
    }
  std::string binary = cube_ply();
  TriMesh cube = make_cube();
  const TemporaryFolder folder;
  write_ply(folder.path() / "b.ply", cube);
  expect_cube(read_bytes("b.ply", kMark + read_file(folder.path() / "b.ply")).mesh);
}

// The first vertex was lost, and the mesh was another.
TEST(ByteOrderMark, LosesNoVertex) {
  const std::string text = "v 5 5 5\n" + cube_obj();
  EXPECT_EQ(parse_obj(kMark + text, "m").positions, parse_obj(text, "m").positions);
  const std::string joined = cube_obj() + kMark + "v 9 9 9\n" + kMark + "f 1 2 9\n";
  const TriMesh mesh = parse_obj(joined, "m");  // files put together
  EXPECT_EQ(mesh.positions.back(), glm::vec3(9));
  EXPECT_EQ(mesh.triangles.back(), (Triangle{0, 1, 8}));
}

TEST(ByteOrderMark, OfUtf16IsRefusedByName) {
  const auto wide = [](const std::string& text, bool is_big) {
    std::string out = is_big ? "\xfe\xff" : "\xff\xfe";
    for (const char c : text) out += is_big ? std::string({'\0', c}) : std::string({c, '\0'});
    return out;
  };
  for (const char* name : {"m.obj", "m.ply", "m.off", "m.stl", "m.gltf", "m.unknown"})
    for (const bool is_big : {false, true})
      EXPECT_INPUT_ERROR(read_bytes(name, wide(cube_obj(), is_big)), "save it as UTF-8");
  EXPECT_INPUT_ERROR(read_bytes("m.obj", std::string("\0\0\xfe\xff", 4) + "v"), "UTF-32");
  std::string binary = cube_stl_binary();  // whose comment may be anything
  binary.replace(0, 2, "\xff\xfe");
  EXPECT_EQ(read_bytes("m.stl", binary).mesh.positions.size(), 8u);
  binary.replace(0, 3, kMark);
  EXPECT_EQ(read_bytes("m.stl", binary).mesh.positions.size(), 8u);
}

// ---- line breaks ----

TEST(LineBreaks, OfAnyMachine) {
  for (const auto& [name, text] :
       {std::pair("m.obj", cube_obj()), std::pair("m.off", cube_off()),
        std::pair("m.ply", cube_ply()), std::pair("m.stl", cube_stl_text())}) {
    SCOPED_TRACE(name);
    std::string macintosh = text, windows;
    std::replace(macintosh.begin(), macintosh.end(), '\n', '\r');
    for (const char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
    for (const std::string& other : {macintosh, windows}) {
      const TriMesh mesh = read_bytes(name, other).mesh;
      EXPECT_EQ(mesh.triangles, read_bytes(name, text).mesh.triangles);
      EXPECT_EQ(mesh.positions, read_bytes(name, text).mesh.positions);
    }
  }
}

// ---- OFF ----

TEST(OffVariants, HeadersTouchTheirCounts) {
  for (const std::string head : {"OFF8 6 0", "OFF8 6", "off 8 6 0", "Off\n8 6 0", "off8 6 0",
                                 "OFF\r\n8 6 0", "# first\nOFF8 6 0", "OFF +8 6 0"}) {
    SCOPED_TRACE(head);
    const std::string text = replaced(cube_off(), "OFF\n8 6 0", head);
    expect_cube(parse_off(text, "m.off"));
    if (head[0] != '#') expect_cube(read_bytes("nameless", text).mesh);
  }
  const std::string body = "0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n";
  for (const std::string head : {"NOFF3 1 0\n", "noff 3 1 0\n", "NOFF 3 1\n"})
    EXPECT_EQ(parse_off(head + body, "m").normals, std::vector<glm::vec3>(3, {0, 0, 1})) << head;
  for (const std::string head : {"4OFF3 1 0\n", "nOFF 3 3 1 0\n", "4nOFF 3 3 1 0\n"})
    EXPECT_INPUT_ERROR(parse_off(head + body, "m"), "three dimensions");
  for (const std::string head : {"OFFICE 3 1 0\n", "OFF8x 1 0\n", "SOFF 3 1 0\n", "OF 3 1 0\n"})
    EXPECT_INPUT_ERROR(parse_off(head + body, "m"), "is not an OFF file");
}

TEST(OffVariants, AllOnOneLine) {
  std::string text = cube_off();
  std::replace(text.begin(), text.end(), '\n', ' ');
  expect_cube(parse_off(text, "m.off"));
  EXPECT_INPUT_ERROR(parse_off(text + "3 0 1 2", "m.off"), "more stands behind the last face");
  EXPECT_INPUT_ERROR(parse_off("C" + text, "m.off"), "fewer lines than vertices and faces");
  // Counts on a line of their own.
  text.replace(text.find(" 0 ") + 2, 1, "\n");
  expect_cube(parse_off(text, "m.off"));
  EXPECT_INPUT_ERROR(parse_off(text.substr(0, text.size() - 3), "m.off"), "too early");
}

TEST(OffVariants, TextureCoordinatesStandLast) {
  const TriMesh mesh = parse_off(
      "STCOFF 3 1 0\n0 0 0 255 0 0 255 0 0\n1 0 0 0 255 0 1 0\n0 1 0 0 0 255 0 1\n3 0 1 2\n", "m");
  EXPECT_EQ(mesh.texcoords, (std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}}));
  EXPECT_EQ(mesh.colors, (std::vector<glm::vec3>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_INPUT_ERROR(parse_off("STOFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "m"),
                     "vertex 0: a texture coordinate is missing");
}

TEST(OffVariants, ColoursOfAnyRange) {
  const auto green_of = [](const std::string& color, const std::string& others) {
    return parse_off("COFF 3 1 0\n0 0 0 " + color + "\n1 0 0 " + others + "\n0 1 0 " + others +
                         "\n3 0 1 2\n",
                     "m")
        .colors[0];
  };
  const glm::vec3 orange(1, srgb_decode(128 / 255.0f), 0);
  EXPECT_EQ(green_of("255 128 0", "0 0 0"), orange);
  EXPECT_EQ(green_of("255.0 128.0 0.0", "0 0 0"), orange);
  EXPECT_EQ(green_of("65535 32896 0", "0 0 0"), orange);
  EXPECT_EQ(green_of("1 0 0", "0.25 0.5 1"), glm::vec3(1, 0, 0));  // as streams print floats
  EXPECT_EQ(green_of("1 0 0 255", "0 0 0 255"), glm::vec3(srgb_decode(1 / 255.0f), 0, 0));
}

// ---- STL ----

TEST(StlVariants, WordsInCapitals) {
  const std::string text = capitals(cube_stl_text());
  const TriMesh wanted = read_bytes("m.stl", cube_stl_text()).mesh;
  for (const char* name : {"m.stl", "nameless"}) {
    const TriMesh mesh = read_bytes(name, text).mesh;
    EXPECT_EQ(mesh.positions, wanted.positions);
    EXPECT_EQ(mesh.triangles, wanted.triangles);
  }
  std::string mixed = replaced(cube_stl_text(), "endfacet", "EndFacet");
  EXPECT_EQ(parse_stl("\n  \n" + mixed, "m").triangles, wanted.triangles);
}

// Programs that write facets as they make them leave it.
TEST(StlVariants, TheCountIsLeftOpen) {
  const TriMesh wanted = parse_stl(cube_stl_binary(), "m");
  for (const std::uint32_t count : {0u, 0xffffffffu})
    for (const char* begin : {"", "solid ", "SOLID facet "}) {
      SCOPED_TRACE(begin);
      std::string bytes = cube_stl_binary();
      bytes.replace(0, std::string(begin).size(), begin);
      std::memcpy(bytes.data() + 80, &count, 4);
      const auto [mesh, remarks] = read_bytes("m.stl", bytes);
      EXPECT_EQ(mesh.triangles, wanted.triangles);
      EXPECT_EQ(count_of(remarks, "facets, counted by the file's size"), 12u);
      EXPECT_EQ(read_bytes("nameless", bytes).mesh.triangles, wanted.triangles);
      for (const std::size_t n : {1u, 25u, 49u})
        EXPECT_INPUT_ERROR(parse_stl(bytes.substr(0, bytes.size() - n), "m"),
                           "facet 11: the file ends inside this facet");
    }
  for (const std::uint32_t count : {11u, 13u}) {  // said, and wrong
    std::string bytes = cube_stl_binary();
    std::memcpy(bytes.data() + 80, &count, 4);
    EXPECT_THROW(parse_stl(bytes, "m"), InputError);
  }
}

// ---- PLY ----

const std::string kHead =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
    "property float y\nproperty float z\n";
const std::string kFaces = "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kFaceRows = "3 0 1 2\n3 0 2 3\n";

TEST(PlyVariants, CommentsAnywhereInTheHeader) {
  const std::string text = cube_ply();
  for (const std::string to : {"ply\ncomment made by Y\nobj_info z\nformat ascii 1.0\n",
                               "ply\n\nformat  ascii  1.0\ncomment x\n"})
    expect_cube(parse_ply_mesh(replaced(text, "ply\nformat ascii 1.0\n", to), "m"));
  const std::string late = replaced(text, "ply\nformat ascii 1.0\n", "ply\n");
  expect_cube(parse_ply_mesh(replaced(late, "end_header", "format ascii 1.0\nend_header"), "m"));
  EXPECT_INPUT_ERROR(parse_ply_mesh(late, "m"), "no line 'format'");
  EXPECT_INPUT_ERROR(parse_ply_mesh(replaced(text, "1.0\n", "1.0\nformat ascii 1.0\n"), "m"),
                     "the format stands twice");
}

// -1 ends a strip; a corner named twice turns one.
TEST(PlyVariants, TriangleStrips) {
  const std::string head = kHead + "element tristrips ";
  const std::string rest =
      "\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  const auto strips = [&](const std::string& n, const std::string& rows) {
    return parse_ply_mesh(head + n + rest + rows, "m").triangles;
  };
  EXPECT_EQ(strips("1", "4 0 1 3 2\n"), (std::vector<Triangle>{{0, 1, 3}, {3, 1, 2}}));
  EXPECT_EQ(strips("1", "7 0 1 2 -1 0 2 3\n"), (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(strips("2", "3 0 1 2\n4 -1 0 2 3\n"), (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(strips("1", "5 0 1 2 2 3\n"), (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(strips("1", "6 0 1 2 2 3 0\n"), (std::vector<Triangle>{{0, 1, 2}, {3, 2, 0}}));
  EXPECT_INPUT_ERROR(strips("2", "3 0 1 2\n3 0 1 4\n"),
                     "tristrips 1: names a vertex that does not");
  EXPECT_INPUT_ERROR(strips("1", "3 0 1 -2\n"), "tristrips 0");
  const std::string both = kHead +
                           "element face 1\nproperty list uchar int vertex_index\n"
                           "element tristrips 1" +
                           rest + "3 0 1 2\n3 0 2 3\n";
  EXPECT_EQ(parse_ply_mesh(both, "m").triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

// (255, 128, 0) by every name, type and range.
TEST(PlyVariants, ColoursOfAnyTypeAndRange) {
  const auto colors_of = [](const std::string& type, const std::array<const char*, 3>& names,
                            const std::string& color) {
    std::string text = kHead;
    for (const char* name : names) text += "property " + type + " " + name + "\n";
    text += kFaces;
    for (const char* p : {"0 0 0 ", "1 0 0 ", "1 1 0 ", "0 1 0 "}) text += p + color + "\n";
    return parse_ply_mesh(text + kFaceRows, "m").colors;
  };
  const glm::vec3 orange(1, srgb_decode(128 / 255.0f), 0);
  const std::array<const char*, 3> kRgb{"r", "g", "b"};
  for (const std::array<const char*, 3>& names :
       {std::array<const char*, 3>{"red", "green", "blue"},
        kRgb,
        {"Red", "Green", "Blue"},
        {"R", "G", "B"},
        {"diffuse_red", "diffuse_green", "diffuse_blue"}})
    EXPECT_EQ(colors_of("uchar", names, "255 128 0"), std::vector<glm::vec3>(4, orange))
        << names[0];
  for (const char* type : {"char", "short", "ushort", "int", "uint", "float", "double", "uint8"})
    EXPECT_EQ(colors_of(type, kRgb, "255 128 0"), std::vector<glm::vec3>(4, orange)) << type;
  for (const char* type : {"ushort", "int", "uint", "float", "double"})
    EXPECT_EQ(colors_of(type, kRgb, "65535 32896 0"), std::vector<glm::vec3>(4, orange)) << type;
  EXPECT_LT(glm::distance(colors_of("float", kRgb, "1 0.50196078 0")[0], orange), 1e-6f);
  EXPECT_LT(glm::distance(colors_of("double", kRgb, "1 0.50196078 0")[0], orange), 1e-6f);
  EXPECT_LT(glm::distance(colors_of("short", kRgb, "32767 16448 0")[0], orange), 1e-4f);
}

TEST(PlyVariants, WhatIsPassedOverOfColoursIsSaid) {
  const std::string faces =
      "element face 2\nproperty list uchar int vertex_indices\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 1 2 3\n3 0 2 3 1 2 3\n";
  Remarks remarks;
  EXPECT_TRUE(parse_ply_mesh(kHead + faces, "m", &remarks).colors.empty());
  EXPECT_EQ(count_of(remarks, "faces with colours of their own"), 2u);
}

// A square, of binary floats; more: what each vertex has behind its position.
std::string binary_square(const std::string& columns, const std::vector<float>& more) {
  std::string out = replaced(kHead, "ascii", "binary_little_endian") + columns + kFaces;
  for (const glm::vec3& p : {glm::vec3(0, 0, 0), {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}) {
    append_vec3(out, p);
    for (const float x : more) append_value(out, x);
  }
  for (const Triangle& t : {Triangle{0, 1, 2}, {0, 2, 3}}) {
    append_value<std::uint8_t>(out, 3);
    for (const std::uint32_t v : t) append_value(out, static_cast<std::int32_t>(v));
  }
  return out;
}

// Normals that are no numbers, in text and in binary, are computed; columns that nobody reads may
// hold anything.
TEST(PlyVariants, NormalsThatAreNoNumbers) {
  const std::string columns =
      "property float nx\nproperty float ny\nproperty float nz\n"
      "property float quality\n";
  const auto [mesh, remarks] = read_bytes("m.ply", kHead + columns + kFaces +
                                                       "0 0 0 nan nan nan 1\n1 0 0 0 0 2 -nan\n"
                                                       "1 1 0 0 -1 0 inf\n0 1 0 1.#QNAN 0 0 0\n" +
                                                       kFaceRows);
  EXPECT_EQ(mesh.normals, (std::vector<glm::vec3>{{0, 0, 1}, {0, 0, 1}, {0, -1, 0}, {0, 0, 1}}));
  EXPECT_EQ(count_of(remarks, "vertices without a normal: computed"), 2u);
  EXPECT_INPUT_ERROR(
      read_bytes("m.ply", kHead + kFaces + "0 0 0\n1 nan 0\n1 1 0\n0 1 0\n" + kFaceRows),
      "vertex 1: a coordinate is not a finite number");
}

// White, as where there are none, and counted; what is infinite is as bright as can be.
TEST(PlyVariants, ColoursThatAreNoNumbers) {
  const std::string columns = "property float red\nproperty float green\nproperty float blue\n";
  const auto [mesh, remarks] = read_bytes(
      "m.ply", kHead + columns + kFaces + "0 0 0 nan 0 0\n1 0 0 1 0 -nan\n1 1 0 1 0 0\n" +
                   "0 1 0 0 1 0\n" + kFaceRows);
  EXPECT_EQ(mesh.colors, (std::vector<glm::vec3>{{1, 1, 1}, {1, 1, 1}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(count_of(remarks, "colours that are no numbers, taken as white"), 2u);
  const auto [bright, none] =
      read_bytes("m.ply", binary_square(columns, {std::numeric_limits<float>::infinity(), 0, 1}));
  EXPECT_EQ(bright.colors, (std::vector<glm::vec3>(4, {1, 0, 1})));
  EXPECT_EQ(count_of(none, "colours that are no numbers"), 0u);
}

TEST(PlyVariants, ColoursOfAnyRange) {
  const std::string columns = "property float red\nproperty float green\nproperty float blue\n";
  const auto [mesh, remarks] = read_bytes("m.ply", binary_square(columns, {1e30f, 0, 1e30f}));
  EXPECT_EQ(mesh.colors, (std::vector<glm::vec3>(4, {1, 0, 1})));
  EXPECT_EQ(count_of(remarks, "colours, taken as 0 to 1.000000015e+30"), 4u);
}

// ---- faces ----

TEST(Faces, OfFewerThanThreeCornersAreCounted) {
  const std::string off = replaced(cube_off(), "4 4 5 6 7", "2 4 5");
  const std::string ply = replaced(cube_ply(), "4 4 5 6 7", "2 4 5");
  for (const auto& [name, bytes] : {std::pair("m.off", off), {"m.ply", ply}}) {
    const auto [mesh, remarks] = read_bytes(name, bytes);
    EXPECT_EQ(mesh.triangles.size(), 10u) << name;
    EXPECT_EQ(count_of(remarks, "faces of fewer than three corners"), 1u) << name;
  }
  for (const char* row : {"0", "1 4"})
    EXPECT_EQ(parse_off(replaced(cube_off(), "4 4 5 6 7", row), "m").triangles.size(), 10u);
}

// The L, from each corner on, by every format that has polygons; texture coordinates go with the
// corners.
TEST(Faces, ThatAreNotConvex) {
  const float x[] = {0, 2, 2, 1, 1, 0}, y[] = {0, 0, 1, 1, 2, 2};
  std::string obj, off = "OFF 6 1 0\n", vertices;
  for (int k = 0; k < 6; ++k) {
    const std::string row = std::to_string(x[k]) + " " + std::to_string(y[k]);
    obj += "v " + row + " 0\nvt " + row + "\n";
    vertices += row + " 0\n";
  }
  for (int start = 0; start < 6; ++start) {
    std::string face = "f", row = "6", texcoords = " 12";
    for (int k = 0; k < 6; ++k) {
      const int v = (start + k) % 6;
      const std::string one = std::to_string(v + 1);
      face += " " + one + "/" + one;
      row += " " + std::to_string(v);
      texcoords += " " + std::to_string(x[v]) + " " + std::to_string(y[v]);
    }
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
        "property list uchar double texcoord\nend_header\n" +
        vertices + row + texcoords + "\n";
    for (const TriMesh& mesh : {parse_obj(obj + face + "\n", "m"), parse_ply_mesh(ply, "m"),
                                parse_off(off + vertices + row + "\n", "m")}) {
      ASSERT_EQ(mesh.triangles.size(), 4u);
      double area = 0;
      for (const Triangle& t : mesh.triangles) {
        EXPECT_GE(area_normal(mesh, t).z, 0);
        area += area_normal(mesh, t).z / 2;
      }
      EXPECT_DOUBLE_EQ(area, 3);
      for (std::size_t c = 0; c < mesh.texcoords.size(); ++c)
        EXPECT_EQ(mesh.texcoords[c], glm::vec2(mesh.positions[mesh.triangles[c / 3][c % 3]]));
    }
  }
}

// As 3D scanners write grids with holes.
TEST(PlyVariants, VerticesOfNoFaceMayBeNowhere) {
  const std::string head = "ply\nformat ascii 1.0\nelement vertex 5\n",
                    tail = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  for (const char* type : {"float", "double"}) {
    std::string properties;
    for (const char* axis : {"x", "y", "z"})
      properties += std::string("property ") + type + " " + axis + "\n";
    const auto file = [&](const char* face) {
      return head + properties + tail + "nan nan nan\n1 0 0\n2 0 0\n1 1 0\n0 0 inf\n" + face;
    };
    const auto [mesh, remarks] = read_bytes("m.ply", file("3 1 2 3\n"));
    EXPECT_EQ(count_of(remarks, "vertices that no face uses, without a position"), 2u);
    EXPECT_EQ(mesh.positions[0], glm::vec3(1, 0, 0));
    EXPECT_EQ(mesh.positions[3], glm::vec3(1, 1, 0));
    EXPECT_INPUT_ERROR(read_bytes("m.ply", file("3 0 2 3\n")),
                       "vertex 0: a coordinate is not a finite");
  }
}

TEST(ObjAndOffVariants, VerticesOfNoFaceMayBeNowhere) {
  const std::string obj = "v nan nan nan\nv 1 0 0\nv 2 0 0\nv 1 1 0\nv 0 -inf 0\nf ";
  const std::string off = "OFF 5 1 0\nnan nan nan\n1 0 0\n2 0 0\n1 1 0\n0 inf 0\n3 ";
  for (const Read& read :
       {read_bytes("m.obj", obj + "2 3 4\n"), read_bytes("m.off", off + "1 2 3\n")}) {
    EXPECT_EQ(count_of(read.remarks, "vertices that no face uses, without a position"), 2u);
    EXPECT_EQ(read.mesh.positions[4], glm::vec3(1, 0, 0));
  }
  EXPECT_INPUT_ERROR(read_bytes("m.obj", obj + "2 3 5\n"), "line 5: vertex 4: a coordinate is not");
  EXPECT_INPUT_ERROR(read_bytes("m.off", off + "0 2 3\n"), "line 2: vertex 0: a coordinate is not");
}

// Alpha behind the colour, or a weight before it.
TEST(ObjVariants, SevenNumbersOfAVertex) {
  const auto first_color = [](const std::string& first, const std::string& second) {
    return parse_obj(
               "v 0 0 0 " + first + "\nv 1 0 0 " + second + "\nv 0 1 0 " + second + "\nf 1 2 3\n",
               "m.obj")
        .colors[0];
  };
  EXPECT_EQ(first_color("1 0 1 0", "1 1 1 1"), glm::vec3(0, 1, 0));        // w r g b
  EXPECT_EQ(first_color("1 0 0 1", "0 1 0 1"), glm::vec3(1, 0, 0));        // r g b a
  EXPECT_EQ(first_color("255 0 0 255", "0 0 0 255"), glm::vec3(1, 0, 0));  // of bytes
  EXPECT_EQ(first_color("1 0 0 1", "1 0 0 1"), glm::vec3(0, 0, 1));        // may be either
}

TEST(OffVariants, NumbersBeyondTheFirstWordAreSaid) {
  const auto [mesh, remarks] =
      read_bytes("m.off", "OFF 3 1 0\n0 0 0 1 0 0\n1 0 0\n0 1 0 1 1 1\n3 0 1 2\n");
  EXPECT_EQ(
      count_of(remarks, "vertices with more numbers than the file's first word says, passed over"),
      2u);
}

TEST(ObjVariants, ColoursOfZBrushAreSaid) {
  const auto [mesh, remarks] =
      read_bytes("m.obj", "#MRGB ffff0000\n" + cube_obj() + "# not #MRGB \n#MRGB ff00ff00\n");
  EXPECT_EQ(count_of(remarks, "comments '#MRGB' (colours of ZBrush), passed over"), 2u);
}

TEST(PlyVariants, NamesInCapitals) {
  const std::string capitals_of_it =
      replaced(replaced(replaced(cube_ply(), "float x", "float X"), "float y", "float Y"),
               "float z", "float Z");
  expect_cube(read_bytes("m.ply", capitals_of_it).mesh);
  expect_cube(
      read_bytes("m.ply", replaced(replaced(capitals_of_it, "element vertex", "element VERTEX"),
                                   "property float X", "property FLOAT X"))
          .mesh);
  const std::string both =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float X\n"
      "property float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n9 0 0 0\n9 1 0 0\n9 0 1 0\n3 0 1 2\n";
  EXPECT_EQ(read_bytes("m.ply", both).mesh.positions[1], glm::vec3(1, 0, 0));
}

// Exporters leave blanks or a signature behind the facets.
TEST(StlVariants, BytesAfterTheLastFacetAreCounted) {
  for (const char* begin : {"solid", "made "}) {
    std::string bytes = begin + std::string(75, '\0') + std::string("\2\0\0\0", 4);
    for (const float x : {0.0f, 1.0f}) {
      const float facet[12] = {0, 0, 1, x, 0, 0, x + 1, 0, 0, x, 1, 0};
      bytes.append(reinterpret_cast<const char*>(facet), sizeof facet).append(2, '\0');
    }
    EXPECT_EQ(read_bytes("m.stl", bytes).mesh.triangles.size(), 2u);
    EXPECT_TRUE(read_bytes("m.stl", bytes).remarks.empty());
    std::string coloured = bytes;
    coloured[84 + 48] = '\x1f';
    EXPECT_EQ(count_of(read_bytes("m.stl", coloured).remarks,
                       "facets with attributes (colours of VisCAM and Magics), passed over"),
              1u);
    const auto [mesh, remarks] = read_bytes("m.stl", bytes + "\r\n");
    EXPECT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(count_of(remarks, "bytes after the last facet, passed over"), 2u);
    EXPECT_INPUT_ERROR(read_bytes("m.stl", bytes.substr(0, bytes.size() - 60)),
                       "facet 0: the file ends inside or before this facet, of 2");
  }
}

// A sheet of quads and one of hexagons, told from each side: from any corner on, on vertices of
// their own or not, three times over. Whatever is on a back is on its front, too.
TEST(Faces, SheetsOfTwoSidesAreCutAlike) {
  Random random(1);
  for (const std::size_t n : {4u, 6u})
    for (const bool has_own : {false, true}) {
      SCOPED_TRACE(std::to_string(n) + (has_own ? ", own vertices" : ""));
      std::string text;
      std::vector<glm::vec3> corners;
      for (int face = 0; face < 30; ++face)
        for (std::size_t k = 0; k < n; ++k) {
          const double angle = 2 * 3.14159265 * static_cast<double>(k) / static_cast<double>(n);
          corners.emplace_back(3 * face + std::cos(angle), std::sin(angle), random.uniform(-1, 1));
        }
      const int n_sides = 3;
      for (int side = 0; side < (has_own ? n_sides : 1); ++side)
        for (const glm::vec3& p : corners)
          text += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " +
                  std::to_string(p.z) + "\n";
      for (int side = 0; side < n_sides; ++side)
        for (std::size_t face = 0; face < 30; ++face) {
          text += "f";
          const std::size_t first = random.below(static_cast<std::uint32_t>(n));
          for (std::size_t k = 0; k < n; ++k) {
            const std::size_t at = (side == 1 ? first + n - k : first + k) % n;
            text += " " + std::to_string(1 + face * n + at +
                                         (has_own ? corners.size() * std::size_t(side) : 0));
          }
          text += "\n";
        }
      const TriMesh mesh = parse_obj(text, "m");
      const std::size_t n_side = mesh.triangles.size() / n_sides;
      ASSERT_EQ(n_side, 30 * (n - 2));
      const auto at = [&](std::size_t t, std::size_t k) {
        return mesh.triangles[t][k] % corners.size();
      };
      for (std::size_t t = 0; t < n_side; ++t) {
        std::array<std::size_t, 3> sorted[3];
        for (std::size_t side = 0; side < 3; ++side) {
          const std::size_t other = t + side * n_side;
          sorted[side] = {at(other, 0), at(other, 1), at(other, 2)};
          const auto& c = sorted[side];
          const glm::dvec3 normal = glm::cross(glm::dvec3(corners[c[1]] - corners[c[0]]),
                                               glm::dvec3(corners[c[2]] - corners[c[0]]));
          EXPECT_EQ(normal.z > 0, side != 1);
          std::sort(sorted[side].begin(), sorted[side].end());
        }
        EXPECT_EQ(sorted[0], sorted[1]);
        EXPECT_EQ(sorted[0], sorted[2]);
      }
    }
}

TEST(Faces, ThatCrossThemselvesAreSaid) {
  Remarks remarks;
  const TriMesh mesh =
      parse_obj("v 0 0 0\nv 3 3 0\nv 3 0 0\nv 0 1 0\nf 1 2 3 4\nf 1 2 3\n", "m", &remarks);
  EXPECT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(count_of(remarks, "polygons that cross themselves"), 1u);
}

TEST(Faces, PointsAloneAreNoSurface) {
  const TemporaryFolder folder;
  const auto off = folder.add("a.off", "OFF 2 0 0\n0 0 0\n1 2 3\n");
  EXPECT_INPUT_ERROR(read_mesh(off), "has no faces");
  EXPECT_EQ(read_surface_or_points(off).positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 2, 3}}));
  EXPECT_INPUT_ERROR(read_surface_or_points(folder.add("n.off", "OFF 0 0 0\n")), "no vertices");
  EXPECT_EQ(read_surface_or_points(folder.add("a.obj", "v 1 2 3\np 1\n")).positions.size(), 1u);
}

}  // namespace
}  // namespace viewcell
