// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/base/fault_point.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>

namespace orbweave {
namespace {

/// Each expectation is a process of its own, as the variable is read once.
class FaultPointDeathTest : public ::testing::Test {
 protected:
  void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

TEST_F(FaultPointDeathTest, EndsTheProcessAtThePassingThatIsNamed) {
  EXPECT_EXIT(
      {
        ::setenv("ORBWEAVE_FAULT", "result.before:2", 1);
        FaultPoint("result", FaultSide::kBefore);
        FaultPoint("result", FaultSide::kAfter);
        FaultPoint("start", FaultSide::kBefore);
        std::fputs("still there", stderr);
        FaultPoint("result", FaultSide::kBefore);
        std::exit(0);
      },
      ::testing::KilledBySignal(SIGKILL),
      "still there");
}

TEST_F(FaultPointDeathTest, DoesNothingUnlessAsked) {
  EXPECT_EXIT(
      {
        ::unsetenv("ORBWEAVE_FAULT");
        FaultPoint("result", FaultSide::kBefore);
        std::exit(0);
      },
      ::testing::ExitedWithCode(0),
      "");
}

TEST_F(FaultPointDeathTest, AVariableOfAnotherFormIsNotTakenForNone) {
  for (const char* text : {"result", "result.before", "result.between:1", "result.after:0"}) {
    EXPECT_EXIT(
        {
          ::setenv("ORBWEAVE_FAULT", text, 1);
          FaultPoint("result", FaultSide::kBefore);
          std::exit(0);
        },
        ::testing::KilledBySignal(SIGABRT),
        "")
        << text;
  }
}

}  // namespace
}  // namespace orbweave
