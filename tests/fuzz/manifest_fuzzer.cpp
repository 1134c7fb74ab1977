// bundle.json, of a bundle whose other files are whole.
#include "bundle/manifest.h"

#include "fuzz.h"
#include "small_bundle.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t n_bytes) {
  using namespace viewcell;
  static const auto bake = write_small_bundle(fuzz_folder() / "b", TextureFormat::rgba8);
  const std::filesystem::path folder = fuzz_folder() / "b";
  std::filesystem::rename(put_input("in.json", view_of(data, n_bytes)), folder / kManifestName);
  BundleManifest m;
  if (!is_taken([&] { m = read_manifest(folder / kManifestName); })) return 0;
  const Json json = format_manifest(m);
  std::filesystem::rename(put_input("in.json", format_json(json)), folder / kManifestName);
  hold(format_manifest(read_manifest(folder / kManifestName)) == json,
       "what is written reads back");
  is_taken([&] {
    const Bundle bundle(folder);
    for (const CellId cell : m.cells) hold(bundle.has(cell), "cells of the manifest are there");
    for (const CellId cell : m.cells) bundle.read_cell(cell);
    for (const CentreId centre : m.centres) bundle.read_centre(centre);
  });
  return 0;
}
