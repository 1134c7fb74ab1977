// Picture files and folders of them compared, and the report of it (`psnr --json`).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/json.h"
#include "base/parallel.h"
#include "image/metrics.h"

namespace viewcell {

struct CompareFilesOptions {
  CompareOptions measures;
  /// Where difference pictures go: a PNG's name for a pair, a folder for folders. Empty: nowhere.
  std::filesystem::path difference;
  double difference_gain = 8;  ///< see difference_image
};

struct NamedDistance {
  std::string name;  ///< the file's name in both folders
  ImageDistance distance;
};

/// Throws InputError when either is no picture or their sizes differ. One of them may be "-".
ImageDistance compare_files(const std::filesystem::path& reference,
                            const std::filesystem::path& tested,
                            const CompareFilesOptions& options = {});

/// Pairs by file name, in order of name: the pictures (by extension: png, jpg, jpeg, exr, tif,
/// tiff, webp; hidden files passed over) of each folder itself. Throws InputError when one has no
/// partner, or there are none.
std::vector<NamedDistance> compare_folders(const std::filesystem::path& reference,
                                           const std::filesystem::path& tested,
                                           const CompareFilesOptions& options = {},
                                           int n_threads = 0, const Progress& progress = {});

/// {"psnr_db", "psnr_covered_db", "ssim", "snr_db", "rms", "max_abs", "width_px", "height_px"};
/// "ssim" is null when it was not measured.
Json report_pair(const ImageDistance& distance);

/// {"pairs": [report_pair with "name"], "summary": {KEY: {"mean", "min", "max"}}}, with the
/// decibels of the mean squared error beside the mean of the decibels, "of_mean_square".
Json report_pairs(const std::vector<NamedDistance>& pairs);

/// The same for people: a line a pair, then mean, min and max of several; aligned columns.
std::string format_table(const std::vector<NamedDistance>& pairs);

}  // namespace viewcell
