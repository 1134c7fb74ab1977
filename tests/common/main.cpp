// Runs the tests of a room. Exit codes: 0 all passed; 1 one failed, or there was none to run; 77
// none failed, but some were skipped, which CTest reports. Suites that may skip, for they need
// something from outside the repository, begin with Outside.
#include <gtest/gtest.h>

#include <cstdio>

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const int code = RUN_ALL_TESTS();
  const testing::UnitTest& tests = *testing::UnitTest::GetInstance();
  if (tests.test_to_run_count() == 0) {
    std::fprintf(stderr, "no test has run\n");
    return 1;
  }
  return code == 0 && tests.skipped_test_count() > 0 ? 77 : code;
}
