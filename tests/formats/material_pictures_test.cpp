#include "formats/material_pictures.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include "common/expect_input_error.h"
#include "common/mutate.h"
#include "common/temporary_folder.h"
#include "formats/gltf_builder.h"
#include "formats/mesh_file.h"
#include "formats/mtl.h"
#include "formats/texture_file.h"
#include "formats/write_glb.h"
#include "image/io.h"
#include "image/jpeg.h"

namespace viewcell {
namespace {

constexpr Rgba8 kRedTexel{200, 10, 20, 255}, kBlueTexel{120, 130, 250, 255};

std::string png(int width_px, const Rgba8& color = kRedTexel) {
  return encode_png(ImageRgba8(width_px, 1, color));
}

// ---- glTF ----

// A triangle for each material of the JSON, and pictures of one, two, three.. texels' width.
GltfBuilder with_materials(const char* materials, int n_pictures) {
  GltfBuilder out = one_triangle();
  out.json["materials"] = Json::parse(materials);
  const std::size_t uv = out.add<float>({0, 0, 1, 0, 0, 1}, "VEC2");
  Json primitive = out.primitive();
  primitive["attributes"]["TEXCOORD_0"] = uv;
  out.json["meshes"][0]["primitives"] = Json::array();
  for (std::size_t m = 0; m < out.json["materials"].size(); ++m) {
    primitive["material"] = m;
    out.json["meshes"][0]["primitives"].push_back(primitive);
  }
  for (int i = 0; i < n_pictures; ++i) {
    const std::string bytes = png(i + 1);
    out.json["images"].push_back(
        {{"bufferView", out.add_view(bytes.data(), bytes.size())}, {"mimeType", "image/png"}});
    out.json["textures"].push_back({{"source", i}});
  }
  return out;
}

MaterialPictures read(const TemporaryFolder& folder, const GltfBuilder& gltf) {
  return read_material_pictures(folder.add("m.glb", gltf.bytes()));
}

TEST(MaterialPictures, OfAGlbEachMaterialHasItsOwn) {
  const TemporaryFolder folder;
  const GltfBuilder gltf = with_materials(R"([
    {"name": "skin", "pbrMetallicRoughness": {"baseColorTexture": {"index": 1},
      "baseColorFactor": [0.5, 0.25, 1, 0.75], "roughnessFactor": 0.5},
      "normalTexture": {"index": 2, "scale": 2}, "doubleSided": true, "alphaMode": "MASK",
      "alphaCutoff": 0.25},
    {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0}},
    {"name": "skin", "pbrMetallicRoughness": {"baseColorTexture": {"index": 1}},
      "emissiveFactor": [1, 0, 0.5]},
    {"name": "plain", "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}}])",
                                          3);
  const MaterialPictures model = read(folder, gltf);
  ASSERT_EQ(model.materials.size(), 4u);
  EXPECT_EQ(count_colors(model), 2u);
  ASSERT_EQ(model.pictures.size(), 3u);
  const auto width_of = [&](int picture) {
    return decode_texture(model.pictures.at(static_cast<std::size_t>(picture))).width_px;
  };
  const PicturedMaterial& skin = model.materials[0];
  EXPECT_EQ(width_of(skin.color), 2);
  EXPECT_EQ(width_of(skin.normal), 3);
  EXPECT_EQ(skin.look.base_color_factor, glm::dvec4(0.5, 0.25, 1, 0.75));
  EXPECT_EQ(skin.look.metallic, 1);
  EXPECT_EQ(skin.look.roughness, 0.5);
  EXPECT_EQ(skin.look.normal_scale, 2);
  EXPECT_TRUE(skin.look.is_double_sided);
  EXPECT_EQ(skin.look.alpha_mode, "MASK");
  EXPECT_EQ(skin.look.alpha_cutoff, 0.25);
  EXPECT_EQ(width_of(model.materials[1].color), 1);
  EXPECT_EQ(model.materials[1].normal, -1);
  EXPECT_EQ(model.materials[1].look.metallic, 0);
  EXPECT_EQ(model.materials[1].look.name, "");
  EXPECT_EQ(model.materials[2].color, skin.color);
  EXPECT_EQ(model.materials[2].look.emissive, glm::dvec3(1, 0, 0.5));
  EXPECT_EQ(model.materials[3].color, -1);
  EXPECT_EQ(model.hash, hash_file(folder.path() / "m.glb"));
  // By the names that a mesh has them by, though two have one name and one has none.
  const TriMesh mesh = read_mesh(folder.path() / "m.glb");
  ASSERT_EQ(mesh.triangles.size(), 4u);
  for (std::size_t t = 0; t < 4; ++t) {
    const std::string& name = mesh.material_names[static_cast<std::size_t>(mesh.materials[t])];
    EXPECT_EQ(find_material(model, name), &model.materials[t]) << name;
  }
  EXPECT_EQ(find_material(model, "none"), nullptr);
}

TEST(MaterialPictures, SamplersAreKept) {
  const TemporaryFolder folder;
  GltfBuilder gltf = with_materials(R"([
    {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "normalTexture": {"index": 1}},
    {"pbrMetallicRoughness": {"baseColorTexture": {"index": 2}}}])",
                                    3);
  gltf.json["samplers"] = Json::parse(R"([{"wrapS": 33648, "magFilter": 9728, "minFilter": 9984},
    {"wrapT": 10496, "minFilter": 1}])");
  gltf.json["textures"][0]["sampler"] = 0;
  gltf.json["textures"][2]["sampler"] = 1;
  const MaterialPictures model = read(folder, gltf);
  EXPECT_EQ(model.materials[0].look.color_sampler,
            (GlbSampler{.wrap_s = 33648, .mag_filter = 9728, .min_filter = 9984}));
  EXPECT_EQ(model.materials[0].look.normal_sampler, GlbSampler());
  EXPECT_EQ(model.materials[1].look.color_sampler, (GlbSampler{.wrap_t = 33071}));
}

TEST(MaterialPictures, WhatIsLeftOutIsSaid) {
  const TemporaryFolder folder;
  GltfBuilder gltf = with_materials(R"([
    {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0.5,
      "metallicRoughnessTexture": {"index": 1}}, "emissiveFactor": [1, 1, 1],
      "emissiveTexture": {"index": 1}, "normalTexture": {"index": 1, "texCoord": 1},
      "extensions": {"KHR_materials_clearcoat": {}}},
    {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "normalTexture": {"index": 2}}])",
                                    2);
  gltf.json["textures"].push_back(
      Json::parse(R"({"extensions": {"KHR_texture_basisu": {"source": 0}}})"));
  const MaterialPictures model = read(folder, gltf);
  EXPECT_EQ(count_said(model.remarks, "slot metallicRoughness, left out"), 1u);
  EXPECT_EQ(count_said(model.remarks, "slot emissive, left out"), 1u);
  EXPECT_EQ(count_said(model.remarks, "normal with texture coordinates of their own"), 1u);
  EXPECT_EQ(count_said(model.remarks, "KHR_materials_clearcoat"), 1u);
  EXPECT_EQ(count_said(model.remarks, "normal maps that are no PNG, JPEG or WebP"), 1u);
  EXPECT_EQ(model.materials[0].normal, -1);
  EXPECT_EQ(model.materials[1].normal, -1);
  // Without their textures these factors would mean another thing.
  EXPECT_EQ(model.materials[0].look.metallic, 0);
  EXPECT_EQ(model.materials[0].look.emissive, glm::dvec3(0));
}

TEST(MaterialPictures, OfAGlbMaterialsThatNoFaceHasArePassedOver) {
  const TemporaryFolder folder;
  GltfBuilder gltf = with_materials(R"([{"name": "used"}])", 1);
  gltf.json["materials"].push_back(Json::parse(
      R"({"name": "other", "pbrMetallicRoughness": {"baseColorTexture": {"index": 9}}})"));
  const MaterialPictures model = read(folder, gltf);
  ASSERT_EQ(model.materials.size(), 1u);
  EXPECT_EQ(model.materials[0].name, "used");
  gltf.json["materials"][0]["alphaMode"] = "MASKED";
  EXPECT_INPUT_ERROR(read(folder, gltf), "alphaMode: is 'MASKED', not OPAQUE");
  gltf.json["textures"][0] =
      Json::parse(R"({"extensions": {"KHR_texture_basisu": {"source": 0}}})");
  gltf.json["materials"][0].erase("alphaMode");
  gltf.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
  EXPECT_INPUT_ERROR(read(folder, gltf), "has its picture as KHR_texture_basisu alone");
}

TEST(MaterialPictures, DamagedFilesNeverCrash) {
  constexpr std::uint64_t kSeed = 9;
  const TemporaryFolder folder;
  const std::string gltf =
      with_materials(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
    "alphaMode": "MASK", "normalTexture": {"index": 1, "scale": 2}, "emissiveFactor": [1, 1, 1]},
    {"pbrMetallicRoughness": {"baseColorTexture": {"index": 1}}}])",
                     2)
          .bytes();
  read_damaged_copies(gltf, 1000, kSeed, [&](const std::string& damaged) {
    put_bytes(folder / "bad.glb", damaged);
    read_material_pictures(folder / "bad.glb");
  });
  folder.add("m.obj", "mtllib bad.mtl\nusemtl a\nusemtl b\n");
  folder.add("one.png", png(1));
  read_damaged_copies(
      "newmtl a\nKd 1 0.5 0\nd 0.5\nmap_Kd -s 1 1 1 -mm 0 1 one.png\nnewmtl b\nbump x\n", 500,
      kSeed, [&](const std::string& damaged) {
        put_bytes(folder / "bad.mtl", damaged);
        read_material_pictures(folder / "m.obj");
      });
}

// ---- OBJ ----

constexpr const char* kTexturedTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n";

struct ObjFolder {
  TemporaryFolder folder;
  ObjFolder() {
    folder.add("one.png", png(1));
    folder.add("two three.png", png(2));
  }
  MaterialPictures read(const std::string& mtl, const std::string& obj) const {
    folder.add("m.mtl", mtl);
    return read_material_pictures(folder.add("m.obj", kTexturedTriangle + obj));
  }
};

TEST(MaterialPictures, OfAnObjTheirLibrariesSay) {
  const ObjFolder files;
  const MaterialPictures model = files.read(
      "map_Kd above.png\nnewmtl  red  cloth \r\nKd 0.5 1 0\r\nmap_Kd -s 1 1 1 -blendu on "
      "one.png\r\n"
      "newmtl steel\nKd 0.5 1 0\nd 0.25\nmap_Bump -bm 0.5 bump.png\n"
      "newmtl sail\n\tmap_Kd two three.png\nnewmtl unused\nmap_Kd none.png\n",
      "mtllib m.mtl\nusemtl red cloth\nf 1/1 2/2 3/3\nusemtl steel\nf 1/1 3/3 2/2\n"
      "usemtl sail\nf 1/1 2/2 3/3\n");
  ASSERT_EQ(model.materials.size(), 3u);
  EXPECT_EQ(model.materials[0].name, "red cloth");
  EXPECT_EQ(model.materials[0].look.base_color_factor, glm::dvec4(1));
  EXPECT_EQ(decode_texture(model.pictures[0]).width_px, 1);
  EXPECT_EQ(model.materials[1].color, -1);
  EXPECT_NEAR(model.materials[1].look.base_color_factor.x, 0.214, 1e-3);  // sRGB 0.5
  EXPECT_EQ(model.materials[1].look.base_color_factor.w, 0.25);
  EXPECT_EQ(model.materials[1].look.alpha_mode, "BLEND");
  EXPECT_EQ(model.materials[2].color, 1);
  EXPECT_EQ(decode_texture(model.pictures[1]).width_px, 2);
  EXPECT_EQ(count_said(model.remarks, "pictures of map_Bump, left out"), 1u);
  EXPECT_EQ(count_colors(model), 2u);
}

TEST(MaterialPictures, OfAnObjLibrariesMayBeSeveralAndElsewhere) {
  const ObjFolder files;
  std::filesystem::create_directory(files.folder.path() / "sub");
  files.folder.add("sub/a.mtl", "newmtl a\nmap_Kd beside.png\nnewmtl b\nmap_Kd one.png\n");
  files.folder.add("sub/beside.png", png(5));
  const MaterialPictures model =
      files.read("newmtl c\nmap_Kd .\\one.png\n",
                 "mtllib m.mtl sub\\a.mtl gone.mtl\nusemtl a\nf 1/1 2/2 3/3\nusemtl b\n"
                 "f 1/1 2/2 3/3\nusemtl c\nf 1/1 2/2 3/3\n");
  ASSERT_EQ(model.materials.size(), 3u);
  EXPECT_EQ(count_said(model.remarks, "libraries that are not there"), 1u);
  const auto width_of = [&](const char* name) {
    const int color = find_material(model, name)->color;
    return decode_texture(model.pictures.at(static_cast<std::size_t>(color))).width_px;
  };
  EXPECT_EQ(width_of("a"), 5);  // beside its library
  EXPECT_EQ(width_of("b"), 1);  // beside the OBJ
  EXPECT_EQ(width_of("c"), 1);
}

TEST(MaterialPictures, OfAnObjWhatIsWrongIsSaid) {
  const ObjFolder files;
  const std::string use = "usemtl a\nf 1/1 2/2 3/3\n";
  EXPECT_INPUT_ERROR(files.read("", use), "m.obj: names no material library (mtllib)");
  EXPECT_INPUT_ERROR(files.read("", "mtllib gone.mtl\n" + use), "'gone.mtl' is not there");
  EXPECT_INPUT_ERROR(files.read("", "mtllib ../m.mtl\n" + use), "leaves the file's folder");
  const auto bad = [&](const std::string& map, const std::string& part) {
    EXPECT_INPUT_ERROR(files.read("newmtl a\n" + map + "\n", "mtllib m.mtl\n" + use), part);
  };
  bad("map_Kd gone.png", "gone.png: cannot open");
  bad("map_Kd -s 2 2 one.png", "m.mtl: line 2: map_Kd -s: a picture that is moved");
  bad("map_Kd -o 0 0.5 0 one.png", "map_Kd -o: a picture that is moved");
  bad("map_Kd /etc/one.png", "is absolute");
  bad("map_Kd ../one.png", "leaves the file's folder");
  bad("map_Kd -clamp on", "path '' is empty");
}

TEST(MaterialPictures, AnObjOfOnePictureIsATexture) {
  const ObjFolder files;
  const std::string obj = (files.folder.path() / "m.obj").string();
  const std::string use = "mtllib m.mtl\nusemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 2/2 3/3\n";
  files.read("newmtl a\nmap_Kd two three.png\nnewmtl b\nnewmtl c\nmap_Kd one.png\n", use);
  EXPECT_EQ(read_texture(obj).width_px, 2);
  files.read("newmtl a\nmap_Kd one.png\nnewmtl b\nmap_Kd two three.png\n", use);
  EXPECT_INPUT_ERROR(read_texture(obj), "m.obj: its materials have 2 different pictures (map_Kd)");
  files.read("newmtl a\n", use);
  EXPECT_INPUT_ERROR(read_texture(obj), "none of its materials has a picture");
}

// ---- what is written again as JPEG ----

// Lossy; with alpha in the extended form.
std::string webp(int n_channels) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "a.webp").string();
  const std::vector<std::uint8_t> samples(static_cast<std::size_t>(16 * 16 * n_channels), 100);
  const auto output = OIIO::ImageOutput::create(file);
  EXPECT_TRUE(output && output->open(file, {16, 16, n_channels, OIIO::TypeUInt8}) &&
              output->write_image(OIIO::TypeUInt8, samples.data()) && output->close());
  return read_file(file);
}

TEST(MaterialPictures, OpaqueJpegAndWebpAreLossy) {
  const ImageRgba8 opaque(8, 8, kRedTexel), clear(8, 8, {200, 10, 20, 100});
  const auto quality_of = [](const std::string& bytes) {
    int out = -1;
    decode_texture({bytes, "a"}, {}, &out);
    return out;
  };
  EXPECT_EQ(quality_of(encode_jpeg(opaque, {.quality = 73})), 73);
  EXPECT_EQ(quality_of(webp(3)), 90);
  EXPECT_EQ(quality_of(webp(4)), 0);
  EXPECT_EQ(quality_of(encode_png(opaque)), 0);
  EXPECT_EQ(quality_of(encode_png(clear)), 0);
}

}  // namespace
}  // namespace viewcell
