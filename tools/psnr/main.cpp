// psnr: how far pictures are from a reference.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "base/error.h"
#include "base/file.h"
#include "psnr/arguments.h"
#include "psnr/index_maps.h"

namespace viewcell {
namespace {

namespace fs = std::filesystem;

std::vector<NamedDistance> compare(const Tool& tool, const PsnrArguments& arguments, bool folders) {
  if (folders)
    return compare_folders(arguments.reference, arguments.tested, arguments.options,
                           tool.common().n_threads, tool.progress("pair"));
  return {compare_files(arguments.reference, arguments.tested, arguments.options)};
}

// Of a folder's pictures, the same remark once.
void remark(const Tool& tool, const PsnrArguments& arguments,
            const std::vector<NamedDistance>& pairs) {
  Remarks of_reference, of_tested;
  for (const NamedDistance& pair : pairs) {
    for (const Remark& r : pair.of_reference) add_remark(&of_reference, r.what, r.count);
    for (const Remark& r : pair.of_tested) add_remark(&of_tested, r.what, r.count);
  }
  tool.remark(arguments.reference, of_reference);
  tool.remark(arguments.tested, of_tested);
}

int run(const Tool& tool, const PsnrArguments& arguments) {
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

  remark(tool, arguments, pairs);
  const CommonOptions& common = tool.common();
  const std::string table_file = common.output.empty() ? "-" : common.output;
  const bool stdout_is_json = common.json_file == "-";
  if (!(stdout_is_json && table_file == "-")) write_file(table_file, format_table(pairs));
  tool.report(folders ? report_pairs(pairs) : report_pair(pairs[0].distance));

  if (std::isinf(arguments.fail_below_db)) return 0;  // not asked for
  const auto judged = static_cast<JudgedPsnr>(
      std::find(judged_names().begin(), judged_names().end(), arguments.judge) -
      judged_names().begin());
  const Verdict verdict = judge(pairs, judged, arguments.fail_below_db);
  tool.say(verdict.words);
  return verdict.n_below > 0 ? kOverThreshold : 0;
}

}  // namespace
}  // namespace viewcell

int main(int argc, char** argv) {
  viewcell::Tool tool(
      "psnr",
      "Measures how far pictures are from a reference, at their own depth: PSNR of luminance and "
      "of "
      "R, G and B together, over the frame and over covered pixels (alpha above 0 in either), "
      "SSIM, "
      "SNR (power of the tested picture over power of the error), RMS and largest difference. "
      "Pictures of two depths are compared as reals in [0, 1].",
      "psnr frustum/0001.png hybrid/0001.png --diff difference.png\n"
      "  psnr frustum/ hybrid/ --fail-below 37 --json distances.json\n"
      "  psnr before.exr after.exr --index-maps --inside head.obj");
  viewcell::PsnrArguments arguments;
  viewcell::declare_arguments(tool, arguments);
  return tool.main(
      argc, argv, [&] { viewcell::check_arguments(tool, arguments); },
      [&] { return viewcell::run(tool, arguments); });
}
