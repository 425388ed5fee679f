// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/kept_blobs.h"

#include <gtest/gtest.h>

#include "tests/support/command.h"
#include "tests/support/memory_objects.h"

namespace orbweave {
namespace {

using testing::MemoryObjects;
using Where = BlobGrant::Where;

class KeptBlobsTest : public ::testing::Test {
 protected:
  KeptBlobs Open(std::shared_ptr<ObjectStore> objects) {
    auto opened = KeptBlobs::Open(folder_.Path(), std::move(objects));
    ORBWEAVE_CHECK(opened.ok());
    return *std::move(opened);
  }
  Digest Store(const std::string& bytes) {
    const Digest digest = DigestOf(bytes);
    store_->objects[digest.ToHex()] = {bytes, UnixNow()};
    return digest;
  }
  static Where WhereTo(KeptBlobs& blobs, const WantedBlob& blob, GrantVerb verb) {
    return blobs.Grant({blob}, verb, 600)->front().where;
  }

  testing::TemporaryFolder folder_;
  std::shared_ptr<MemoryObjects> store_ = std::make_shared<MemoryObjects>();
};

TEST_F(KeptBlobsTest, WithoutAnObjectStoreGrantsNothing) {
  KeptBlobs blobs = Open(nullptr);
  EXPECT_TRUE(blobs.Grant({{DigestOf("a"), 1 << 20}}, GrantVerb::kPut, 600)->empty());
  EXPECT_FALSE(*blobs.Confirm(DigestOf("a")));
  EXPECT_TRUE(blobs.Refresh().ok());
}

TEST_F(KeptBlobsTest, SmallOnesStayAndLargeOnesGoToTheStore) {
  KeptBlobs blobs = Open(store_);
  const Digest digest = DigestOf("a");
  EXPECT_EQ(WhereTo(blobs, {digest, kLeastObjectBytes - 1}, GrantVerb::kPut), Where::kCoordinator);
  EXPECT_EQ(WhereTo(blobs, {digest, kLeastObjectBytes}, GrantVerb::kPut), Where::kObject);
  EXPECT_EQ(WhereTo(blobs, {digest, kMostObjectBytes + 1}, GrantVerb::kPut), Where::kCoordinator);
}

TEST_F(KeptBlobsTest, WhatIsStoredIsNotPutAgain) {
  const Digest large = Store(std::string(100'000, 'a'));
  KeptBlobs blobs = Open(store_);
  EXPECT_EQ(WhereTo(blobs, {large, 100'000}, GrantVerb::kPut), Where::kNowhere);
  const Digest linked = *blobs.Put(std::string(100'000, 'b'));
  EXPECT_EQ(WhereTo(blobs, {linked, 100'000}, GrantVerb::kPut), Where::kNowhere);
}

TEST_F(KeptBlobsTest, GrantsReadingWhereItIs) {
  const Digest large = Store("in the store");
  KeptBlobs blobs = Open(store_);
  const Digest small = *blobs.Put("in the folder");
  EXPECT_EQ(WhereTo(blobs, {small}, GrantVerb::kGet), Where::kCoordinator);
  EXPECT_EQ(WhereTo(blobs, {DigestOf("nowhere")}, GrantVerb::kGet), Where::kCoordinator);
  const BlobGrant grant = blobs.Grant({{large}}, GrantVerb::kGet, 600)->front();
  EXPECT_EQ(grant.where, Where::kObject);
  EXPECT_EQ(grant.object.url, "get " + large.ToHex());
  EXPECT_EQ(*blobs.Get(large), "in the store");
  EXPECT_EQ(*blobs.Get(small), "in the folder");
  EXPECT_EQ(*blobs.StatBlobs({large, small, DigestOf("nowhere")}),
            (std::vector<bool>{true, true, false}));
}

TEST_F(KeptBlobsTest, AnswersAQuestionOfBoundedLengthInItsOrder) {
  const Digest large = Store("in the store");
  KeptBlobs blobs = Open(store_);
  const auto grants = blobs.Grant({{DigestOf("a")}, {large}}, GrantVerb::kGet, 600);
  ASSERT_EQ(grants->size(), 2U);
  EXPECT_EQ(grants->at(1).where, Where::kObject);
  const std::vector<WantedBlob> many(kMostGrants + 1);
  EXPECT_TRUE(absl::IsInvalidArgument(blobs.Grant(many, GrantVerb::kGet, 600).status()));
}

TEST_F(KeptBlobsTest, ListsAndRemovesBoth) {
  const Digest large = Store("in the store");
  KeptBlobs blobs = Open(store_);
  const Digest small = *blobs.Put("small");
  EXPECT_EQ(blobs.List()->size(), 2U);
  EXPECT_FALSE(*blobs.RemoveUnused(large, 1000.0));
  EXPECT_TRUE(*blobs.RemoveUnused(large, 0.0));
  EXPECT_TRUE(*blobs.RemoveUnused(small, 0.0));
  EXPECT_TRUE(blobs.List()->empty());
  EXPECT_FALSE(blobs.Has(large));
}

TEST_F(KeptBlobsTest, AListOfAStoreThatIsAwayIsNone) {
  KeptBlobs blobs = Open(store_);
  store_->is_away = true;
  EXPECT_TRUE(absl::IsUnavailable(blobs.List().status()));
  EXPECT_TRUE(absl::IsUnavailable(blobs.Probe("probe")));
}

TEST_F(KeptBlobsTest, TheStoreIsTheStates) {
  (void)Open(store_);
  (void)Open(store_);  // the same state
  const testing::TemporaryFolder other;
  EXPECT_TRUE(absl::IsFailedPrecondition(KeptBlobs::Open(other.Path(), store_).status()));
}

}  // namespace
}  // namespace orbweave
