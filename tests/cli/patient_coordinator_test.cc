// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/fleet/patient_coordinator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "coordinator/coordinator.h"
#include "coordinator/grpc/grpc_server.h"
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

/// A coordinator whose process can be killed and started again at its address.
class CutOff : public ::testing::Test {
 protected:
  void SetUp() override { Start(); }

  void Start() {
    auto opened = Coordinator::Open({.state_dir = folder_ / "state"}, clock_);
    ASSERT_TRUE(opened.ok()) << opened.status();
    coordinator_ = *std::move(opened);
    auto server = GrpcServer::Start(*coordinator_, address_);
    ASSERT_TRUE(server.ok()) << server.status();
    server_ = *std::move(server);
  }

  void StartAgain() {
    server_.reset();
    coordinator_.reset();
    Start();
  }

  /// More than the wire holds at a time.
  static std::string ManyBytes() {
    std::string bytes(size_t{16} << 20, '\0');
    for (size_t i = 0; i < bytes.size(); i += 4096) bytes[i] = static_cast<char>(i / 4096 % 251);
    return bytes;
  }

  testing::TemporaryFolder folder_;
  SteadyClock clock_;
  std::string address_ = "unix:" + folder_ / "s";
  std::unique_ptr<Coordinator> coordinator_;
  std::unique_ptr<GrpcServer> server_;
  PatientCoordinator patient_{std::make_unique<GrpcCoordinatorClient>(address_),
                              {.address = address_, .wait_s = 60.0}};
};

TEST_F(CutOff, AReaderGetsPiecesAndEachByteOnce) {
  const std::string bytes = ManyBytes();
  const Digest digest = *coordinator_->Put(bytes);
  std::string taken;
  size_t largest = 0;
  const absl::Status read = patient_.Read(digest, [&](std::string_view piece) {
    if (taken.empty()) StartAgain();
    taken += piece;
    largest = std::max(largest, piece.size());
    return absl::OkStatus();
  });
  EXPECT_TRUE(read.ok()) << read;
  EXPECT_EQ(DigestOf(taken), digest);
  EXPECT_LE(largest, kPieceBytes);
}

TEST_F(CutOff, WhatTheReaderSaysIsFinal) {
  const Digest digest = *coordinator_->Put("bytes");
  int calls = 0;
  const absl::Status read = patient_.Read(digest, [&](std::string_view) {
    ++calls;
    return absl::UnavailableError("the disk is away");
  });
  EXPECT_EQ(read, absl::UnavailableError("the disk is away"));
  EXPECT_EQ(calls, 1);
}

TEST_F(CutOff, AWriterWhoseFirstPieceWasLostBeginsAgain) {
  const std::string bytes = "bytes of one piece";
  server_.reset();
  bool is_asked = false;
  const NextPiece pieces = PiecesOf(bytes);
  std::jthread starter;
  const absl::Status written = patient_.Write(DigestOf(bytes), bytes.size(), [&] {
    if (!std::exchange(is_asked, true)) starter = std::jthread([this] { StartAgain(); });
    return pieces();
  });
  EXPECT_TRUE(written.ok()) << written;
  EXPECT_EQ(*patient_.Get(DigestOf(bytes)), bytes);
}

TEST_F(CutOff, AWriterWhosePiecesAreLostIsToldAtOnce) {
  const std::string bytes = ManyBytes();
  const NextPiece pieces = PiecesOf(bytes);
  size_t asked = 0;
  const absl::Status written = patient_.Write(DigestOf(bytes), bytes.size(), [&] {
    if (++asked == 8) StartAgain();
    return pieces();
  });
  EXPECT_TRUE(absl::IsUnavailable(written)) << written;
  EXPECT_LT(asked, bytes.size() / kPieceBytes) << "nobody took the others";
  EXPECT_TRUE(patient_.Put(bytes).ok()) << "bytes that stay are sent again";
  EXPECT_EQ(patient_.Get(DigestOf(bytes))->size(), bytes.size());
}

}  // namespace
}  // namespace orbweave
