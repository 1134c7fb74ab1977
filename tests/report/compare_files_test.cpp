#include "report/compare_files.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "base/file.h"
#include "common/temporary_folder.h"
#include "image/io.h"
#include "image/random_image.h"

namespace viewcell {
namespace {

namespace fs = std::filesystem;

ImageRgba8 gray(std::uint8_t value, std::uint8_t alpha = 255) {
  return {12, 12, {value, value, value, alpha}};
}

// a/ and b/: pictures 0 to n - 1; those of b are brighter by their number.
void write_folders(const TemporaryFolder& folder, int n) {
  fs::create_directory(folder / "a");
  fs::create_directory(folder / "b");
  for (int i = 0; i < n; ++i) {
    const std::string name = "frame" + std::to_string(i) + ".png";
    write_png(folder / ("a/" + name), gray(100));
    write_png(folder / ("b/" + name), gray(static_cast<std::uint8_t>(100 + i)));
  }
}

std::string error_of_comparing(const fs::path& a, const fs::path& b) {
  try {
    compare_folders(a, b);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CompareFiles, PairWithDifferencePicture) {
  const TemporaryFolder folder;
  write_png(folder / "a.png", gray(100));
  write_png(folder / "b.png", gray(103));
  const ImageDistance d =
      compare_files(folder / "a.png", folder / "b.png", {{}, folder / "d.png", 10, {}}).distance;
  EXPECT_DOUBLE_EQ(d.mse, 9);
  EXPECT_EQ(read_image_rgba8(folder / "d.png").pixels[0], (Rgba8{30, 30, 30, 255}));
}

TEST(CompareFiles, SizesMustAgree) {
  const TemporaryFolder folder;
  write_png(folder / "a.png", ImageRgba8(3, 2));
  write_png(folder / "b.png", ImageRgba8(2, 3));
  try {
    compare_files(folder / "a.png", folder / "b.png");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), (folder / "b.png").string() + ": is 2 x 3 pixels, but " +
                                (folder / "a.png").string() + " is 3 x 2");
  }
}

TEST(CompareFolders, PairsByNameInOrderWhateverTheThreads) {
  const TemporaryFolder folder;
  write_folders(folder, 12);
  write_file(folder / "a/notes.txt", "not a picture");
  write_file(folder / "b/.hidden.png", "nor this");
  std::string first;
  for (const int n_threads : {1, 2, 8}) {
    const auto pairs = compare_folders(folder / "a", folder / "b", {}, n_threads);
    ASSERT_EQ(pairs.size(), 12u);
    EXPECT_EQ(pairs[2].name, "frame10.png");
    EXPECT_DOUBLE_EQ(pairs[2].distance.mse, 100);
    const std::string report = format_json(report_pairs(pairs));
    if (first.empty()) first = report;
    EXPECT_EQ(report, first);
  }
}

TEST(CompareFolders, AMissingPartnerIsAnErrorEitherWay) {
  const TemporaryFolder folder;
  write_folders(folder, 2);
  write_png(folder / "b/more.png", gray(1));
  EXPECT_EQ(
      error_of_comparing(folder / "a", folder / "b"),
      (folder / "a").string() + ": has no 'more.png', which '" + (folder / "b").string() + "' has");
  EXPECT_EQ(
      error_of_comparing(folder / "b", folder / "a"),
      (folder / "a").string() + ": has no 'more.png', which '" + (folder / "b").string() + "' has");
  fs::create_directory(folder / "empty");
  EXPECT_NE(error_of_comparing(folder / "empty", folder / "a").find("has no pictures"),
            std::string::npos);
  EXPECT_NE(error_of_comparing(folder / "none", folder / "a").find("cannot list"),
            std::string::npos);
}

TEST(CompareFolders, DifferencePicturesOfEveryPair) {
  const TemporaryFolder folder;
  write_folders(folder, 3);
  compare_folders(folder / "a", folder / "b", {{}, folder / "d", 4, {}}, 2);
  EXPECT_EQ(read_image_rgba8(folder / "d/frame0.png").pixels[0], (Rgba8{0, 0, 0, 255}));
  EXPECT_EQ(read_image_rgba8(folder / "d/frame2.png").pixels[0], (Rgba8{8, 8, 8, 255}));
}

TEST(CompareReport, KeysAreTheContracts) {
  const Json pair = report_pair(compare_images(gray(100), gray(101)));
  std::vector<std::string> keys;
  for (const auto& [key, value] : pair.items()) keys.push_back(key);
  EXPECT_EQ(keys, (std::vector<std::string>{
                      "psnr_db", "psnr_rgb_db", "psnr_covered_db", "psnr_rgb_covered_db", "ssim",
                      "snr_db", "rms", "max_abs", "peak", "compared_as", "covered_px",
                      "alpha_differs_px", "not_finite_px", "width_px", "height_px"}));
  EXPECT_NEAR(pair["psnr_db"].get<double>(), 48.1308, 1e-4);
  EXPECT_TRUE(report_pair(compare_images(gray(1), gray(2), {.ssim = false}))["ssim"].is_null() ||
              format_json(report_pair(compare_images(gray(1), gray(2), {.ssim = false})))
                      .find("\"ssim\": null") != std::string::npos);
}

TEST(CompareReport, SummaryHasTheMeanOfDecibelsAndTheDecibelsOfTheMean) {
  const std::vector<NamedDistance> pairs = {
      {"a", compare_images(gray(100), gray(101)), {}, {}},
      {"b", compare_images(gray(100), gray(103)), {}, {}},
      {"c", compare_images(gray(100, 0), gray(150, 0)), {}, {}}};  // nothing covered
  const Json report = report_pairs(pairs);
  ASSERT_EQ(report["pairs"].size(), 3u);
  EXPECT_EQ(report["pairs"][1]["name"], "b");
  const Json& psnr = report["summary"]["psnr_db"];
  double sum = 0, least = 1e9;
  for (const NamedDistance& pair : pairs) {
    sum += pair.distance.psnr_db;
    least = std::min(least, pair.distance.psnr_db);
  }
  EXPECT_NEAR(psnr["mean"].get<double>(), sum / 3, 1e-9);
  EXPECT_NEAR(psnr["min"].get<double>(), least, 1e-9);
  EXPECT_NEAR(psnr["of_mean_square"].get<double>(), psnr_db_of((1 + 9 + 2500) / 3.0), 1e-9);
  const Json& covered = report["summary"]["psnr_covered_db"];
  EXPECT_NEAR(covered["of_mean_square"].get<double>(), psnr_db_of(5), 1e-9);
  EXPECT_EQ(covered["max"].get<double>(), 100);
}

TEST(CompareReport, VerdictSaysWhatItJudges) {
  const ImageDistance near_in_luminance =
      compare_images({8, 8, {200, 0, 0, 255}}, {8, 8, {0, 102, 0, 255}});
  std::vector<NamedDistance> pairs = {{"a", near_in_luminance, {}, {}},
                                      {"b", compare_images(gray(7), gray(7)), {}, {}}};
  Verdict verdict = judge(pairs, JudgedPsnr::luminance, 37.5);
  EXPECT_EQ(verdict.n_below, 0u);
  verdict = judge(pairs, JudgedPsnr::rgb, 37.5);
  EXPECT_EQ(verdict.n_below, 1u);
  EXPECT_TRUE(
      verdict.words.starts_with("PSNR of R, G and B: 1 of 2 pairs below 37.5 dB; the least"))
      << verdict.words;
  EXPECT_TRUE(verdict.words.ends_with(", a")) << verdict.words;
  // A picture with holes passes no threshold.
  pairs[1].distance.n_not_finite = pairs[1].distance.n_not_finite_in_one = 1;
  EXPECT_EQ(judge(pairs, JudgedPsnr::luminance, 0).n_below, 1u);
  EXPECT_EQ(judge(pairs, JudgedPsnr::luminance, 0).words.find("a with"), std::string::npos);
}

TEST(CompareFiles, DepthsThatDifferAreSaid) {
  const TemporaryFolder folder;
  write_png(folder / "a.png", gray(100));
  write_file(folder / "b.pfm", "PF\n12 12\n-1.0\n" + std::string(12 * 12 * 12, '\0'));
  const NamedDistance pair = compare_files(folder / "a.png", folder / "b.pfm");
  EXPECT_EQ(pair.distance.compared_as, ComparedAs::unit);
  EXPECT_NEAR(pair.distance.rms, 100 / 255.0, 1e-9);
  ASSERT_EQ(pair.of_tested.size(), 1u);
  EXPECT_TRUE(pair.of_tested[0].what.starts_with("linear beside a reference of 8 bits"));
}

TEST(CompareReport, TableIsAligned) {
  const std::vector<NamedDistance> pairs = {
      {"a.png", compare_images(gray(100), gray(101)), {}, {}},
      {"longer name.png", compare_images(gray(7), gray(7)), {}, {}}};
  const std::string table = format_table(pairs);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 6);  // heading, 2, mean, min, max
  const std::size_t width = table.find('\n');
  for (std::size_t i = 0; i + 1 < table.size(); i += width + 1) EXPECT_EQ(table[i + width], '\n');
  EXPECT_EQ(format_table({pairs[0]}).find("mean"), std::string::npos);
}

}  // namespace
}  // namespace viewcell
