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
  KeptBlobs Open(std::shared_ptr<ObjectStore> objects, ObjectRoots roots = {}) {
    auto opened = KeptBlobs::Open(folder_.Path(), std::move(objects), std::move(roots));
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
  EXPECT_EQ(WhereTo(blobs, {digest, kMostPutBytes + 1}, GrantVerb::kPut), Where::kParts);
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

class LinkedObjectsTest : public KeptBlobsTest {
 protected:
  LinkedObjectsTest() { images_->objects["north/a.jpg"] = {"pixels", UnixNow()}; }
  ObjectRoots Roots() { return {{"s3://city/2026", images_}}; }

  const Digest pixels_ = DigestOf("pixels");
  std::shared_ptr<MemoryObjects> images_ = std::make_shared<MemoryObjects>();
};

TEST_F(LinkedObjectsTest, AreBlobsWithOrWithoutAStoreOfBlobs) {
  for (const auto& objects : {std::shared_ptr<MemoryObjects>(), store_}) {
    KeptBlobs blobs = Open(objects, Roots());
    ASSERT_TRUE(blobs.LinkFile(pixels_, "s3://city/2026/north/a.jpg").ok());
    EXPECT_TRUE(blobs.Has(pixels_));
    EXPECT_TRUE(blobs.Use(pixels_));
    EXPECT_TRUE(*blobs.Confirm(pixels_));
    EXPECT_TRUE(blobs.Verify(pixels_));
    EXPECT_EQ(*blobs.Get(pixels_), "pixels");
    const BlobGrant grant = blobs.Grant({{pixels_}}, GrantVerb::kGet, 600)->front();
    EXPECT_EQ(grant.where, Where::kObject);
    EXPECT_EQ(grant.object.url, "get north/a.jpg");
  }
  EXPECT_EQ(WhereTo(*std::make_unique<KeptBlobs>(Open(nullptr, Roots())),
                    {DigestOf("b"), kLeastObjectBytes},
                    GrantVerb::kPut),
            Where::kCoordinator);
}

TEST_F(LinkedObjectsTest, OutOfTheRootsNothingIsLinked) {
  images_->objects["../secret"] = {"pixels", UnixNow()};
  KeptBlobs blobs = Open(nullptr, Roots());
  for (const char* path : {"s3://city/2025/a.jpg", "s3://city/2026", "s3://city/20261/a", "s3://"})
    EXPECT_TRUE(absl::IsNotFound(blobs.LinkFile(pixels_, path))) << path;
  for (const char* path : {"s3://city/2026/../secret", "s3://city/2026//a", "s3://city/2026/./a"})
    EXPECT_TRUE(absl::IsInvalidArgument(blobs.LinkFile(pixels_, path))) << path;
  EXPECT_TRUE(absl::IsNotFound(blobs.LinkFile(pixels_, "s3://city/2026/missing.jpg")));
  EXPECT_FALSE(blobs.Has(pixels_));
}

TEST_F(LinkedObjectsTest, WhatChangedIsNamedAndFoundAgainWhenPutBack) {
  KeptBlobs blobs = Open(nullptr, Roots());
  ASSERT_TRUE(blobs.LinkFile(pixels_, "s3://city/2026/north/a.jpg").ok());
  images_->objects["north/a.jpg"].bytes = "other pixels";
  const absl::Status changed = blobs.Get(pixels_).status();
  EXPECT_TRUE(absl::IsNotFound(changed));
  EXPECT_NE(changed.message().find("s3://city/2026/north/a.jpg was changed"), std::string::npos);
  images_->objects.clear();
  const absl::Status removed = blobs.Get(pixels_).status();
  EXPECT_TRUE(absl::IsNotFound(removed));
  EXPECT_NE(removed.message().find("s3://city/2026/north/a.jpg was removed"), std::string::npos);
  images_->is_away = true;
  EXPECT_TRUE(absl::IsUnavailable(blobs.Get(pixels_).status()));
  images_->is_away = false;
  images_->objects["north/a.jpg"] = {"pixels", UnixNow()};
  EXPECT_EQ(*blobs.Get(pixels_), "pixels");
}

TEST_F(LinkedObjectsTest, WhoBringsTheBytesIsNotToldThatTheyAreThere) {
  KeptBlobs blobs = Open(store_, Roots());
  ASSERT_TRUE(blobs.LinkFile(pixels_, "s3://city/2026/north/a.jpg").ok());
  images_->objects.clear();
  EXPECT_FALSE(blobs.StatBlobs({pixels_})->front());
  EXPECT_EQ(WhereTo(blobs, {pixels_, kLeastObjectBytes}, GrantVerb::kPut), Where::kObject);
  ASSERT_TRUE(blobs.Put("pixels").ok());
  EXPECT_TRUE(blobs.StatBlobs({pixels_})->front());
  EXPECT_EQ(*blobs.Get(pixels_), "pixels");
  EXPECT_EQ(WhereTo(blobs, {pixels_}, GrantVerb::kGet), Where::kCoordinator);
}

TEST_F(LinkedObjectsTest, ACoordinatorWithoutTheRootSaysWhatItLacks) {
  ASSERT_TRUE(Open(nullptr, Roots()).LinkFile(pixels_, "s3://city/2026/north/a.jpg").ok());
  KeptBlobs blobs = Open(nullptr);
  const absl::Status status = blobs.Get(pixels_).status();
  EXPECT_TRUE(absl::IsNotFound(status));
  EXPECT_NE(status.message().find("--root"), std::string::npos) << status;
}

TEST_F(LinkedObjectsTest, GarbageIsTheLinkAndNeverTheObject) {
  KeptBlobs blobs = Open(store_, Roots());
  ASSERT_TRUE(blobs.LinkFile(pixels_, "s3://city/2026/north/a.jpg").ok());
  EXPECT_FALSE(*blobs.RemoveUnused(pixels_, 1000.0));
  EXPECT_TRUE(*blobs.RemoveUnused(pixels_, 0.0));
  EXPECT_FALSE(blobs.Has(pixels_));
  EXPECT_TRUE(images_->objects.contains("north/a.jpg"));
}

}  // namespace
}  // namespace orbweave
