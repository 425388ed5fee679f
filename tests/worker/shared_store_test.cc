// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/shared_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/command.h"
#include "tests/support/memory_blobs.h"

namespace orbweave {
namespace {

using testing::TemporaryFolder;

/// A coordinator that can be away, whose blobs lie in a folder.
class FolderCoordinator final : public BlobAccess {
 public:
  explicit FolderCoordinator(const std::string& folder) : store_(*BlobStore::Open(folder)) {}

  absl::StatusOr<std::string> Get(const Digest& digest) override {
    ++calls;
    if (is_away) return absl::UnavailableError("away");
    return store_.Get(digest);
  }
  absl::StatusOr<Digest> Put(std::string_view bytes) override {
    ++calls;
    return store_.Put(bytes);
  }

  int calls = 0;
  bool is_away = false;

 private:
  BlobStore store_;
};

class SharedStoreTest : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
  FolderCoordinator coordinator_{folder_ / "blobs"};
};

std::vector<std::string> FilesIn(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path().filename().string());
  }
  return files;
}

TEST_F(SharedStoreTest, WithoutAFolderItIsTheCoordinator) {
  SharedStore store(coordinator_, "");
  EXPECT_TRUE(store.Check().ok());
  EXPECT_EQ(coordinator_.calls, 0);
  const Digest digest = *store.Put("text");
  EXPECT_EQ(*store.Get(digest), "text");
  EXPECT_TRUE(store.Write(DigestOf("more"), 4, PiecesOf("more")).ok());
  EXPECT_EQ(coordinator_.calls, 3);
}

TEST_F(SharedStoreTest, ReadsAndWritesPastTheCoordinator) {
  SharedStore store(coordinator_, folder_ / "blobs");
  ASSERT_TRUE(store.Check().ok());
  coordinator_.calls = 0;
  EXPECT_TRUE(store.Write(DigestOf("text"), 4, PiecesOf("text")).ok());
  std::string back;
  const auto take = [&back](std::string_view piece) {
    back += piece;
    return absl::OkStatus();
  };
  EXPECT_TRUE(store.Read(*store.Put("more"), take).ok());
  EXPECT_EQ(back, "more");
  EXPECT_EQ(coordinator_.calls, 0);
  EXPECT_EQ(*coordinator_.Get(DigestOf("text")), "text");
}

TEST_F(SharedStoreTest, AsksTheCoordinatorForWhatTheFolderLacks) {
  testing::MemoryBlobs elsewhere;
  const Digest digest = *elsewhere.Put("text");
  ASSERT_TRUE(BlobStore::Open(folder_ / "other").ok());
  SharedStore unchecked(elsewhere, folder_ / "other");
  EXPECT_TRUE(absl::IsFailedPrecondition(unchecked.Check()));
  EXPECT_EQ(*unchecked.Get(digest), "text");
  EXPECT_TRUE(absl::IsNotFound(unchecked.Get(DigestOf("nothing")).status()));
}

TEST_F(SharedStoreTest, RefusesTheFolderOfAnotherCoordinator) {
  ASSERT_TRUE(BlobStore::Open(folder_ / "other").ok());
  SharedStore store(coordinator_, folder_ / "other");
  const absl::Status status = store.Check();
  EXPECT_TRUE(absl::IsFailedPrecondition(status)) << status;
  EXPECT_THAT(std::string(status.message()), ::testing::HasSubstr(folder_ / "other"));
  EXPECT_TRUE(absl::IsNotFound(SharedStore(coordinator_, folder_ / "none").Check()));
}

TEST_F(SharedStoreTest, CheckingLeavesNothingBehind) {
  SharedStore store(coordinator_, folder_ / "blobs");
  ASSERT_TRUE(store.Check().ok());
  ASSERT_TRUE(store.Check().ok());
  EXPECT_THAT(FilesIn(folder_ / "blobs"), ::testing::IsEmpty());
}

TEST_F(SharedStoreTest, ACoordinatorThatIsAwayIsNoOther) {
  SharedStore store(coordinator_, folder_ / "blobs");
  coordinator_.is_away = true;
  EXPECT_TRUE(absl::IsUnavailable(store.Check()));
  coordinator_.is_away = false;
  EXPECT_TRUE(store.Check().ok());
}

TEST_F(SharedStoreTest, NoticesDamageInTheFolder) {
  SharedStore store(coordinator_, folder_ / "blobs");
  ASSERT_TRUE(store.Check().ok());
  const std::string hex = (*store.Put("precious")).ToHex();
  std::ofstream(folder_ / ("blobs/" + hex.substr(0, 2) + "/" + hex)) << "presious";
  EXPECT_TRUE(absl::IsDataLoss(store.Get(DigestOf("precious")).status()));
  EXPECT_TRUE(store.Put("precious").ok());
  EXPECT_EQ(*store.Get(DigestOf("precious")), "precious");
}

}  // namespace
}  // namespace orbweave
