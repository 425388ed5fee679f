// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "objects/http_client.h"
#include "objects/object_store.h"
#include "objects/s3_address.h"
#include "objects/s3_keys.h"
#include "objects/sign_s3.h"
#include "security/unix_time.h"

namespace orbweave {

/// Takes objects of a list; its error ends the listing.
using TakeObjects = std::function<absl::Status(std::vector<ObjectInfo> objects)>;

/// An S3 server's bucket. Every request is signed in its URL, those of this process as those that
/// others are granted. What may pass is tried a few times (kMostAttempts), with waits between.
class S3Store final : public ObjectStore {
 public:
  /// Asks nobody yet. `keys` without a region have that of the address, or us-east-1. Errors of
  /// HttpClient::Make.
  [[nodiscard]] static absl::StatusOr<std::unique_ptr<S3Store>> Make(
      S3Address address, S3Keys keys, const HttpPatience& patience = {}, UnixClock clock = UnixNow);

  [[nodiscard]] absl::StatusOr<ObjectInfo> Head(const std::string& key) override;
  [[nodiscard]] absl::Status Get(const std::string& key,
                                 const std::optional<ByteRange>& range,
                                 const TakePiece& take) override;
  /// Where the server knows no conditions the object is written again.
  [[nodiscard]] absl::Status Put(const std::string& key,
                                 const Digest& digest,
                                 std::string_view bytes) override;
  [[nodiscard]] absl::Status Delete(const std::string& key) override;
  [[nodiscard]] absl::StatusOr<std::vector<ObjectInfo>> List() override;
  /// The same a page (of a thousand, usually) at a time. Errors of `take` too.
  [[nodiscard]] absl::Status ListPages(const TakeObjects& take);
  /// Get of all of an object as long as it is the one with this ETag. Aborted: it is another by
  /// now.
  [[nodiscard]] absl::Status GetVersion(const std::string& key,
                                        const std::string& etag,
                                        const TakePiece& take);
  [[nodiscard]] ObjectGrant GrantGet(const std::string& key, int valid_s) override;
  [[nodiscard]] ObjectGrant GrantPut(const std::string& key,
                                     const Digest& digest,
                                     uint64_t size_bytes,
                                     int valid_s) override;
  [[nodiscard]] absl::StatusOr<std::string> BeginUpload(const std::string& key) override;
  [[nodiscard]] ObjectGrant GrantPart(const std::string& key,
                                      const ObjectPart& part,
                                      int valid_s) override;
  [[nodiscard]] absl::Status FinishUpload(const std::string& key,
                                          const std::string& upload,
                                          const std::vector<std::string>& etags) override;
  [[nodiscard]] absl::Status AbortUpload(const std::string& key,
                                         const std::string& upload) override;
  [[nodiscard]] absl::StatusOr<std::vector<UploadInfo>> ListUploads() override;

 private:
  S3Store(S3Address address, S3Keys keys, UnixClock clock, std::unique_ptr<HttpClient> http)
      : address_(std::move(address)),
        keys_(std::move(keys)),
        clock_(std::move(clock)),
        http_(std::move(http)) {}
  [[nodiscard]] ObjectGrant Grant(S3Request request, int valid_s) const;
  [[nodiscard]] std::string NameOf(const std::string& key) const;
  /// The answer to `request`, tried a few times. Errors of StatusOfS3.
  [[nodiscard]] absl::StatusOr<HttpAnswer> Ask(const S3Request& request,
                                               const std::string& what,
                                               const std::string& body = {});

  const S3Address address_;
  const S3Keys keys_;
  const UnixClock clock_;
  const std::unique_ptr<HttpClient> http_;
  std::atomic<bool> knows_conditions_{true};  ///< until it says otherwise
};

/// The store at an address (ParseS3Address), with the keys of `keys_path` or the environment
/// (FindS3Keys).
[[nodiscard]] absl::StatusOr<std::unique_ptr<S3Store>> OpenS3Store(const std::string& address,
                                                                   const std::string& keys_path);

}  // namespace orbweave
