#include "formats/texture_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/json.h"
#include "base/random.h"
#include "common/expect_input_error.h"
#include "common/models.h"
#include "common/mutate.h"
#include "common/temporary_folder.h"
#include "formats/mesh_file.h"
#include "formats/write_glb.h"
#include "image/io.h"
#include "image/random_image.h"
#include "mesh/cube.h"

namespace viewcell {
namespace {

constexpr Rgba8 kRed{200, 10, 20, 255}, kBlue{120, 130, 250, 255};

// A cube with a red base colour and a blue normal map, two and three texels wide.
std::string textured_cube(const TemporaryFolder& folder) {
  TriMesh mesh;
  mesh.positions = cube_positions();
  mesh.triangles = cube_triangles();
  mesh.texcoords.assign(36, glm::vec2(0.5f));
  write_glb(folder.path() / "cube.glb", mesh,
            {.base_color = encode_png(ImageRgba8(2, 1, kRed)),
             .normal_map = encode_png(ImageRgba8(3, 1, kBlue)),
             .generator = ""});
  return read_file(folder.path() / "cube.glb");
}

// Calls change(JSON) on a GLB.
template <typename Change>
std::string changed(const std::string& glb, const Change& change) {
  std::uint32_t n_json = 0;
  std::memcpy(&n_json, glb.data() + 12, 4);
  Json json = Json::parse(glb.substr(20, n_json));
  change(json);
  return make_glb(json.dump(), glb.substr(28 + n_json));
}

TEST(TextureFile, PicturesAreReadAsTheyAre) {
  const TemporaryFolder folder;
  write_png(folder.path() / "a.png", ImageRgba8(5, 4, kBlue));
  std::string hash;
  EXPECT_EQ(read_texture((folder.path() / "a.png").string(), &hash).pixels,
            ImageRgba8(5, 4, kBlue).pixels);
  EXPECT_EQ(hash, hash_file(folder.path() / "a.png"));
  EXPECT_INPUT_ERROR(read_texture((folder.path() / "none.png").string()), "cannot open");
}

TEST(TextureFile, SlotsOfAGlb) {
  const TemporaryFolder folder;
  textured_cube(folder);
  const std::string file = (folder.path() / "cube.glb").string();
  std::string hash;
  for (const std::string& name : {file, file + "#baseColor"})
    EXPECT_EQ(read_texture(name).pixels, ImageRgba8(2, 1, kRed).pixels);
  EXPECT_EQ(read_texture(file + "#normal", &hash).pixels, ImageRgba8(3, 1, kBlue).pixels);
  EXPECT_EQ(hash, hash_file(file));
  EXPECT_EQ(texture_file(file + "#normal"), file);
  EXPECT_EQ(texture_file("-"), "-");
  EXPECT_EQ(texture_file("a#b.png"), "a#b.png");
  EXPECT_INPUT_ERROR(read_texture(file + "#emissive"), "none has a texture in the slot emissive");
  EXPECT_INPUT_ERROR(read_texture(file + "#colour"), "baseColor, normal, emissive");
  EXPECT_INPUT_ERROR(read_texture(file + "#"), "is no texture's name");
}

// A file whose own name looks like a slot's is that file.
TEST(TextureFile, AFileOfTheWholeNameComesFirst) {
  const TemporaryFolder folder;
  textured_cube(folder);
  const std::string name = (folder.path() / "cube.glb#normal").string();
  write_png(name, ImageRgba8(1, 1, kRed));
  EXPECT_EQ(read_texture(name).width_px, 1);
  EXPECT_EQ(texture_file(name), name);
}

TEST(TextureFile, MaterialsMustAgree) {
  const TemporaryFolder folder;
  const std::string glb = textured_cube(folder);
  const auto two = [&](const char* second, bool is_used) {
    return folder
        .add("two.glb", changed(glb,
                                [&](Json& json) {
                                  json["materials"].push_back(Json::parse(second));
                                  Json primitive = json["meshes"][0]["primitives"][0];
                                  primitive["material"] = 1;
                                  if (is_used) json["meshes"][0]["primitives"].push_back(primitive);
                                }))
        .string();
  };
  const char* other = R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 1}}})";
  EXPECT_INPUT_ERROR(read_texture(two(other, true)),
                     "two.glb: materials: have 2 different pictures in the slot baseColor");
  EXPECT_EQ(read_texture(two(other, false)).width_px, 2);
  EXPECT_EQ(read_texture(two("{}", true)).width_px, 2);
  const char* same = R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})";
  EXPECT_EQ(read_texture(two(same, true)).width_px, 2);
  EXPECT_EQ(read_texture(two(other, true) + "#normal").width_px, 3);
}

TEST(TextureFile, WhatIsNotReadIsSaid) {
  const TemporaryFolder folder;
  const std::string glb = textured_cube(folder);
  const auto bad = [&](const auto& change, const std::string& part) {
    const auto file = folder.add("bad.glb", changed(glb, change));
    EXPECT_INPUT_ERROR(read_texture(file.string()), part);
  };
  const auto info = [](Json& json) -> Json& {
    return json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  };
  bad([&](Json& json) { info(json)["index"] = 7; }, "textures: has no element 7");
  bad([&](Json& json) { info(json)["index"] = -1; }, "index");
  bad([](Json& json) { json["textures"][0].erase("source"); }, "has no picture that is read");
  for (const char* other : {"KHR_texture_basisu", "EXT_texture_avif"})
    bad(
        [&](Json& json) {
          json["textures"][0].erase("source");
          json["textures"][0]["extensions"][other]["source"] = 0;
        },
        std::string("has its picture as ") + other + " alone");
  bad([](Json& json) { json["textures"][0]["source"] = 9; }, "images: has no element 9");
  bad([](Json& json) { json["images"][0]["bufferView"] = 99; }, "has no element 99");
  bad([](Json& json) { json["images"][0].erase("bufferView"); }, "has no \"bufferView\"");
  bad([](Json& json) { json["images"][0]["bufferView"] = 0; }, "bad.glb: images[0]: is not a PNG");
  bad([](Json& json) { json["meshes"][0]["primitives"][0]["material"] = 3; },
      "materials: has no element 3");
  bad([](Json& json) { json.erase("meshes"); }, "none has a texture in the slot baseColor");
  const auto view = [](Json& json) -> Json& {
    return json["bufferViews"][json["images"][0]["bufferView"].get<std::size_t>()];
  };
  bad([&](Json& json) { view(json)["byteLength"] = 1 << 20; }, "is past its buffer's end");
  bad([&](Json& json) { view(json)["byteOffset"] = 1LL << 39; }, "is past its buffer's end");
  bad([&](Json& json) { view(json)["byteLength"] = 40; }, "images[0]");
  bad([&](Json& json) { view(json)["buffer"] = 1; }, "no such buffer");
}

// The mesh has one set of coordinates a material: a picture that takes others does not fit it.
TEST(TextureFile, SlotsShareTheirCoordinates) {
  const TemporaryFolder folder;
  const std::string glb = textured_cube(folder);
  const auto with = [&](const auto& change) {
    return folder.add("a.glb", changed(glb, [&](Json& json) { change(json["materials"][0]); }))
        .string();
  };
  const auto change_both = [](Json& material) {
    material["normalTexture"]["texCoord"] = 1;
    material["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 1;
  };
  EXPECT_EQ(read_texture(with(change_both) + "#normal").width_px, 3);
  EXPECT_EQ(read_texture(with(change_both)).width_px, 2);
  const auto change_one = [](Json& material) {
    material["normalTexture"]["extensions"]["KHR_texture_transform"]["scale"] = {2, 2};
  };
  EXPECT_EQ(read_texture(with(change_one)).width_px, 2);
  EXPECT_INPUT_ERROR(read_texture(with(change_one) + "#normal"),
                     "materials[0]: its texture in the slot normal has other texture coordinates");
}

// WebP stands in an extension; a PNG or JPEG beside it comes first.
TEST(TextureFile, WebpExtensionIsFollowed) {
  const TemporaryFolder folder;
  const auto file = folder.add("a.glb", changed(textured_cube(folder), [](Json& json) {
                                 json["textures"][0].erase("source");
                                 json["textures"][0]["extensions"]["EXT_texture_webp"]["source"] =
                                     1;
                                 json["extensionsRequired"] = {"EXT_texture_webp"};
                               }));
  EXPECT_EQ(read_texture(file.string()).width_px, 3);
}

TEST(TextureFile, PicturesBesideAGltf) {
  const TemporaryFolder folder;
  write_png(folder.path() / "a b.png", ImageRgba8(6, 1, kRed));
  const auto with = [&](const std::string& uri) {
    return folder
               .add("m.gltf", R"({"asset": {"version": "2.0"},
      "meshes": [{"primitives": [{"attributes": {}, "material": 0}]}],
      "materials": [{"emissiveTexture": {"index": 0}}], "textures": [{"source": 0}],
      "images": [{"uri": ")" + uri +
                                  "\"}]}")
               .string() +
           "#emissive";
  };
  EXPECT_EQ(read_texture(with("a%20b.png")).width_px, 6);
  EXPECT_INPUT_ERROR(read_texture(with("../a.png")), "images[0].uri: path '../a.png' leaves");
  EXPECT_INPUT_ERROR(read_texture(with("/etc/passwd")), "is absolute");
  EXPECT_INPUT_ERROR(read_texture(with("none.png")), "cannot open");
  EXPECT_INPUT_ERROR(read_texture(with("data:image/png;base64,AAAA")),
                     "m.gltf: images[0]: is not a PNG");
}

TEST(TextureFile, DamagedFilesNeverCrash) {
  constexpr std::uint64_t kSeed = 8;
  const TemporaryFolder folder;
  const std::string glb = textured_cube(folder);
  const std::string file = (folder.path() / "bad.glb").string();
  read_damaged_copies(glb, 1500, kSeed, [&](const std::string& damaged) {
    std::ofstream(file, std::ios::binary) << damaged;
    read_texture(file);
  });
}

// A figure of several charts in large pictures that do not compress to nothing, and whose bytes
// therefore lie all over the file.
TEST(TextureFile, LargePicturesOfAFigure) {
  const TemporaryFolder folder;
  Random random(12);
  const ImageRgba8 color = random_image(1024, 512, random),
                   normal = random_image(512, 1024, random);
  const std::string file = (folder.path() / "figure.glb").string();
  write_glb(file, make_gored_figure(30, 6),
            {.base_color = encode_png(color), .normal_map = encode_png(normal), .generator = ""});
  EXPECT_EQ(read_texture(file).pixels, color.pixels);
  EXPECT_EQ(read_texture(file + "#normal").pixels, normal.pixels);
  EXPECT_EQ(read_mesh(file).triangles.size(), 4u * 30 * 29);
}

TEST(OutsideTextureFile, EgyptianCat) {
  const std::string file = VIEWCELL_SHARED_DATA "/egyptian-cat-5k/cat.glb";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  const ImageRgba8 color = read_texture(file), normal = read_texture(file + "#normal");
  EXPECT_GE(color.width_px, 1024);
  double blue = 0;
  for (const Rgba8& p : normal.pixels) blue += p[2];
  EXPECT_GT(blue / double(normal.pixels.size()), 200);  // normals point outwards
  EXPECT_NE(color.pixels, normal.pixels);
}

}  // namespace
}  // namespace viewcell
