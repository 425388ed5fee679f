// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// A coordinator with an object store, and a caller without keys to it, over a real connection.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coordinator/coordinator.h"
#include "coordinator/grpc/grpc_server.h"
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
    options.object_limits = limits_;
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

  explicit GrantedBlobsTest(testing::FaultStoreOptions options = {}, ObjectLimits limits = {})
      : store_(std::move(options)), limits_(limits) {}

  const std::string large_ = std::string(200'000, 'a') + "b";
  TemporaryFolder folder_;
  FaultStore store_;
  const ObjectLimits limits_;
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

/// A store that takes less by one request than blobs have.
class BlobsInParts : public GrantedBlobsTest {
 protected:
  explicit BlobsInParts(testing::FaultStoreOptions options = {})
      : GrantedBlobsTest(Small(std::move(options)), {.put_bytes = 150'000, .part_bytes = 66'000}) {}

  static testing::FaultStoreOptions Small(testing::FaultStoreOptions options) {
    options.most_put_bytes = 150'000;
    options.least_part_bytes = 66'000;
    return options;
  }
  /// Bytes that are nowhere the same.
  static std::string Bytes(size_t size) {
    std::string bytes;
    for (uint32_t i = 0; bytes.size() < size; ++i) bytes += std::to_string(i) + " ";
    return bytes.substr(0, size);
  }
  void ExpectStored(const std::string& bytes) {
    const auto digest = client_->Put(bytes);
    ASSERT_TRUE(digest.ok()) << digest.status();
    EXPECT_EQ(store_.Objects().at(KeyOf(*digest)), bytes);
    EXPECT_EQ(store_.CountUploads(), 0U) << "nothing is left half done";
    ASSERT_TRUE(coordinator_->SubmitJob({.kind = "toy", .inputs = {*digest}}).ok());
    EXPECT_EQ(*client_->Get(*digest), bytes);
  }
};

TEST_F(BlobsInParts, AreOneObjectInTheEnd) {
  ExpectStored(Bytes(200'001));
  EXPECT_EQ(store_.Count("PUT"), 1U + 4U) << "whose the store is, and four parts";
  ExpectStored(Bytes(198'000));  // whole parts
  EXPECT_EQ(store_.Count("PUT"), 1U + 4U + 3U);
  ExpectStored(Bytes(150'000));  // what one request takes
  EXPECT_EQ(store_.Count("PUT"), 1U + 4U + 3U + 1U);
  EXPECT_EQ(coordinator_->blob_traffic().bytes_in, 0U);
}

TEST_F(BlobsInParts, APartThatFailsIsTriedAgainByItself) {
  store_.FailNext("PUT", {StoreFault::kSlowDown, StoreFault::kCutBody, StoreFault::kServerError});
  ExpectStored(Bytes(300'000));
  EXPECT_EQ(store_.Count("PUT"), 1U + 5U + 3U);
}

TEST_F(BlobsInParts, WhatIsNotWhatItIsNamedLeavesNothing) {
  const std::string bytes = Bytes(300'000);
  const absl::Status other = client_->Write(DigestOf("another"), bytes.size(), PiecesOf(bytes));
  EXPECT_TRUE(absl::IsDataLoss(other)) << other;
  const absl::Status shorter = client_->Write(DigestOf(bytes), bytes.size() + 1, PiecesOf(bytes));
  EXPECT_TRUE(absl::IsDataLoss(shorter)) << shorter;
  EXPECT_EQ(CountBlobs(), 0U);
  EXPECT_EQ(store_.CountUploads(), 0U);
}

TEST_F(BlobsInParts, WhoeverBringsItThatBreaksOffLeavesNothing) {
  int pieces = 0;
  const absl::Status broken =
      client_->Write(DigestOf("x"), 300'000, [&]() -> absl::StatusOr<std::string_view> {
        if (++pieces > 100) return absl::CancelledError("enough");
        return "1000 bytes or so";
      });
  EXPECT_TRUE(absl::IsCancelled(broken)) << broken;
  EXPECT_EQ(store_.CountUploads(), 0U);
}

TEST_F(BlobsInParts, AStoreThatIsAwayForLongIsUnavailable) {
  store_.FailNext("PUT", std::vector<StoreFault>(6, StoreFault::kSlowDown));
  EXPECT_TRUE(absl::IsUnavailable(client_->Put(Bytes(300'000)).status()));
  EXPECT_EQ(store_.CountUploads(), 0U);
  ExpectStored(Bytes(300'000));
}

TEST_F(BlobsInParts, GarbageIsWhatCameOfUploadsThatNobodyEnded) {
  const auto store = *S3Store::Make(*ParseS3Address(store_.Url("state")), store_.keys());
  ASSERT_TRUE(store->BeginUpload(DigestOf("a").ToHex()).ok());
  EXPECT_TRUE(client_->CollectGarbage({}).ok());
  EXPECT_EQ(store_.CountUploads(), 1U) << "it may be going on";
  store_.AgeUploads(100'000);
  const auto other = *S3Store::Make(*ParseS3Address(store_.Url("other")), store_.keys());
  ASSERT_TRUE(other->BeginUpload("theirs").ok());
  store_.AgeUploads(100'000);
  EXPECT_TRUE(client_->CollectGarbage({.dry_run = true}).ok());
  EXPECT_EQ(store_.CountUploads(), 2U);
  EXPECT_TRUE(client_->CollectGarbage({}).ok());
  EXPECT_EQ(store_.CountUploads(), 1U) << "that of another prefix";
}

TEST_F(BlobsInParts, TwoMayBringTheSame) {
  const auto store = *S3Store::Make(*ParseS3Address(store_.Url("state")), store_.keys());
  const std::string bytes = Bytes(300'000);
  const std::string key = DigestOf(bytes).ToHex();
  const std::string upload = *store->BeginUpload(key);
  ASSERT_TRUE(client_->Put(bytes).ok());
  EXPECT_EQ(store_.CountUploads(), 1U);
  EXPECT_TRUE(store->FinishUpload(key, upload, {}).ok()) << "the other was first";
  EXPECT_EQ(store_.CountUploads(), 0U);
  EXPECT_TRUE(store->FinishUpload(key, upload, {}).ok()) << "an answer that was lost";
  EXPECT_TRUE(absl::IsNotFound(store->FinishUpload("nothing", upload, {})));
  EXPECT_EQ(store_.Objects().at(KeyOf(DigestOf(bytes))), bytes);
}

class BlobsInPartsWithFaults : public BlobsInParts {
 protected:
  BlobsInPartsWithFaults()
      : BlobsInParts({.knows_conditions = false, .slow_down_share = 0.1, .cut_share = 0.05}) {}
};

TEST_F(BlobsInPartsWithFaults, ComeThrough) {
  for (size_t size = 200'000; size < 220'000; size += 1000) ExpectStored(Bytes(size));
  EXPECT_GT(store_.Faults(), 5U);
}

TEST(ObjectLimits, PartsAreAsManyAsAServerTakes) {
  const ObjectLimits usual;
  EXPECT_EQ(usual.PartBytesOf(usual.put_bytes + 1), uint64_t{64} << 20);
  const uint64_t most = uint64_t{5} << 40;
  EXPECT_LE(most / usual.PartBytesOf(most), kMostParts);
  EXPECT_LE(usual.PartBytesOf(most), kMostPutBytes);
}

}  // namespace
}  // namespace orbweave
