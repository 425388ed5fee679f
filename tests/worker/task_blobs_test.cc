// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/task_blobs.h"

#include <gtest/gtest.h>

#include <atomic>
#include <barrier>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/memory_blobs.h"

namespace orbweave {
namespace {

/// Takes blobs in batches: the first of a batch is stored when the last has come.
class BatchingBlobs final : public BlobAccess {
 public:
  explicit BatchingBlobs(std::ptrdiff_t batch) : batch_(batch) {}

  absl::StatusOr<std::string> Get(const Digest& digest) override { return blobs_.Get(digest); }
  absl::StatusOr<Digest> Put(std::string_view bytes) override {
    ++came;
    batch_.arrive_and_wait();
    return blobs_.Put(bytes);
  }

  std::atomic<size_t> came = 0;

 private:
  std::barrier<> batch_;
  testing::MemoryBlobs blobs_;
};

/// Has no room for what begins with "bad".
class PickyBlobs final : public BlobAccess {
 public:
  absl::StatusOr<std::string> Get(const Digest& digest) override { return blobs_.Get(digest); }
  absl::StatusOr<Digest> Put(std::string_view bytes) override {
    if (bytes.starts_with("bad")) return absl::ResourceExhaustedError(std::string(bytes));
    return blobs_.Put(bytes);
  }

 private:
  testing::MemoryBlobs blobs_;
};

Digest PutText(TaskBlobs& blobs, const std::string& text) {
  const Digest digest = DigestOf(text);
  blobs.Put(digest, SharedBytes::Of(text));
  return digest;
}

TEST(TaskBlobs, StoresSeveralAtATime) {
  BatchingBlobs store(TaskBlobs::kMostOnTheirWay);
  BlobCache cache(store, 0, {});
  TaskBlobs blobs(cache);
  std::vector<Digest> digests;
  for (size_t i = 0; i < 3 * TaskBlobs::kMostOnTheirWay; ++i)
    digests.push_back(PutText(blobs, std::to_string(i)));
  EXPECT_TRUE(blobs.Settle().ok());
  for (const Digest& digest : digests) EXPECT_TRUE(store.Get(digest).ok());
}

TEST(TaskBlobs, LetsNoMoreThanThatBeOnTheirWay) {
  BatchingBlobs store(TaskBlobs::kMostOnTheirWay + 1);  // more than ever come by themselves
  BlobCache cache(store, 0, {});
  std::optional<TaskBlobs> blobs(cache);
  std::atomic<bool> waited = false;
  const std::jthread task([&] {
    for (size_t i = 0; i < TaskBlobs::kMostOnTheirWay; ++i) PutText(*blobs, std::to_string(i));
    waited = true;
    PutText(*blobs, "one too many");
    EXPECT_TRUE(blobs->Settle().ok());
  });
  while (!waited || store.came < TaskBlobs::kMostOnTheirWay) std::this_thread::yield();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(store.came, TaskBlobs::kMostOnTheirWay);
  std::vector<std::jthread> others;  // fill the batch with it, and the one after that
  for (size_t i = 0; i < TaskBlobs::kMostOnTheirWay + 1; ++i)
    others.emplace_back([&store] { (void)store.Put("another's"); });
}

TEST(TaskBlobs, TellsTheFirstErrorInTheOrderOfPutting) {
  PickyBlobs store;
  BlobCache cache(store, 0, {});
  TaskBlobs blobs(cache);
  const Digest good = PutText(blobs, "good");
  PutText(blobs, "bad first");
  PutText(blobs, "bad second");
  EXPECT_EQ(blobs.Settle(), absl::ResourceExhaustedError("bad first"));
  PutText(blobs, "good later");
  EXPECT_EQ(blobs.Settle(), absl::ResourceExhaustedError("bad first")) << "not all is stored";
  EXPECT_TRUE(store.Get(good).ok());
}

TEST(TaskBlobs, GetsWhatIsStillOnItsWay) {
  testing::MemoryBlobs store;
  BlobCache cache(store, 0, {});
  TaskBlobs blobs(cache);
  for (int i = 0; i < 100; ++i) {
    const std::string text = "blob " + std::to_string(i);
    EXPECT_EQ(blobs.Get(PutText(blobs, text))->View(), text);
  }
  EXPECT_TRUE(absl::IsNotFound(blobs.Get(DigestOf("nothing")).status()));
}

TEST(TaskBlobs, WaitsForWhatIsOnItsWayWhenItGoes) {
  testing::MemoryBlobs store;
  BlobCache cache(store, 0, {});
  Digest digest;
  {
    TaskBlobs blobs(cache);
    digest = PutText(blobs, "text");
  }
  EXPECT_TRUE(store.Get(digest).ok());
}

}  // namespace
}  // namespace orbweave
