#include "bundle/bundle.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "base/file.h"
#include "base/section_file.h"
#include "image/bc.h"

namespace viewcell {
namespace fs = std::filesystem;
namespace {

constexpr const char* kFormat = "viewcell-bundle";
constexpr std::uint32_t kCellKind = 2;
constexpr std::uint32_t kCentreKind = 3;

std::string numbered(const char* pattern, int number) {
  char name[48];
  std::snprintf(name, sizeof name, pattern, number);
  return name;
}

// Every index of the geometry against the counts that it states and the scene's.
void check_geometry(const CellGeometry& g, const Scene& scene, const SectionReader& reader) {
  std::uint64_t n_vertices = 0, n_triangles = 0;
  for (const BundleObject& o : g.objects) {
    if (o.object < 0 || static_cast<std::size_t>(o.object) >= scene.objects.size())
      reader.fail("OBJECTS", "names object " + std::to_string(o.object));
    if (o.kind != 1 && o.kind != 2) reader.fail("OBJECTS", "has an unknown kind of mesh");
    n_vertices += o.n_vertices;
    n_triangles += o.n_triangles;
  }
  if (g.source_vertices.size() != n_vertices || g.offsets.size() != n_vertices ||
      g.indices.size() != 3 * n_triangles || g.views.size() != n_triangles)
    reader.fail("OBJECTS", "its counts are not those of the other sections");
  std::size_t v = 0, i = 0;
  for (const BundleObject& o : g.objects) {
    const auto& mesh = scene.mesh_of(scene.objects[static_cast<std::size_t>(o.object)]).mesh;
    for (std::uint32_t k = 0; k < o.n_vertices; ++k)
      if (g.source_vertices[v++] >= mesh.positions.size())
        reader.fail("VERTICES", "has a vertex out of its mesh's range");
    for (std::uint32_t k = 0; k < 3 * o.n_triangles; ++k)
      if (g.indices[i++] >= o.n_vertices) reader.fail("INDICES", "has an index out of range");
  }
}

void check_tiles(const CentreTextures& t, std::uint64_t n_texels, const Scene& scene,
                 const SectionReader& reader) {
  for (const BundleTile& tile : t.tiles) {
    if (tile.object < 0 || static_cast<std::size_t>(tile.object) >= scene.objects.size())
      reader.fail("TILES", "names object " + std::to_string(tile.object));
    if (tile.width_px < 2 || tile.height_px < 2 || tile.width_px > 1 << 15 ||
        tile.height_px > 1 << 15)
      reader.fail("TILES", "has a crop of an absurd size");
    const auto n =
        static_cast<std::uint64_t>(tile.width_px) * static_cast<std::uint64_t>(tile.height_px);
    if (tile.first_texel > n_texels || n > n_texels - tile.first_texel)
      reader.fail("TILES", "reaches past the texels");
    if (!std::isfinite(tile.focal_px) || !std::isfinite(tile.code_scale) ||
        !std::isfinite(tile.code_bias))
      reader.fail("TILES", "has a number that is not finite");
  }
}

template <typename Id>
std::vector<Id> read_ids(const JsonCursor& cursor, int count) {
  std::vector<Id> out;
  for (std::size_t i = 0; i < cursor.size(); ++i) {
    out.push_back(Id(cursor.at(i).integer(0, count - 1)));
    if (i > 0 && out[i] <= out[i - 1]) cursor.at(i).fail("is not in ascending order");
  }
  return out;
}

template <typename Id>
Json format_ids(const std::vector<Id>& ids) {
  Json out = Json::array();
  for (const Id id : ids) out.push_back(static_cast<int>(id));
  return out;
}

}  // namespace

fs::path cell_file(const fs::path& bundle, CellId cell) {
  return bundle / "cells" / numbered("cell-%05d.geo", static_cast<int>(cell));
}

fs::path centre_file(const fs::path& bundle, CentreId centre) {
  return bundle / "centres" / numbered("centre-%05d.tex", static_cast<int>(centre));
}

Json format_manifest(const BundleManifest& m) {
  return {{"format", kFormat},
          {"version", 1},
          {"made_by", m.made_by},
          {"scene_hash", m.scene_hash},
          {"resolution_px", m.resolution_px},
          {"texture_format", m.texture_format == TextureFormat::bc3 ? "bc3" : "rgba8"},
          {"cells", format_ids(m.cells)},
          {"centres", format_ids(m.centres)}};
}

Bundle::Bundle(const fs::path& folder, int n_threads) : folder_(folder) {
  const fs::path file = folder / kManifestName;
  const Json json = read_json(file, kFormat, 1);
  const JsonCursor root(json, file);
  scene_ = read_scene(folder / "scene.json", {.n_threads = n_threads});
  cells_ = read_cells(folder / "cells.json");
  check_cells_of_scene(cells_, scene_, folder / "cells.json");
  manifest_.scene_hash = root.at("scene_hash").string();
  if (manifest_.scene_hash != scene_.hash)
    root.at("scene_hash").fail("is not that of the bundle's own scene.json");
  manifest_.resolution_px = static_cast<int>(root.at("resolution_px").integer(1, 1 << 14));
  const std::string format = root.at("texture_format").string();
  if (format != "rgba8" && format != "bc3")
    root.at("texture_format").fail("is neither rgba8 nor bc3");
  manifest_.texture_format = format == "bc3" ? TextureFormat::bc3 : TextureFormat::rgba8;
  manifest_.cells = read_ids<CellId>(root.at("cells"), cells_.grid.n_cells());
  manifest_.centres = read_ids<CentreId>(root.at("centres"), cells_.grid.n_centres());
  if (manifest_.cells.empty()) root.at("cells").fail("is empty");
}

bool Bundle::has(CellId cell) const {
  return std::binary_search(manifest_.cells.begin(), manifest_.cells.end(), cell);
}

bool Bundle::has(CentreId centre) const {
  return std::binary_search(manifest_.centres.begin(), manifest_.centres.end(), centre);
}

CellGeometry Bundle::read_cell(CellId cell) const {
  const SectionReader reader(cell_file(folder_, cell), kCellKind);
  CellGeometry g;
  g.objects = reader.read<BundleObject>("OBJECTS");
  g.source_vertices = reader.read<std::uint32_t>("VERTICES");
  g.offsets = reader.read<std::int16_t>("OFFSETS");
  g.indices = reader.read<std::uint32_t>("INDICES");
  g.views = reader.read<std::uint8_t>("VIEWS");
  check_geometry(g, scene_, reader);
  return g;
}

namespace {

// A tile's texels as BC3 blocks and back; tiles lie one after another, without gaps.
std::vector<std::uint8_t> encode_tiles(const CentreTextures& t) {
  std::vector<std::uint8_t> blocks;
  for (const BundleTile& tile : t.tiles) {
    ImageRgba8 image(tile.width_px, tile.height_px);
    std::copy_n(t.texels.begin() + static_cast<std::ptrdiff_t>(tile.first_texel),
                image.pixels.size(), image.pixels.begin());
    const BlockImage encoded = encode_blocks(image, BlockFormat::bc3);
    blocks.insert(blocks.end(), encoded.blocks.begin(), encoded.blocks.end());
  }
  return blocks;
}

// The bytes of all tiles' blocks, and in n_texels their texels.
std::uint64_t measure_blocks(const CentreTextures& t, std::uint64_t& n_texels) {
  std::uint64_t n_bytes = 0;
  for (const BundleTile& tile : t.tiles) {
    n_bytes += block_bytes(BlockFormat::bc3, tile.width_px, tile.height_px);
    n_texels +=
        static_cast<std::uint64_t>(tile.width_px) * static_cast<std::uint64_t>(tile.height_px);
  }
  return n_bytes;
}

void decode_tiles(const std::vector<std::uint8_t>& blocks, CentreTextures& t) {
  auto from = blocks.begin();
  for (const BundleTile& tile : t.tiles) {
    BlockImage encoded{BlockFormat::bc3, tile.width_px, tile.height_px, {}};
    const auto n =
        static_cast<std::ptrdiff_t>(block_bytes(BlockFormat::bc3, tile.width_px, tile.height_px));
    encoded.blocks.assign(from, from + n);
    from += n;
    const ImageRgba8 image = decode_blocks(encoded);
    std::copy(image.pixels.begin(), image.pixels.end(),
              t.texels.begin() + static_cast<std::ptrdiff_t>(tile.first_texel));
  }
}

}  // namespace

CentreTextures Bundle::read_centre(CentreId centre, std::vector<Rgba8> texels) const {
  const SectionReader reader(centre_file(folder_, centre), kCentreKind);
  CentreTextures t{reader.read<BundleTile>("TILES"), std::move(texels)};
  if (manifest_.texture_format == TextureFormat::rgba8) {
    reader.read("TEXELS", t.texels);
    check_tiles(t, t.texels.size(), scene_, reader);
    return t;
  }
  const auto blocks = reader.read<std::uint8_t>("BC3");
  check_tiles(t, ~std::uint64_t{0} >> 1, scene_, reader);  // sizes, before they are multiplied
  std::uint64_t n_texels = 0;
  if (measure_blocks(t, n_texels) != blocks.size())
    reader.fail("BC3", "is not as long as its tiles say");
  check_tiles(t, n_texels, scene_, reader);
  t.texels.resize(n_texels);
  decode_tiles(blocks, t);
  return t;
}

void write_cell_geometry(const fs::path& file, const CellGeometry& g) {
  SectionWriter writer(kCellKind);
  writer.add("OBJECTS", g.objects);
  writer.add("VERTICES", g.source_vertices);
  writer.add("OFFSETS", g.offsets);
  writer.add("INDICES", g.indices);
  writer.add("VIEWS", g.views);
  writer.write(file);
}

void write_centre_textures(const fs::path& file, const CentreTextures& t, TextureFormat format) {
  SectionWriter writer(kCentreKind);
  writer.add("TILES", t.tiles);
  if (format == TextureFormat::bc3)
    writer.add("BC3", encode_tiles(t));
  else
    writer.add("TEXELS", t.texels);
  writer.write(file);
}

}  // namespace viewcell
