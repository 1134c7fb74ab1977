// Picture files and folders of them compared, and the report of it (`psnr --json`).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/json.h"
#include "base/parallel.h"
#include "base/remarks.h"
#include "image/header.h"
#include "image/metrics.h"

namespace viewcell {

struct CompareFilesOptions {
  CompareOptions measures;
  /// Where difference pictures go: a PNG's name for a pair, a folder for folders. Empty: nowhere.
  std::filesystem::path difference;
  double difference_gain = 8;  ///< see difference_image
  ImageLimits limits;          ///< of each picture
};

struct NamedDistance {
  std::string name;  ///< the file's name in both folders
  ImageDistance distance;
  /// What reading them did on the side, and of both: depths that differ, pixels that are not
  /// finite, alpha that differs.
  Remarks of_reference, of_tested;
};

/// At their own depth (image/deep_metrics.h). Throws InputError when either is no picture, their
/// sizes differ, or no pixel is finite in both. One of them may be "-".
NamedDistance compare_files(const std::filesystem::path& reference,
                            const std::filesystem::path& tested,
                            const CompareFilesOptions& options = {});

/// Pairs by file name, in order of name: the pictures (by picture_endings; hidden files passed
/// over) of each folder itself. Throws InputError when one has no partner, or there are none.
std::vector<NamedDistance> compare_folders(const std::filesystem::path& reference,
                                           const std::filesystem::path& tested,
                                           const CompareFilesOptions& options = {},
                                           int n_threads = 0, const Progress& progress = {});

/// What a threshold judges.
enum class JudgedPsnr { luminance, rgb, covered, rgb_covered };
/// As --judge has it: "luminance", "rgb", "covered", "rgb-covered".
const std::vector<std::string>& judged_names();
/// "PSNR of luminance", "PSNR of R, G and B over covered pixels".
std::string judged_in_words(JudgedPsnr judged);

/// Whether pairs hold a threshold of dB. A pair with pixels that are not finite in one picture
/// alone does not.
struct Verdict {
  std::size_t n_below = 0;
  std::string words;  ///< "PSNR of luminance: 2 of 3 pairs below 37 dB; the least is 31.250, b.png"
};
Verdict judge(const std::vector<NamedDistance>& pairs, JudgedPsnr judged, double least_db);

/// {"psnr_db", "psnr_rgb_db", "psnr_covered_db", "psnr_rgb_covered_db", "ssim", "snr_db", "rms",
/// "max_abs", "peak", "compared_as", "covered_px", "alpha_differs_px", "not_finite_px", "width_px",
/// "height_px"}; "ssim" is null when it was not measured.
Json report_pair(const ImageDistance& distance);

/// {"pairs": [report_pair with "name"], "summary": {KEY: {"mean", "min", "max"}}}, with the
/// decibels of the mean squared error beside the mean of the decibels, "of_mean_square".
Json report_pairs(const std::vector<NamedDistance>& pairs);

/// The same for people: a line a pair, then mean, min and max of several; aligned columns.
std::string format_table(const std::vector<NamedDistance>& pairs);

}  // namespace viewcell
