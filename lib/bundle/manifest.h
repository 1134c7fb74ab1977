// bundle.json. Private to this room.
#pragma once

#include "bundle/bundle.h"

namespace viewcell {

/// Reads and checks a bundle's manifest, all but what scene and cells must say. Throws InputError.
BundleManifest read_manifest(const std::filesystem::path& file);

}  // namespace viewcell
