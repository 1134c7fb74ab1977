#include "psnr/arguments.h"

#include <cmath>
#include <filesystem>

#include "base/error.h"

namespace viewcell {
namespace {

// What is compared in a folder.
const std::vector<std::string> kPictures = {"*.png", "*.jpg",  "*.jpeg", "*.exr",
                                            "*.tif", "*.tiff", "*.webp"};

}  // namespace

void declare_arguments(Tool& tool, PsnrArguments& arguments) {
  tool.add_option("REFERENCE", &arguments.reference,
                  "picture (PNG, JPEG, EXR, TIFF, WebP; -: standard input) or folder of pictures")
      .required()
      .reads("REFERENCE", kPictures);
  tool.add_option("TESTED", &arguments.tested,
                  "the picture to judge, or a folder with the same file names")
      .required()
      .reads("TESTED", kPictures);
  tool.add_flag("--index-maps", &arguments.index_maps,
                "both are indexing maps (.exr, .tif): RMS and largest distance "
                "in texels, share within one texel")
      .excludes("--fail-below")
      .excludes("--diff");
  tool.add_option("--inside", &arguments.inside,
                  "of indexing maps, only texels inside the charts of this mesh")
      .needs("--index-maps")
      .reads("the mesh of --inside");
  tool.add_option("--fail-below", &arguments.fail_below_db,
                  "exit with 5 when the PSNR of any pair is below this many dB");
  tool.add_option("--diff", &arguments.options.difference,
                  "write the amplified difference: a PNG, or a folder of them for folders");
  tool.add_option("--gain", &arguments.options.difference_gain, "what --diff multiplies by")
      .show_default();
  tool.add_flag("--ssim,!--no-ssim", &arguments.options.measures.ssim,
                "measure SSIM (default: yes)");
  tool.add_output("write the table to this file (default -: standard output)", false);
}

void check_arguments(Tool& tool, const PsnrArguments& arguments) {
  if (arguments.reference == "-" && arguments.tested == "-")
    throw UsageError("only one of the two pictures can be standard input");
  if (!(arguments.options.difference_gain >= 0))
    throw UsageError("--gain is not a number of at least 0");
  if (std::isnan(arguments.fail_below_db)) throw UsageError("--fail-below is not a number");
  // A folder, when folders are compared.
  NamedFile diff{"--diff", arguments.options.difference.string()};
  if (std::filesystem::is_directory(arguments.reference)) diff.inside = {"*.png"};
  tool.writes({diff});
}

}  // namespace viewcell
