// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "objects/sign_s3.h"

#include <array>
#include <ctime>

#include "absl/strings/ascii.h"
#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "core/base/digest.h"
#include "objects/s3_address.h"
#include "security/hmac.h"

namespace orbweave {
namespace {

constexpr char kAlgorithm[] = "AWS4-HMAC-SHA256";

std::string ScopeOf(const S3Keys& keys, const std::string& time) {
  return absl::StrCat(time.substr(0, 8), "/", keys.region, "/s3/aws4_request");
}

std::map<std::string, std::string> HeadersOf(const S3Request& request) {
  std::map<std::string, std::string> headers = request.headers;
  headers["host"] = request.host;
  return headers;
}

std::string NamesOf(const std::map<std::string, std::string>& headers) {
  std::string names;
  for (const auto& [name, value] : headers) absl::StrAppend(&names, names.empty() ? "" : ";", name);
  return names;
}

std::string EncodeQuery(const std::map<std::string, std::string>& query) {
  std::string text;
  for (const auto& [name, value] : query) {
    absl::StrAppend(
        &text, text.empty() ? "" : "&", UriEncode(name, false), "=", UriEncode(value, false));
  }
  return text;
}

std::string CanonicalRequest(const S3Request& request, const std::string& payload_hash) {
  std::string text =
      absl::StrCat(request.method, "\n", request.path, "\n", EncodeQuery(request.query), "\n");
  const std::map<std::string, std::string> headers = HeadersOf(request);
  for (const auto& [name, value] : headers)
    absl::StrAppend(&text, name, ":", absl::StripAsciiWhitespace(value), "\n");
  absl::StrAppend(&text, "\n", NamesOf(headers), "\n", payload_hash);
  return text;
}

}  // namespace

std::string SignatureOf(const S3Request& request,
                        const std::string& payload_hash,
                        const S3Keys& keys,
                        const std::string& time) {
  const std::string text = absl::StrCat(kAlgorithm,
                                        "\n",
                                        time,
                                        "\n",
                                        ScopeOf(keys, time),
                                        "\n",
                                        DigestOf(CanonicalRequest(request, payload_hash)).ToHex());
  std::string key = HmacSha256(absl::StrCat("AWS4", keys.secret_key), time.substr(0, 8));
  for (const std::string& part : {keys.region, std::string("s3"), std::string("aws4_request")})
    key = HmacSha256(key, part);
  return absl::BytesToHexString(HmacSha256(key, text));
}

std::string TimeOfS3(int64_t unix_s) {
  const auto seconds = static_cast<std::time_t>(unix_s);
  std::tm utc{};
  ::gmtime_r(&seconds, &utc);
  std::array<char, 32> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%Y%m%dT%H%M%SZ", &utc)};
}

std::string Presign(S3Request request, const S3Keys& keys, int64_t unix_s, int valid_s) {
  const std::string time = TimeOfS3(unix_s);
  request.query["X-Amz-Algorithm"] = kAlgorithm;
  request.query["X-Amz-Credential"] = absl::StrCat(keys.access_key, "/", ScopeOf(keys, time));
  request.query["X-Amz-Date"] = time;
  request.query["X-Amz-Expires"] = absl::StrCat(valid_s);
  request.query["X-Amz-SignedHeaders"] = NamesOf(HeadersOf(request));
  if (!keys.session_token.empty()) request.query["X-Amz-Security-Token"] = keys.session_token;
  const auto hash = request.headers.find("x-amz-content-sha256");
  const std::string payload_hash = hash == request.headers.end() ? kUnsignedPayload : hash->second;
  const std::string signature = SignatureOf(request, payload_hash, keys, time);
  return absl::StrCat(
      request.path, "?", EncodeQuery(request.query), "&X-Amz-Signature=", signature);
}

}  // namespace orbweave
