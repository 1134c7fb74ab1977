#include "report/mesh_info.h"

#include <gtest/gtest.h>

#include "base/file.h"
#include "common/expect_input_error.h"
#include "common/temporary_folder.h"
#include "formats/mesh_file.h"
#include "formats/write_glb.h"
#include "image/io.h"
#include "mesh/cube.h"

namespace viewcell {
namespace {

TriMesh plain_cube() {
  TriMesh mesh;
  mesh.positions = cube_positions();
  mesh.triangles = cube_triangles();
  return mesh;
}

MeshInfo info_of(const TemporaryFolder& folder, const TriMesh& mesh) {
  write_ply(folder / "m.ply", mesh);
  return measure_mesh_file(folder / "m.ply");
}

double side_of(const TriMesh& mesh) {
  return bounding_box(mesh).size().x;
}

TEST(MeshInfo, AClosedCube) {
  const TemporaryFolder folder;
  const TriMesh cube = plain_cube();
  const double a = side_of(cube);
  const MeshInfo info = info_of(folder, cube);
  EXPECT_EQ(info.format, "PLY");
  EXPECT_EQ(info.n_vertices, 8u);
  EXPECT_EQ(info.n_triangles, 12u);
  EXPECT_NEAR(info.area, 6 * a * a, 1e-9);
  ASSERT_TRUE(info.volume);
  EXPECT_NEAR(*info.volume, a * a * a, 1e-9);
  EXPECT_EQ(info.topology.n_components, 1u);
  EXPECT_EQ(info.n_border_loops, 0u);
  EXPECT_FALSE(info.has_normals || info.has_colors || info.has_texcoords);
  const std::string text = format_mesh_info(info);
  EXPECT_NE(text.find("1 part, no border"), std::string::npos) << text;
  EXPECT_NE(text.find("faults       none"), std::string::npos) << text;
}

// Inside out; as a soup of triangles with vertices of their own; with a hole, and another apart.
TEST(MeshInfo, PartsBordersAndTurns) {
  const TemporaryFolder folder;
  TriMesh turned = plain_cube();
  for (Triangle& t : turned.triangles) std::swap(t[0], t[1]);
  EXPECT_LT(*info_of(folder, turned).volume, 0);

  TriMesh soup;
  const TriMesh cube = plain_cube();
  for (const Triangle& t : cube.triangles)
    for (const std::uint32_t v : t) soup.positions.push_back(cube.positions[v]);
  for (std::uint32_t v = 0; v < 36; v += 3) soup.triangles.push_back({v, v + 1, v + 2});
  EXPECT_EQ(info_of(folder, soup).n_places, 8u);
  EXPECT_TRUE(info_of(folder, soup).volume);

  TriMesh two = plain_cube();
  for (const glm::vec3& p : cube.positions) two.positions.push_back(p + glm::vec3(9, 0, 0));
  for (const Triangle& t : cube.triangles) two.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  two.triangles.erase(two.triangles.begin());      // a triangle of the first
  two.triangles.erase(two.triangles.end() - 1);    // one of the second
  two.triangles.push_back(two.triangles.front());  // there twice
  two.triangles.push_back({0, 0, 1});              // nothing
  const MeshInfo info = info_of(folder, two);
  EXPECT_EQ(info.topology.n_components, 2u);
  EXPECT_EQ(info.n_border_loops, 2u);
  EXPECT_FALSE(info.volume);
  EXPECT_EQ(info.defects.n_duplicates, 1u);
  EXPECT_EQ(info.defects.n_repeated_index, 1u);
  EXPECT_GT(info.topology.n_nonmanifold_edges + info.topology.n_opposed_edges, 0u);
}

TEST(MeshInfo, SizeForAScene) {
  const TemporaryFolder folder;
  for (const double height : {1.0, 0.0517, 40.0, 75.0, 150.0, 1720.0, 25000.0}) {
    SCOPED_TRACE(height);
    TriMesh mesh = plain_cube();
    const double a = side_of(mesh);
    for (glm::vec3& p : mesh.positions) p *= static_cast<float>(height / a);
    const MeshInfo info = info_of(folder, mesh);
    const double scaled = info.scale * height;
    EXPECT_GE(scaled, 20);
    EXPECT_LE(scaled, 80);
    if (height >= 20 && height <= 80) {
      EXPECT_EQ(info.scale, 1);
    }
    EXPECT_EQ(info.up, "z");
  }
  write_obj(folder / "m.obj", plain_cube());
  EXPECT_EQ(measure_mesh_file(folder / "m.obj").up, "y");
}

TEST(MeshInfo, TexturesOfGlb) {
  const TemporaryFolder folder;
  TriMesh mesh = plain_cube();
  mesh.texcoords.assign(36, glm::vec2(0.25f, 0.5f));
  write_glb(folder / "m.glb", mesh,
            {.base_color = encode_png(ImageRgba8(20, 10)),
             .normal_map = encode_png(ImageRgba8(30, 10)),
             .generator = ""});
  const MeshInfo info = measure_mesh_file(folder / "m.glb");
  ASSERT_EQ(info.textures.size(), 2u);
  EXPECT_EQ(info.textures[0].width_px, 20);
  EXPECT_EQ(info.textures[1].width_px, 30);
  EXPECT_TRUE(info.textures[0].used_by.starts_with("baseColor of"));
  EXPECT_TRUE(info.textures[1].used_by.starts_with("normal of"));
  EXPECT_TRUE(info.has_texcoords);
  EXPECT_FLOAT_EQ(float(info.charts.uv_lo.x), 0.25f);
}

TEST(MeshInfo, TexturesOfObjAndPly) {
  const TemporaryFolder folder;
  write_png(folder / "my skin.png", ImageRgba8(7, 5));
  folder.add("a.mtl",
             "newmtl skin\nKd 1 1 1\nmap_Kd -s 1 1 1 my skin.png\nmap_Bump -bm 0.5 my skin.png\n"
             "newmtl other\nmap_Kd gone.tga\nmap_Ka ../outside.png\n");
  const std::string cube = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  folder.add("m.obj", "mtllib a.mtl\nmtllib none.mtl\n" + cube + "usemtl skin\nf 1 2 3\n");
  const auto listed = list_textures(folder / "m.obj");
  ASSERT_EQ(listed.size(), 3u);
  EXPECT_EQ(listed[0].name, "my skin.png");
  EXPECT_EQ(listed[0].used_by, "map_Kd of 'skin', map_Bump of 'skin'");
  EXPECT_EQ(listed[0].width_px, 7);
  EXPECT_EQ(listed[0].format, "png");
  EXPECT_NE(listed[1].fault.find("cannot open"), std::string::npos) << listed[1].fault;
  EXPECT_FALSE(listed[2].fault.empty());
  const MeshInfo info = measure_mesh_file(folder / "m.obj");
  ASSERT_EQ(info.materials.size(), 1u);
  EXPECT_EQ(info.materials[0].name, "skin");
  EXPECT_EQ(info.materials[0].n_triangles, 1u);

  write_ply(folder / "m.ply", plain_cube(), {"TextureFile my skin.png"});
  ASSERT_EQ(list_textures(folder / "m.ply").size(), 1u);
  EXPECT_EQ(list_textures(folder / "m.ply")[0].height_px, 5);
  EXPECT_TRUE(list_textures(folder / "m.stl").empty());
}

TEST(MeshInfo, SeveralAreATable) {
  const TemporaryFolder folder;
  const MeshInfo info = info_of(folder, plain_cube());
  const std::string table = format_mesh_table({info, info});
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 3);
  EXPECT_NE(table.find("border edges"), std::string::npos);
  const Json json = report_mesh_info(info);
  EXPECT_EQ(json["file"], "m.ply");
  EXPECT_TRUE(json["topology"]["closed"].get<bool>());
  EXPECT_TRUE(json["normals"].is_null());
  EXPECT_TRUE(json["texture_coordinates"].is_null());
  EXPECT_INPUT_ERROR(measure_mesh_file(folder / "none.ply"), "none.ply");
}

}  // namespace
}  // namespace viewcell
