#include "report/csv.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/random.h"
#include "report/plot_csv.h"

namespace viewcell {
namespace {

// What the error of reading `text` says.
std::string fault(const std::string& text) {
  try {
    parse_csv(text, "f.csv");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Csv, RowsQuotesAndEnds) {
  const CsvTable table = parse_csv(
      "\xef\xbb\xbf"
      "a,b\r\n\n1,\"x, \"\"y\"\"\nz\"\n,last",
      "f.csv");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"a", "b"}));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0], (std::vector<std::string>{"1", "x, \"y\"\nz"}));
  EXPECT_EQ(table.rows[1], (std::vector<std::string>{"", "last"}));
  EXPECT_EQ(table.lines, (std::vector<std::size_t>{3, 5}));
}

TEST(Csv, FaultsNameTheLine) {
  EXPECT_EQ(fault(""), "f.csv: has no header");
  EXPECT_EQ(fault("a,b\n1,2\n1\n"), "f.csv: line 3: has 1 fields, the header has 2");
  EXPECT_EQ(fault("a,b\n1,\"2\n\n"), "f.csv: line 2: a quote does not end");
  EXPECT_EQ(fault("a,b\n1,\"2\"3\n"), "f.csv: line 2: a field goes on after its quote");
  EXPECT_EQ(fault("a,b,a\n"), "f.csv: header: column 'a' stands twice");
}

// What is written with quotes comes back.
TEST(Csv, QuotedFieldsComeBack) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    std::string text = "a,b,c\n";
    std::vector<std::vector<std::string>> rows(1 + random.below(5), std::vector<std::string>(3));
    for (auto& row : rows)
      for (std::size_t k = 0; k < 3; ++k) {
        text += k == 0 ? "\"" : ",\"";
        for (std::size_t n = random.below(6); n > 0; --n) {
          const char c = "x\",\n\r "[random.below(6)];
          row[k] += c;
          text += c == '"' ? std::string("\"\"") : std::string(1, c);
        }
        text += k == 2 ? "\"\n" : "\"";
      }
    EXPECT_EQ(parse_csv(text, "f.csv").rows, rows);
  }
}

TEST(Csv, Numbers) {
  const CsvTable table = parse_csv("a,b\n1.5,x\n,1\nnan,2\n-2e3,3\n", "f.csv");
  const std::vector<double> a = read_numbers(table, find_column(table, "a"));
  EXPECT_EQ(a[0], 1.5);
  EXPECT_TRUE(std::isnan(a[1]) && std::isnan(a[2]));
  EXPECT_EQ(a[3], -2000);
  EXPECT_THROW(read_numbers(table, 1), InputError);
  EXPECT_THROW(find_column(table, "c"), InputError);
  for (const char* bad : {"1x", "0x10", " 1", "1 ", "--1", "1e999"})
    EXPECT_THROW(read_numbers(parse_csv(std::string("a\n") + bad + "\n", "f"), 0), InputError)
        << bad;
}

TEST(CsvPlot, LinesByNameInTheOrderOfTheTable) {
  const CsvTable table = parse_csv("m,x,y,z\nb,1,2,3\na,1,4,5\nb,2,6,\n", "f.csv");
  CsvPlotOptions options;
  options.x = "x", options.y = {"y", "z"}, options.by = "m";
  const Plot plot = make_csv_plot(table, options);
  ASSERT_EQ(plot.panels.size(), 2u);
  ASSERT_EQ(plot.panels[0].lines.size(), 2u);
  EXPECT_EQ(plot.panels[0].title, "y");
  EXPECT_EQ(plot.panels[0].lines[0].name, "b");
  EXPECT_EQ(plot.panels[0].lines[0].x, (std::vector<double>{1, 2}));
  EXPECT_EQ(plot.panels[0].lines[0].y, (std::vector<double>{2, 6}));
  EXPECT_EQ(plot.panels[0].lines[1].y, (std::vector<double>{4}));
  EXPECT_EQ(plot.panels[1].lines[0].y[0], 3);
  EXPECT_EQ(count_points(plot.panels[0]), 3u);
  EXPECT_EQ(count_points(plot.panels[1]), 2u);
  options.by.clear(), options.y = {"y"};
  const Plot alone = make_csv_plot(table, options);
  EXPECT_EQ(alone.panels[0].lines.size(), 1u);
  EXPECT_EQ(alone.panels[0].lines[0].name, "y");
  EXPECT_EQ(alone.panels[0].y_label, "y");
  EXPECT_EQ(alone.panels[0].title, "");
}

}  // namespace
}  // namespace viewcell
