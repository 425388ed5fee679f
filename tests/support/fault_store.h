// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "core/base/digest.h"
#include "objects/s3_keys.h"

namespace orbweave::testing {

/// What goes wrong with a request.
enum class StoreFault {
  kSlowDown,     ///< 503
  kCutBody,      ///< the connection ends in the middle of what is sent or answered
  kConflict,     ///< 409
  kServerError,  ///< 500
};

struct FaultStoreOptions {
  S3Keys keys{.access_key = "AKIDTEST", .secret_key = "secret of the test", .region = "test-1"};
  bool knows_conditions = true;  ///< otherwise If-None-Match is 501
  bool gives_ranges = true;      ///< otherwise the whole is given
  size_t page_keys = 1000;       ///< keys in one answer to List
  int64_t clock_ahead_s = 0;     ///< of the store's clock
  double slow_down_share = 0.0;  ///< of requests
  double cut_share = 0.0;        ///< of requests with a body in the question or the answer
  double delay_s = 0.0;          ///< before each answer
  size_t most_put_bytes = size_t{1} << 30;  ///< by one request; more is EntityTooLarge
  size_t least_part_bytes = 0;              ///< of all parts but the last; less is EntityTooSmall
};

/// An S3 server for tests, with one bucket "blobs" in memory: presigned requests are held against
/// their signature, their time, the digest and the length of their body. Listens on the loopback.
class FaultStore {
 public:
  explicit FaultStore(FaultStoreOptions options = {});
  ~FaultStore();
  FaultStore(const FaultStore&) = delete;
  FaultStore& operator=(const FaultStore&) = delete;

  /// s3://blobs/PREFIX?endpoint=...
  [[nodiscard]] std::string Url(const std::string& prefix) const;
  [[nodiscard]] const S3Keys& keys() const { return options_.keys; }

  /// The next requests of `method` (any when it is empty) meet these, one each.
  void FailNext(const std::string& method, std::vector<StoreFault> faults);
  [[nodiscard]] std::map<std::string, std::string> Objects();
  void SetObject(const std::string& key, const std::string& bytes);
  void RemoveObject(const std::string& key);
  /// Uploads in parts that were begun and not ended.
  [[nodiscard]] size_t CountUploads();
  /// As if all of them had been begun so long ago.
  void AgeUploads(int64_t age_s);
  /// As if it had been put so long ago.
  void Age(const std::string& key, int64_t age_s);
  /// Requests with this method so far, refused ones among them.
  [[nodiscard]] uint64_t Count(const std::string& method);
  /// Faults that requests met.
  [[nodiscard]] uint64_t Faults();
  /// Addresses' query keys "X-Amz-Credential" that were seen: who signed.
  [[nodiscard]] std::set<std::string> Signers();

 private:
  class Listener;
  friend class FaultStoreTalk;
  struct Object {
    std::string bytes{};
    int64_t modified_unix_s = 0;
  };

  struct Upload {
    std::string key{};
    std::map<int, std::string> parts{};
    int64_t begun_unix_s = 0;
  };

  FaultStoreOptions options_;
  std::mutex mutex_;
  std::map<std::string, Upload> uploads_;
  uint64_t begun_uploads_ = 0;
  std::map<std::string, Object> objects_;
  std::map<std::string, uint64_t> counts_;
  std::map<std::string, std::deque<StoreFault>> next_faults_;
  std::set<std::string> signers_;
  uint64_t faults_ = 0;
  std::mt19937 chance_{7};
  std::unique_ptr<Listener> listener_;
};

}  // namespace orbweave::testing
