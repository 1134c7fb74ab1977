#include "psnr/arguments.h"

#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "common/picture_input.h"

namespace viewcell {
namespace {

// What is compared in a folder: "*.png" and so on.
std::vector<std::string> picture_patterns() {
  std::vector<std::string> patterns;
  for (const std::string& ending : picture_endings()) patterns.push_back("*" + ending);
  return patterns;
}

}  // namespace

void declare_arguments(Tool& tool, PsnrArguments& arguments) {
  tool.add_option(
          "REFERENCE", &arguments.reference,
          "picture (PNG, JPEG, EXR, TIFF, WebP, GIF, BMP, TGA, PPM, HDR; -: standard input) "
          "or folder of pictures")
      .required()
      .reads("REFERENCE", picture_patterns());
  tool.add_option("TESTED", &arguments.tested,
                  "the picture to judge, or a folder with the same file names")
      .required()
      .reads("TESTED", picture_patterns());
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
                  "exit with 5 when a pair's PSNR, of what --judge says, is below this many dB");
  tool.add_option("--judge", &arguments.judge,
                  "what --fail-below holds: luminance | rgb (R, G and B together) | covered, "
                  "rgb-covered (the same over covered pixels)")
      .show_default()
      .needs("--fail-below")
      .check(one_of(judged_names()));
  tool.add_option("--peak", &arguments.options.measures.peak,
                  "full scale of PSNR and SSIM, in units of the samples (default: 255 or 65535 of "
                  "8 or 16 bits; 1 of linear light, which is compared unclipped)")
      .check(within(1e-30, 1e30))
      .excludes("--index-maps");
  declare_max_pixels(tool, &arguments.options.limits.max_pixels);
  tool.add_option("--diff", &arguments.options.difference,
                  "write the amplified difference: a PNG, or a folder of them for folders");
  tool.add_option("--gain", &arguments.options.difference_gain, "what --diff multiplies by")
      .show_default();
  tool.add_flag("--ssim,!--no-ssim", &arguments.options.measures.ssim,
                "measure SSIM (default: yes)");
  tool.add_mesh_limit(tool);
  tool.add_output("write the table to this file (default -: standard output)", false);
}

void check_arguments(Tool& tool, const PsnrArguments& arguments) {
  if (arguments.reference == "-" && arguments.tested == "-")
    throw UsageError("only one of the two pictures can be standard input");
  if (!(arguments.options.difference_gain >= 0))
    throw UsageError("--gain is not a number of at least 0");
  if (arguments.options.limits.max_pixels && arguments.index_maps)
    throw UsageError("--max-pixels is not for --index-maps");
  if (std::isnan(arguments.fail_below_db)) throw UsageError("--fail-below is not a number");
  // A folder, when folders are compared.
  NamedFile diff{"--diff", arguments.options.difference.string()};
  if (std::filesystem::is_directory(arguments.reference)) diff.inside = {"*.png"};
  tool.writes({diff});
}

}  // namespace viewcell
