// PLY files as programs write them, not quite as the format has it.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "base/srgb.h"
#include "common/expect_input_error.h"
#include "common/mutate.h"
#include "formats/mesh_bytes.h"
#include "formats/read_bytes.h"
#include "formats/readers.h"
#include "formats/remarks_of.h"

namespace viewcell {
namespace {

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

}  // namespace
}  // namespace viewcell
