// OBJ: what faces name, and what is passed over and said.
#include <gtest/gtest.h>

#include "base/srgb.h"
#include "common/expect_input_error.h"
#include "common/temporary_folder.h"
#include "formats/mesh_file.h"
#include "formats/readers.h"
#include "formats/remarks_of.h"
#include "mesh/cube.h"

namespace viewcell {
namespace {

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(Obj, IndicesCountFromOneOrBackwards) {
  const TriMesh mesh = parse_obj(kTriangle + "f 1 2 3\nf -3 -2 -1\nv 9 9 9\nf -1 \\\n 1 2\n", "m");
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 1, 2}, {3, 0, 1}}));
}

TEST(Obj, AttributesOfCorners) {
  const TriMesh mesh = parse_obj(kTriangle +
                                     "vt 0 0\nvt 1 0 0\nvt 0.5\nvn 0 0 1\nvn 0 1 0\n"
                                     "f 1/1/1 2/2/1 3/3/1\nf 3/-3/2 2/2/2 1//2\n",
                                 "m");
  EXPECT_EQ(mesh.texcoords,
            (std::vector<glm::vec2>{{0, 0}, {1, 0}, {0.5, 0}, {0, 0}, {1, 0}, {0, 0}}));
  EXPECT_EQ(
      mesh.corner_normals,
      (std::vector<glm::vec3>{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 1, 0}, {0, 1, 0}, {0, 1, 0}}));
}

TEST(Obj, MaterialsAndColours) {
  const TriMesh mesh = parse_obj(
      "mtllib none.mtl\nv 0 0 0 1 1 1\nv 1 0 0\nv 0 1 0 1.0 0 0 1\nf 1 2 3\nusemtl old stone\n"
      "f 1 2 3 1\nusemtl moss\nusemtl old stone\nf 1 3 2\n",
      "m");
  EXPECT_EQ(mesh.material_names, (std::vector<std::string>{"old stone", "moss", "default"}));
  EXPECT_EQ(mesh.materials, (std::vector<std::int32_t>{2, 0, 0, 0}));
  EXPECT_EQ(mesh.colors, (std::vector<glm::vec3>{{1, 1, 1}, {1, 1, 1}, {0, 0, 1}}));
}

TEST(Obj, RefusesWhatOthersReadAsZero) {
  const auto bad = [](const std::string& text, const std::string& part) {
    SCOPED_TRACE(text);
    EXPECT_INPUT_ERROR(parse_obj(text, "m.obj"), part);
  };
  bad("v nan 0 0\n", "m.obj: line 1: vertex 0: a coordinate is not a finite number");
  bad("v 1 2\n", "vertex 0: a number is missing");
  bad("v x y z\n", "vertex 0: 'x'");
  bad("v 0 0 1e400\n", "vertex 0");
  for (const char* face : {"f 1 2 4", "f 1 2 99999999999", "f 1 2 99999999999999999999", "f 1 2 0",
                           "f 1 2 -4", "f 1 2 -2147483648", "f 1 2 x", "f 1 2 3/1", "f 1 2 3//1",
                           "f 1 2 /1", "f 1 2 3/4294967295"})
    bad(kTriangle + face + "\n", "line 4");
}

TEST(Obj, LongPolygonsKeepAllVertices) {
  std::string text, face = "f";
  for (int i = 0; i < 600; ++i) {
    text += "v " + std::to_string(i) + " 0 " + std::to_string(i * i) + "\n";
    face += " " + std::to_string(i + 1);
  }
  EXPECT_EQ(parse_obj(text + face + "\n", "m").triangles.size(), 598u);
}

// Elements may stand below the faces that name them.
TEST(Obj, FacesMayComeFirst) {
  const TriMesh mesh = parse_obj("f 1/1 2/2 3/3\nvt 0 0\nvt 1 0\n" + kTriangle + "vt 0 1\n", "m");
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(mesh.texcoords, (std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}}));
  EXPECT_INPUT_ERROR(parse_obj("f 1 2 3\nf 1 2 4\nf 2 1 3\n" + kTriangle, "m.obj"),
                     "m.obj: line 2: a face names vertex 4; there are 3");
  EXPECT_INPUT_ERROR(parse_obj("f 1 2 -1\n" + kTriangle, "m"), "there are 0 before it");
}

TEST(Obj, CountsWhatItPassesOver) {
  const std::string text = "mtllib ../a.mtl\nmtllib C:\\b.mtl\nmtllib c d.mtl\n" + kTriangle +
                           "vn nan nan nan\nvn -nan(ind) 0 0\nvn 0 0\nvn 0 0 1\nvt 1.#QNAN 0\n"
                           "f 1//1 2//4 3//0\nf 1/0/4 2/1/4 3//4\nf 1 2\nf 1\nf\nl 1 2 3\np 1\n"
                           "curv 0 1\ncurv 1 2\ng a\ns 1\no b\n";
  Remarks remarks;
  const TriMesh mesh = parse_obj(text, "m", &remarks);
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.material_libraries,
            (std::vector<std::string>{"../a.mtl", "C:\\b.mtl", "c d.mtl"}));
  EXPECT_EQ(count_of(remarks, "normals that are no three finite numbers"), 3u);
  EXPECT_EQ(count_of(remarks, "texture coordinates that are no finite"), 1u);
  EXPECT_EQ(count_of(remarks, "corners that name texture coordinate or normal 0"), 2u);
  EXPECT_EQ(count_of(remarks, "faces of fewer than three corners"), 3u);
  EXPECT_EQ(count_of(remarks, "lines and points"), 2u);
  EXPECT_EQ(count_of(remarks, "lines 'curv'"), 2u);
  EXPECT_EQ(count_of(remarks, "material libraries outside"), 2u);
  EXPECT_EQ(count_of(remarks, "corners without texture coordinates beside others"), 5u);
  EXPECT_EQ(remarks.size(), 8u);
  Remarks none;
  parse_obj("mtllib a.mtl\no x\ng y\ns 1\n" + kTriangle + "f 1 2 3\n", "m", &none);
  EXPECT_TRUE(none.empty()) << none[0].what;
}

TEST(Obj, SmoothingGroupsThatMakeEdgesHardAreSaid) {
  const auto said = [](const std::string& text) {
    Remarks remarks;
    parse_obj(kTriangle + "vn 0 0 1\n" + text, "m", &remarks);
    return count_of(remarks, "smoothing groups");
  };
  EXPECT_EQ(said("s off\nf 1 2 3\n"), 1u);
  EXPECT_EQ(said("s 1\nf 1 2 3\ns 2\nf 1 2 3\n"), 2u);
  EXPECT_EQ(said("s 1\nf 1 2 3\ns 1\nf 1 2 3\n"), 0u);
  EXPECT_EQ(said("s off\nf 1//1 2//1 3//1\n"), 0u);  // normals say it
}

// Colours of [0, 1], and of bytes, which some programs write.
TEST(Obj, ColoursOfBytes) {
  const TriMesh mesh = parse_obj("v 0 0 0 255 128 0\nv 1 0 0 0 0 0\nv 0 1 0\nf 1 2 3\n", "m");
  EXPECT_EQ(mesh.colors[0], glm::vec3(1, srgb_decode(128 / 255.0f), 0));
  EXPECT_EQ(mesh.colors[1], glm::vec3(0));
  EXPECT_EQ(mesh.colors[2], glm::vec3(1));
}

// ---- normals of corners, as read_mesh has them ----

struct ReadObj {
  TriMesh mesh;
  Remarks remarks;
};
ReadObj read_obj(const std::string& text) {
  const TemporaryFolder folder;
  MeshSource source;
  TriMesh mesh = read_mesh(folder.add("m.obj", text), &source);
  return {std::move(mesh), source.remarks};
}

const std::string kRoof =  // two triangles on the edge 1-2, one in the floor, one upright
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 2\nvn 0 -1 0\nvn 0 0 1\n";

TEST(ObjNormals, StayWithTheirCorners) {
  const auto [mesh, remarks] = read_obj(kRoof + "f 1//1 2//1 3//1\nf 1//2 2//2 4//2\n");
  EXPECT_TRUE(mesh.normals.empty());
  const glm::vec3 up(0, 0, 1), out(0, -1, 0);
  EXPECT_EQ(mesh.corner_normals, (std::vector<glm::vec3>{up, up, up, out, out, out}));
  EXPECT_TRUE(remarks.empty());
}

// By direction, not by number.
TEST(ObjNormals, BecomeTheVerticesWhereAllCornersAgree) {
  const auto [mesh, remarks] = read_obj(kRoof + "f 1//1 2//3 3//1\nf 1//3 2//1 4//2\n");
  EXPECT_TRUE(mesh.corner_normals.empty());
  const glm::vec3 up(0, 0, 1);
  EXPECT_EQ(mesh.normals, (std::vector<glm::vec3>{up, up, up, {0, -1, 0}}));
}

// Corners without one, in a file where others have some: from the triangles around, by angle.
TEST(ObjNormals, AreComputedWhereTheyAreMissing) {
  for (const char* missing : {"1", "1//0", "1//4"}) {
    SCOPED_TRACE(missing);
    const auto [mesh, remarks] =
        read_obj(kRoof + "vn nan nan nan\nf " + missing + " 2//1 3//1\nf 1//2 2//2 4//2\n");
    ASSERT_EQ(mesh.corner_normals.size(), 6u);
    EXPECT_LT(glm::distance(mesh.corner_normals[0], glm::normalize(glm::vec3(0, -1, 1))), 1e-6f);
    EXPECT_EQ(mesh.corner_normals[1], glm::vec3(0, 0, 1));
    EXPECT_EQ(count_of(remarks, "corners without a normal: computed"), 1u);
  }
  EXPECT_TRUE(read_obj(kRoof + "f 1//0 2 3\n").mesh.normals.empty());
  EXPECT_TRUE(read_obj(kRoof + "f 1//0 2 3\n").mesh.corner_normals.empty());
}

TEST(ObjNormals, ACubeOfHardEdges) {
  std::string text;
  for (const glm::vec3& p : cube_positions())
    text +=
        "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
  const TriMesh cube = make_cube();
  for (std::size_t t = 0; t < cube.triangles.size(); ++t) {
    const glm::dvec3 n = glm::normalize(area_normal(cube, cube.triangles[t]));
    text +=
        "vn " + std::to_string(n.x) + " " + std::to_string(n.y) + " " + std::to_string(n.z) + "\nf";
    for (const std::uint32_t v : cube.triangles[t])
      text += " " + std::to_string(v + 1) + "//" + std::to_string(t + 1);
    text += "\n";
  }
  const TriMesh mesh = read_obj(text).mesh;
  ASSERT_EQ(mesh.corner_normals.size(), 36u);
  for (std::size_t c = 0; c < 36; ++c)
    EXPECT_EQ(glm::dvec3(mesh.corner_normals[c]),
              glm::normalize(area_normal(mesh, mesh.triangles[c / 3])));
}

}  // namespace
}  // namespace viewcell
