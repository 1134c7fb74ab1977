#include "base/error.h"

#include <gtest/gtest.h>

namespace viewcell {
namespace {

TEST(InputError, NamesFileAndPlaceOnOneLine) {
  EXPECT_STREQ(InputError("a.json", "objects[3]", "has no mesh").what(),
               "a.json: objects[3]: has no mesh");
  EXPECT_STREQ(InputError("a.json", "", "is empty").what(), "a.json: is empty");
}

TEST(Check, HoldsQuietly) {
  int n_evaluated = 0;
  VIEWCELL_CHECK(++n_evaluated == 1);
  EXPECT_EQ(n_evaluated, 1);
}

TEST(Check, FailurePrintsConditionAndValues) {
  const int i = 7, n = 5;
  try {
    VIEWCELL_CHECK(i < n, "i =", i, "n =", n);
    FAIL() << "7 < 5 passed";
  } catch (const BugError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("error_test.cpp:"), std::string::npos) << text;
    EXPECT_NE(text.find("check failed: i < n i = 7 n = 5"), std::string::npos) << text;
  }
}

// Tools tell the kinds apart by type, so none may derive from another.
TEST(Errors, KindsAreUnrelated) {
  EXPECT_FALSE((std::is_base_of_v<InputError, UsageError>));
  EXPECT_FALSE((std::is_base_of_v<InputError, MachineError>));
  EXPECT_FALSE((std::is_base_of_v<std::runtime_error, BugError>));
}

}  // namespace
}  // namespace viewcell
