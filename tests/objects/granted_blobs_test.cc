// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// A coordinator with an object store, and a caller without keys to it, over a real connection.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coordinator/coordinator.h"
#include "coordinator/grpc_server.h"
#include "core/pipeline/build_version.h"
#include "objects/s3_store.h"
#include "tests/support/command.h"
#include "tests/support/fault_store.h"
#include "tests/support/toy_job.h"
#include "worker/grpc_coordinator_client.h"

namespace orbweave {
namespace {

using testing::FaultStore;
using testing::StoreFault;
using testing::TemporaryFolder;

class GrantedBlobsTest : public ::testing::Test {
 protected:
  void SetUp() override { Start(); }
  void TearDown() override { Stop(); }

  void Start() {
    CoordinatorOptions options{.state_dir = folder_ / "state", .find_plan = testing::FindToyPlan};
    options.objects = *S3Store::Make(*ParseS3Address(store_.Url("state")), store_.keys());
    options.object_roots["s3://blobs/street"] =
        *S3Store::Make(*ParseS3Address(store_.Url("street")), store_.keys());
    auto opened = Coordinator::Open(options, clock_);
    ASSERT_TRUE(opened.ok()) << opened.status();
    coordinator_ = *std::move(opened);
    server_ = *GrpcServer::Start(*coordinator_, "unix:" + (folder_ / "socket"));
    client_ = std::make_unique<GrpcCoordinatorClient>(server_->address());
  }
  void Stop() {
    coordinator_->BeginShutdown();
    client_.reset();
    server_.reset();
    coordinator_.reset();
  }
  void Restart() {
    Stop();
    Start();
  }

  /// The objects of blobs.
  size_t CountBlobs() {
    size_t count = 0;
    for (const auto& [key, bytes] : store_.Objects())
      count += key.size() == std::string("state/").size() + 64 ? 1U : 0U;
    return count;
  }
  std::string KeyOf(const Digest& digest) { return "state/" + digest.ToHex(); }

  /// A task of a toy job, and a result for it.
  Lease LeaseTask(uint64_t session) {
    while (true) {
      const auto lease = client_->LeaseTask(session, 0, 1.0);
      ORBWEAVE_CHECK(lease.ok());
      if (*lease) return **lease;
    }
  }

  const std::string large_ = std::string(200'000, 'a') + "b";
  TemporaryFolder folder_;
  FaultStore store_;
  SteadyClock clock_;
  std::unique_ptr<Coordinator> coordinator_;
  std::unique_ptr<GrpcServer> server_;
  std::unique_ptr<GrpcCoordinatorClient> client_;
};

TEST_F(GrantedBlobsTest, LargeOnesGoPastTheCoordinator) {
  const Digest digest = *client_->Put(large_);
  EXPECT_EQ(store_.Objects().at(KeyOf(digest)), large_);
  EXPECT_EQ(coordinator_->blob_traffic().bytes_in, 0U);
  ASSERT_TRUE(coordinator_->SubmitJob({.kind = "toy", .inputs = {digest}}).ok());  // it is there
  EXPECT_EQ(*client_->Get(digest), large_);
  EXPECT_EQ(coordinator_->blob_traffic().bytes_out, 0U);
  EXPECT_EQ(*coordinator_->Get(digest), large_);  // with its own keys
}

TEST_F(GrantedBlobsTest, SmallOnesStayWithTheCoordinator) {
  const Digest digest = *client_->Put("small");
  EXPECT_EQ(CountBlobs(), 0U);
  EXPECT_EQ(*client_->Get(digest), "small");
  EXPECT_EQ(coordinator_->blob_traffic().bytes_in, 5U);
}

TEST_F(GrantedBlobsTest, WhatIsStoredIsNotSentAgain) {
  const Digest digest = *client_->Put(large_);
  ASSERT_TRUE(coordinator_->SubmitJob({.kind = "toy", .inputs = {digest}}).ok());
  const uint64_t puts = store_.Count("PUT");
  EXPECT_EQ(*client_->Put(large_), digest);
  EXPECT_EQ(store_.Count("PUT"), puts);
  EXPECT_TRUE(client_->StatBlobs({digest})->front());
}

TEST_F(GrantedBlobsTest, IsFoundAgainAfterARestart) {
  const Digest digest = *client_->Put(large_);
  Restart();
  EXPECT_TRUE(client_->StatBlobs({digest})->front());
  EXPECT_EQ(*client_->Get(digest), large_);
}

TEST_F(GrantedBlobsTest, AMissingBlobIsNotFound) {
  EXPECT_TRUE(absl::IsNotFound(client_->Get(DigestOf("nobody has it")).status()));
  const Digest digest = *client_->Put(large_);
  ASSERT_TRUE(coordinator_->SubmitJob({.kind = "toy", .inputs = {digest}}).ok());
  ASSERT_TRUE((*S3Store::Make(*ParseS3Address(store_.Url("state")), store_.keys()))
                  ->Delete(digest.ToHex())
                  .ok());
  EXPECT_TRUE(absl::IsNotFound(client_->Get(digest).status()));
  EXPECT_FALSE(client_->StatBlobs({digest})->front());
  EXPECT_EQ(*client_->Put(large_), digest);  // and can be put again
  EXPECT_EQ(*client_->Get(digest), large_);
}

TEST_F(GrantedBlobsTest, ADamagedBlobIsNoticedAndCanBePutAgain) {
  const Digest digest = *client_->Put(large_);
  ASSERT_TRUE(coordinator_->SubmitJob({.kind = "toy", .inputs = {digest}}).ok());
  store_.SetObject(KeyOf(digest), "other bytes");
  EXPECT_TRUE(absl::IsDataLoss(client_->Get(digest).status()));
  EXPECT_TRUE(absl::IsNotFound(client_->Get(digest).status()));
  EXPECT_EQ(*client_->Put(large_), digest);
  EXPECT_EQ(*client_->Get(digest), large_);
}

TEST_F(GrantedBlobsTest, ACutOrRefusedPutIsUnavailableAndStoresNothing) {
  store_.FailNext("PUT", {StoreFault::kCutBody, StoreFault::kSlowDown});
  EXPECT_TRUE(absl::IsUnavailable(client_->Put(large_).status()));
  EXPECT_TRUE(absl::IsUnavailable(client_->Put(large_).status()));
  EXPECT_EQ(CountBlobs(), 0U);
  EXPECT_TRUE(client_->Put(large_).ok());
  store_.FailNext("GET", {StoreFault::kCutBody, StoreFault::kSlowDown, StoreFault::kServerError});
  ASSERT_TRUE(coordinator_->SubmitJob({.kind = "toy", .inputs = {DigestOf(large_)}}).ok());
  EXPECT_EQ(*client_->Get(DigestOf(large_)), large_);
}

TEST_F(GrantedBlobsTest, AResultIsTakenWhenItsBlobsAreInTheStore) {
  ASSERT_TRUE(coordinator_->SubmitJob(*testing::PrepareToyJob(*client_, "1")).ok());
  const uint64_t session =
      client_->Join({.name = "w", .version = std::string(BuildVersion())})->session;
  const Lease lease = LeaseTask(session);
  TaskResult result{.recipes = {DigestOf(large_)}, .report_json = "{}"};
  EXPECT_TRUE(absl::IsAborted(client_->CompleteTask(session, lease, result)));
  ASSERT_TRUE(client_->Put(large_).ok());
  store_.FailNext("HEAD", std::vector<StoreFault>(6, StoreFault::kSlowDown));
  // A store that does not answer is no fault of the result.
  EXPECT_TRUE(absl::IsUnavailable(client_->CompleteTask(session, lease, result)));
  EXPECT_TRUE(client_->CompleteTask(session, lease, result).ok());
}

TEST_F(GrantedBlobsTest, GarbageGoesFromTheStoreToo) {
  const Digest garbage = *client_->Put(large_);
  const std::string needed_bytes = large_ + "needed";
  const Digest needed = *client_->Put(needed_bytes);
  ASSERT_TRUE(coordinator_->SubmitJob({.kind = "toy", .inputs = {needed}}).ok());
  EXPECT_EQ(client_->CollectGarbage({})->removed_blobs, 0U);  // both are new
  store_.Age(KeyOf(garbage), 100'000);
  store_.Age(KeyOf(needed), 100'000);
  Restart();
  const GarbageReport dry = *client_->CollectGarbage({.dry_run = true});
  EXPECT_EQ(dry.removed_blobs, 1U);
  EXPECT_EQ(CountBlobs(), 2U);
  const GarbageReport report = *client_->CollectGarbage({});
  EXPECT_EQ(report.removed_blobs, 1U);
  EXPECT_EQ(report.removed_bytes, large_.size());
  EXPECT_EQ(report.needed_bytes, needed_bytes.size());
  EXPECT_EQ(CountBlobs(), 1U);
  EXPECT_EQ(*client_->Get(needed), needed_bytes);
}

TEST_F(GrantedBlobsTest, ALinkedObjectIsReadWhereItLiesAndNeverCopied) {
  store_.SetObject("street/north/a b.jpg", large_);
  const std::string path = "s3://blobs/street/north/a b.jpg";
  ASSERT_TRUE(client_->LinkFile(DigestOf(large_), path).ok());
  Restart();
  EXPECT_EQ(*client_->Get(DigestOf(large_)), large_);
  EXPECT_EQ(coordinator_->blob_traffic().bytes_out, 0U);
  EXPECT_EQ(*coordinator_->Get(DigestOf(large_)), large_);
  EXPECT_EQ(CountBlobs(), 0U);
  EXPECT_TRUE(absl::IsNotFound(client_->LinkFile(DigestOf("b"), "s3://blobs/street/b.jpg")));
  EXPECT_TRUE(absl::IsNotFound(client_->LinkFile(DigestOf("b"), "s3://blobs/streets/b.jpg")));
}

TEST_F(GrantedBlobsTest, ALinkedObjectThatChangedIsNamed) {
  store_.SetObject("street/a.jpg", large_);
  ASSERT_TRUE(client_->LinkFile(DigestOf(large_), "s3://blobs/street/a.jpg").ok());
  for (const bool is_removed : {false, true}) {
    store_.SetObject("street/a.jpg", large_ + "other");
    if (is_removed) store_.RemoveObject("street/a.jpg");
    const absl::Status status = client_->Get(DigestOf(large_)).status();
    EXPECT_TRUE(absl::IsNotFound(status)) << status;
    EXPECT_THAT(std::string(status.message()),
                ::testing::HasSubstr(is_removed ? "s3://blobs/street/a.jpg was removed"
                                                : "s3://blobs/street/a.jpg was changed"));
  }
  store_.SetObject("street/a.jpg", large_);  // put back
  EXPECT_EQ(*client_->Get(DigestOf(large_)), large_);
}

TEST_F(GrantedBlobsTest, IsNotReadyWhenTheStoreIsNot) {
  EXPECT_TRUE(coordinator_->CheckReady().ok());
  store_.FailNext("", std::vector<StoreFault>(6, StoreFault::kServerError));
  const absl::Status status = coordinator_->CheckReady();
  EXPECT_TRUE(absl::IsUnavailable(status));
  EXPECT_THAT(std::string(status.message()), ::testing::HasSubstr("blobs: "));
}

TEST_F(GrantedBlobsTest, AnotherCoordinatorIsRefused) {
  CoordinatorOptions options{.state_dir = folder_ / "other"};
  options.objects = *S3Store::Make(*ParseS3Address(store_.Url("state")), store_.keys());
  EXPECT_TRUE(absl::IsFailedPrecondition(Coordinator::Open(options, clock_).status()));
  options.objects = *S3Store::Make(*ParseS3Address(store_.Url("other")), store_.keys());
  EXPECT_TRUE(Coordinator::Open(options, clock_).ok());
}

}  // namespace
}  // namespace orbweave
