// Every format: the same cube comes out, attributes arrive, and damaged files are refused.
#include "formats/mesh_file.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/file.h"
#include "base/srgb.h"
#include "common/expect_input_error.h"
#include "common/mutate.h"
#include "common/temporary_folder.h"
#include "formats/mesh_bytes.h"
#include "formats/readers.h"
#include "mesh/cube.h"

namespace viewcell {
namespace {

// The triangles as positions, each rotated to begin with its least corner, sorted.
std::vector<std::array<std::array<float, 3>, 3>> shape_of(const TriMesh& mesh) {
  std::vector<std::array<std::array<float, 3>, 3>> out;
  for (const Triangle& t : mesh.triangles) {
    std::array<std::array<float, 3>, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::vec3& p = mesh.positions.at(t[k]);
      corners[k] = {p.x, p.y, p.z};
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    out.push_back(corners);
  }
  std::sort(out.begin(), out.end());
  return out;
}

struct Sample {
  const char* name;
  std::string bytes;
  TriMesh (*parse)(std::string_view, const std::filesystem::path&, Remarks*);
};
TriMesh parse_gltf_sample(std::string_view bytes, const std::filesystem::path& file,
                          Remarks* remarks) {
  return parse_gltf(bytes, file, remarks);
}
std::vector<Sample> samples() {
  return {{"cube.off", cube_off(), parse_off},        {"cube.obj", cube_obj(), parse_obj},
          {"cube.ply", cube_ply(), parse_ply_mesh},   {"cube.stl", cube_stl_text(), parse_stl},
          {"Cube.STL", cube_stl_binary(), parse_stl}, {"cube.3ds", cube_3ds(), parse_3ds},
          {"cube.glb", cube_glb(), parse_gltf_sample}};
}

TEST(ReadMesh, TheSameCubeInEveryFormat) {
  const TemporaryFolder folder;
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.name);
    const TriMesh mesh = read_mesh(folder.add(sample.name, sample.bytes));
    EXPECT_EQ(mesh.positions.size(), 8u);
    EXPECT_EQ(shape_of(mesh), shape_of(make_cube()));
    EXPECT_TRUE(mesh.normals.empty());
  }
  const TriMesh packed = read_mesh(folder.add("c.ply.gz", gzipped(cube_ply())));
  EXPECT_EQ(packed.positions, cube_positions());
  EXPECT_EQ(packed.triangles, cube_triangles());
}

// Without a name that says it, the same mesh and the hash of its bytes.
TEST(ReadMesh, FormatsAreToldByContent) {
  const TemporaryFolder folder;
  std::vector<Sample> all = samples();
  all.push_back({"c.ply.gz", gzipped(cube_ply()), nullptr});
  all.push_back({"comment.obj", "# a cube\n" + cube_obj(), parse_obj});
  for (const Sample& sample : all) {
    SCOPED_TRACE(sample.name);
    MeshSource source;
    const TriMesh named = read_mesh(folder.add(sample.name, sample.bytes));
    const TriMesh mesh = read_mesh(folder.add("nameless", sample.bytes), &source);
    EXPECT_EQ(mesh.positions, named.positions);
    EXPECT_EQ(mesh.triangles, named.triangles);
    EXPECT_EQ(source.hash, hash_hex(sample.bytes));
  }
}

TEST(ReadMesh, NamesFileAndPlace) {
  const TemporaryFolder folder;
  EXPECT_INPUT_ERROR(read_mesh(folder.path() / "none.ply"), "none.ply: cannot open");
  EXPECT_INPUT_ERROR(read_mesh(folder.add("model.fbx", "Kaydara")),
                     ".obj, .ply, .ply.gz, .off, .stl");
  EXPECT_INPUT_ERROR(read_mesh(folder.add("none", "")), "no known mesh format");
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.name);
    EXPECT_INPUT_ERROR(read_mesh(folder.add(sample.name, "")), sample.name);
  }
}

TEST(ReadMesh, NoFacesIsAnError) {
  const TemporaryFolder folder;
  EXPECT_INPUT_ERROR(read_mesh(folder.add("a.off", "OFF 1 0 0\n0 0 0\n")), "has no faces");
  EXPECT_INPUT_ERROR(read_mesh(folder.add("a.obj", "v 0 0 0\n")), "has no faces");
  EXPECT_INPUT_ERROR(read_mesh(folder.add("a.stl", "solid\nendsolid\n")), "has no faces");
  EXPECT_INPUT_ERROR(read_mesh(folder.add("a.3ds", cube_3ds(""))), "has no faces");
  EXPECT_INPUT_ERROR(read_mesh(folder.add("a.glb", make_glb(cube_gltf_json("[]"), cube_buffer()))),
                     "has no faces");
  const std::string points = replaced(cube_ply(),
                                      "element face 6\nproperty list uchar int "
                                      "vertex_index\n",
                                      "");
  EXPECT_INPUT_ERROR(read_mesh(folder.add("a.ply", points.substr(0, points.rfind("4 3 2 1 0")))),
                     "has no faces");
}

TEST(ReadMesh, DamagedFilesNeverCrash) {
  constexpr std::uint64_t kSeed = 11;
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.name);
    for (std::size_t n = 0; n < sample.bytes.size(); n += 1 + n / 64)
      read_damaged_copies(sample.bytes.substr(0, n), n > 0, kSeed + n, [&](const auto& damaged) {
        check_mesh(sample.parse(damaged, sample.name, nullptr), sample.name);
      });
    read_damaged_copies(sample.bytes, 3000, kSeed, [&](const std::string& damaged) {
      check_mesh(sample.parse(damaged, sample.name, nullptr), sample.name);
    });
  }
}

TEST(ReadMesh, NormalsComeOutUnit) {
  const TemporaryFolder folder;
  const TriMesh mesh = read_mesh(folder.add(
      "n.off", "NOFF 4 1 0\n0 0 0 0 0 2\n1 0 0 0 0 0\n0 1 0 0 3 4\n5 5 5 0 0 0\n3 0 1 2\n"));
  EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(mesh.normals[1], glm::vec3(0, 0, 1));  // from its triangle
  EXPECT_EQ(mesh.normals[2], glm::vec3(0, 0.6f, 0.8f));
}

// ---- gzip ----

TEST(Gunzip, MembersFollowEachOther) {
  EXPECT_EQ(gunzip(gzipped("one ") + gzipped("two"), "f"), "one two");
  std::string long_text;
  for (int i = 0; i < 200000; ++i) long_text += std::to_string(i);
  EXPECT_EQ(gunzip(gzipped(long_text), "f"), long_text);
}

TEST(Gunzip, RefusesCutForeignAndExplodingData) {
  const std::string bytes = gzipped(cube_ply());
  for (std::size_t n = 0; n < bytes.size(); ++n)
    EXPECT_THROW(gunzip(bytes.substr(0, n), "f"), InputError) << n;
  EXPECT_INPUT_ERROR(gunzip("ply\n", "f.gz"), "not valid gzip data");
  EXPECT_THROW(gunzip(bytes + "tail", "f"), InputError);
  std::string bomb;
  for (const std::string member = gzipped(std::string(1 << 20, ' '));
       bomb.size() < 80 * member.size();)
    bomb += member;
  EXPECT_INPUT_ERROR(gunzip(bomb, "bomb"), "unpacks to more than");
}

// ---- PLY ----

TEST(PlyMesh, ColoursNormalsAndTextureCoordinates) {
  const TriMesh mesh = parse_ply_mesh(
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float s\n"
      "property float t\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0 0 0 1 255 0 188 0 0\n1 0 0 0 0 1 0 0 0 1 0\n1 1 0 0 0 1 0 0 0 1 1\n"
      "0 1 0 0 0 1 0 0 0 0 1\n4 0 1 2 3\n",
      "m.ply");
  EXPECT_EQ(mesh.normals[3], glm::vec3(0, 0, 1));
  EXPECT_EQ(mesh.colors[0].x, 1.0f);
  EXPECT_NEAR(mesh.colors[0].z, 0.5029f, 1e-4);  // sRGB 188
  ASSERT_EQ(mesh.texcoords.size(), 6u);
  EXPECT_EQ(mesh.texcoords[5], glm::vec2(0, 1));
  EXPECT_EQ(mesh.triangles[1], (Triangle{0, 2, 3}));
}

TEST(PlyMesh, TextureCoordinatesOfCorners) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
      "property list uchar float texcoord\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 ";
  const TriMesh mesh = parse_ply_mesh(head + "8 0 0 1 0 1 1 0 1\n", "m.ply");
  EXPECT_EQ(mesh.texcoords,
            (std::vector<glm::vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}}));
  EXPECT_INPUT_ERROR(parse_ply_mesh(head + "6 0 0 1 0 1 1\n", "m.ply"), "face 0");
}

TEST(PlyMesh, BadFaces) {
  EXPECT_INPUT_ERROR(parse_ply_mesh(replaced(cube_ply(), "4 4 5 6 7", "4 4 5 6 8"), "m.ply"),
                     "face 1: property 'vertex_index': 8");
  EXPECT_INPUT_ERROR(parse_ply_mesh(replaced(cube_ply(), "4 4 5 6 7", "4 4 5 6 -1"), "m.ply"),
                     "face 1");
}

TEST(WritePly, ReadsBackTheSame) {
  const TemporaryFolder folder;
  TriMesh mesh = make_cube();
  mesh.normals = make_vertex_normals(mesh);
  for (int v = 0; v < 8; ++v) mesh.colors.emplace_back(srgb_decode(static_cast<float>(v) / 255.0f));
  write_ply(folder.path() / "out.ply", mesh, {"made by a test"});
  const TriMesh again = read_mesh(folder.path() / "out.ply");
  EXPECT_EQ(again.positions, mesh.positions);
  EXPECT_EQ(again.normals, mesh.normals);
  EXPECT_EQ(again.triangles, mesh.triangles);
  for (std::size_t v = 0; v < 8; ++v) EXPECT_EQ(again.colors[v], mesh.colors[v]);
  EXPECT_THROW(write_ply("/nowhere/at/all.ply", mesh), MachineError);
}

TEST(Srgb, EveryByteComesBack) {
  for (int i = 0; i < 256; ++i)
    EXPECT_EQ(srgb8_from_linear(srgb_decode(static_cast<float>(i) / 255)), i);
}

// ---- OFF ----

TEST(Off, HeadersVary) {
  const std::string body = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  for (const std::string head :
       {"OFF\n3 1 0\n", "OFF 3 1 0\n", "OFF\n# a comment\n\n3 1\n", "3 1 0\n", "OFF 3 1 0 # why\n"})
    EXPECT_EQ(parse_off(head + body, "m.off").triangles.size(), 1u) << head;
  EXPECT_INPUT_ERROR(parse_off("4OFF 3 1 0\n" + body, "m.off"), "three dimensions");
  EXPECT_INPUT_ERROR(parse_off("OFF BINARY\n3 1 0\n", "m.off"), "binary OFF is not read");
  EXPECT_INPUT_ERROR(parse_off("solid cube\n", "m.off"), "line 1: is not an OFF file");
  EXPECT_INPUT_ERROR(parse_off("OFF 3\n", "m.off"), "too early");
}

TEST(Off, ColoursAndFaceColours) {
  const TriMesh mesh = parse_off(
      "COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 1.0 0.0 0.5 1.0\n0 1 0 0 0 0\n3 0 1 2 0.5 0.5 0.5\n",
      "m.off");
  EXPECT_EQ(mesh.colors[0], glm::vec3(1, 0, 0));
  EXPECT_NEAR(mesh.colors[1].z, 0.2140f, 1e-4);
}

TEST(Off, ARowStaysOnItsLine) {
  const std::string body = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n4 0 1 2\n3 0 1 3\n3 0 1 2\n";
  EXPECT_INPUT_ERROR(parse_off("OFF 4 3 0\n" + body, "m.off"),
                     "line 6: face 0: a number is missing");
}

TEST(Off, AbsurdCountsAllocateNothing) {
  for (const std::string counts : {"999999999999 1 0", "8 999999999999 0",
                                   "9223372036854775807 "
                                   "9223372036854775807 0",
                                   "-1 6 0", "8 -6 0", "1e9 6 0"})
    EXPECT_THROW(parse_off(replaced(cube_off(), "8 6 0", counts), "m.off"), InputError) << counts;
}

TEST(Off, BadNumbersNameTheirPlace) {
  EXPECT_INPUT_ERROR(parse_off(replaced(cube_off(), "1 1 0\n", "1 nan 0\n"), "m.off"),
                     "m.off: line 5: vertex 2: a coordinate is not a finite number");
  EXPECT_INPUT_ERROR(parse_off(replaced(cube_off(), "1 1 0\n", "1 1e99 0\n"), "m.off"), "line 5");
  EXPECT_INPUT_ERROR(parse_off(replaced(cube_off(), "4 4 5 6 7", "4 4 5 6 8"), "m.off"),
                     "line 12: face 1: '8' is not within 0 to 7");
  EXPECT_INPUT_ERROR(parse_off(replaced(cube_off(), "4 4 5 6 7", "99 4 5 6 7"), "m.off"), "face 1");
}

// ---- STL ----

TEST(Stl, WeldsMinusZero) {
  const TriMesh mesh =
      parse_stl(replaced(cube_stl_text(), "vertex 0 0 0", "vertex -0 0 -0.0"), "m");
  EXPECT_EQ(mesh.positions.size(), 8u);
}

TEST(Stl, RefusesBadFacets) {
  EXPECT_INPUT_ERROR(parse_stl(replaced(cube_stl_text(), "vertex 0 0 0", "vertex 0 inf 0"), "m"),
                     "is not a finite number");
  EXPECT_INPUT_ERROR(parse_stl(replaced(cube_stl_text(), "endloop", "vertex 0 0 0"), "m"),
                     "expected 'endloop'");
  std::string binary = cube_stl_binary();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(binary.data() + 84 + 50 + 12, &nan, 4);
  EXPECT_INPUT_ERROR(parse_stl(binary, "m"), "facet 1: a position is not finite");
  EXPECT_INPUT_ERROR(parse_stl(cube_stl_binary() + std::string(50, 'x'), "m"),
                     "12 facets, and the file has 13");
  EXPECT_THROW(parse_stl("ply\n", "m"), InputError);
}

// ---- 3DS ----

TEST(Read3ds, ObjectsFollowEachOther) {
  std::string stone("stone\0", 6);
  append_value<std::uint16_t>(stone, 1);
  append_value<std::uint16_t>(stone, 5);
  const TriMesh mesh =
      parse_3ds(cube_3ds(cube_3ds_object() + cube_3ds_object(chunk_3ds(0x4130, stone))), "m.3ds");
  EXPECT_EQ(mesh.positions.size(), 16u);
  EXPECT_EQ(mesh.triangles.size(), 24u);
  EXPECT_EQ(mesh.triangles[12], (Triangle{11, 10, 9}));
  EXPECT_EQ(mesh.material_names, (std::vector<std::string>{"stone", "default"}));
  EXPECT_EQ(mesh.materials[17], 0);
  EXPECT_EQ(mesh.materials[5], 1);
}

TEST(Read3ds, RefusesWhatIsOutOfRange) {
  std::string stone("stone\0", 6);
  append_value<std::uint16_t>(stone, 1);
  append_value<std::uint16_t>(stone, 12);
  EXPECT_INPUT_ERROR(parse_3ds(cube_3ds(cube_3ds_object(chunk_3ds(0x4130, stone))), "m.3ds"),
                     "given to a face that is not");
  std::string bytes = cube_3ds();
  bytes[bytes.size() - 3] = 1;  // the last index becomes 256 and more
  EXPECT_INPUT_ERROR(parse_3ds(bytes, "m.3ds"), "does not exist; its object has 8");
  EXPECT_INPUT_ERROR(parse_3ds(cube_3ds().substr(0, cube_3ds().size() - 1), "m.3ds"),
                     "the file ends too early");
  EXPECT_INPUT_ERROR(parse_3ds("MMM", "m.3ds"), "is not a 3DS file");
}

}  // namespace
}  // namespace viewcell
