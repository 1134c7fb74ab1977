// Files as programs write them, not quite as formats have it: the same cube comes out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
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

const std::string kMark = "\xef\xbb\xbf";

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

}  // namespace
}  // namespace viewcell
