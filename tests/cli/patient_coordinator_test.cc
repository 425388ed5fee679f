// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/patient_coordinator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "tests/support/command.h"
#include "worker/grpc_coordinator_client.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;

class NobodyThere : public ::testing::Test {
 protected:
  PatientCoordinator WithPatience(double wait_s) {
    return {std::make_unique<GrpcCoordinatorClient>(address_),
            {.address = address_,
             .wait_s = wait_s,
             .stop = stop_.get_token(),
             .on_away = [this](const absl::Status&) { ++times_away_; }}};
  }

  testing::TemporaryFolder folder_;
  std::string address_ = "unix:" + folder_ / "nobody";
  std::stop_source stop_;
  int times_away_ = 0;
};

TEST_F(NobodyThere, AfterThePatienceTheCallIsUnavailableAndNamesTheAddress) {
  PatientCoordinator coordinator = WithPatience(0.5);
  const auto start = std::chrono::steady_clock::now();
  const absl::Status status = coordinator.ListJobs().status();
  EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(500));
  EXPECT_TRUE(absl::IsUnavailable(status)) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr("no coordinator answers at " + address_));
}

TEST_F(NobodyThere, TheAbsenceIsToldOnce) {
  PatientCoordinator coordinator = WithPatience(2.5);  // a call alone takes 2 s to find nobody
  EXPECT_TRUE(absl::IsUnavailable(coordinator.GetJob(DigestOf("job")).status()));
  EXPECT_TRUE(absl::IsUnavailable(coordinator.CancelJob(DigestOf("job"))));
  EXPECT_EQ(times_away_, 1);
}

TEST_F(NobodyThere, WithoutPatienceTheCallIsMadeOnce) {
  PatientCoordinator coordinator = WithPatience(0.0);
  EXPECT_TRUE(absl::IsUnavailable(coordinator.Put("bytes").status()));
  EXPECT_EQ(times_away_, 0) << "nobody waits";
}

TEST_F(NobodyThere, AStopEndsTheWaiting) {
  PatientCoordinator coordinator = WithPatience(3600.0);
  stop_.request_stop();
  EXPECT_TRUE(absl::IsCancelled(coordinator.Get(DigestOf("blob")).status()));
}

}  // namespace
}  // namespace orbweave
