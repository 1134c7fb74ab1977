// What texadapt reads.
#pragma once

#include <string>
#include <vector>

#include "adapt/adaptation.h"
#include "image/image.h"
#include "pm/progressive_mesh.h"
#include "texadapt/arguments.h"

namespace viewcell {

struct TexadaptInputs {
  ProgressiveRecord record;
  TriMesh finest;
  ImageRgba8 texture;
  ImageRgba8 normal_map;            ///< empty: none was given
  std::vector<ImageRgba8> further;  ///< as in the arguments
  std::string charts;               ///< lines about them
  std::string hash;                 ///< adaptation_hash() of the record
};

/// Reads all but the log, and sets the arguments' start and the size of the map, where it is not
/// given. Throws InputError for a mesh without texture coordinates, or with charts that no texture
/// can follow.
TexadaptInputs read_inputs(const Tool& tool, TexadaptArguments& arguments);

/// The log that is to be replayed, or a fresh one, which is written where that was asked for.
AdaptationLog get_log(const Tool& tool, const TexadaptArguments& arguments,
                      const ProgressiveRecord& record);

}  // namespace viewcell
