// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "core/base/status.h"

namespace orbweave {

/// A place in a bucket of an S3 server.
struct S3Address {
  std::string bucket{};
  std::string prefix{};  ///< of all keys; empty, or without '/' at its ends
  std::string scheme = "https";
  std::string host{};           ///< of the server, with its port where it is not the usual one
  std::string region{};         ///< empty: as the keys say
  bool bucket_in_path = false;  ///< http://host/bucket/key instead of http://bucket.host/key

  /// What an HTTP request names as its host.
  [[nodiscard]] std::string HostOfBucket() const;
  /// The encoded path of an object, whose key is relative to the prefix; of the bucket itself when
  /// `key` is empty.
  [[nodiscard]] std::string PathOf(const std::string& key) const;
  /// The prefix and the key, as the server names it.
  [[nodiscard]] std::string KeyOf(const std::string& key) const;
  /// s3://bucket/prefix, for people.
  [[nodiscard]] std::string ToText() const;
};

/// s3://BUCKET[/PREFIX][?endpoint=URL][&region=REGION][&style=path|host][&plain=yes]. Without an
/// endpoint it is Amazon's. An endpoint is http(s)://host[:port]; over http bytes and rights are
/// open to whoever sees the network, so beyond the loopback only with plain=yes. A bucket is in the
/// path of another endpoint unless style=host. InvalidArgument: another form.
[[nodiscard]] absl::StatusOr<S3Address> ParseS3Address(const std::string& text);

/// Whether `text` begins as such an address does.
[[nodiscard]] bool IsS3Address(std::string_view text);

/// RFC 3986, section 2.1: every byte but letters, digits and "-._~" becomes %XX; '/' stays when
/// `keeps_slash`.
[[nodiscard]] std::string UriEncode(std::string_view text, bool keeps_slash);

/// And back. InvalidArgument: a '%' without two hexadecimal digits.
[[nodiscard]] absl::StatusOr<std::string> UriDecode(std::string_view text);

}  // namespace orbweave
