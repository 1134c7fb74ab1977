#include "play/modes.h"

#include <gtest/gtest.h>

#include <set>

#include "base/error.h"

namespace viewcell {
namespace {

TEST(Modes, RowsAreWholeAndOfOneNameEach) {
  std::set<std::string> names;
  for (const ModeRow& row : mode_rows()) {
    SCOPED_TRACE(row.name);
    EXPECT_TRUE(names.insert(row.name).second);
    EXPECT_EQ(parse_mode(row.name), row.mode);
    EXPECT_EQ(&row_of(row.mode), &row);
    EXPECT_STREQ(mode_name(row.mode), row.name);
    EXPECT_EQ(row.plan != nullptr, row.engine == ModeEngine::objects);
    EXPECT_TRUE(!row.draws_levels || row.plan);
    EXPECT_TRUE(!row.asks_hybrid || row.plan);
    EXPECT_EQ(std::string(row.color).size(), 7u);
  }
  EXPECT_EQ(names.size(), 8u);
}

TEST(Modes, AreListedWithTheirVariantsLast) {
  EXPECT_EQ(list_modes(),
            "geometry,frustum,lod,hybrid,raycast, lod-equal,geometry-two-sided,frustum-two-sided");
  try {
    parse_mode("geometry ");
    ADD_FAILURE() << "a mode";
  } catch (const UsageError& error) {
    EXPECT_STREQ(error.what(),
                 "'geometry ' is no mode: geometry, frustum, lod, hybrid, raycast, lod-equal, "
                 "geometry-two-sided, frustum-two-sided");
  }
}

}  // namespace
}  // namespace viewcell
