#include "report/compare_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <set>

#include "base/error.h"
#include "base/file.h"
#include "image/io.h"
#include "report/table.h"

namespace viewcell {
namespace fs = std::filesystem;
namespace {

struct Measure {
  const char* key;
  const char* heading;
  double ImageDistance::*value;
  int decimals;
};

constexpr std::array<Measure, 6> kMeasures = {{
    {"psnr_db", "PSNR dB", &ImageDistance::psnr_db, 3},
    {"psnr_covered_db", "covered dB", &ImageDistance::psnr_covered_db, 3},
    {"ssim", "SSIM", &ImageDistance::ssim, 6},
    {"snr_db", "SNR dB", &ImageDistance::snr_db, 3},
    {"rms", "RMS", &ImageDistance::rms, 4},
    {"max_abs", "max", &ImageDistance::max_abs, 0},
}};

struct Spread {
  double mean = 0, min = 0, max = 0;
};

Spread spread_of(const std::vector<NamedDistance>& pairs, double ImageDistance::*value) {
  Spread s{0, pairs.front().distance.*value, pairs.front().distance.*value};
  for (const NamedDistance& pair : pairs) {
    const double x = pair.distance.*value;
    s.mean += x;
    s.min = std::min(s.min, x);
    s.max = std::max(s.max, x);
  }
  s.mean /= static_cast<double>(pairs.size());
  return s;
}

// --- folders ---

bool is_picture_name(const fs::path& path) {
  static const std::set<std::string> extensions = {".png", ".jpg",  ".jpeg", ".exr",
                                                   ".tif", ".tiff", ".webp"};
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extensions.contains(extension) && path.filename().string()[0] != '.';
}

std::set<std::string> picture_names(const fs::path& folder) {
  std::error_code error;
  std::set<std::string> names;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (is_picture_name(it->path()) && !it->is_directory())
      names.insert(it->path().filename().string());
  if (error) throw InputError(folder.string(), "", "cannot list: " + error.message());
  if (names.empty()) throw InputError(folder.string(), "", "has no pictures");
  return names;
}

void check_partners(const std::set<std::string>& names, const fs::path& folder,
                    const std::set<std::string>& partners, const fs::path& partner_folder) {
  for (const std::string& name : names)
    if (!partners.contains(name))
      throw InputError(partner_folder.string(), "",
                       "has no '" + name + "', which '" + folder.string() + "' has");
}

std::string format_decimals(double x, int n_decimals) {
  return format_fixed(x, n_decimals, "-");
}

}  // namespace

ImageDistance compare_files(const fs::path& reference, const fs::path& tested,
                            const CompareFilesOptions& options) {
  const ImageRgba8 a = read_image_rgba8(reference), b = read_image_rgba8(tested);
  const auto size = [](const ImageRgba8& image) {
    return std::to_string(image.width_px) + " x " + std::to_string(image.height_px);
  };
  if (a.width_px != b.width_px || a.height_px != b.height_px)
    throw InputError(tested.string(), "",
                     "is " + size(b) + " pixels, but " + reference.string() + " is " + size(a));
  const ImageDistance distance = compare_images(a, b, options.measures);
  if (!options.difference.empty())
    write_png(options.difference, difference_image(a, b, options.difference_gain));
  return distance;
}

std::vector<NamedDistance> compare_folders(const fs::path& reference, const fs::path& tested,
                                           const CompareFilesOptions& options, int n_threads,
                                           const Progress& progress) {
  const std::set<std::string> names = picture_names(reference);
  const std::set<std::string> tested_names = picture_names(tested);
  check_partners(names, reference, tested_names, tested);
  check_partners(tested_names, tested, names, reference);
  if (!options.difference.empty()) make_folder(options.difference);
  std::vector<NamedDistance> pairs;
  for (const std::string& name : names) pairs.push_back({name, {}});
  const auto compare = [&](std::size_t i) {
    CompareFilesOptions own = options;
    if (!options.difference.empty())
      own.difference = options.difference / fs::path(pairs[i].name).replace_extension(".png");
    pairs[i].distance = compare_files(reference / pairs[i].name, tested / pairs[i].name, own);
  };
  parallel_for(pairs.size(), n_threads, compare, progress);
  return pairs;
}

Json report_pair(const ImageDistance& distance) {
  Json json;
  for (const Measure& m : kMeasures) json[m.key] = distance.*m.value;
  json["width_px"] = distance.width_px;
  json["height_px"] = distance.height_px;
  return json;
}

Json report_pairs(const std::vector<NamedDistance>& pairs) {
  Json list = Json::array(), summary = Json::object();
  double mse = 0, squared_covered = 0, n_covered = 0;
  for (const NamedDistance& pair : pairs) {
    Json json{{"name", pair.name}};
    json.update(report_pair(pair.distance));
    list.push_back(json);
    const auto covered = static_cast<double>(pair.distance.n_covered);
    mse += pair.distance.mse / static_cast<double>(pairs.size());
    squared_covered += pair.distance.mse_covered * covered;
    n_covered += covered;
  }
  for (const Measure& m : kMeasures) {
    const Spread s = spread_of(pairs, m.value);
    summary[m.key] = {{"mean", s.mean}, {"min", s.min}, {"max", s.max}};
  }
  summary["psnr_db"]["of_mean_square"] = psnr_db_of(mse);
  summary["psnr_covered_db"]["of_mean_square"] =
      psnr_db_of(n_covered > 0 ? squared_covered / n_covered : 0);
  return {{"pairs", list}, {"summary", summary}};
}

std::string format_table(const std::vector<NamedDistance>& pairs) {
  std::vector<std::vector<std::string>> rows(1, {"picture"});
  for (const Measure& m : kMeasures) rows[0].push_back(m.heading);
  const auto add_row = [&](const std::string& name, const auto& value_of) {
    rows.push_back({name});
    for (const Measure& m : kMeasures)
      rows.back().push_back(format_decimals(value_of(m), m.decimals));
  };
  for (const NamedDistance& pair : pairs)
    add_row(pair.name, [&](const Measure& m) { return pair.distance.*m.value; });
  if (pairs.size() > 1) {
    add_row("mean", [&](const Measure& m) { return spread_of(pairs, m.value).mean; });
    add_row("min", [&](const Measure& m) { return spread_of(pairs, m.value).min; });
    add_row("max", [&](const Measure& m) { return spread_of(pairs, m.value).max; });
  }
  return format_table(rows);
}

}  // namespace viewcell
