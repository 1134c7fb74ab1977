#include "bundle/bundle.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <set>

#include "bake/bundle_copy.h"
#include "bake/pack.h"
#include "base/srgb.h"
#include "common/expect_input_error.h"
#include "common/mutate.h"

namespace viewcell {
namespace {
namespace fs = std::filesystem;

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

// A cell that has objects 1 and 3, both tori, outside.
CellId chosen_cell() {
  const CellSet& cells = shared_bake().cells;
  for (const CellId cell : shared_bake().list)
    if (!is_inside(cells, cell, ObjectId(1)) && !is_inside(cells, cell, ObjectId(3))) return cell;
  throw BugError("no such cell");
}

// Two objects of 4 and 3 vertices, 2 and 1 triangles, among others without any.
CellGeometry make_geometry() {
  CellGeometry g;
  for (int o = 0; o < 5; ++o) {
    if (is_inside(shared_bake().cells, chosen_cell(), ObjectId(o))) continue;
    if (o == 1)
      g.objects.push_back({1, 1, 4, 2, {0, 1, 2}, {3, 4, 5}});
    else if (o == 3)
      g.objects.push_back({3, 2, 3, 1, {-1, -2, -3}, {0, 0, 0}});
    else
      g.objects.push_back({o, 1, 0, 0, {0, 0, 0}, {0, 0, 0}});
  }
  g.source_vertices = {5, 6, 7, 8, 0, 1, 1151};
  g.offsets = {0, 1, -1, 32767, -32767, 100, -100};
  g.indices = {0, 1, 2, 3, 1, 0, 2, 1, 0};
  g.views = {1, 0x7f, 0};
  return g;
}

BundleObject& object_of(CellGeometry& g, std::int32_t id) {
  return *std::find_if(g.objects.begin(), g.objects.end(),
                       [&](const BundleObject& o) { return o.object == id; });
}

TEST(Bundle, GeometryReadsBack) {
  const BundleCopy copy;
  copy.write(chosen_cell(), make_geometry());
  expect_same(Bundle(copy.path()).read_cell(chosen_cell()), make_geometry());
}

TEST(Bundle, EveryNumberOfGeometryIsChecked) {
  const BundleCopy copy;
  const auto refused = [&](const char* message, const auto& change) {
    CellGeometry g = make_geometry();
    change(g);
    copy.write(chosen_cell(), g);
    const Bundle bundle(copy.path());
    EXPECT_INPUT_ERROR(bundle.read_cell(chosen_cell()), cell_name(chosen_cell()));
    EXPECT_INPUT_ERROR(bundle.read_cell(chosen_cell()), message);
  };
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  refused("names object 5", [](CellGeometry& g) { object_of(g, 1).object = 5; });
  refused("names object -1", [](CellGeometry& g) { object_of(g, 1).object = -1; });
  refused("object 1 twice", [](CellGeometry& g) { object_of(g, 3).object = 1; });
  refused("kind", [](CellGeometry& g) { object_of(g, 3).kind = 0; });
  refused("seen or unseen", [](CellGeometry& g) { object_of(g, 3).kind = 3; });
  refused("unknown kind", [](CellGeometry& g) { object_of(g, 3).kind = 4; });
  refused("box of object 1", [](CellGeometry& g) { object_of(g, 1).lo[2] = 6; });
  refused("box of object 1", [](CellGeometry& g) { object_of(g, 1).lo[0] = kNaN; });
  refused("box of object 3", [](CellGeometry& g) { object_of(g, 3).hi[1] = kNaN; });
  refused("box of object 3", [](CellGeometry& g) { object_of(g, 3).hi[1] = kInfinity; });
  refused("box of object 3", [](CellGeometry& g) { object_of(g, 3).lo[1] = -kInfinity; });
  refused("INDICES", [](CellGeometry& g) { g.indices[5] = 4; });
  refused("INDICES", [](CellGeometry& g) { g.indices[8] = 3; });
  refused("INDICES", [](CellGeometry& g) { g.indices[8] = ~0u; });
  refused("VERTICES", [](CellGeometry& g) { g.source_vertices[6] = 1152; });  // a torus: 48 * 24
  refused("VERTICES", [](CellGeometry& g) { g.source_vertices[0] = ~0u; });
  refused("VIEWS", [](CellGeometry& g) { g.views[1] = 0x80; });
  refused("counts", [](CellGeometry& g) { g.source_vertices.pop_back(); });
  refused("counts", [](CellGeometry& g) { g.offsets.push_back(0); });
  refused("counts", [](CellGeometry& g) { g.indices.pop_back(); });
  refused("counts", [](CellGeometry& g) { g.views.pop_back(); });
  refused("counts", [](CellGeometry& g) {
    object_of(g, 1).n_vertices = ~0u, object_of(g, 3).n_vertices = 8;
  });
  refused("counts", [](CellGeometry& g) { ++object_of(g, 1).n_triangles; });
  refused("lacks objects", [](CellGeometry& g) { g.objects.clear(); });
  refused("lacks objects", [](CellGeometry& g) { g.objects.pop_back(); });
}

TEST(Bundle, ObjectsInsideTheCellAreNotOutsideIt) {
  const BundleCopy copy;
  const CellSet& cells = shared_bake().cells;
  for (const CellId cell : shared_bake().list) {
    if (cells.inside[index(cell)].empty()) continue;
    CellGeometry g = Bundle(copy.path()).read_cell(cell);
    g.objects[0].object = static_cast<std::int32_t>(cells.inside[index(cell)][0]);
    copy.write(cell, g);
    EXPECT_INPUT_ERROR(Bundle(copy.path()).read_cell(cell), "which is inside the cell");
    return;
  }
  FAIL() << "no object inside any cell";
}

constexpr CentreId kCentre{5};

CentreTextures make_textures() {
  CentreTextures t;
  BundleTile tile;
  tile.object = 2, tile.x = -3, tile.y = 4, tile.width_px = 4, tile.height_px = 3;
  const glm::dvec3 eye = eye_of(shared_bake().cells, kCentre);
  for (int k = 0; k < 3; ++k) tile.eye[k] = eye[k];
  tile.source_px = 256, tile.right[1] = -1, tile.up[2] = 1;
  tile.forward[0] = 1, tile.focal_px = 221.7, tile.code_scale = 1e4, tile.code_bias = -17;
  t.tiles = {tile, tile};
  t.tiles[1].object = 4, t.tiles[1].first_texel = 12;
  for (int i = 0; i < 24; ++i)
    t.texels.push_back({static_cast<std::uint8_t>(i), 1, 2, static_cast<std::uint8_t>(255 - i)});
  return t;
}

TEST(Bundle, TexturesReadBack) {
  const BundleCopy copy;
  const CentreTextures made = make_textures();
  copy.write(kCentre, made);
  const CentreTextures read = Bundle(copy.path()).read_centre(kCentre);
  EXPECT_EQ(read.texels, made.texels);
  ASSERT_EQ(read.tiles.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read.tiles[i].object, made.tiles[i].object);
    EXPECT_EQ(read.tiles[i].x, -3);
    EXPECT_EQ(read.tiles[i].height_px, 3);
    EXPECT_EQ(read.tiles[i].eye[0], made.tiles[i].eye[0]);
    EXPECT_EQ(read.tiles[i].focal_px, 221.7);
    EXPECT_EQ(read.tiles[i].code_bias, -17);
    EXPECT_EQ(read.tiles[i].first_texel, made.tiles[i].first_texel);
  }
}

// Memory that held a longer or a shorter centre leaves no trace.
TEST(Bundle, TexturesAreReadIntoUsedMemory) {
  const BundleCopy copy;
  const CentreTextures made = make_textures();
  copy.write(kCentre, made);
  const Bundle bundle(copy.path());
  for (const std::size_t n : {std::size_t{3}, made.texels.size() + 1000}) {
    const std::vector<Rgba8> used(n, Rgba8{9, 9, 9, 9});
    EXPECT_EQ(bundle.read_centre(kCentre, used).texels, made.texels);
  }
}

TEST(Bundle, CompressedTexturesReadBackNearly) {
  const SmallBake& small = shared_bake();
  const TemporaryFolder folder;
  pack_bundle(small.scene, small.cells, small.inputs, small.list, TextureFormat::bc3,
              test_provenance(), folder / "bundle", 2, {});
  const BundleCopy copy(folder / "bundle");
  const CentreTextures made = make_textures();
  copy.write(kCentre, made, TextureFormat::bc3);
  const CentreTextures read = Bundle(copy.path()).read_centre(kCentre);
  ASSERT_EQ(read.texels.size(), made.texels.size());
  for (std::size_t i = 0; i < made.texels.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(read.texels[i][k], made.texels[i][k], 8) << i << " " << k;
  // Textures of the other format, and blocks that are fewer than the tiles need.
  copy.write(kCentre, made, TextureFormat::rgba8);
  EXPECT_INPUT_ERROR(Bundle(copy.path()).read_centre(kCentre), "BC3");
  CentreTextures wider = made;
  wider.texels.resize(1000);
  wider.tiles[1].width_px = 60;
  copy.write(kCentre, wider, TextureFormat::bc3);
  EXPECT_NO_THROW(Bundle(copy.path()).read_centre(kCentre));
}

TEST(Bundle, EveryNumberOfATileIsChecked) {
  const BundleCopy copy;
  const auto refused = [&](const char* message, const auto& change) {
    CentreTextures t = make_textures();
    change(t.tiles[1], t);
    copy.write(kCentre, t);
    const Bundle bundle(copy.path());
    EXPECT_INPUT_ERROR(bundle.read_centre(kCentre), centre_name(kCentre));
    EXPECT_INPUT_ERROR(bundle.read_centre(kCentre), message);
  };
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  refused("object 5", [](BundleTile& t, auto&) { t.object = 5; });
  refused("object -1", [](BundleTile& t, auto&) { t.object = -1; });
  refused("object 2", [](BundleTile& t, auto&) { t.object = 2; });  // again
  refused("crop", [](BundleTile& t, auto&) { t.width_px = 1; });
  refused("crop", [](BundleTile& t, auto&) { t.width_px = -4, t.height_px = -3; });
  refused("crop", [](BundleTile& t, auto&) { t.height_px = 1 << 16; });
  refused("crop", [](BundleTile& t, auto&) { t.x = 1 << 21; });
  refused("crop", [](BundleTile& t, auto&) { t.y = -(1 << 21); });
  refused("picture", [](BundleTile& t, auto&) { t.source_px = 0; });
  refused("picture", [](BundleTile& t, auto&) { t.source_px = -256; });
  refused("texels", [](BundleTile& t, auto&) { t.height_px = 4; });
  refused("follow", [](BundleTile& t, auto&) { t.first_texel = 11; });
  refused("follow", [](BundleTile& t, auto&) { t.first_texel = 13; });
  refused("follow", [](BundleTile& t, auto&) { t.first_texel = ~std::uint64_t{0} - 3; });
  for (const double bad : {kNaN, kInfinity, -kInfinity, 1e5}) {
    refused("not seen from the centre", [&](BundleTile& t, auto&) { t.eye[1] = bad; });
    refused("axes", [&](BundleTile& t, auto&) { t.right[0] = bad; });
    refused("axes", [&](BundleTile& t, auto&) { t.up[2] = bad; });
    refused("axes", [&](BundleTile& t, auto&) { t.forward[0] = bad; });
  }
  refused("axes", [](BundleTile& t, auto&) { t.right[1] = 1; });  // a mirror
  refused("axes", [](BundleTile& t, auto&) { t.up[2] = 0; });
  refused("axes", [](BundleTile& t, auto&) { t.right[0] = 0.01; });
  for (const double bad : {kNaN, kInfinity, 0.0, -221.7, 1e10})
    refused("focal", [&](BundleTile& t, auto&) { t.focal_px = bad; });
  for (const double bad : {kNaN, kInfinity, -1.0})
    refused("depth code", [&](BundleTile& t, auto&) { t.code_scale = bad; });
  for (const double bad : {kNaN, -kInfinity, 1.0})
    refused("depth code", [&](BundleTile& t, auto&) { t.code_bias = bad; });
  refused("texels", [](BundleTile&, CentreTextures& t) { t.texels.pop_back(); });
  refused("texels", [](BundleTile&, CentreTextures& t) { t.texels.push_back({}); });
}

// Files that are whole in themselves, but not what stands for them in this bundle.
TEST(Bundle, ExchangedFilesAreFound) {
  const BundleCopy copy;
  const Bundle bundle(copy.path());
  const auto exchanged = [&](const std::string& name, const fs::path& other, auto id,
                             const char* message) {
    const std::string before = read_file(copy.file(name));
    fs::remove(copy.file(name));
    fs::copy(other, copy.file(name));
    if constexpr (std::is_same_v<decltype(id), CellId>)
      EXPECT_INPUT_ERROR(bundle.read_cell(id), message)
    else
      EXPECT_INPUT_ERROR(bundle.read_centre(id), message)
    put_bytes(copy.file(name), before);
  };
  const CellId cell{1};
  exchanged(cell_name(cell), copy.file(cell_name(CellId(0))), cell, "is of cell 0, not 1");
  exchanged(cell_name(cell), copy.file(centre_name(kCentre)), cell, "is not geometry of a cell");
  exchanged(centre_name(kCentre), copy.file(centre_name(CentreId(6))), kCentre,
            "is of centre 6, not 5");
  exchanged(centre_name(kCentre), copy.file(cell_name(cell)), kCentre,
            "is not textures of a centre");
  // Of another bake of the same scene.
  const TemporaryFolder folder;
  shared_bake().pack(folder / "few", shared_bake().inputs, {cell, CellId(2)});
  const BundleCopy few(folder / "few");
  exchanged(cell_name(cell), few.file(cell_name(cell)), cell, "is of another bake");
  // Of this bake by what it says, but not what was packed.
  CellGeometry geometry = bundle.read_cell(cell);
  ++geometry.offsets.at(0);
  write_cell_geometry(folder / "forged", cell, copy.key(), geometry);
  exchanged(cell_name(cell), folder / "forged", cell, "is not the file that was packed");
  CentreTextures textures = bundle.read_centre(kCentre);
  textures.texels.at(0)[1] ^= 1;
  write_centre_textures(folder / "forged", kCentre, copy.key(), textures, TextureFormat::rgba8);
  exchanged(centre_name(kCentre), folder / "forged", kCentre, "is not the file that was packed");
  EXPECT_NO_THROW(bundle.read_cell(cell));
  EXPECT_NO_THROW(bundle.read_centre(kCentre));
}

TEST(Bundle, DamagedFilesAreRefusedOrSound) {
  const BundleCopy copy;
  copy.write(chosen_cell(), make_geometry());
  copy.write(kCentre, make_textures());
  const Bundle bundle(copy.path());
  const fs::path cell = copy.file(cell_name(chosen_cell()));
  const fs::path centre = copy.file(centre_name(kCentre));
  read_damaged_copies(read_file(cell), 1000, 1, [&](const std::string& bytes) {
    fs::remove(cell);  // some file systems flush one that is rewritten
    put_bytes(cell, bytes);
    expect_same(bundle.read_cell(chosen_cell()), make_geometry());  // or a refusal
  });
  read_damaged_copies(read_file(centre), 1000, 2, [&](const std::string& bytes) {
    fs::remove(centre);
    put_bytes(centre, bytes);
    EXPECT_EQ(bundle.read_centre(kCentre).texels, make_textures().texels);
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
    append_tile(tile, false, textures);
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
  append_tile(tile, false, textures);
  EXPECT_TRUE(std::isfinite(textures.tiles[0].code_scale));
  EXPECT_TRUE(std::isfinite(textures.tiles[0].code_bias));
}

// What a masked object's crop does not show is code 0, and nothing else is: as bytes and as BC3.
TEST(Bundle, HolesOfMasksHaveACodeOfTheirOwn) {
  Random random(8);
  CaptureTile tile;
  tile.object = ObjectId(0);
  tile.crop = {0, 0, 37, 22};
  tile.view.focal_px = 100, tile.view.source_px = 256;
  tile.color = ImageRgbaFloat(37, 22);
  tile.inverse_depth = Image<float>(37, 22);
  for (std::size_t i = 0; i < tile.color.pixels.size(); ++i) {
    tile.inverse_depth.pixels[i] = static_cast<float>(random.uniform(0.01, 0.02));
    tile.color.pixels[i] = {0.5f, 0.5f, 0.5f, random.below(3) == 0 ? 0.0f : 1.0f};
  }
  CentreTextures textures;
  append_tile(tile, true, textures);
  const BundleTile& out = textures.tiles.at(0);
  ImageRgba8 image(37, 22);
  image.pixels = textures.texels;
  const ImageRgba8 unpacked =
      decode_blocks(encode_blocks(image, BlockFormat::bc3, ZeroAlpha::exact));
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const bool is_seen = tile.color.pixels[i][3] > 0;
    ASSERT_EQ(image.pixels[i][3] > 0, is_seen) << i;
    ASSERT_EQ(unpacked.pixels[i][3] > 0, is_seen) << i;
    if (!is_seen) continue;
    EXPECT_NEAR((image.pixels[i][3] - out.code_bias) / out.code_scale,
                static_cast<double>(tile.inverse_depth.pixels[i]), 0.5001 / out.code_scale);
    EXPECT_NEAR(unpacked.pixels[i][3], image.pixels[i][3], 26) << i;  // a tenth of the range
  }
}

// As from behind a wall of one side: no code is near what any depth would have.
TEST(Bundle, ATileThatShowsNothingIsAtNoDepth) {
  CaptureTile tile;
  tile.crop = {0, 0, 2, 2};
  tile.color = ImageRgbaFloat(2, 2);
  tile.inverse_depth = Image<float>(2, 2, 0.0f);
  CentreTextures textures;
  append_tile(tile, false, textures);
  for (const double inverse_depth : {0.0, 1e-6, 0.1, 1e3}) {
    const BundleTile& out = textures.tiles[0];
    for (const Rgba8& texel : textures.texels)
      EXPECT_GT(std::abs(out.code_scale * inverse_depth + out.code_bias - texel[3]), 1e4);
  }
}

TEST(Bundle, OpensOnlyWhatIsWhole) {
  for (const char* part : {"scene.json", "cells.json", "torus.ply"}) {
    const BundleCopy copy;
    EXPECT_EQ(Bundle(copy.path()).manifest().cells.size(), shared_bake().list.size());
    fs::remove(copy.file(part));
    EXPECT_INPUT_ERROR(Bundle{copy.path()}, part);
  }
  EXPECT_INPUT_ERROR(Bundle{"/nonexistent/bundle"}, "bundle.json");
  const BundleCopy copy;
  const Bundle bundle(copy.path());
  fs::remove(copy.file(cell_name(CellId(1))));
  EXPECT_INPUT_ERROR(bundle.read_cell(CellId(1)), "cell-00001.geo");
  fs::remove(copy.path() / kManifestName);
  EXPECT_INPUT_ERROR(Bundle{copy.path()}, "bundle.json");
}

// The file at fault is named, though its bytes may be as good as those that were packed.
TEST(Bundle, SceneMeshesAndCellsMustBeThosePacked) {
  const auto refused = [](const char* part, const std::string& from, const std::string& to) {
    const BundleCopy copy;
    const std::string bytes = read_file(copy.file(part));
    put_bytes(copy.file(part), replaced(bytes, from, to));
    EXPECT_INPUT_ERROR(Bundle{copy.path()}, part);
  };
  refused("scene.json", "\"scale\": 0.4", "\"scale\": 0.5");
  refused("scene.json", "\"name\": \"object 1\"", "\"name\": \"object 7\"");
  refused("cells.json", "\"near\": 1.0", "\"near\": 1.5");
  refused("cells.json", "\"id\": 0", "\"id\":  0");
  refused("torus.ply", "element face", "element  face");
}

TEST(Bundle, EveryLineOfTheManifestIsHeld) {
  const BundleCopy copy;
  const std::string manifest = read_file(copy.path() / "bundle.json");
  const auto refused = [&](const char* key, const Json& value, const char* message) {
    Json json = Json::parse(manifest);
    json[key] = value;
    if (std::string(key) != "hash") seal_manifest(json);
    put_bytes(copy.path() / "bundle.json", json.dump());
    EXPECT_INPUT_ERROR(Bundle{copy.path()}, "bundle.json");
    EXPECT_INPUT_ERROR(Bundle{copy.path()}, message);
  };
  const std::string other = "0123456789abcdef";
  refused("version", 1,
          "version 1, this tool reads version 2 to 3: pack the bundle again with cellpack");
  for (const char* key : {"scene_hash", "cells_hash", "captures", "meshes", "key", "hash"}) {
    refused(key, other,
            std::string(key) == "hash" ? "hash: is not that of" : "key: is not that of");
    refused(key, "0123", key);
    refused(key, "../../../../../x", key);
    refused(key, 7, key);
  }
  refused("made_by", {{"tool", "other"}}, "key");
  refused("cells", Json::array(), "cells: is empty");
  refused("cells", {-1}, "cells[0]");
  refused("cells", {3, 2}, "cells[1]");
  refused("cells", {2, 2}, "cells[1]");
  refused("cells", {0, 1}, "key");
  refused("centres", Json::array(), "key");  // other pictures, without a word, if it were read
  refused("centres", {1, 0}, "centres[1]");
  refused("resolution_px", 0, "resolution_px");
  refused("resolution_px", 64, "key");
  refused("texture_format", "png", "texture_format");
  refused("texture_format", "bc3", "key");
  refused("files", Json::array(), "files");
  refused("files", {{"torus.ply", other}}, "files: has no \"cells/cell-00000.geo\"");
  Json files = Json::parse(manifest)["files"];
  files["cells/cell-00001.geo"] = "no hash";
  refused("files", files, "files.cells/cell-00001.geo");
  put_bytes(copy.path() / "bundle.json", replaced(manifest, files["torus.ply"], other));
  EXPECT_INPUT_ERROR(Bundle{copy.path()}, "hash: is not that of what stands beside it");
  put_bytes(copy.path() / "bundle.json", Json::parse(manifest).dump());  // other blanks
  EXPECT_NO_THROW(Bundle{copy.path()});
}

// A key that fits, of a grid that does not.
TEST(Bundle, CellsAndCentresMustBeOfTheGrid) {
  for (const bool is_cell : {true, false}) {
    const BundleCopy copy;
    BundleManifest manifest = Bundle(copy.path()).manifest();
    const fs::path old = bake_folder(copy.path(), manifest);
    if (is_cell)
      manifest.cells.push_back(CellId(1000));
    else
      manifest.centres.push_back(CentreId(1000));
    manifest.files[cell_name(CellId(1000))] = manifest.files[centre_name(CentreId(1000))] =
        "0123456789abcdef";
    fs::rename(old, bake_folder(copy.path(), manifest));
    put_bytes(copy.path() / kManifestName, format_json(format_manifest(manifest)));
    EXPECT_INPUT_ERROR(Bundle{copy.path()}, "1000 is not within the grid's");
  }
}

TEST(Bundle, NamedPipesAreRefusedAtOnce) {
  const BundleCopy copy;
  const Bundle bundle(copy.path());
  for (const std::string& name : {cell_name(CellId(1)), centre_name(kCentre)}) {
    fs::remove(copy.file(name));
    ASSERT_EQ(::mkfifo(copy.file(name).c_str(), 0600), 0);
  }
  EXPECT_INPUT_ERROR(bundle.read_cell(CellId(1)), "is a pipe");
  EXPECT_INPUT_ERROR(bundle.read_centre(kCentre), "is a pipe");
  fs::remove(copy.path() / kManifestName);
  ASSERT_EQ(::mkfifo((copy.path() / kManifestName).c_str(), 0600), 0);
  EXPECT_INPUT_ERROR(Bundle{copy.path()}, "bundle.json: is a pipe");
}

}  // namespace
}  // namespace viewcell
