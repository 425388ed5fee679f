// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/blob_cache.h"

#include <gtest/gtest.h>

#include <map>

namespace orbweave {
namespace {

/// Counts what it is asked for; away for the first `failures` calls.
class CountingBlobs final : public BlobAccess {
 public:
  absl::StatusOr<std::string> Get(const Digest& digest) override {
    ++gets;
    if (failures > 0) {
      --failures;
      return absl::UnavailableError("away");
    }
    const auto found = blobs.find(digest);
    if (found == blobs.end()) return absl::NotFoundError("no such blob");
    return found->second;
  }
  absl::StatusOr<Digest> Put(std::string_view bytes) override {
    blobs[DigestOf(bytes)] = bytes;
    return DigestOf(bytes);
  }

  int gets = 0;
  int failures = 0;
  std::map<Digest, std::string> blobs;
};

absl::StatusOr<Digest> PutText(BlobCache& cache, const std::string& text) {
  const Digest digest = DigestOf(text);
  ORBWEAVE_RETURN_IF_ERROR(cache.Put(digest, SharedBytes::Of(text)));
  return digest;
}

TEST(BlobCache, AsksOnceForWhatItKeeps) {
  CountingBlobs source;
  BlobCache cache(source, 100, {});
  const Digest digest = *source.Put("text");
  EXPECT_EQ(cache.Get(digest)->View(), "text");
  EXPECT_EQ(cache.Get(digest)->View(), "text");
  EXPECT_EQ(source.gets, 1);
}

TEST(BlobCache, KeepsWhatWasPut) {
  CountingBlobs source;
  BlobCache cache(source, 100, {});
  EXPECT_EQ(cache.Get(*PutText(cache, "text"))->View(), "text");
  EXPECT_EQ(source.gets, 0);
  EXPECT_EQ(source.blobs.size(), 1U);
}

TEST(BlobCache, KeepsNothingUnderAnothersName) {
  CountingBlobs source;
  BlobCache cache(source, 100, {});
  EXPECT_TRUE(absl::IsDataLoss(cache.Put(DigestOf("text"), SharedBytes::Of("other text"))));
  EXPECT_TRUE(absl::IsNotFound(cache.Get(DigestOf("text")).status()));
}

TEST(BlobCache, ForgetsWhatWasNotUsedForLongest) {
  CountingBlobs source;
  BlobCache cache(source, 10, {});
  const Digest a = *PutText(cache, "aaaa");
  const Digest b = *PutText(cache, "bbbb");
  EXPECT_TRUE(cache.Get(a).ok());
  EXPECT_TRUE(PutText(cache, "cccc").ok());  // b goes
  EXPECT_TRUE(cache.Get(a).ok());
  EXPECT_EQ(source.gets, 0);
  EXPECT_EQ(cache.Get(b)->View(), "bbbb");
  EXPECT_EQ(source.gets, 1);
}

TEST(BlobCache, PassesOnWhatIsTooLargeToKeep) {
  CountingBlobs source;
  BlobCache cache(source, 3, {});
  const Digest digest = *PutText(cache, "four");
  EXPECT_EQ(cache.Get(digest)->View(), "four");
  EXPECT_EQ(cache.Get(digest)->View(), "four");
  EXPECT_EQ(source.gets, 2);
}

TEST(BlobCache, WaitsForASourceThatIsAwayUntilToldToStop) {
  CountingBlobs source;
  std::stop_source stop;
  BlobCache cache(source, 100, stop.get_token());
  const Digest digest = *source.Put("text");
  source.failures = 1;
  EXPECT_EQ(cache.Get(digest)->View(), "text");
  EXPECT_EQ(source.gets, 2);
  stop.request_stop();
  source.failures = 1;
  EXPECT_TRUE(absl::IsUnavailable(cache.Get(DigestOf("other")).status()));
}

TEST(BlobCache, ReportsWhatNobodyHas) {
  CountingBlobs source;
  BlobCache cache(source, 100, {});
  EXPECT_TRUE(absl::IsNotFound(cache.Get(DigestOf("nothing")).status()));
}

}  // namespace
}  // namespace orbweave
