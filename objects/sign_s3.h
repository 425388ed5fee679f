// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "objects/s3_keys.h"

namespace orbweave {

/// A request to an S3 server as its signature sees it.
struct S3Request {
  std::string method = "GET";
  std::string host{};
  std::string path = "/";                        ///< encoded
  std::map<std::string, std::string> query{};    ///< not encoded
  std::map<std::string, std::string> headers{};  ///< to be signed beside the host; lower-case names
};

/// What stands for the digest of a body that is not signed.
inline constexpr char kUnsignedPayload[] = "UNSIGNED-PAYLOAD";

/// The signature of a request (AWS Signature Version 4, service s3; "Signature Calculations for the
/// Authorization Header" in the Amazon S3 API reference): hexadecimal HMAC-SHA256, under the key
/// HMAC(HMAC(HMAC(HMAC("AWS4" + secret, day), region), "s3"), "aws4_request"), of the algorithm,
/// the time, the scope and the digest of the canonical request. `payload_hash`: the digest of the
/// body, or kUnsignedPayload. `time`: as TimeOfS3 says it.
[[nodiscard]] std::string SignatureOf(const S3Request& request,
                                      const std::string& payload_hash,
                                      const S3Keys& keys,
                                      const std::string& time);

/// 20130524T000000Z
[[nodiscard]] std::string TimeOfS3(int64_t unix_s);

/// The path and query by which whoever has them may make this request, with its headers, from
/// `unix_s` on for `valid_s` seconds. The digest of its body is that of the header
/// x-amz-content-sha256, where it has one.
[[nodiscard]] std::string Presign(S3Request request,
                                  const S3Keys& keys,
                                  int64_t unix_s,
                                  int valid_s);

}  // namespace orbweave
