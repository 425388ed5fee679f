// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/object_shelf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/memory_objects.h"

namespace orbweave {
namespace {

using testing::MemoryObjects;

constexpr double kDay_s = 86'400.0;

class ObjectShelfTest : public ::testing::Test {
 protected:
  absl::StatusOr<std::unique_ptr<ObjectShelf>> Open(const std::string& owner = "we") {
    return ObjectShelf::Open(store_, owner, [this] { return store_->now_unix_s; });
  }
  /// As a worker puts it.
  Digest Store(const std::string& bytes) {
    const Digest digest = DigestOf(bytes);
    store_->objects[digest.ToHex()] = {bytes, store_->now_unix_s};
    return digest;
  }
  static absl::StatusOr<std::string> Read(ObjectShelf& shelf, const Digest& digest) {
    std::string bytes;
    ORBWEAVE_RETURN_IF_ERROR(shelf.Read(digest, [&bytes](std::string_view piece) {
      bytes += piece;
      return absl::OkStatus();
    }));
    return bytes;
  }

  std::shared_ptr<MemoryObjects> store_ = std::make_shared<MemoryObjects>();
};

TEST_F(ObjectShelfTest, KnowsWhatIsThereAtItsStartWithoutAsking) {
  const Digest there = Store("there");
  store_->objects["check/1"] = {"no blob"};
  const auto shelf = *Open();
  EXPECT_TRUE(shelf->Use(there));
  EXPECT_FALSE(shelf->Use(DigestOf("not there")));
  EXPECT_EQ(store_->heads, 0);
  EXPECT_EQ(shelf->List().size(), 1U);
}

TEST_F(ObjectShelfTest, AsksForWhatItDoesNotKnowOnce) {
  const auto shelf = *Open();
  const Digest digest = Store("put by a worker");
  EXPECT_FALSE(shelf->Use(digest));
  EXPECT_TRUE(*shelf->Confirm(digest));
  EXPECT_TRUE(*shelf->Confirm(digest));
  EXPECT_TRUE(shelf->Use(digest));
  EXPECT_EQ(store_->heads, 1);
  EXPECT_FALSE(*shelf->Confirm(DigestOf("said to be there")));
  store_->is_away = true;
  EXPECT_TRUE(absl::IsUnavailable(shelf->Confirm(DigestOf("another")).status()));
}

TEST_F(ObjectShelfTest, IsForOneCoordinatorAlone) {
  ASSERT_TRUE(Open("we").ok());
  EXPECT_TRUE(Open("we").ok());
  const absl::Status other = Open("they").status();
  EXPECT_TRUE(absl::IsFailedPrecondition(other));
  EXPECT_THAT(std::string(other.message()), ::testing::HasSubstr("another coordinator"));
}

TEST_F(ObjectShelfTest, OpensNoStoreThatIsAway) {
  store_->is_away = true;
  EXPECT_TRUE(absl::IsUnavailable(Open().status()));
}

TEST_F(ObjectShelfTest, RemovesWhatIsDamaged) {
  const Digest digest = Store("right");
  const auto shelf = *Open();
  EXPECT_EQ(*Read(*shelf, digest), "right");
  store_->objects[digest.ToHex()].bytes = "wrong";
  EXPECT_TRUE(absl::IsDataLoss(Read(*shelf, digest).status()));
  EXPECT_FALSE(shelf->Use(digest));
  EXPECT_FALSE(store_->objects.contains(digest.ToHex()));  // or else it could not be put again
}

TEST_F(ObjectShelfTest, ForgetsWhatIsGone) {
  const Digest digest = Store("gone");
  const auto shelf = *Open();
  store_->objects.erase(digest.ToHex());
  EXPECT_TRUE(shelf->Use(digest));
  EXPECT_TRUE(absl::IsNotFound(Read(*shelf, digest).status()));
  EXPECT_FALSE(shelf->Use(digest));
  const int lists = store_->lists;
  ASSERT_TRUE(shelf->Refresh(300).ok());
  EXPECT_EQ(store_->lists, lists + 1);  // others may be gone as well
}

TEST_F(ObjectShelfTest, ANewListTellsWhatCameAndWent) {
  const Digest goes = Store("goes");
  const auto shelf = *Open();
  store_->objects.erase(goes.ToHex());
  const Digest comes = Store("comes");
  ASSERT_TRUE(shelf->Refresh().ok());
  EXPECT_FALSE(shelf->Use(goes));
  EXPECT_TRUE(shelf->Use(comes));
}

TEST_F(ObjectShelfTest, AListThatIsNewEnoughIsNotReadAgain) {
  const auto shelf = *Open();
  const int lists = store_->lists;
  ASSERT_TRUE(shelf->Refresh(300).ok());
  EXPECT_EQ(store_->lists, lists);
  store_->now_unix_s += 300;
  ASSERT_TRUE(shelf->Refresh(300).ok());
  EXPECT_EQ(store_->lists, lists + 1);
  ASSERT_TRUE(shelf->Refresh().ok());
  EXPECT_EQ(store_->lists, lists + 2);
}

TEST_F(ObjectShelfTest, AListDoesNotForgetWhatWasConfirmedMeanwhile) {
  const auto shelf = *Open();
  Digest digest;
  store_->on_list = [&] {
    digest = Store("put while it was read");
    EXPECT_TRUE(*shelf->Confirm(digest));
  };
  ASSERT_TRUE(shelf->Refresh().ok());
  EXPECT_TRUE(shelf->Use(digest));
}

TEST_F(ObjectShelfTest, RemovesWhatNobodyUsedForADay) {
  const Digest digest = Store("old");
  const auto shelf = *Open();
  EXPECT_FALSE(*shelf->RemoveUnused(digest, kDay_s));
  store_->now_unix_s += 80'000;
  EXPECT_FALSE(*shelf->RemoveUnused(digest, kDay_s));
  EXPECT_TRUE(shelf->Use(digest));
  store_->now_unix_s += 80'000;
  EXPECT_FALSE(*shelf->RemoveUnused(digest, kDay_s));  // used in between
  store_->now_unix_s += 80'000;
  EXPECT_TRUE(shelf->IsUnused(digest, kDay_s));
  EXPECT_TRUE(*shelf->RemoveUnused(digest, kDay_s));
  EXPECT_FALSE(shelf->Use(digest));
  EXPECT_FALSE(store_->objects.contains(digest.ToHex()));
}

TEST_F(ObjectShelfTest, AfterARestartTheTimeOfTheObjectCounts) {
  const Digest digest = Store("old");
  store_->now_unix_s += 80'000;
  EXPECT_FALSE(*(*Open())->RemoveUnused(digest, kDay_s));
  store_->now_unix_s += 80'000;
  EXPECT_TRUE(*(*Open())->RemoveUnused(digest, kDay_s));
}

TEST_F(ObjectShelfTest, NobodyGetsWhatIsBeingRemoved) {
  const Digest digest = Store("going");
  const auto shelf = *Open();
  store_->now_unix_s += 100'000;
  bool was_looked_at = false;
  store_->on_delete = [&] {
    was_looked_at = true;
    EXPECT_FALSE(shelf->Use(digest));
    EXPECT_TRUE(absl::IsUnavailable(shelf->Confirm(digest).status()));
    EXPECT_TRUE(absl::IsUnavailable(shelf->GrantPut(digest, 5, 600).status()));
    EXPECT_FALSE(shelf->GrantGet(digest, 600).has_value());
  };
  EXPECT_TRUE(*shelf->RemoveUnused(digest, kDay_s));
  EXPECT_TRUE(was_looked_at);
  EXPECT_TRUE(shelf->GrantPut(digest, 5, 600).ok());
}

TEST_F(ObjectShelfTest, ARemovalThatFailsIsAnError) {
  const Digest digest = Store("stays");
  const auto shelf = *Open();
  store_->now_unix_s += 100'000;
  store_->is_away = true;
  EXPECT_TRUE(absl::IsUnavailable(shelf->RemoveUnused(digest, kDay_s).status()));
  store_->is_away = false;
  ASSERT_TRUE(shelf->Refresh().ok());
  EXPECT_TRUE(shelf->Use(digest));
}

TEST_F(ObjectShelfTest, IsReadyWhenBytesCanBePutAndRead) {
  const auto shelf = *Open();
  const size_t objects = store_->objects.size();
  EXPECT_TRUE(shelf->Probe("one").ok());
  EXPECT_TRUE(shelf->Probe("another").ok());
  EXPECT_EQ(store_->objects.size(), objects + 1) << "probes do not pile up";
  EXPECT_EQ(shelf->List().size(), 0U) << "and are no blobs";
  store_->is_away = true;
  EXPECT_TRUE(absl::IsUnavailable(shelf->Probe("a third")));
}

TEST_F(ObjectShelfTest, AStoreThatAnswersAndTakesNothingIsNotReady) {
  const auto shelf = *Open();
  store_->is_read_only = true;
  EXPECT_TRUE(store_->Head("coordinator").ok());
  EXPECT_TRUE(absl::IsPermissionDenied(shelf->Probe("one")));
  store_->is_read_only = false;
  store_->loses_bytes = true;
  EXPECT_TRUE(absl::IsDataLoss(shelf->Probe("one")));
}

}  // namespace
}  // namespace orbweave
