// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "objects/check_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/fault_store.h"

namespace orbweave {
namespace {

using testing::FaultStore;

std::vector<StoreCheck> Check(const FaultStore& server, const S3Keys& keys) {
  return CheckStore([&](UnixClock clock) {
    return S3Store::Make(*ParseS3Address(server.Url("a")), keys, {}, std::move(clock));
  });
}

/// Names of the rows that are not OK.
std::vector<std::string> Failed(const std::vector<StoreCheck>& checks) {
  std::vector<std::string> names;
  for (const StoreCheck& check : checks) {
    if (!check.result.ok()) names.push_back(check.what);
  }
  return names;
}

TEST(CheckStore, FindsNothingAndLeavesNothing) {
  FaultStore server;
  server.SetObject("a/other", "stays");
  const std::vector<StoreCheck> checks = Check(server, server.keys());
  EXPECT_GE(checks.size(), 12U);
  EXPECT_THAT(Failed(checks), ::testing::IsEmpty());
  EXPECT_EQ(server.Objects().size(), 1U);
}

TEST(CheckStore, SaysWhatOrbweaveGetsByWithout) {
  FaultStore server({.knows_conditions = false});
  const std::vector<StoreCheck> checks = Check(server, server.keys());
  ASSERT_THAT(Failed(checks), ::testing::SizeIs(1));
  for (const StoreCheck& check : checks) EXPECT_TRUE(check.result.ok() || !check.is_needed);
}

TEST(CheckStore, FailsEveryRowThatNeedsKeysWithWrongOnes) {
  FaultStore server;
  S3Keys wrong = server.keys();
  wrong.secret_key = "another";
  EXPECT_GE(Failed(Check(server, wrong)).size(), 9U);
}

TEST(CheckStore, FailsEveryRowWhenNobodyAnswers) {
  auto server = std::make_unique<FaultStore>(testing::FaultStoreOptions{.slow_down_share = 1.0});
  const std::vector<StoreCheck> checks = Check(*server, server->keys());
  // Refused is not the same as away.
  EXPECT_THAT(Failed(checks), ::testing::SizeIs(checks.size()));
}

}  // namespace
}  // namespace orbweave
