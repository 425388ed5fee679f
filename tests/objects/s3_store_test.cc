// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "objects/s3_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "objects/granted_object.h"
#include "tests/support/fault_store.h"

namespace orbweave {
namespace {

using testing::FaultStore;
using testing::FaultStoreOptions;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::StoreFault;

std::unique_ptr<S3Store> Open(const FaultStore& server, UnixClock clock = UnixNow) {
  auto store = S3Store::Make(
      *ParseS3Address(server.Url("a/b")), server.keys(), {.stall_s = 2.0}, std::move(clock));
  ORBWEAVE_CHECK(store.ok());
  return *std::move(store);
}

absl::StatusOr<std::string> Read(ObjectStore& store,
                                 const std::string& key,
                                 const std::optional<ByteRange>& range = std::nullopt) {
  std::string bytes;
  ORBWEAVE_RETURN_IF_ERROR(store.Get(key, range, [&bytes](std::string_view piece) {
    bytes += piece;
    return absl::OkStatus();
  }));
  return bytes;
}

/// Bytes that differ everywhere.
std::string Bytes(size_t size) {
  std::string bytes;
  for (size_t i = 0; bytes.size() < size; ++i) bytes += std::to_string(i) + " ";
  return bytes.substr(0, size);
}

absl::Status Put(ObjectStore& store, const std::string& key, const std::string& bytes) {
  return store.Put(key, DigestOf(bytes), bytes);
}

TEST(S3Store, GivesWhatWasPut) {
  FaultStore server;
  const auto store = Open(server);
  for (const size_t size : {0U, 1U, 70'000U, 3'000'000U}) {
    const std::string key = std::to_string(size);
    const std::string bytes = Bytes(size);
    ASSERT_TRUE(Put(*store, key, bytes).ok());
    EXPECT_EQ(*Read(*store, key), bytes);
    EXPECT_EQ(store->Head(key)->size_bytes, size);
    EXPECT_NEAR(static_cast<double>(store->Head(key)->modified_unix_s),
                static_cast<double>(UnixNow()),
                60.0);
    EXPECT_TRUE(server.Objects().contains("a/b/" + key));
  }
  EXPECT_EQ(*Read(*store, "70000", ByteRange{10, 19}), Bytes(70'000).substr(10, 10));
}

TEST(S3Store, DoesNotWriteOverWhatIsThere) {
  FaultStore server;
  const auto store = Open(server);
  ASSERT_TRUE(Put(*store, "key", "first").ok());
  EXPECT_TRUE(Put(*store, "key", "second").ok());
  EXPECT_EQ(*Read(*store, "key"), "first");
}

TEST(S3Store, WritesWhereTheServerKnowsNoConditions) {
  FaultStore server({.knows_conditions = false});
  const auto store = Open(server);
  ASSERT_TRUE(Put(*store, "key", "bytes").ok());
  ASSERT_TRUE(Put(*store, "key", "bytes").ok());
  EXPECT_EQ(*Read(*store, "key"), "bytes");
  EXPECT_EQ(server.Count("PUT"), 3U);  // only the first one is asked twice
}

TEST(S3Store, SaysThatAKeyIsMissing) {
  FaultStore server;
  const auto store = Open(server);
  EXPECT_TRUE(absl::IsNotFound(Read(*store, "missing").status()));
  EXPECT_TRUE(absl::IsNotFound(store->Head("missing").status()));
  EXPECT_TRUE(store->Delete("missing").ok());
}

TEST(S3Store, ListsPageAfterPage) {
  FaultStore server({.page_keys = 2});
  const auto store = Open(server);
  for (const char* key : {"a", "b c", "d", "e", "f"}) ASSERT_TRUE(Put(*store, key, key).ok());
  server.SetObject("a/bc", "of another prefix");
  server.SetObject("z", "of another prefix");
  std::vector<std::string> keys;
  const std::vector<ObjectInfo> listed = *store->List();
  for (const ObjectInfo& object : listed) keys.push_back(object.key);
  EXPECT_THAT(keys, ::testing::ElementsAre("a", "b c", "d", "e", "f"));
  ASSERT_TRUE(store->Delete("d").ok());
  EXPECT_EQ(store->List()->size(), 4U);
}

TEST(S3Store, ListsAPageAtATimeUntilItIsTaken) {
  FaultStore server({.page_keys = 2});
  const auto store = Open(server);
  for (const char* key : {"a", "b", "c", "d", "e"}) ASSERT_TRUE(Put(*store, key, key).ok());
  std::vector<size_t> pages;
  ASSERT_TRUE(store
                  ->ListPages([&](const std::vector<ObjectInfo>& page) {
                    pages.push_back(page.size());
                    return absl::OkStatus();
                  })
                  .ok());
  EXPECT_THAT(pages, ::testing::ElementsAre(2, 2, 1));
  const uint64_t before = server.Count("GET");
  const auto refuse = [](const std::vector<ObjectInfo>&) { return absl::CancelledError("enough"); };
  EXPECT_TRUE(absl::IsCancelled(store->ListPages(refuse)));
  EXPECT_EQ(server.Count("GET"), before + 1);
}

TEST(S3Store, ReadsTheVersionThatWasListedOrNone) {
  FaultStore server;
  const auto store = Open(server);
  const std::string bytes = Bytes(2'000'000);
  ASSERT_TRUE(Put(*store, "key", bytes).ok());
  const std::string etag = store->List()->front().etag;
  const auto read = [&](const std::string& version) {
    std::string read_bytes;
    const absl::Status status = store->GetVersion("key", version, [&](std::string_view piece) {
      read_bytes += piece;
      return absl::OkStatus();
    });
    return status.ok() ? absl::StatusOr<std::string>(read_bytes) : status;
  };
  EXPECT_EQ(*read(etag), bytes);
  EXPECT_EQ(*read(""), bytes);  // of a server that tells no versions
  server.SetObject("a/b/key", Bytes(1'000'000) + Bytes(1'000'000));
  const absl::Status changed = read(etag).status();
  EXPECT_TRUE(absl::IsAborted(changed)) << changed;
  EXPECT_THAT(std::string(changed.message()), HasSubstr("s3://blobs/a/b/key"));
  server.RemoveObject("a/b/key");
  EXPECT_TRUE(absl::IsNotFound(read(etag).status()));
}

TEST(S3Store, ListsAnEmptyStore) {
  FaultStore server;
  EXPECT_TRUE(Open(server)->List()->empty());
}

TEST(S3Store, OutlastsFaultsThatPass) {
  FaultStore server;
  const auto store = Open(server);
  const std::string bytes = Bytes(1'000'000);
  const std::vector<StoreFault> faults = {
      StoreFault::kSlowDown, StoreFault::kCutBody, StoreFault::kServerError};
  server.FailNext("PUT", {StoreFault::kSlowDown, StoreFault::kCutBody, StoreFault::kConflict});
  ASSERT_TRUE(Put(*store, "key", bytes).ok());
  server.FailNext("GET", faults);
  EXPECT_EQ(*Read(*store, "key"), bytes);
  server.FailNext("HEAD", {StoreFault::kSlowDown, StoreFault::kServerError});
  EXPECT_EQ(store->Head("key")->size_bytes, bytes.size());
  server.FailNext("GET", faults);
  EXPECT_EQ(store->List()->size(), 1U);
  server.FailNext("DELETE", {StoreFault::kSlowDown});
  EXPECT_TRUE(store->Delete("key").ok());
  EXPECT_EQ(server.Faults(), 12U);
}

TEST(S3Store, GoesOnWithABodyWhereItWasCut) {
  FaultStore server;
  const auto store = Open(server);
  const std::string bytes = Bytes(2'000'000);
  ASSERT_TRUE(Put(*store, "key", bytes).ok());
  server.FailNext("GET", {StoreFault::kCutBody, StoreFault::kCutBody});
  size_t taken = 0;
  ASSERT_TRUE(store
                  ->Get("key",
                        std::nullopt,
                        [&](std::string_view piece) {
                          EXPECT_EQ(piece, std::string_view(bytes).substr(taken, piece.size()));
                          taken += piece.size();
                          return absl::OkStatus();
                        })
                  .ok());
  EXPECT_EQ(taken, bytes.size());  // none of them twice
  server.FailNext("GET", {StoreFault::kCutBody});
  EXPECT_EQ(*Read(*store, "key", ByteRange{1000, 1'999'999}), bytes.substr(1000));
}

TEST(S3Store, TakesNoBytesTwiceOfAServerThatGivesNoRanges) {
  FaultStore server({.gives_ranges = false});
  const auto store = Open(server);
  ASSERT_TRUE(Put(*store, "key", Bytes(2'000'000)).ok());
  server.FailNext("GET", {StoreFault::kCutBody});
  EXPECT_TRUE(absl::IsUnavailable(Read(*store, "key").status()));
}

TEST(S3Store, GivesUpAfterAWhile) {
  FaultStore server({.slow_down_share = 1.0});
  const absl::Status status = Read(*Open(server), "key").status();
  EXPECT_TRUE(absl::IsUnavailable(status));
  EXPECT_THAT(std::string(status.message()), HasSubstr("503 SlowDown"));
  EXPECT_EQ(server.Count("GET"), static_cast<uint64_t>(kMostAttempts));
}

TEST(S3Store, RefusalsAreFinalAndTellNoSecret) {
  FaultStore server;
  S3Keys wrong = server.keys();
  wrong.secret_key = "SECRET of another";
  const auto store = *S3Store::Make(*ParseS3Address(server.Url("a")), wrong);
  const absl::Status status = Read(*store, "key").status();
  EXPECT_TRUE(absl::IsPermissionDenied(status)) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr("SignatureDoesNotMatch"));
  EXPECT_THAT(std::string(status.message()), Not(HasSubstr("SECRET")));
  EXPECT_THAT(std::string(status.message()), Not(HasSubstr("X-Amz")));
  EXPECT_EQ(server.Count("GET"), 1U);
}

TEST(S3Store, NamesAClockThatIsWrong) {
  FaultStore behind({.clock_ahead_s = -3600});
  FaultStore ahead({.clock_ahead_s = 3600});
  EXPECT_THAT(std::string(Read(*Open(behind), "key").status().message()),
              HasSubstr("ahead of the store's"));
  EXPECT_THAT(std::string(Read(*Open(ahead), "key").status().message()),
              HasSubstr("behind the store's"));
}

TEST(S3Store, IsUnavailableWhenNobodyListens) {
  std::string url;
  {
    FaultStore server;
    url = server.Url("a");
  }
  const auto store = *S3Store::Make(*ParseS3Address(url), {.access_key = "a", .secret_key = "b"});
  EXPECT_TRUE(absl::IsUnavailable(store->Delete("key")));
}

TEST(HttpClient, GivesUpAServerThatStalls) {
  FaultStore server({.delay_s = 5.0});
  const auto store = Open(server);
  const auto http = *HttpClient::Make({.stall_s = 1.0});
  const auto began = std::chrono::steady_clock::now();
  EXPECT_TRUE(absl::IsUnavailable(http->Do({.url = store->GrantGet("key", 600).url}).status()));
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(4));
}

TEST(S3Store, RefusesBytesOfAnotherDigest) {
  FaultStore server;
  const auto store = Open(server);
  EXPECT_TRUE(absl::IsDataLoss(store->Put("key", DigestOf("other"), "bytes")));
  EXPECT_TRUE(server.Objects().empty());
}

class GrantTest : public ::testing::Test {
 protected:
  absl::Status Write(const ObjectGrant& grant, const std::string& bytes) {
    return WriteGranted(*http_, grant, bytes.size(), "blob", PiecesOf(bytes));
  }

  FaultStore server_;
  std::unique_ptr<S3Store> store_ = Open(server_);
  std::unique_ptr<HttpClient> http_ = *HttpClient::Make({.stall_s = 1.0});
};

TEST_F(GrantTest, IsForOneKeyTheseBytesAndThisVerb) {
  const ObjectGrant put = store_->GrantPut("key", DigestOf("bytes"), 5, 600);
  EXPECT_TRUE(absl::IsDataLoss(Write(put, "other")));
  EXPECT_FALSE(Write(put, "bytes and more").ok());
  ObjectGrant elsewhere = put;
  elsewhere.url.replace(elsewhere.url.find("/key?"), 5, "/kez?");
  EXPECT_TRUE(absl::IsPermissionDenied(Write(elsewhere, "bytes")));
  ObjectGrant other_hash = put;
  for (std::string& header : other_hash.headers) {
    if (header.starts_with("x-amz-content-sha256"))
      header = "x-amz-content-sha256: " + DigestOf("other").ToHex();
  }
  EXPECT_TRUE(absl::IsPermissionDenied(Write(other_hash, "other")));
  const ObjectGrant get = store_->GrantGet("key", 600);
  EXPECT_TRUE(absl::IsPermissionDenied(Write(get, "bytes")));
  EXPECT_TRUE(server_.Objects().empty());
  EXPECT_TRUE(Write(put, "bytes").ok());
  EXPECT_TRUE(Write(put, "bytes").ok());  // a repeat is no error
  EXPECT_EQ(http_->Do({.url = get.url, .headers = get.headers})->body, "bytes");
  EXPECT_EQ(http_->Do({.method = "DELETE", .url = get.url})->status, 403);
}

TEST_F(GrantTest, EndsInTime) {
  ASSERT_TRUE(Put(*store_, "key", "bytes").ok());
  const ObjectGrant old = Open(server_, [] { return UnixNow() - 700; })->GrantGet("key", 600);
  EXPECT_EQ(http_->Do({.url = old.url})->status, 403);
  const ObjectGrant fresh = Open(server_, [] { return UnixNow() - 500; })->GrantGet("key", 600);
  EXPECT_EQ(http_->Do({.url = fresh.url})->status, 200);
}

TEST_F(GrantTest, AnErrorOfTheReaderEndsTheReading) {
  ASSERT_TRUE(Put(*store_, "key", Bytes(2'000'000)).ok());
  int pieces = 0;
  const auto take = [&](std::string_view) {
    ++pieces;
    return absl::ResourceExhaustedError("full");
  };
  EXPECT_TRUE(absl::IsResourceExhausted(store_->Get("key", std::nullopt, take)));
  EXPECT_EQ(pieces, 1);
}

TEST_F(GrantTest, AnErrorOfTheWriterStoresNothing) {
  const std::string bytes = Bytes(1'000'000);
  const ObjectGrant put = store_->GrantPut("key", DigestOf(bytes), bytes.size(), 600);
  int pieces = 0;
  const auto next = [&]() -> absl::StatusOr<std::string_view> {
    if (++pieces > 1) return absl::CancelledError("left");
    return std::string_view(bytes).substr(0, 1000);
  };
  EXPECT_TRUE(absl::IsCancelled(WriteGranted(*http_, put, bytes.size(), "blob", next)));
  const auto too_few = [&]() -> absl::StatusOr<std::string_view> { return std::string_view(); };
  EXPECT_FALSE(WriteGranted(*http_, put, bytes.size(), "blob", too_few).ok());
  EXPECT_TRUE(server_.Objects().empty());
}

TEST(PauseBefore, DoublesAndIsSpread) {
  for (int attempt = 1; attempt < kMostAttempts; ++attempt) {
    const double usual_s = 0.1 * static_cast<double>(1 << (attempt - 1));
    for (int i = 0; i < 100; ++i) {
      EXPECT_GE(PauseBefore_s(attempt), 0.5 * usual_s);
      EXPECT_LE(PauseBefore_s(attempt), 1.5 * usual_s);
    }
  }
  EXPECT_NE(PauseBefore_s(3), PauseBefore_s(3));
}

}  // namespace
}  // namespace orbweave
