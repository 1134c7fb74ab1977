#include <gtest/gtest.h>

#include <limits>

#include "base/error.h"
#include "base/random.h"
#include "common/temporary_folder.h"
#include "formats/mesh_file.h"
#include "formats/textured_obj.h"
#include "mesh/cube.h"

namespace viewcell {
namespace {

std::vector<std::string> names_in(const std::filesystem::path& folder) {
  std::vector<std::string> out;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    out.push_back(entry.path().filename().string());
  std::sort(out.begin(), out.end());
  return out;
}

TriMesh make_textured_triangle() {
  TriMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1.5f, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.texcoords = {{0, 0}, {1, 0}, {0, 0}};
  mesh.normals.assign(3, {0, 0, 1});
  return mesh;
}

TEST(WriteObj, ByHand) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.obj";
  write_obj(file, make_textured_triangle(), {{"one\ntwo"}, "a.mtl", "stone"});
  EXPECT_EQ(read_file(file),
            "# one two\nmtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1.5 0\nvt 0 0\nvt 1 0\n"
            "vn 0 0 1\nvn 0 0 1\nvn 0 0 1\nusemtl stone\nf 1/1/1 2/2/2 3/1/3\n");
  TriMesh bare = make_textured_triangle();
  bare.texcoords.clear();
  write_obj(file, bare);
  EXPECT_NE(read_file(file).find("f 1//1 2//2 3//3\n"), std::string::npos);
  bare.normals.clear();
  write_obj(file, bare);
  EXPECT_NE(read_file(file).find("f 1 2 3\n"), std::string::npos);
}

// Any floats, any order of materials: reading gives back what was written.
TEST(WriteObj, ReadsBackTheSame) {
  const TemporaryFolder folder;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const auto number = [&] {
      const double scale = std::pow(10, random.uniform(-38, 38));
      return static_cast<float>(random.uniform(-1, 1) * scale);
    };
    TriMesh mesh;
    for (int v = 0; v < 20; ++v) {
      mesh.positions.emplace_back(number(), number(), number());
      mesh.normals.push_back(glm::normalize(
          glm::vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.1, 1))));
    }
    mesh.positions[3] = {std::numeric_limits<float>::denorm_min(), -0.f,
                         std::numeric_limits<float>::max()};
    mesh.material_names = {"stone", "old wood"};
    for (int t = 0; t < 30; ++t) {
      mesh.triangles.push_back({random.below(20), random.below(20), random.below(20)});
      mesh.materials.push_back(t == 0 ? 0 : t == 1 ? 1 : static_cast<int>(random.below(2)));
      for (int k = 0; k < 3; ++k)
        mesh.texcoords.emplace_back(number(), static_cast<float>(random.below(3)));
    }
    write_obj(folder.path() / "a.obj", mesh);
    const TriMesh back = read_mesh(folder.path() / "a.obj");
    EXPECT_EQ(back.positions, mesh.positions);
    EXPECT_EQ(back.triangles, mesh.triangles);
    EXPECT_EQ(back.texcoords, mesh.texcoords);
    EXPECT_EQ(back.materials, mesh.materials);
    EXPECT_EQ(back.material_names, mesh.material_names);
    for (const Triangle& t : mesh.triangles)
      for (const std::uint32_t v : t) EXPECT_EQ(back.normals[v], mesh.normals[v]);
    const std::string bytes = read_file(folder.path() / "a.obj");
    write_obj(folder.path() / "b.obj", mesh);
    EXPECT_EQ(read_file(folder.path() / "b.obj"), bytes);
  }
}

TEST(WriteTexturedObj, ThreeFilesOrNone) {
  const TemporaryFolder folder;
  const auto obj = folder.path() / "a.obj";
  const TriMesh mesh = make_textured_triangle();
  const auto picture = [](const std::filesystem::path& file) { write_file(file, "pixels"); };
  const auto no_picture = [](const std::filesystem::path& file) {
    write_file(file, "pix");
    throw MachineError("no more pixels");
  };
  EXPECT_THROW(write_textured_obj(obj, mesh, ".png", no_picture, {}), MachineError);
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{});

  write_textured_obj(obj, mesh, ".png", picture, {"made by hand"});
  EXPECT_EQ(names_in(folder.path()), (std::vector<std::string>{"a.mtl", "a.obj", "a.png"}));
  EXPECT_EQ(read_file(folder.path() / "a.png"), "pixels");
  EXPECT_NE(read_file(folder.path() / "a.mtl").find("newmtl a\n"), std::string::npos);
  EXPECT_NE(read_file(folder.path() / "a.mtl").find("map_Kd a.png\n"), std::string::npos);
  const TriMesh back = read_mesh(obj);
  EXPECT_EQ(back.texcoords, mesh.texcoords);
  EXPECT_EQ(back.material_names, std::vector<std::string>{"a"});

  const std::string before = read_file(obj);
  EXPECT_THROW(write_textured_obj(obj, mesh, ".png", no_picture, {"anew"}), MachineError);
  EXPECT_EQ(read_file(obj), before);
  EXPECT_EQ(read_file(folder.path() / "a.png"), "pixels");
  std::filesystem::create_directory(folder.path() / "a.jpg");
  EXPECT_THROW(write_textured_obj(obj, mesh, ".jpg", picture, {"anew"}), MachineError);
  EXPECT_EQ(read_file(obj), before);
  EXPECT_EQ(names_in(folder.path()).size(), 4u);
}

}  // namespace
}  // namespace viewcell
