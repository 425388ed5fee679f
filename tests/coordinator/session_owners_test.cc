// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/session_owners.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

Identity Worker(const std::string& name) {
  return {.fleet = "city", .role = Role::kWorker, .name = name};
}

TEST(SessionOwners, KeepASessionForWhoBeganIt) {
  SessionOwners owners;
  owners.Begin(7, "node/1", Worker("node"));
  EXPECT_TRUE(owners.Check(7, Worker("node")).ok());
  EXPECT_TRUE(absl::IsPermissionDenied(owners.Check(7, Worker("other"))));
  Identity admin = Worker("node");
  admin.role = Role::kAdmin;
  EXPECT_TRUE(absl::IsPermissionDenied(owners.Check(7, admin)));
}

TEST(SessionOwners, KnowNoSessionTheyDidNotSeeBegin) {
  EXPECT_TRUE(absl::IsNotFound(SessionOwners().Check(7, Worker("node"))));
}

TEST(SessionOwners, ForgetTheSessionThatANewOneReplaces) {
  SessionOwners owners;
  owners.Begin(7, "node/1", Worker("node"));
  owners.Begin(8, "node/2", Worker("node"));
  owners.Begin(9, "node/1", Worker("node"));
  EXPECT_TRUE(absl::IsNotFound(owners.Check(7, Worker("node"))));
  EXPECT_TRUE(owners.Check(8, Worker("node")).ok());
  EXPECT_TRUE(owners.Check(9, Worker("node")).ok());
}

TEST(SessionOwners, ForgetInTimeASessionInWhichNobodySpeaks) {
  constexpr uint64_t kMany = 100'000;
  SessionOwners owners;
  owners.Begin(1, "silent", Worker("silent"));
  owners.Begin(2, "speaks", Worker("speaks"));
  for (uint64_t session = 3; session < kMany + 2; ++session) {
    owners.Begin(session, "pod" + std::to_string(session), Worker("pod"));
    ASSERT_TRUE(owners.Check(2, Worker("speaks")).ok());
  }
  EXPECT_TRUE(absl::IsNotFound(owners.Check(1, Worker("silent"))));
  owners.Begin(kMany + 2, "silent", Worker("silent"));
  EXPECT_TRUE(owners.Check(kMany + 2, Worker("silent")).ok()) << "it joined again";
  EXPECT_TRUE(owners.Check(2, Worker("speaks")).ok());
}

TEST(SessionOwners, LetNobodyJoinUnderAnothersName) {
  EXPECT_TRUE(SessionOwners::CheckName(Worker("node"), "node/1").ok());
  EXPECT_TRUE(absl::IsPermissionDenied(SessionOwners::CheckName(Worker("node"), "nodes")));
}

}  // namespace
}  // namespace orbweave
