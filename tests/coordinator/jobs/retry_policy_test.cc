// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/jobs/retry_policy.h"

#include <gtest/gtest.h>

#include <set>

namespace orbweave {
namespace {

TEST(RetryPolicy, WaitsDoubleUpToALimitAndAreSpread) {
  const RetryPolicy policy{.first_wait_s = 1.0, .longest_wait_s = 10.0};
  std::set<double> waits;
  for (uint64_t seed = 0; seed < 100; ++seed) {
    for (const auto& [failures, most_s] : {std::pair(1U, 1.0), {2U, 2.0}, {3U, 4.0}, {99U, 10.0}}) {
      const double wait_s = policy.WaitAfter(failures, seed);
      EXPECT_GE(wait_s, 0.5 * most_s);
      EXPECT_LE(wait_s, most_s);
      EXPECT_EQ(wait_s, policy.WaitAfter(failures, seed)) << "the same each time";
      waits.insert(wait_s);
    }
  }
  EXPECT_EQ(waits.size(), 400U);
}

TEST(RetryPolicy, AJobMayRetryANumberAndAShare) {
  const RetryPolicy policy{.job_retries = 10, .job_retry_share = 0.1};
  EXPECT_EQ(policy.MaxJobRetries(0), 10U);
  EXPECT_EQ(policy.MaxJobRetries(50'000), 5'010U);
}

TEST(RetryPolicy, AStragglerRunsTwiceAsLongAsOthersAndAMinuteAtLeast) {
  const RetryPolicy policy;
  EXPECT_DOUBLE_EQ(policy.StragglerAfter(1.0), 60.0);
  EXPECT_DOUBLE_EQ(policy.StragglerAfter(100.0), 200.0);
}

TEST(RetryPolicy, OneStragglerMayRunTwiceOnAFewSlotsAndATenthOnMany) {
  const RetryPolicy policy;
  EXPECT_EQ(policy.MaxDuplicates(2), 1U);
  EXPECT_EQ(policy.MaxDuplicates(200), 20U);
}

TEST(ClassifyFailure, KnowsWhoseFaultItIs) {
  using Code = absl::StatusCode;
  EXPECT_EQ(ClassifyFailure(Code::kCancelled), FailureClass::kReturned);
  EXPECT_EQ(ClassifyFailure(Code::kDataLoss), FailureClass::kInputLost);
  EXPECT_EQ(ClassifyFailure(Code::kInvalidArgument), FailureClass::kPermanent);
  EXPECT_EQ(ClassifyFailure(Code::kInternal), FailureClass::kTransient);
  EXPECT_EQ(ClassifyFailure(Code::kUnavailable), FailureClass::kInfrastructure);
  EXPECT_EQ(ClassifyFailure(Code::kResourceExhausted), FailureClass::kInfrastructure);
  EXPECT_EQ(ClassifyFailure(Code::kAborted), FailureClass::kProcessLost);
  EXPECT_EQ(ClassifyFailure(Code::kDeadlineExceeded), FailureClass::kProcessLost);
}

}  // namespace
}  // namespace orbweave
