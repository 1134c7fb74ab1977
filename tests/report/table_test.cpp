#include "report/table.h"

#include <gtest/gtest.h>

#include <limits>

namespace viewcell {
namespace {

const TableRows kRows{{"name", "n", "x"}, {"a", "10", ""}, {"longer", "2", "1.5"}};

TEST(Table, ColumnsStandUnderTheirHeads) {
  EXPECT_EQ(format_table(kRows),
            "name     n    x\n"
            "a       10\n"
            "longer   2  1.5\n");
}

TEST(Table, Markdown) {
  EXPECT_EQ(format_markdown_table(kRows),
            "| name | n | x |\n"
            "|---|---:|---:|\n"
            "| a | 10 |  |\n"
            "| longer | 2 | 1.5 |\n");
}

TEST(Table, FixedNumbers) {
  EXPECT_EQ(format_fixed(1.25, 1, "-"), "1.2");
  EXPECT_EQ(format_fixed(2, 2, "-", true), "+2.00");
  EXPECT_EQ(format_fixed(-2, 0, "-"), "-2");
  EXPECT_EQ(format_fixed(std::numeric_limits<double>::quiet_NaN(), 1, "-"), "-");
  EXPECT_EQ(format_fixed(1e300, 3, "-").size(), 305u);
}

}  // namespace
}  // namespace viewcell
