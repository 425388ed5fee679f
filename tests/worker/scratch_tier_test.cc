// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/scratch_tier.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <thread>

#include "tests/support/command.h"

namespace orbweave {
namespace {

namespace fs = std::filesystem;

/// Counts how often each blob is read.
class CountingBlobs final : public BlobAccess {
 public:
  absl::StatusOr<std::string> Get(const Digest& digest) override {
    const std::lock_guard lock(mutex_);
    ++reads_[digest];
    const auto found = blobs_.find(digest);
    if (found == blobs_.end()) return absl::NotFoundError("no such blob");
    return found->second;
  }
  absl::StatusOr<Digest> Put(std::string_view bytes) override {
    const std::lock_guard lock(mutex_);
    blobs_[DigestOf(bytes)] = bytes;
    return DigestOf(bytes);
  }
  int ReadsOf(const Digest& digest) {
    const std::lock_guard lock(mutex_);
    return reads_[digest];
  }

 private:
  std::mutex mutex_;
  std::map<Digest, int> reads_;
  std::map<Digest, std::string> blobs_;
};

class ScratchTierTest : public ::testing::Test {
 protected:
  std::unique_ptr<ScratchTier> Make(uint64_t capacity_bytes) {
    auto made = ScratchTier::Make(source_, folder_ / "scratch", capacity_bytes);
    EXPECT_TRUE(made.ok()) << made.status();
    return *std::move(made);
  }
  Digest Store(char c, size_t size = 100) { return *source_.Put(std::string(size, c)); }
  std::vector<fs::path> Files() {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.Path()))
      if (entry.is_regular_file()) files.push_back(entry.path());
    return files;
  }

  testing::TemporaryFolder folder_;
  CountingBlobs source_;
};

TEST_F(ScratchTierTest, AsksOnceForWhatItKeepsAndGivesTheSameBytes) {
  const auto tier = Make(1 << 20);
  const Digest digest = Store('a', (1 << 19) + 7);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(*tier->Get(digest), std::string((1 << 19) + 7, 'a'));
  EXPECT_EQ(source_.ReadsOf(digest), 1);
  EXPECT_EQ(Files().size(), 1U);
}

TEST_F(ScratchTierTest, WhatWasUsedLongestAgoMakesRoom) {
  const auto tier = Make(250);
  const Digest a = Store('a');
  const Digest b = Store('b');
  const Digest c = Store('c');
  for (const Digest& digest : {a, b, a, c}) EXPECT_TRUE(tier->Get(digest).ok());
  EXPECT_EQ(Files().size(), 2U);
  EXPECT_TRUE(tier->Get(a).ok());
  EXPECT_EQ(source_.ReadsOf(a), 1) << "used after b";
  EXPECT_TRUE(tier->Get(b).ok());
  EXPECT_EQ(source_.ReadsOf(b), 2);
}

TEST_F(ScratchTierTest, WhatIsLargerThanAllOfItIsNotKept) {
  const auto tier = Make(250);
  const Digest small = Store('a');
  const Digest large = Store('b', 251);
  for (const Digest& digest : {small, large, large}) EXPECT_TRUE(tier->Get(digest).ok());
  EXPECT_EQ(source_.ReadsOf(large), 2);
  EXPECT_TRUE(tier->Get(small).ok());
  EXPECT_EQ(source_.ReadsOf(small), 1) << "it took nobody's room";
  EXPECT_EQ(Files().size(), 1U);
}

TEST_F(ScratchTierTest, DamagedAndRemovedFilesAreReadFromTheSourceAgain) {
  const auto tier = Make(1000);
  const Digest digest = Store('a');
  EXPECT_TRUE(tier->Get(digest).ok());
  testing::WriteAll(Files().front().string(), std::string(99, 'a') + "x");
  EXPECT_TRUE(absl::IsUnavailable(tier->Get(digest).status())) << "who reads comes again";
  EXPECT_EQ(*tier->Get(digest), std::string(100, 'a'));
  EXPECT_EQ(source_.ReadsOf(digest), 2);
  fs::remove(Files().front());
  EXPECT_EQ(*tier->Get(digest), std::string(100, 'a'));
  EXPECT_EQ(source_.ReadsOf(digest), 3);
}

TEST_F(ScratchTierTest, ADiskThatTakesNothingCostsNoReading) {
  const auto tier = Make(1000);
  const Digest digest = Store('a');
  fs::remove_all(folder_ / "scratch");
  for (int i = 0; i < 2; ++i) EXPECT_EQ(*tier->Get(digest), std::string(100, 'a'));
  EXPECT_EQ(source_.ReadsOf(digest), 2);
}

TEST_F(ScratchTierTest, ErrorsOfTheSourceLeaveNothing) {
  const auto tier = Make(1000);
  EXPECT_TRUE(absl::IsNotFound(tier->Get(DigestOf("nobody has it")).status()));
  const Digest digest = Store('a');
  const absl::Status refused =
      tier->Read(digest, [](std::string_view) { return absl::CancelledError("enough"); });
  EXPECT_TRUE(absl::IsCancelled(refused));
  EXPECT_TRUE(Files().empty());
}

TEST_F(ScratchTierTest, ManyMayReadAtOnce) {
  const auto tier = Make(300);
  std::vector<Digest> digests;
  for (const char c : {'a', 'b', 'c', 'd', 'e'}) digests.push_back(Store(c));
  {
    std::vector<std::jthread> readers;
    for (int reader = 0; reader < 4; ++reader) {
      readers.emplace_back([&] {
        for (int i = 0; i < 200; ++i) {
          const auto bytes = tier->Get(digests[i % digests.size()]);
          EXPECT_TRUE(bytes.ok() && DigestOf(*bytes) == digests[i % digests.size()]);
        }
      });
    }
  }
  EXPECT_LE(Files().size(), 3U);
}

TEST_F(ScratchTierTest, GoesWithItsWorker) {
  Make(1000).reset();
  EXPECT_TRUE(fs::is_empty(folder_ / "scratch"));
  testing::WriteAll(folder_ / "file", "x");
  EXPECT_FALSE(ScratchTier::Make(source_, folder_ / "file/below", 10).ok());
}

}  // namespace
}  // namespace orbweave
