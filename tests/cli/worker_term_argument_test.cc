// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/arguments/worker_term_argument.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <ctime>
#include <set>

namespace orbweave {
namespace {

constexpr int64_t kNow = 1'800'000'000;  // 2027-01-15T08:00:00Z

TEST(ParseUnixTime, TakesSecondsAndTimesOfDay) {
  EXPECT_EQ(*ParseUnixTime("1800000000"), kNow);
  EXPECT_EQ(*ParseUnixTime("2027-01-15T08:00:00Z"), kNow);
  ::setenv("TZ", "XYZ-2", 1);  // two hours before UTC
  ::tzset();
  EXPECT_EQ(*ParseUnixTime("2027-01-15T10:00:00"), kNow);
  ::unsetenv("TZ");
  ::tzset();
}

TEST(ParseUnixTime, RefusesWhatIsNoTime) {
  for (const char* text : {"",
                           "soon",
                           "2027-01-15",
                           "2027-01-15T08:00",
                           "2027-13-15T08:00:00Z",
                           "2027-01-15T08:00:00+02:00",
                           "1800000000.5",
                           "1e9"}) {
    EXPECT_TRUE(absl::IsInvalidArgument(ParseUnixTime(text).status())) << text;
  }
}

TEST(WorkerTerm, NeverEndsUnlessItIsSaid) {
  const WorkerTerm term = *WorkerTermArgument{}.Begin(kNow);
  for (const double end_s : {term.idle_s, term.patience_s, term.lifetime_s, term.stays_s})
    EXPECT_TRUE(std::isinf(end_s));
}

TEST(WorkerTerm, EndsAtTheTimeThatIsSaid) {
  EXPECT_EQ(WorkerTermArgument{.until = "2027-01-15T08:10:00Z"}.Begin(kNow)->stays_s, 600.0);
  EXPECT_TRUE(absl::IsInvalidArgument(
      WorkerTermArgument{.until = "2027-01-15T08:00:00Z"}.Begin(kNow).status()));
}

TEST(WorkerTerm, LifetimesThatBeganTogetherDoNotEndTogether) {
  const WorkerTermArgument argument{.term = {.lifetime_s = 1000.0}};
  std::set<double> ends_s;
  for (int i = 0; i < 100; ++i) {
    const double end_s = argument.Begin(kNow)->lifetime_s;
    EXPECT_GE(end_s, 900.0);
    EXPECT_LE(end_s, 1000.0);
    ends_s.insert(end_s);
  }
  EXPECT_GT(ends_s.size(), 90U);
}

}  // namespace
}  // namespace orbweave
