#include "bundle/manifest.h"

#include <cstdio>

#include "base/error.h"
#include "base/file.h"

namespace viewcell {
namespace fs = std::filesystem;
namespace {

constexpr const char* kFormat = "viewcell-bundle";
// The second says that there are masks; without them the first is written.
constexpr JsonVersions kVersions{2, 3};
constexpr const char* kRemedy = "pack the bundle again with cellpack";

std::string numbered(const char* pattern, int number) {
  char name[48];
  std::snprintf(name, sizeof name, pattern, number);
  return name;
}

template <typename Id>
std::vector<Id> read_ids(const JsonCursor& cursor) {
  std::vector<Id> out;
  for (std::size_t i = 0; i < cursor.size(); ++i) {
    out.push_back(Id(cursor.at(i).integer(0, 1 << 30)));
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

std::string read_hash(const JsonCursor& cursor) {
  const std::string text = cursor.string();
  if (text.size() != 16 || text.find_first_not_of("0123456789abcdef") != std::string::npos)
    cursor.fail("is no hash of 16 hexadecimal digits");
  return text;
}

TextureFormat read_texture_format(const JsonCursor& cursor) {
  const std::string format = cursor.string();
  if (format != "rgba8" && format != "bc3") cursor.fail("is neither rgba8 nor bc3");
  return format == "bc3" ? TextureFormat::bc3 : TextureFormat::rgba8;
}

// All but "key", "files" and "hash".
Json format_bake(const BundleManifest& m) {
  return {{"format", kFormat},
          {"version", m.has_masks ? kVersions.last : kVersions.first},
          {"made_by", m.made_by},
          {"scene_hash", m.scene_hash},
          {"cells_hash", m.cells_hash},
          {"captures", m.captures},
          {"meshes", m.meshes},
          {"resolution_px", m.resolution_px},
          {"texture_format", m.texture_format == TextureFormat::bc3 ? "bc3" : "rgba8"},
          {"cells", format_ids(m.cells)},
          {"centres", format_ids(m.centres)}};
}

// All but "hash".
Json format_all(const BundleManifest& m) {
  Json json = format_bake(m);
  json["key"] = bake_key(m);
  json["files"] = Json::object();
  for (const auto& [name, hash] : m.files) json["files"][name] = hash;
  return json;
}

std::map<std::string, std::string> read_files(const JsonCursor& cursor, const BundleManifest& m) {
  std::map<std::string, std::string> files;
  if (!cursor.value().is_object()) cursor.fail("is not an object");
  for (const auto& item : cursor.value().items())
    files[item.key()] = read_hash(cursor.at(item.key()));
  const auto hold = [&](const std::string& name) {
    if (!files.contains(name)) cursor.fail("has no \"" + name + "\"");
  };
  for (const CellId cell : m.cells) hold(cell_name(cell));
  for (const CentreId centre : m.centres) hold(centre_name(centre));
  return files;
}

}  // namespace

std::string bake_key(const BundleManifest& m) {
  return hash_hex(format_bake(m).dump());
}

fs::path bake_folder(const fs::path& bundle, const BundleManifest& m) {
  return bundle / ("bake-" + hash_hex(format_all(m).dump()));
}

std::string cell_name(CellId cell) {
  return numbered("cells/cell-%05d.geo", static_cast<int>(cell));
}

std::string centre_name(CentreId centre) {
  return numbered("centres/centre-%05d.tex", static_cast<int>(centre));
}

Json format_manifest(const BundleManifest& m) {
  Json json = format_all(m);
  json["hash"] = hash_hex(json.dump());
  return json;
}

BundleManifest read_manifest(const fs::path& file) {
  refuse_special(file);
  const Json json = read_json(file, kFormat, kVersions, kRemedy);
  const JsonCursor root(json, file);
  BundleManifest m;
  m.has_masks = root.at("version").integer(kVersions.first, kVersions.last) == kVersions.last;
  m.made_by = root.at("made_by").value();
  m.scene_hash = read_hash(root.at("scene_hash"));
  m.cells_hash = read_hash(root.at("cells_hash"));
  m.captures = read_hash(root.at("captures"));
  m.meshes = read_hash(root.at("meshes"));
  m.resolution_px = static_cast<int>(root.at("resolution_px").integer(1, 1 << 14));
  m.texture_format = read_texture_format(root.at("texture_format"));
  m.cells = read_ids<CellId>(root.at("cells"));
  m.centres = read_ids<CentreId>(root.at("centres"));
  if (m.cells.empty()) root.at("cells").fail("is empty");
  m.files = read_files(root.at("files"), m);
  const Json expected = format_manifest(m);
  for (const char* key : {"key", "hash"})
    if (read_hash(root.at(key)) != expected[key])
      root.at(key).fail(std::string("is not that of what stands beside it, which was changed; ") +
                        kRemedy);
  return m;
}

}  // namespace viewcell
