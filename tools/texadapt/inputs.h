// What texadapt reads.
#pragma once

#include <string>
#include <vector>

#include "adapt/adaptation.h"
#include "image/image.h"
#include "pm/progressive_mesh.h"
#include "texadapt/arguments.h"
#include "texadapt/pictures.h"
#include "uv/chart_checks.h"

namespace viewcell {

struct TexadaptInputs {
  ProgressiveRecord record;
  TriMesh finest;
  ShownPictures shown;
  std::vector<ImageRgba8> further;  ///< as in the arguments
  std::string charts;               ///< lines about them
  std::string hash;                 ///< adaptation_hash() of the record
};

/// Reads all but the log, and sets the arguments' start. Throws InputError for a mesh without
/// texture coordinates, or with charts that no texture can follow; UsageError for what is for one
/// picture where there are several.
TexadaptInputs read_inputs(const Tool& tool, TexadaptArguments& arguments);

/// The arguments' options with the size of the map: where it is not given, the start's or the
/// picture's.
AdaptLevelsOptions options_of(const TexadaptArguments& arguments, const ShownPicture& picture);

/// Throws InputError(file) where no texture can follow such charts. of: which materials have them,
/// for people.
void check_obstacle(const std::string& file, const std::string& of, const ChartFindings& findings,
                    bool allows_overlap);

/// The log that is to be replayed, or a fresh one, which is written where that was asked for.
AdaptationLog get_log(const Tool& tool, const TexadaptArguments& arguments,
                      const TexadaptInputs& inputs);

}  // namespace viewcell
