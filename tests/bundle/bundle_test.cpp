#include "bundle/bundle.h"

#include <gtest/gtest.h>

#include <fstream>

#include "bake/pack.h"
#include "bake/small_bake.h"
#include "base/srgb.h"
#include "common/expect_input_error.h"
#include "common/mutate.h"

namespace viewcell {
namespace {
namespace fs = std::filesystem;

// A copy of the shared bundle, to be damaged.
struct BundleCopy {
  TemporaryFolder folder;
  fs::path path = folder.path() / "bundle";
  BundleCopy() { fs::copy(shared_bundle(), path, fs::copy_options::recursive); }
};

void expect_same(const CellGeometry& a, const CellGeometry& b) {
  ASSERT_EQ(a.objects.size(), b.objects.size());
  for (std::size_t i = 0; i < a.objects.size(); ++i) {
    EXPECT_EQ(a.objects[i].object, b.objects[i].object);
    EXPECT_EQ(a.objects[i].kind, b.objects[i].kind);
    EXPECT_EQ(a.objects[i].n_vertices, b.objects[i].n_vertices);
    EXPECT_EQ(a.objects[i].n_triangles, b.objects[i].n_triangles);
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(a.objects[i].lo[k], b.objects[i].lo[k]);
      EXPECT_EQ(a.objects[i].hi[k], b.objects[i].hi[k]);
    }
  }
  EXPECT_EQ(a.source_vertices, b.source_vertices);
  EXPECT_EQ(a.offsets, b.offsets);
  EXPECT_EQ(a.indices, b.indices);
  EXPECT_EQ(a.views, b.views);
}

// Two objects of 4 and 3 vertices, 2 and 1 triangles.
CellGeometry make_geometry() {
  CellGeometry g;
  g.objects = {{1, 1, 4, 2, {0, 1, 2}, {3, 4, 5}}, {3, 2, 3, 1, {-1, -2, -3}, {0, 0, 0}}};
  g.source_vertices = {5, 6, 7, 8, 0, 1, 1151};
  g.offsets = {0, 1, -1, 32767, -32767, 100, -100};
  g.indices = {0, 1, 2, 3, 1, 0, 2, 1, 0};
  g.views = {1, 0x7f, 0};
  return g;
}

TEST(Bundle, GeometryReadsBack) {
  const BundleCopy copy;
  const Bundle bundle(copy.path);
  const CellGeometry geometry = make_geometry();
  write_cell_geometry(cell_file(copy.path, CellId(3)), geometry);
  expect_same(bundle.read_cell(CellId(3)), geometry);
  write_cell_geometry(cell_file(copy.path, CellId(3)), {});
  expect_same(bundle.read_cell(CellId(3)), {});
}

TEST(Bundle, EveryIndexOfGeometryIsChecked) {
  const BundleCopy copy;
  const Bundle bundle(copy.path);
  const auto refused = [&](const auto& change) {
    CellGeometry g = make_geometry();
    change(g);
    write_cell_geometry(cell_file(copy.path, CellId(3)), g);
    EXPECT_INPUT_ERROR(bundle.read_cell(CellId(3)), "cell-00003.geo");
  };
  refused([](CellGeometry& g) { g.objects[0].object = 5; });
  refused([](CellGeometry& g) { g.objects[0].object = -1; });
  refused([](CellGeometry& g) { g.objects[1].kind = 0; });
  refused([](CellGeometry& g) { g.objects[1].kind = 3; });
  refused([](CellGeometry& g) { g.indices[5] = 4; });
  refused([](CellGeometry& g) { g.indices[8] = 3; });
  refused([](CellGeometry& g) { g.indices[8] = ~0u; });
  refused([](CellGeometry& g) { g.source_vertices[6] = 1152; });  // a torus has 48 * 24
  refused([](CellGeometry& g) { g.source_vertices[0] = ~0u; });
  refused([](CellGeometry& g) { g.source_vertices.pop_back(); });
  refused([](CellGeometry& g) { g.offsets.push_back(0); });
  refused([](CellGeometry& g) { g.indices.pop_back(); });
  refused([](CellGeometry& g) { g.views.pop_back(); });
  refused([](CellGeometry& g) { g.objects[0].n_vertices = ~0u, g.objects[1].n_vertices = 8; });
  refused([](CellGeometry& g) { ++g.objects[0].n_triangles; });
  refused([](CellGeometry& g) { g.objects.clear(); });
}

CentreTextures make_textures() {
  CentreTextures t;
  BundleTile tile;
  tile.object = 2, tile.x = -3, tile.y = 4, tile.width_px = 4, tile.height_px = 3;
  tile.source_px = 256, tile.eye[0] = 1.0 / 3, tile.right[1] = -1, tile.up[2] = 1;
  tile.forward[0] = 1, tile.focal_px = 221.7, tile.code_scale = 1e4, tile.code_bias = -17;
  t.tiles = {tile, tile};
  t.tiles[1].object = 4, t.tiles[1].first_texel = 12;
  for (int i = 0; i < 24; ++i)
    t.texels.push_back({static_cast<std::uint8_t>(i), 1, 2, static_cast<std::uint8_t>(255 - i)});
  return t;
}

TEST(Bundle, TexturesReadBack) {
  const BundleCopy copy;
  const Bundle bundle(copy.path);
  const CentreTextures made = make_textures();
  write_centre_textures(centre_file(copy.path, CentreId(4)), made, TextureFormat::rgba8);
  const CentreTextures read = bundle.read_centre(CentreId(4));
  EXPECT_EQ(read.texels, made.texels);
  ASSERT_EQ(read.tiles.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read.tiles[i].object, made.tiles[i].object);
    EXPECT_EQ(read.tiles[i].x, -3);
    EXPECT_EQ(read.tiles[i].height_px, 3);
    EXPECT_EQ(read.tiles[i].eye[0], 1.0 / 3);
    EXPECT_EQ(read.tiles[i].focal_px, 221.7);
    EXPECT_EQ(read.tiles[i].code_bias, -17);
    EXPECT_EQ(read.tiles[i].first_texel, made.tiles[i].first_texel);
  }
}

// Memory that held a longer or a shorter centre leaves no trace.
TEST(Bundle, TexturesAreReadIntoUsedMemory) {
  const BundleCopy copy;
  const Bundle bundle(copy.path);
  const CentreTextures made = make_textures();
  write_centre_textures(centre_file(copy.path, CentreId(4)), made, TextureFormat::rgba8);
  for (const std::size_t n : {std::size_t{3}, made.texels.size() + 1000}) {
    const std::vector<Rgba8> used(n, Rgba8{9, 9, 9, 9});
    EXPECT_EQ(bundle.read_centre(CentreId(4), used).texels, made.texels);
  }
}

TEST(Bundle, CompressedTexturesReadBackNearly) {
  const BundleCopy copy;
  std::string manifest = read_file(copy.path / kManifestName);
  const std::size_t at = manifest.find("rgba8");
  ASSERT_NE(at, std::string::npos);
  write_file(copy.path / kManifestName, manifest.replace(at, 5, "bc3"));
  const Bundle bundle(copy.path);
  const CentreTextures made = make_textures();
  write_centre_textures(centre_file(copy.path, CentreId(4)), made, TextureFormat::bc3);
  const CentreTextures read = bundle.read_centre(CentreId(4));
  ASSERT_EQ(read.texels.size(), made.texels.size());
  for (std::size_t i = 0; i < made.texels.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(read.texels[i][k], made.texels[i][k], 8) << i << " " << k;
  // Textures of the other format, and blocks that are fewer than the tiles need.
  write_centre_textures(centre_file(copy.path, CentreId(4)), made, TextureFormat::rgba8);
  EXPECT_INPUT_ERROR(bundle.read_centre(CentreId(4)), "BC3");
  CentreTextures wider = made;
  wider.texels.resize(1000);
  wider.tiles[1].width_px = 60;
  write_centre_textures(centre_file(copy.path, CentreId(4)), wider, TextureFormat::bc3);
  EXPECT_NO_THROW(bundle.read_centre(CentreId(4)));
}

TEST(Bundle, EveryTileIsChecked) {
  const BundleCopy copy;
  const Bundle bundle(copy.path);
  const auto refused = [&](const auto& change) {
    CentreTextures t = make_textures();
    change(t.tiles[1], t);
    write_centre_textures(centre_file(copy.path, CentreId(4)), t, TextureFormat::rgba8);
    EXPECT_INPUT_ERROR(bundle.read_centre(CentreId(4)), "centre-00004.tex");
  };
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  refused([](BundleTile& t, auto&) { t.object = 5; });
  refused([](BundleTile& t, auto&) { t.object = -1; });
  refused([](BundleTile& t, auto&) { t.width_px = 1; });
  refused([](BundleTile& t, auto&) { t.width_px = -4, t.height_px = -3; });
  refused([](BundleTile& t, auto&) { t.height_px = 1 << 16; });
  refused([](BundleTile& t, auto&) { t.height_px = 4; });
  refused([](BundleTile& t, auto&) { t.first_texel = 13; });
  refused([](BundleTile& t, auto&) { t.first_texel = ~std::uint64_t{0} - 3; });
  refused([](BundleTile& t, auto&) { t.focal_px = std::nan(""); });
  refused([](BundleTile& t, auto&) { t.code_scale = kInfinity; });
  refused([](BundleTile& t, auto&) { t.code_bias = -kInfinity; });
  refused([](BundleTile&, CentreTextures& t) { t.texels.pop_back(); });
}

TEST(Bundle, DamagedFilesAreRefusedOrSound) {
  const BundleCopy copy;
  const Bundle bundle(copy.path);
  write_cell_geometry(cell_file(copy.path, CellId(3)), make_geometry());
  write_centre_textures(centre_file(copy.path, CentreId(4)), make_textures(), {});
  const std::string cell = read_file(cell_file(copy.path, CellId(3)));
  const std::string centre = read_file(centre_file(copy.path, CentreId(4)));
  read_damaged_copies(cell, 1000, 1, [&](const std::string& bytes) {
    fs::remove(cell_file(copy.path, CellId(3)));  // some file systems flush one that is rewritten
    std::ofstream(cell_file(copy.path, CellId(3)), std::ios::binary) << bytes;
    expect_same(bundle.read_cell(CellId(3)), make_geometry());  // or a refusal: sections are hashed
  });
  read_damaged_copies(centre, 1000, 2, [&](const std::string& bytes) {
    fs::remove(centre_file(copy.path, CentreId(4)));
    std::ofstream(centre_file(copy.path, CentreId(4)), std::ios::binary) << bytes;
    EXPECT_EQ(bundle.read_centre(CentreId(4)).texels, make_textures().texels);
  });
}

TEST(Bundle, CodesDecodeToDepthWithinHalfACode) {
  Random random(6);
  for (int k = 0; k < 20; ++k) {
    CaptureTile tile;
    tile.object = ObjectId(k);
    tile.crop = {k, -k, 9, 7};
    tile.view.focal_px = 100 + k, tile.view.source_px = 256;
    tile.color = ImageRgbaFloat(9, 7);
    tile.inverse_depth = Image<float>(9, 7);
    const double nearest = random.uniform(1, 200), range = random.uniform(0.01, 50);
    for (float& d : tile.inverse_depth.pixels)
      d = static_cast<float>(1 / (nearest + range * random.uniform()));
    for (RgbaFloat& c : tile.color.pixels)
      c = {static_cast<float>(random.uniform()), static_cast<float>(random.uniform(0, 3)), 0, 1};
    CentreTextures textures;
    textures.texels.resize(5);
    append_tile(tile, textures);
    const BundleTile& out = textures.tiles.at(0);
    EXPECT_EQ(out.object, k);
    EXPECT_EQ(out.first_texel, 5u);
    ASSERT_EQ(textures.texels.size(), 5u + 63u);
    std::set<int> codes;
    for (std::size_t i = 0; i < 63; ++i) {
      const Rgba8& texel = textures.texels[5 + i];
      const double decoded = (texel[3] - out.code_bias) / out.code_scale;
      EXPECT_NEAR(decoded, static_cast<double>(tile.inverse_depth.pixels[i]),
                  0.5001 / out.code_scale)
          << "case " << k;
      codes.insert(texel[3]);
      EXPECT_NEAR(texel[0], srgb8_from_linear(tile.color.pixels[i][0]), 1);  // by way of halves
      EXPECT_NEAR(texel[1], srgb8_from_linear(std::min(1.0f, tile.color.pixels[i][1])), 1);
      EXPECT_EQ(texel[2], 0);
    }
    EXPECT_EQ(*codes.begin(), 0);     // the farthest
    EXPECT_EQ(*codes.rbegin(), 255);  // the nearest: all codes are used
  }
}

TEST(Bundle, OneDepthAloneIsEncodedWithoutDividing) {
  CaptureTile tile;
  tile.crop = {0, 0, 2, 2};
  tile.color = ImageRgbaFloat(2, 2, {0.5f, 0.5f, 0.5f, 1});
  tile.inverse_depth = Image<float>(2, 2, 0.25f);
  CentreTextures textures;
  append_tile(tile, textures);
  EXPECT_TRUE(std::isfinite(textures.tiles[0].code_scale));
  EXPECT_TRUE(std::isfinite(textures.tiles[0].code_bias));
}

TEST(Bundle, OpensOnlyWhatIsWhole) {
  for (const char* part : {"bundle.json", "scene.json", "cells.json", "torus.ply"}) {
    const BundleCopy copy;
    EXPECT_EQ(Bundle(copy.path).manifest().cells.size(), shared_bake().list.size());
    fs::remove(copy.path / part);
    EXPECT_INPUT_ERROR(Bundle{copy.path}, part);
  }
  EXPECT_INPUT_ERROR(Bundle{"/nonexistent/bundle"}, "bundle.json");
  const BundleCopy copy;
  const Bundle bundle(copy.path);
  fs::remove(cell_file(copy.path, CellId(1)));
  EXPECT_INPUT_ERROR(bundle.read_cell(CellId(1)), "cell-00001.geo");
}

TEST(Bundle, RefusesAnotherScenesParts) {
  const BundleCopy copy;
  const std::string manifest = read_file(copy.path / "bundle.json");
  const auto write = [&](const char* key, const Json& value) {
    Json json = Json::parse(manifest);
    json[key] = value;
    write_file(copy.path / "bundle.json", json.dump());
  };
  const auto refused = [&](const char* key, const Json& value) {
    write(key, value);
    EXPECT_INPUT_ERROR(Bundle{copy.path}, key);
  };
  refused("scene_hash", "0123456789abcdef");
  refused("cells", Json::array());
  refused("cells", {0, 1000});
  refused("cells", {-1});
  refused("cells", {3, 2});
  refused("cells", {2, 2});
  refused("centres", {100000});
  refused("resolution_px", 0);
  refused("texture_format", "png");
  write_file(copy.path / "bundle.json", manifest);
  Scene other = make_bake_scene();
  other.objects[0].translation.x += 1;
  write_scene(other, copy.path);
  EXPECT_INPUT_ERROR(Bundle{copy.path}, "scene");
}

}  // namespace
}  // namespace viewcell
