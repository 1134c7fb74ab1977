#include "bundle/bundle_writer.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdio>

#include "base/error.h"

namespace viewcell {
namespace fs = std::filesystem;
namespace {

// Whether a manifest of version 1 is there.
bool is_version_1(const fs::path& file) {
  std::error_code ignored;  // a folder without one is new
  if (!fs::is_regular_file(file, ignored)) return false;
  try {
    const Json json = parse_json(read_file(file, 1u << 30), file);
    return json.is_object() && json.contains("version") && json["version"] == 1;
  } catch (const InputError&) {
    return false;
  }
}

bool is_bake_name(const std::string& name) {
  return name.size() == 21 && name.starts_with("bake-") &&
         std::all_of(name.begin() + 5, name.end(),
                     [](unsigned char c) { return std::isxdigit(c); });
}

void remove_bakes_but(const fs::path& folder, const fs::path& kept) {
  std::error_code error;
  std::vector<fs::path> old;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (is_bake_name(at->path().filename().string()) && at->path() != kept)
      old.push_back(at->path());
  for (const fs::path& bake : old) remove_unheld(bake);
}

bool has_name(const fs::path& file, std::string_view start, std::string_view end) {
  const std::string name = file.filename().string();
  return name.starts_with(start) && name.ends_with(end);
}

// Bundles of version 1 kept their files beside the manifest.
void remove_version_1(const fs::path& folder) {
  std::vector<fs::path> files = {folder / "cells.json", folder / "scene.json"};
  std::error_code error;
  for (const auto& [part, start, end] :
       {std::tuple("cells", "cell-", ".geo"), std::tuple("centres", "centre-", ".tex")})
    for (fs::directory_iterator at(folder / part, error), last; !error && at != last;
         at.increment(error))
      if (has_name(at->path(), start, end)) files.push_back(at->path());
  try {
    for (const SceneMesh& mesh :
         read_scene(folder / "scene.json", {.with_meshes = false, .limits = {}}).meshes)
      files.push_back(folder / mesh.file);
  } catch (const InputError&) {  // then its meshes stay
  }
  for (const fs::path& file : files) fs::remove(file, error);
  for (const char* part : {"cells", "centres", "meshes"})
    ::rmdir((folder / part).c_str());  // what is not empty stays
}

// Makes the folder where it is not there; only the last part of its path goes again.
const fs::path& made(const fs::path& folder, Temporary& is_new) {
  std::error_code ignored;  // make_folder says what is wrong
  if (!fs::exists(folder, ignored)) {
    const fs::path leaf = folder.has_filename() ? folder : folder.parent_path();  // "bundle/"
    fs::create_directories(leaf.parent_path(), ignored);
    is_new.make(leaf, [&] { return ::mkdir(leaf.c_str(), 0777) == 0; });
  }
  make_folder(folder);
  return folder;
}

// The folder is at the target; what was there, the same files by their hashes, goes with `from`.
void put_in_place(const fs::path& from, const fs::path& target) {
  if (::rename(from.c_str(), target.c_str()) == 0) return;
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, target.c_str(), RENAME_EXCHANGE) == 0) return;
  const fs::path away = from / "replaced";  // a file system that cannot exchange
  if (::rename(target.c_str(), away.c_str()) != 0 || ::rename(from.c_str(), target.c_str()) != 0)
    throw MachineError(target.string() + ": cannot rename into place: " + errno_text());
  std::error_code ignored;  // it is in nobody's way
  fs::remove_all(target / "replaced", ignored);
}

}  // namespace

BundleWriter::BundleWriter(const fs::path& folder, BundleManifest manifest)
    : folder_(folder),
      lock_(made(folder, new_folder_), "cellpack", std::to_string(::getpid())),
      bake_(folder / "bake"),
      manifest_(std::move(manifest)),
      key_(bake_key(manifest_)) {
  for (const char* part : {"cells", "centres"}) make_folder(bake_.path() / part);
}

void BundleWriter::add_file(const std::string& name, const std::string& hash) {
  const std::lock_guard lock(mutex_);
  manifest_.files[name] = hash;
}

void BundleWriter::write(CellId cell, const CellGeometry& geometry) {
  const std::string name = cell_name(cell);
  add_file(name, write_cell_geometry(bake_.path() / name, cell, key_, geometry));
}

void BundleWriter::write(CentreId centre, const CentreTextures& textures) {
  const std::string name = centre_name(centre);
  add_file(name, write_centre_textures(
                     bake_.path() / name, centre, key_, textures, manifest_.texture_format,
                     manifest_.has_masks ? ZeroAlpha::exact : ZeroAlpha::nearest));
}

void BundleWriter::write_copy(const std::string& name, std::string_view bytes,
                              const std::string& hash) {
  make_folder((bake_.path() / name).parent_path());
  write_file(bake_.path() / name, bytes);
  if (!hash.empty()) add_file(name, hash);
}

void BundleWriter::commit() {
  const bool was_version_1 = is_version_1(folder_ / kManifestName);
  const fs::path target = bake_folder(folder_, manifest_);
  PendingFile manifest(folder_ / kManifestName, format_json(format_manifest(manifest_)));
  run_uninterrupted([&] {
    const bool is_new = !fs::exists(target);
    bool is_committed = false;
    put_in_place(bake_.path(), target);
    try {
      manifest.commit([&] { is_committed = true; });
    } catch (const MachineError&) {
      if (is_new && !is_committed) fs::remove_all(target);
      throw;
    }
    new_folder_.keep();
  });
  remove_bakes_but(folder_, target);
  if (was_version_1) remove_version_1(folder_);
}

}  // namespace viewcell
