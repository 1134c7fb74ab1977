#include "report/compare_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <set>

#include "base/error.h"
#include "base/file.h"
#include "image/deep_metrics.h"
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

constexpr std::array<Measure, 8> kMeasures = {{
    {"psnr_db", "PSNR dB", &ImageDistance::psnr_db, 3},
    {"psnr_rgb_db", "RGB dB", &ImageDistance::psnr_rgb_db, 3},
    {"psnr_covered_db", "covered dB", &ImageDistance::psnr_covered_db, 3},
    {"psnr_rgb_covered_db", "RGB covered", &ImageDistance::psnr_rgb_covered_db, 3},
    {"ssim", "SSIM", &ImageDistance::ssim, 6},
    {"snr_db", "SNR dB", &ImageDistance::snr_db, 3},
    {"rms", "RMS", &ImageDistance::rms, 4},
    {"max_abs", "max", &ImageDistance::max_abs, 0},
}};

// Of values in [0, 1] and of linear light.
constexpr int kUnitDecimals = 6;

int decimals_of(const Measure& measure, bool is_unit) {
  const bool in_units =
      measure.value == &ImageDistance::rms || measure.value == &ImageDistance::max_abs;
  return is_unit && in_units ? kUnitDecimals : measure.decimals;
}

const char* name_of(ComparedAs units) {
  switch (units) {
    case ComparedAs::codes8:
      return "8 bits";
    case ComparedAs::codes16:
      return "16 bits";
    case ComparedAs::linear:
      return "linear";
    case ComparedAs::unit:
      return "[0, 1]";
  }
  throw_bug(__FILE__, __LINE__, "unknown units", static_cast<int>(units));
}

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

// Squares in shares of full scale, over pairs that may have several.
struct MeanSquares {
  double luminance = 0, rgb = 0, covered = 0, rgb_covered = 0, n_covered = 0;
  void add(const ImageDistance& d) {
    const double scale = 1 / (d.peak * d.peak);
    const auto n = static_cast<double>(d.n_covered);
    luminance += scale * d.mse, rgb += scale * d.mse_rgb;
    covered += scale * d.mse_covered * n, rgb_covered += scale * d.mse_rgb_covered * n;
    n_covered += n;
  }
};

// --- folders ---

bool is_picture_name(const fs::path& path) {
  const std::vector<std::string>& endings = picture_endings();
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::find(endings.begin(), endings.end(), extension) != endings.end() &&
         path.filename().string()[0] != '.';
}

std::set<std::string> picture_names(const fs::path& folder) {
  std::error_code error;
  std::set<std::string> names;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (is_picture_name(it->path()) && !it->is_directory()) {
      refuse_special(it->path());
      names.insert(it->path().filename().string());
    }
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

std::string size_of(const DeepImage& image) {
  return std::to_string(image.width_px()) + " x " + std::to_string(image.height_px());
}

const char* name_of(SampleKind kind) {
  return kind == SampleKind::code8 ? "8 bits" : kind == SampleKind::code16 ? "16 bits" : "linear";
}

void remark_pair(const DeepImage& a, const DeepImage& b, NamedDistance& pair) {
  const ImageDistance& d = pair.distance;
  if (a.kind != b.kind) {
    const bool is_linear = a.kind == SampleKind::linear || b.kind == SampleKind::linear;
    add_remark(&pair.of_tested,
               std::string(name_of(b.kind)) + " beside a reference of " + name_of(a.kind) +
                   ": compared as reals in [0, 1]" +
                   (is_linear ? ", linear light encoded as sRGB and clamped" : ""));
  }
  add_remark(&pair.of_tested, "pixels that are not finite in one picture or both, left out",
             d.n_not_finite);
  add_remark(&pair.of_tested,
             "pixels whose alpha differs: no figure counts alpha, their colours count",
             d.n_alpha_differs);
}

struct JudgedRow {
  std::string name;
  const char* words;
  double ImageDistance::*value;
};

// In JudgedPsnr's order.
const std::array<JudgedRow, 4>& judged_rows() {
  static const std::array<JudgedRow, 4> rows{
      {{"luminance", "PSNR of luminance", &ImageDistance::psnr_db},
       {"rgb", "PSNR of R, G and B", &ImageDistance::psnr_rgb_db},
       {"covered", "PSNR of luminance over covered pixels", &ImageDistance::psnr_covered_db},
       {"rgb-covered", "PSNR of R, G and B over covered pixels",
        &ImageDistance::psnr_rgb_covered_db}}};
  return rows;
}

}  // namespace

NamedDistance compare_files(const fs::path& reference, const fs::path& tested,
                            const CompareFilesOptions& options) {
  NamedDistance pair{tested.string(), {}, {}, {}};
  const DeepImage a = read_deep_image(reference, {options.limits, &pair.of_reference});
  const DeepImage b = read_deep_image(tested, {options.limits, &pair.of_tested});
  if (size_of(a) != size_of(b))
    throw InputError(
        tested.string(), "",
        "is " + size_of(b) + " pixels, but " + reference.string() + " is " + size_of(a));
  pair.distance = compare_deep_images(a, b, options.measures);
  if (pair.distance.n_not_finite == a.samples.pixels.size() && pair.distance.n_not_finite > 0)
    throw InputError(tested.string(), "", "no pixel is finite in it and in " + reference.string());
  remark_pair(a, b, pair);
  if (!options.difference.empty())
    write_png(options.difference, difference_of_deep_images(a, b, options.difference_gain));
  return pair;
}

const std::vector<std::string>& judged_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> out;
    for (const JudgedRow& row : judged_rows()) out.push_back(row.name);
    return out;
  }();
  return names;
}

std::string judged_in_words(JudgedPsnr judged) {
  return judged_rows()[static_cast<std::size_t>(judged)].words;
}

Verdict judge(const std::vector<NamedDistance>& pairs, JudgedPsnr judged, double least_db) {
  const auto value = judged_rows()[static_cast<std::size_t>(judged)].value;
  Verdict verdict;
  const NamedDistance* least = &pairs.front();
  std::size_t n_broken = 0;
  for (const NamedDistance& pair : pairs) {
    const bool is_broken = pair.distance.n_not_finite_in_one > 0;
    n_broken += is_broken;
    verdict.n_below += is_broken || pair.distance.*value < least_db;
    if (pair.distance.*value < least->distance.*value) least = &pair;
  }
  char limit[40];
  std::snprintf(limit, sizeof limit, "%g", least_db);
  verdict.words = judged_in_words(judged) + ": " + std::to_string(verdict.n_below) + " of " +
                  std::to_string(pairs.size()) + (pairs.size() == 1 ? " pair" : " pairs") +
                  " below " + limit + " dB; the least is " +
                  format_fixed(least->distance.*value, 3, "-") +
                  (pairs.size() == 1 ? "" : ", " + least->name);
  if (n_broken > 0)
    verdict.words += "; counted as below: " + std::to_string(n_broken) +
                     " with pixels finite in one picture alone";
  return verdict;
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
  for (const std::string& name : names) pairs.push_back({name, {}, {}, {}});
  const auto compare = [&](std::size_t i) {
    CompareFilesOptions own = options;
    if (!options.difference.empty())
      own.difference = options.difference / fs::path(pairs[i].name).replace_extension(".png");
    const std::string name = pairs[i].name;
    pairs[i] = compare_files(reference / name, tested / name, own);
    pairs[i].name = name;
  };
  parallel_for(pairs.size(), n_threads, compare, progress);
  return pairs;
}

Json report_pair(const ImageDistance& distance) {
  Json json;
  for (const Measure& m : kMeasures) json[m.key] = distance.*m.value;
  json["peak"] = distance.peak;
  json["compared_as"] = name_of(distance.compared_as);
  json["covered_px"] = distance.n_covered;
  json["alpha_differs_px"] = distance.n_alpha_differs;
  json["not_finite_px"] = distance.n_not_finite;
  json["width_px"] = distance.width_px;
  json["height_px"] = distance.height_px;
  return json;
}

Json report_pairs(const std::vector<NamedDistance>& pairs) {
  Json list = Json::array(), summary = Json::object();
  MeanSquares all;
  for (const NamedDistance& pair : pairs) {
    Json json{{"name", pair.name}};
    json.update(report_pair(pair.distance));
    list.push_back(json);
    all.add(pair.distance);
  }
  for (const Measure& m : kMeasures) {
    const Spread s = spread_of(pairs, m.value);
    summary[m.key] = {{"mean", s.mean}, {"min", s.min}, {"max", s.max}};
  }
  const auto n = static_cast<double>(pairs.size());
  summary["psnr_db"]["of_mean_square"] = psnr_db_of(all.luminance / n, 1);
  summary["psnr_rgb_db"]["of_mean_square"] = psnr_db_of(all.rgb / n, 1);
  const double covered = std::max(1.0, all.n_covered);
  summary["psnr_covered_db"]["of_mean_square"] = psnr_db_of(all.covered / covered, 1);
  summary["psnr_rgb_covered_db"]["of_mean_square"] = psnr_db_of(all.rgb_covered / covered, 1);
  return {{"pairs", list}, {"summary", summary}};
}

std::string format_table(const std::vector<NamedDistance>& pairs) {
  std::vector<std::vector<std::string>> rows(1, {"picture"});
  for (const Measure& m : kMeasures) rows[0].push_back(m.heading);
  const bool is_unit = std::any_of(pairs.begin(), pairs.end(), [](const NamedDistance& pair) {
    return pair.distance.compared_as == ComparedAs::linear ||
           pair.distance.compared_as == ComparedAs::unit;
  });
  const auto add_row = [&](const std::string& name, const auto& value_of) {
    rows.push_back({name});
    for (const Measure& m : kMeasures)
      rows.back().push_back(format_decimals(value_of(m), decimals_of(m, is_unit)));
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
