#include "play/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.h"
#include "base/random.h"
#include "report/contact_sheet.h"
#include "report/font.h"
#include "report/label.h"

namespace viewcell {
namespace {

TEST(Summary, ByHand) {
  const std::vector<double> values{4, 1, 3, 2, 5};
  const Summary s = summarize(values);
  EXPECT_DOUBLE_EQ(s.mean, 3);
  EXPECT_DOUBLE_EQ(s.median, 3);
  EXPECT_DOUBLE_EQ(s.min, 1);
  EXPECT_DOUBLE_EQ(s.max, 5);
  EXPECT_DOUBLE_EQ(s.p5, 1.2);  // 0.2 of the way from the first to the second
  EXPECT_DOUBLE_EQ(s.p95, 4.8);
  EXPECT_DOUBLE_EQ(s.p99, 4.96);
}

TEST(Summary, OneValueIsEveryNumber) {
  const std::vector<double> one{7};
  const Summary s = summarize(one);
  for (const double x : {s.mean, s.median, s.min, s.max, s.p5, s.p95, s.p99}) EXPECT_EQ(x, 7);
}

TEST(Summary, NoValuesAreNaN) {
  EXPECT_TRUE(std::isnan(summarize({}).mean));
}

TEST(Summary, IsOrderedAndIgnoresOrder) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    std::vector<double> values(1 + random.below(200));
    for (double& x : values) x = random.uniform(-5, 50);
    const Summary s = summarize(values);
    EXPECT_LE(s.min, s.p5);
    EXPECT_LE(s.p5, s.median);
    EXPECT_LE(s.median, s.p95);
    EXPECT_LE(s.p95, s.p99);
    EXPECT_LE(s.p99, s.max);
    std::sort(values.begin(), values.end());
    EXPECT_EQ(summarize(values).p95, s.p95);
  }
}

PictureQuality quality(double db, double covered_db, std::size_t n_covered, std::size_t missing) {
  const auto mse = [](double x) { return x >= 100 ? 0 : 255 * 255 * std::pow(10, -x / 10); };
  return {db, covered_db, mse(db), mse(covered_db), n_covered, missing};
}

// Three frames: the second without objects, the third identical in hybrid.
Timeline make_timeline() {
  Timeline t;
  t.width_px = 100, t.height_px = 50;
  t.renderer = "llvmpipe \"x\"";
  t.gl_threads = 2, t.n_threads = 2;
  t.reference = Mode::frustum;
  t.frames = {{0, 3, 0.25, quality(30, 20, 1000, 5)},
              {0.5, 3, 0, quality(100, 100, 0, 0)},
              {1, 4, 0.5, quality(40, 30, 3000, 5)}};
  t.modes = {{Mode::frustum,
              {{10, 1000, 7, 0, quality(100, 100, 1000, 0)},
               {20, 2000, 8, 0, quality(100, 100, 0, 0)},
               {30, 3000, 9, 0, quality(100, 100, 3000, 0)}}},
             {Mode::hybrid,
              {{1, 100, 3, 50, quality(40, 30, 1000, 9)},
               {2, 200, 4, 60, quality(100, 100, 0, 0)},
               {3, 300, 5, 70, quality(100, 100, 3000, 0)}}},
             {Mode::raycast, {{4, 0, 0, 0, {}}, {5, 0, 0, 0, {}}, {6, 0, 0, 0, {}}}}};
  return t;
}

TEST(Statistics, FollowTheContract) {
  const Json json = make_statistics(make_timeline());
  EXPECT_EQ(json["frames"], 3);
  EXPECT_EQ(json["width_px"], 100);
  EXPECT_EQ(json["height_px"], 50);
  EXPECT_EQ(json["renderer"], "llvmpipe \"x\"");
  EXPECT_EQ(json["gl_threads"], 2);
  EXPECT_DOUBLE_EQ(json["coverage_mean"], 0.25);
  const Json& hybrid = json["modes"]["hybrid"];
  EXPECT_DOUBLE_EQ(hybrid["triangles_mean"], 200);
  EXPECT_DOUBLE_EQ(hybrid["draws_mean"], 4);
  EXPECT_DOUBLE_EQ(hybrid["texture_bytes_mean"], 60);
  EXPECT_DOUBLE_EQ(hybrid["missing_px_mean"], 3);
  EXPECT_DOUBLE_EQ(hybrid["frame_ms"]["mean"], 2);
  EXPECT_DOUBLE_EQ(hybrid["frame_ms"]["max"], 3);
  EXPECT_DOUBLE_EQ(hybrid["psnr_db"]["mean"], 80);
  EXPECT_DOUBLE_EQ(hybrid["psnr_db"]["min"], 40);
  // The empty frame says nothing of covered pixels.
  EXPECT_DOUBLE_EQ(hybrid["psnr_covered_db"]["mean"], 65);
  EXPECT_DOUBLE_EQ(json["yardstick"]["psnr_covered_db"]["mean"], 25);
  EXPECT_DOUBLE_EQ(json["speedup"]["hybrid_over_frustum"], 10);
  EXPECT_DOUBLE_EQ(json["speedup"]["hybrid_over_raycast"], 2.5);
  EXPECT_FALSE(json["speedup"].contains("hybrid_over_hybrid"));
  EXPECT_EQ(json["per_frame"].size(), 3u);
  EXPECT_EQ(json["per_frame"][2]["cell"], 4);
  EXPECT_EQ(json["per_frame"][2]["modes"]["hybrid"]["triangles"], 300);
}

TEST(Statistics, DbOfTheMeanErrorWeighsPixels) {
  const Json json = make_statistics(make_timeline());
  // Frame: 40 dB in one of three, else nothing. Covered: 30 dB over 1000 of 4000 pixels.
  EXPECT_NEAR(json["modes"]["hybrid"]["psnr_db"]["of_mse"], 40 + 10 * std::log10(3), 1e-9);
  EXPECT_NEAR(json["modes"]["hybrid"]["psnr_covered_db"]["of_mse"], 30 + 10 * std::log10(4), 1e-9);
}

TEST(Statistics, WhatWasNotMeasuredIsNull) {
  const Json json = make_statistics(make_timeline());
  EXPECT_TRUE(json["modes"]["raycast"]["psnr_db"]["mean"].is_null());
  EXPECT_TRUE(json["per_frame"][0]["modes"]["raycast"]["psnr_db"].is_null());
  EXPECT_DOUBLE_EQ(json["modes"]["raycast"]["rays_per_s"], 1e6);  // 5000 in 5 ms
}

TEST(Statistics, ModesMustHaveEveryFrame) {
  Timeline timeline = make_timeline();
  timeline.modes[1].frames.pop_back();
  EXPECT_THROW(make_statistics(timeline), BugError);
}

TEST(Statistics, TableHasALineAMode) {
  const std::string table = format_mode_table(make_timeline());
  EXPECT_NE(table.find("hybrid"), std::string::npos);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 5);
  Timeline timeline = make_timeline();
  timeline.floor_ms = {1, 2, 6};
  const std::string with_floor = format_mode_table(timeline);
  EXPECT_NE(with_floor.find("floor"), std::string::npos);
  EXPECT_LT(with_floor.find("3.00"), with_floor.find("2.00", with_floor.find("floor")));
  EXPECT_DOUBLE_EQ(make_statistics(timeline)["floor_ms"]["median"], 2);
}

TEST(Statistics, MarkdownHasTheSameCells) {
  Timeline timeline = make_timeline();
  timeline.floor_ms = {1, 2, 6};
  const std::string text = format_markdown(timeline);
  EXPECT_NE(text.find("| mode | mean ms |"), std::string::npos);
  EXPECT_NE(text.find("| floor | 3.00 | 2.00 |"), std::string::npos);
  EXPECT_NE(text.find("raycast: 1.0 million rays a second."), std::string::npos);
  EXPECT_NE(text.find("Speedup: hybrid_over_"), std::string::npos);
  // Every line of the table has as many cells as its first.
  std::size_t at = text.find("| mode"), n_first = 0, n_lines = 0;
  while (text[at] == '|') {
    const std::size_t end = text.find('\n', at);
    const auto n = static_cast<std::size_t>(std::count(&text[at], &text[end], '|'));
    if (n_lines++ == 0) n_first = n;
    EXPECT_EQ(n, n_first);
    at = end + 1;
  }
  EXPECT_EQ(n_lines, 2 + timeline.modes.size() + 1);
}

TEST(Quality, LuminanceDeviatesOverObjectsOnly) {
  ImageRgba8 picture(3, 1, {255, 255, 255, 0});
  EXPECT_TRUE(std::isnan(measure_luminance_deviation(picture)));
  picture.at(0, 0) = {10, 10, 10, 255};
  EXPECT_NEAR(measure_luminance_deviation(picture), 0, 1e-6);
  picture.at(1, 0) = {50, 50, 50, 254};
  EXPECT_NEAR(measure_luminance_deviation(picture), 20, 1e-6);
}

TEST(Quality, CountsMissingAndCoveredPixels) {
  ImageRgba8 reference(4, 1, {9, 9, 9, 0}), tested = reference;
  reference.at(0, 0) = {50, 50, 50, 255};
  reference.at(1, 0) = {50, 50, 50, 255};
  tested.at(1, 0) = {50, 50, 50, 254};
  tested.at(2, 0) = {80, 80, 80, 255};
  const PictureQuality q = measure_quality(reference, tested);
  EXPECT_EQ(q.missing_px, 1u);
  EXPECT_EQ(q.n_covered_px, 3u);
  EXPECT_NEAR(q.mse, (41.0 * 41 + 71.0 * 71) / 4, 1e-9);
  EXPECT_NEAR(q.mse_covered, (41.0 * 41 + 71.0 * 71) / 3, 1e-9);
  EXPECT_DOUBLE_EQ(measure_coverage(reference), 0.5);
}

// 'I' is a bar with feet: columns 1 and 3 have dots at top and bottom only.
TEST(Label, DrawsDotsAndCutsAtTheEdge) {
  ImageRgba8 image(12, 8, {0, 0, 0, 255});
  const Rgba8 white{255, 255, 255, 255};
  draw_label(image, 0, 0, "I", white);
  for (int y = 0; y < 7; ++y) EXPECT_EQ(image.at(2, y), white) << y;
  EXPECT_EQ(image.at(1, 0), white);
  EXPECT_EQ(image.at(1, 6), white);
  EXPECT_NE(image.at(1, 3), white);
  EXPECT_NE(image.at(0, 0), white);
  EXPECT_NO_THROW(draw_label(image, -3, -3, "clipped \xff\n", white, 3));
  EXPECT_EQ(label_width("abc", 2), 36);
}

std::size_t count_ink(const ImageRgba8& image) {
  return static_cast<std::size_t>(std::count_if(image.pixels.begin(), image.pixels.end(),
                                                [](const Rgba8& p) { return p[0] > 60; }));
}

// Letters count, not bytes; accents that follow their letters take no room; bytes that are no UTF-8
// and letters without a font show all the same.
TEST(Label, LettersBeyondAscii) {
  const std::string composed = "\u00e9", decomposed = "e\u0301";
  EXPECT_EQ(label_width("Gr\u00f6\u00dfe"), 5 * kGlyphWidth);
  EXPECT_EQ(label_width(composed), kGlyphWidth);
  EXPECT_EQ(label_width(decomposed), kGlyphWidth);
  EXPECT_EQ(label_width("\ufeffa\u200d"), kGlyphWidth);
  EXPECT_EQ(label_width("\xff\xc3"), 2 * kGlyphWidth);
  EXPECT_EQ(label_width("\U0001f600"), kGlyphWidth);
  const auto ink = [](const std::string& text, Remarks* remarks = nullptr) {
    ImageRgba8 image(60, 40, {0, 0, 0, 255});
    draw_label(image, 4, 8, text, {255, 255, 255, 255}, 2, remarks);
    return count_ink(image);
  };
  for (const std::string& text : {composed, decomposed, std::string("\u03c0"), std::string("\xff"),
                                  std::string("\u0416"), std::string("\U0001f600")}) {
    SCOPED_TRACE(text);
    EXPECT_GT(ink(text), 20u);
  }
  EXPECT_EQ(ink("\xff"), ink("?"));
  Remarks remarks;
  EXPECT_EQ(ink("\u5c71\u5c71", &remarks),
            2 * 20u * 4);  // boxes of 5 x 7 dots, in DejaVu or without
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_EQ(remarks[0].count, 2u);
  if (!has_font()) return;
  remarks.clear();
  EXPECT_GT(ink(composed, &remarks), ink("e") / 2);
  EXPECT_GT(ink(decomposed), ink("e"));
  EXPECT_TRUE(remarks.empty());
}

TEST(ContactSheet, TheKeyStandsBelowAll) {
  const Rgba8 red{200, 0, 0, 255}, blue{0, 0, 200, 255};
  const std::vector<SheetRow> rows{{"", {ImageRgba8(20, 10)}, {}}};
  const ImageRgba8 bare = make_contact_sheet({""}, rows, {20});
  SheetOptions options{.tile_px = 20, .key = {{red, "near"}, {blue, "far"}}};
  const ImageRgba8 sheet = make_contact_sheet({""}, rows, options);
  ASSERT_GT(sheet.height_px, bare.height_px + 2 * 16);  // the sheet is narrow: two lines
  std::size_t n_red = 0, n_blue = 0;
  for (int y = 0; y < sheet.height_px; ++y)
    for (int x = 0; x < sheet.width_px; ++x) {
      n_red += sheet.at(x, y) == red, n_blue += sheet.at(x, y) == blue;
      if (sheet.at(x, y) == red) {
        EXPECT_GE(y, bare.height_px - 8);
      }
    }
  EXPECT_EQ(n_red, 256u);
  EXPECT_EQ(n_blue, 256u);
}

TEST(ContactSheet, ShrinkingKeepsTheMean) {
  ImageRgba8 image(10, 6);
  Random random(3);
  double sum = 0;
  for (Rgba8& p : image.pixels) sum += p[0] = static_cast<std::uint8_t>(random.below(256));
  const ImageRgba8 half = shrink_to_width(image, 5);
  ASSERT_EQ(half.width_px, 5);
  ASSERT_EQ(half.height_px, 3);
  EXPECT_EQ(
      half.at(1, 2)[0],
      (image.at(2, 4)[0] + image.at(3, 4)[0] + image.at(2, 5)[0] + image.at(3, 5)[0] + 2) / 4);
  double shrunk = 0;
  const ImageRgba8 odd = shrink_to_width(image, 7);
  for (const Rgba8& p : odd.pixels) shrunk += p[0];
  EXPECT_NEAR(shrunk / odd.pixels.size(), sum / image.pixels.size(), 1);
  EXPECT_EQ(shrink_to_width(image, 99).pixels, image.pixels);
}

TEST(ContactSheet, PutsPicturesInTheirColumns) {
  const Rgba8 red{200, 0, 0, 0}, blue{0, 0, 200, 255};
  const std::vector<SheetRow> rows{
      {"first", {ImageRgba8(20, 10, red), ImageRgba8(20, 10, blue)}, {"1"}},
      {"second", {{}, ImageRgba8(20, 10, blue)}, {}}};
  const ImageRgba8 sheet = make_contact_sheet({"a", "b"}, rows, {20});
  EXPECT_EQ(sheet.width_px, 8 + 2 * 28);
  std::size_t n_red = 0, n_blue = 0;
  for (int y = 0; y < sheet.height_px; ++y)
    for (int x = 0; x < sheet.width_px; ++x) {
      const Rgba8& p = sheet.at(x, y);
      EXPECT_EQ(p[3], 255);
      const bool is_red = p[0] == 200 && p[1] == 0, is_blue = p[2] == 200 && p[1] == 0;
      n_red += is_red, n_blue += is_blue;
      EXPECT_FALSE(is_red && x >= 28);
      EXPECT_FALSE(is_blue && x < 36);
    }
  EXPECT_EQ(n_red, 200u);
  EXPECT_EQ(n_blue, 400u);
}

// One pixel at (30, 20) in one picture, one at (50, 41) in the other: 21 x 22 and a margin around.
TEST(ContactSheet, TrimsAllToOneRectangle) {
  const Rgba8 nothing{9, 9, 9, 0}, red{200, 0, 0, 255};
  std::vector<ImageRgba8> pictures{ImageRgba8(100, 60, nothing), {}, ImageRgba8(100, 60, nothing)};
  trim_alike(pictures);
  EXPECT_EQ(pictures[0].width_px, 100);  // nothing to keep
  pictures[0].at(30, 20) = red;
  pictures[2].at(50, 41) = red;
  trim_alike(pictures);
  EXPECT_TRUE(pictures[1].empty());
  for (const std::size_t i : {0, 2}) {
    ASSERT_EQ(pictures[i].width_px, 21 + 8);
    ASSERT_EQ(pictures[i].height_px, 22 + 8);
  }
  EXPECT_EQ(pictures[0].at(4, 4), red);
  EXPECT_EQ(pictures[2].at(24, 25), red);
  pictures[0].at(0, 0) = red;
  trim_alike(pictures);
  EXPECT_EQ(pictures[0].at(0, 0), red);  // no margin beyond the picture
  EXPECT_EQ(pictures[0].width_px, 29);
}

TEST(ContactSheet, PaperShowsWhereNothingIs) {
  ImageRgba8 picture(2, 1, {9, 9, 9, 0});
  picture.at(1, 0) = {9, 9, 9, 1};
  lay_on_paper(picture);
  EXPECT_EQ(picture.at(0, 0)[3], 255);
  EXPECT_GT(picture.at(0, 0)[0], 200);
  EXPECT_EQ(picture.at(1, 0), (Rgba8{9, 9, 9, 1}));
}

TEST(ContactSheet, RoundingKeepsSoManyLevels) {
  for (int n_bits = 1; n_bits <= 8; ++n_bits) {
    ImageRgba8 image(256, 1);
    for (int x = 0; x < 256; ++x) image.at(x, 0).fill(static_cast<std::uint8_t>(x));
    round_channels(image, n_bits);
    std::set<int> levels;
    for (int x = 0; x < 256; ++x) {
      levels.insert(image.at(x, 0)[1]);
      EXPECT_NEAR(image.at(x, 0)[1], x, 127.5 / ((1 << n_bits) - 1) + 1);
      EXPECT_EQ(image.at(x, 0)[3], x);
    }
    EXPECT_EQ(levels.size(), std::size_t{1} << n_bits);
    EXPECT_TRUE(levels.contains(0) && levels.contains(255));
  }
}

TEST(ContactSheet, WordsFindRoom) {
  const auto width = [](const std::string& title, const std::string& note) {
    const std::vector<SheetRow> rows{{"", {ImageRgba8(30, 10), ImageRgba8(30, 10)}, {"", note}}};
    return make_contact_sheet({title, ""}, rows, {30}).width_px;
  };
  EXPECT_EQ(width("", ""), 8 + 2 * 38);
  EXPECT_EQ(width("", "a note"), 8 + 2 * (label_width("a note", 2) + 8));
  EXPECT_EQ(width("a title above all", ""), 8 + label_width("a title above all", 2) + 8);
}

TEST(ContactSheet, RowsWithoutLabelsTakeNoLineForThem) {
  std::vector<SheetRow> rows{{"", {ImageRgba8(20, 10)}, {}}, {"", {ImageRgba8(20, 10)}, {}}};
  const int bare = make_contact_sheet({""}, rows, {20}).height_px;
  rows[1].label = "second";
  EXPECT_GT(make_contact_sheet({""}, rows, {20}).height_px, bare + 20);
}

TEST(ContactSheet, PicturesOfTwoSizesAreABug) {
  const std::vector<SheetRow> rows{{"row", {ImageRgba8(20, 10), ImageRgba8(20, 11)}, {}}};
  EXPECT_THROW(make_contact_sheet({"a", "b"}, rows), BugError);
}

}  // namespace
}  // namespace viewcell
