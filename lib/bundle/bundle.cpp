#include "bundle/bundle.h"

#include <algorithm>

#include "base/error.h"
#include "base/file.h"
#include "base/section_file.h"
#include "bundle/bundle_checks.h"
#include "bundle/manifest.h"
#include "image/bc.h"
#include "scene/pictures.h"

namespace viewcell {
namespace fs = std::filesystem;
namespace {

// What is said of the two kinds of section file.
struct Kind {
  std::uint32_t number;
  const char* format;
  int version;
  const char* id_key;
  const char* what;
};
constexpr Kind kCellKind{2, "viewcell-cell", 1, "cell", "geometry of a cell"};
constexpr Kind kCentreKind{3, "viewcell-centre", 1, "centre", "textures of a centre"};

// --- writing ---

Json format_identity(const Kind& kind, int id, const std::string& key) {
  return {{"format", kind.format}, {"version", kind.version}, {kind.id_key, id}, {"bake", key}};
}

// A tile's texels as BC3 blocks and back; tiles lie one after another, without gaps.
std::vector<std::uint8_t> encode_tiles(const CentreTextures& t, ZeroAlpha zero) {
  std::vector<std::uint8_t> blocks;
  for (const BundleTile& tile : t.tiles) {
    ImageRgba8 image(tile.width_px, tile.height_px);
    std::copy_n(t.texels.begin() + static_cast<std::ptrdiff_t>(tile.first_texel),
                image.pixels.size(), image.pixels.begin());
    const BlockImage encoded = encode_blocks(image, BlockFormat::bc3, zero);
    blocks.insert(blocks.end(), encoded.blocks.begin(), encoded.blocks.end());
  }
  return blocks;
}

// --- reading ---

// Its name must be in the manifest, and what it says of itself must be what it stands for.
void check_identity(const SectionReader& reader, const fs::path& file, const Kind& kind, int id,
                    const std::string& key, const std::string& packed_hash) {
  const Json json = reader.read_info(kind.format, kind.version);
  const JsonCursor info(json, file);
  const auto found = info.at(kind.id_key).integer(0, 1 << 30);
  if (found != id)
    reader.fail("", "is of " + std::string(kind.id_key) + " " + std::to_string(found) + ", not " +
                        std::to_string(id));
  if (info.at("bake").string() != key) reader.fail("", "is of another bake");
  if (hash_hex(reader.table_hash()) != packed_hash)
    reader.fail("", "is not the file that was packed: its hash is not that of bundle.json");
}

std::uint64_t measure_blocks(const std::vector<BundleTile>& tiles) {
  std::uint64_t n_bytes = 0;
  for (const BundleTile& tile : tiles)
    n_bytes += block_bytes(BlockFormat::bc3, tile.width_px, tile.height_px);
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

// Meshes first, for the scene's hash holds theirs: so the file at fault is named.
void check_scene(const Scene& scene, const BundleManifest& manifest, const fs::path& bake) {
  constexpr const char* kChanged = "is damaged, or not the file that was packed";
  for (const SceneMesh& mesh : scene.meshes) {
    const auto packed = manifest.files.find(mesh.file);
    if (packed == manifest.files.end() || packed->second != mesh.hash)
      throw InputError((bake / mesh.file).string(), "", kChanged);
  }
  for (const ScenePicture& picture : scene.pictures) {
    const auto packed = manifest.files.find(picture.file);
    if (packed == manifest.files.end() || packed->second != picture.hash)
      throw InputError((bake / picture.file).string(), "", kChanged);
  }
  if (scene.hash != manifest.scene_hash)
    throw InputError((bake / "scene.json").string(), "", kChanged);
  if (scene.has_masks() && !manifest.has_masks)
    throw InputError((bake / "scene.json").string(), "materials",
                     "have masks, and the bundle was packed when tiles did not tell their holes: "
                     "pack it again with cellpack");
}

void check_cells(const CellSet& cells, const BundleManifest& manifest,
                 const fs::path& manifest_file, const fs::path& cells_file) {
  if (cells.file_hash != manifest.cells_hash)
    throw InputError(cells_file.string(), "", "is damaged, or not the file that was packed");
  const auto hold = [&](const char* what, int last, int count) {
    if (last >= count)
      throw InputError(manifest_file.string(), what,
                       std::to_string(last) + " is not within the grid's " + std::to_string(count));
  };
  hold("cells", static_cast<int>(manifest.cells.back()), cells.grid.n_cells());
  if (!manifest.centres.empty())
    hold("centres", static_cast<int>(manifest.centres.back()), cells.grid.n_centres());
}

}  // namespace

Bundle::Bundle(const fs::path& folder, const ReadSceneOptions& options)
    : manifest_(read_manifest(folder / kManifestName)),
      key_(bake_key(manifest_)),
      bake_(bake_folder(folder, manifest_)),
      hold_(bake_) {
  for (const char* name : {"scene.json", "cells.json"}) refuse_special(bake_ / name);
  scene_ = read_scene(bake_ / "scene.json", options);
  check_scene(scene_, manifest_, bake_);
  if (options.with_meshes) load_pictures(bake_ / "scene.json", scene_, {}, options.n_threads);
  cells_ = read_cells(bake_ / "cells.json");
  check_cells(cells_, manifest_, folder / kManifestName, bake_ / "cells.json");
  check_cells_of_scene(cells_, scene_, bake_ / "cells.json");
}

bool Bundle::has(CellId cell) const {
  return std::binary_search(manifest_.cells.begin(), manifest_.cells.end(), cell);
}

bool Bundle::has(CentreId centre) const {
  return std::binary_search(manifest_.centres.begin(), manifest_.centres.end(), centre);
}

CellGeometry Bundle::read_cell(CellId cell) const {
  const std::string name = cell_name(cell);
  const fs::path file = bake_ / name;
  refuse_special(file);
  const SectionReader reader(file, kCellKind.number, kCellKind.what);
  check_identity(reader, file, kCellKind, static_cast<int>(cell), key_, manifest_.files.at(name));
  CellGeometry g;
  g.objects = reader.read<BundleObject>("OBJECTS");
  g.source_vertices = reader.read<std::uint32_t>("VERTICES");
  g.offsets = reader.read<std::int16_t>("OFFSETS");
  g.indices = reader.read<std::uint32_t>("INDICES");
  g.views = reader.read<std::uint8_t>("VIEWS");
  check_geometry(g, scene_, cells_, cell, reader);
  return g;
}

CentreTextures Bundle::read_centre(CentreId centre, std::vector<Rgba8> texels) const {
  const std::string name = centre_name(centre);
  const fs::path file = bake_ / name;
  refuse_special(file);
  const SectionReader reader(file, kCentreKind.number, kCentreKind.what);
  check_identity(reader, file, kCentreKind, static_cast<int>(centre), key_,
                 manifest_.files.at(name));
  CentreTextures t{reader.read<BundleTile>("TILES"), std::move(texels)};
  if (manifest_.texture_format == TextureFormat::rgba8) {
    reader.read("TEXELS", t.texels);
    check_tiles(t.tiles, t.texels.size(), scene_, cells_, centre, reader);
    return t;
  }
  const auto blocks = reader.read<std::uint8_t>("BC3");
  const std::uint64_t n_texels = count_texels(t.tiles, reader);
  if (measure_blocks(t.tiles) != blocks.size())
    reader.fail("BC3", "is not as long as its tiles say");
  check_tiles(t.tiles, n_texels, scene_, cells_, centre, reader);
  t.texels.resize(n_texels);
  decode_tiles(blocks, t);
  return t;
}

std::string write_cell_geometry(const fs::path& file, CellId cell, const std::string& key,
                                const CellGeometry& g) {
  SectionWriter writer(kCellKind.number);
  writer.add_bytes("INFO", format_identity(kCellKind, static_cast<int>(cell), key).dump());
  writer.add("OBJECTS", g.objects);
  writer.add("VERTICES", g.source_vertices);
  writer.add("OFFSETS", g.offsets);
  writer.add("INDICES", g.indices);
  writer.add("VIEWS", g.views);
  return hash_hex(writer.write(file));
}

std::string write_centre_textures(const fs::path& file, CentreId centre, const std::string& key,
                                  const CentreTextures& t, TextureFormat format, ZeroAlpha zero) {
  SectionWriter writer(kCentreKind.number);
  writer.add_bytes("INFO", format_identity(kCentreKind, static_cast<int>(centre), key).dump());
  writer.add("TILES", t.tiles);
  if (format == TextureFormat::bc3)
    writer.add("BC3", encode_tiles(t, zero));
  else
    writer.add("TEXELS", t.texels);
  return hash_hex(writer.write(file));
}

}  // namespace viewcell
