// psnr: how far pictures are from a reference.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include "base/error.h"
#include "base/file.h"
#include "common/tool.h"
#include "psnr/index_maps.h"
#include "report/compare_files.h"

namespace viewcell {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::string reference, tested, inside;
  bool index_maps = false;
  double fail_below_db = -std::numeric_limits<double>::infinity();
  CompareFilesOptions options;
};

void declare(Tool& tool, Arguments& arguments) {
  tool.add_option("REFERENCE", &arguments.reference,
                  "picture (PNG, JPEG, EXR, TIFF, WebP; -: standard input) or folder of pictures")
      .required();
  tool.add_option("TESTED", &arguments.tested,
                  "the picture to judge, or a folder with the same file names")
      .required();
  tool.add_flag("--index-maps", &arguments.index_maps,
                "both are indexing maps (.exr, .tif): RMS and largest distance "
                "in texels, share within one texel")
      .excludes("--fail-below")
      .excludes("--diff");
  tool.add_option("--inside", &arguments.inside,
                  "of indexing maps, only texels inside the charts of this mesh")
      .needs("--index-maps");
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

std::vector<NamedDistance> compare(const Tool& tool, const Arguments& arguments, bool folders) {
  if (folders)
    return compare_folders(arguments.reference, arguments.tested, arguments.options,
                           tool.common().n_threads, tool.progress("pair"));
  return {
      {arguments.tested, compare_files(arguments.reference, arguments.tested, arguments.options)}};
}

int run(const Tool& tool, const Arguments& arguments) {
  if (arguments.reference == "-" && arguments.tested == "-")
    throw UsageError("only one of the two pictures can be standard input");
  if (!(arguments.options.difference_gain >= 0))
    throw UsageError("--gain is not a number of at least 0");
  if (std::isnan(arguments.fail_below_db)) throw UsageError("--fail-below is not a number");
  if (arguments.index_maps) {
    compare_index_map_files(tool, arguments.reference, arguments.tested, arguments.inside);
    return 0;
  }
  const bool folders = fs::is_directory(arguments.reference);
  if (folders != fs::is_directory(arguments.tested)) {
    for (const std::string& path : {arguments.reference, arguments.tested})
      if (path != "-" && !fs::exists(path)) throw InputError(path, "", "does not exist");
    throw UsageError("give two pictures or two folders, not one of each");
  }
  const std::vector<NamedDistance> pairs = compare(tool, arguments, folders);

  const CommonOptions& common = tool.common();
  const std::string table_file = common.output.empty() ? "-" : common.output;
  const bool stdout_is_json = common.json_file == "-";
  if (!(stdout_is_json && table_file == "-")) write_file(table_file, format_table(pairs));
  tool.report(folders ? report_pairs(pairs) : report_pair(pairs[0].distance));

  const bool any_below = std::any_of(pairs.begin(), pairs.end(), [&](const NamedDistance& pair) {
    return pair.distance.psnr_db < arguments.fail_below_db;
  });
  return any_below ? kOverThreshold : 0;
}

}  // namespace
}  // namespace viewcell

int main(int argc, char** argv) {
  viewcell::Tool tool(
      "psnr",
      "Measures how far pictures are from a reference: PSNR of luminance over the "
      "frame and over covered pixels (alpha above 0 in either), SSIM, SNR (power of "
      "the tested picture over power of the error), RMS and largest difference.",
      "psnr frustum/0001.png hybrid/0001.png --diff difference.png\n"
      "  psnr frustum/ hybrid/ --fail-below 37 --json distances.json\n"
      "  psnr before.exr after.exr --index-maps --inside head.obj");
  viewcell::Arguments arguments;
  viewcell::declare(tool, arguments);
  return tool.main(argc, argv, [&] { return viewcell::run(tool, arguments); });
}
