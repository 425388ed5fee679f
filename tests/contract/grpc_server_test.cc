// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/grpc/grpc_server.h"

#include <gtest/gtest.h>

#include "coordinator/coordinator.h"
#include "tests/support/command.h"
#include "tests/support/grpc_health.h"
#include "worker/grpc_coordinator_client.h"

namespace orbweave {
namespace {

using testing::TemporaryFolder;

TEST(GrpcServer, RefusesAnAddressThatOthersCanReach) {
  const TemporaryFolder folder;
  const SteadyClock clock;
  const auto coordinator = Coordinator::Open({.state_dir = folder.Path()}, clock);
  ASSERT_TRUE(coordinator.ok());
  EXPECT_TRUE(absl::IsInvalidArgument(GrpcServer::Start(**coordinator, "0.0.0.0:0").status()));
}

TEST(GrpcServer, AnswersHealthChecks) {
  const TemporaryFolder folder;
  const SteadyClock clock;
  const auto coordinator = Coordinator::Open({.state_dir = folder.Path()}, clock);
  ASSERT_TRUE(coordinator.ok());
  const auto server = GrpcServer::Start(**coordinator, "127.0.0.1:0");
  ASSERT_TRUE(server.ok());
  EXPECT_EQ(testing::AskHealth((*server)->address()), testing::Health::kServing);
  EXPECT_EQ(testing::AskHealth("unix:" + (folder / "nobody")), testing::Health::kNoAnswer);
}

TEST(GrpcServer, SaysSoWhenAPortIsTaken) {
  const TemporaryFolder folder;
  const SteadyClock clock;
  const auto coordinator = Coordinator::Open({.state_dir = folder.Path()}, clock);
  ASSERT_TRUE(coordinator.ok());
  const auto first = GrpcServer::Start(**coordinator, "127.0.0.1:0");
  ASSERT_TRUE(first.ok());
  EXPECT_TRUE(absl::IsUnavailable(GrpcServer::Start(**coordinator, (*first)->address()).status()));
}

TEST(GrpcCoordinatorClient, IsUnavailableWhileNobodyListens) {
  const TemporaryFolder folder;
  GrpcCoordinatorClient client("unix:" + (folder / "nobody"));
  EXPECT_TRUE(absl::IsUnavailable(client.ListJobs().status()));
  EXPECT_TRUE(absl::IsUnavailable(client.Put("bytes").status()));
  EXPECT_TRUE(absl::IsUnavailable(client.Get(DigestOf("bytes")).status()));
}

}  // namespace
}  // namespace orbweave
