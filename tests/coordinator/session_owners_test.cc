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

TEST(SessionOwners, LetNobodyJoinUnderAnothersName) {
  EXPECT_TRUE(SessionOwners::CheckName(Worker("node"), "node/1").ok());
  EXPECT_TRUE(absl::IsPermissionDenied(SessionOwners::CheckName(Worker("node"), "nodes")));
}

}  // namespace
}  // namespace orbweave
