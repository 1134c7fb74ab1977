// --cells and --slice.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "cells/cells.h"
#include "cells/small_scene.h"
#include "common/expect_input_error.h"
#include "common/temporary_folder.h"

namespace viewcell {
namespace {

// 4 columns, 3 rows: cells 0 to 11.
CellSet make_twelve() {
  CellSet cells = make_cells(make_box_scene({{0, 0}, {240, 200}}, {}), 50, {16, 20});
  EXPECT_EQ(cells.grid.columns, 4);
  EXPECT_EQ(cells.grid.rows, 3);
  return cells;
}

std::vector<int> select(const std::string& list, const std::string& slice = "") {
  std::vector<int> out;
  for (const CellId cell : select_cells(make_twelve(), list, slice))
    out.push_back(static_cast<int>(cell));
  return out;
}

using Cells = std::vector<int>;

TEST(SelectCells, TakesEveryForm) {
  EXPECT_EQ(select("all"), (Cells{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}));
  EXPECT_EQ(select("3"), (Cells{3}));
  EXPECT_EQ(select("7,3,10-11"), (Cells{3, 7, 10, 11}));
  EXPECT_EQ(select("3,3,2-4"), (Cells{2, 3, 4}));
  EXPECT_EQ(select("5-5"), (Cells{5}));
  EXPECT_EQ(select(" 1, 2 ,\n3,"), (Cells{1, 2, 3}));
}

TEST(SelectCells, TakesAFile) {
  const TemporaryFolder folder;
  const auto file = folder.add("list", "3\n1,2\n\n10-11\n");
  EXPECT_EQ(select("@" + file.string()), (Cells{1, 2, 3, 10, 11}));
  EXPECT_INPUT_ERROR(select("@" + (folder.path() / "absent").string()), "absent: cannot open");
  EXPECT_THROW(select("@" + folder.add("empty", "\n").string()), UsageError);
  EXPECT_THROW(select("@" + folder.add("words", "all").string()), UsageError);
}

// Along y = 0 from cell 0 to cell 2: cell 1, on whose lower border that is, lies between the two
// samples.
TEST(SelectCells, TakesAPath) {
  const TemporaryFolder folder;
  const auto path = [&](double x0, double x1) {
    const CameraPath line{{{0, {x0, 0, 18}, {1, 0, 0}}, {9, {x1, 0, 18}, {1, 0, 0}}}};
    return "path:" + folder.add("path.json", format_json(format_path(line, {}))).string();
  };
  EXPECT_EQ(select(path(0, 150)), (Cells{0, 1, 2}));
  EXPECT_EQ(select(path(-500, 150)), (Cells{0, 1, 2}));
  EXPECT_THROW(select(path(-500, -400)), UsageError);
  EXPECT_INPUT_ERROR(select("path:" + (folder.path() / "absent.json").string()), "cannot open");
}

TEST(SelectCells, PathTakesEveryCellOfEverySample) {
  const TemporaryFolder folder;
  const CellSet cells = make_twelve();
  CameraPath path;
  for (int i = 0; i < 6; ++i)
    path.samples.push_back({i * 1.0, {40.0 * i, i % 2 ? 20.0 : 150.0, 18}, {1, 0, 0}});
  const auto file = folder.add("path.json", format_json(format_path(path, {})));
  const auto chosen = select_cells(cells, "path:" + file.string());
  for (std::size_t i = 0; i + 1 < path.samples.size(); ++i)
    for (double t = 0; t <= 1; t += 0.01) {
      const glm::dvec2 eye(glm::mix(path.samples[i].eye, path.samples[i + 1].eye, t));
      const auto cell = cell_at(cells.grid, coord_at(cells.grid, eye));
      EXPECT_TRUE(!cell || std::binary_search(chosen.begin(), chosen.end(), *cell));
    }
}

TEST(SelectCells, RefusesMalformedLists) {
  for (const char* list :
       {"",     ",",   "x",   "ALL", "all,3", "3;4", "3-",          "-3",  "-",    "1-2-3",
        "1--2", "4-2", "0x3", "3.0", "+3",    "1e1", "99999999999", "3,x", "path", "@"})
    EXPECT_THROW(
        {
          try {
            select(list);
          } catch (const InputError&) {  // "@": no file
            throw UsageError("");
          }
        },
        UsageError)
        << list;
}

TEST(SelectCells, OutOfRangeIsTheInputsFault) {
  EXPECT_INPUT_ERROR(select("12"), "cell 12 is out of range: the grid has cells 0 to 11");
  EXPECT_INPUT_ERROR(select("0-12"), "cell 12 is out of range");
  EXPECT_INPUT_ERROR(select("0-2147483647"), "out of range");
}

TEST(SelectCells, SlicesPartitionTheList) {
  const std::vector<int> all = select("0-10");
  for (int n = 1; n <= 13; ++n) {
    std::vector<int> together;
    std::size_t least = 100, most = 0;
    for (int i = 1; i <= n; ++i) {
      const Cells part = select("0-10", std::to_string(i) + "/" + std::to_string(n));
      EXPECT_TRUE(std::is_sorted(part.begin(), part.end()));
      together.insert(together.end(), part.begin(), part.end());
      least = std::min(least, part.size()), most = std::max(most, part.size());
    }
    std::sort(together.begin(), together.end());
    EXPECT_EQ(together, all);
    EXPECT_LE(most, least + 1);
  }
}

TEST(SelectCells, RefusesMalformedSlices) {
  for (const char* slice :
       {"0/2", "3/2", "1/0", "1", "/", "1/", "/2", "a/b", "1/2/3", "-1/2", "1/-2", "1/2x", "1.5/2",
        " 1/2", "+1/2", "1/ 2", "1/99999999999", "4294967297/4294967298"})
    EXPECT_THROW(select("all", slice), UsageError) << slice;
}

}  // namespace
}  // namespace viewcell
