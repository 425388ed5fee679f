// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/join_token.h"

#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/rand.h>

#include <array>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/escaping.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "security/hmac.h"

namespace orbweave {
namespace {

constexpr std::string_view kPrefix = "orbweave-join-2.";
constexpr size_t kNonceBytes = 16;
constexpr size_t kKeyBytes = 32;
constexpr size_t kLongestToken = 16'384;

std::string RandomHex(size_t num_bytes) {
  std::string bytes(num_bytes, '\0');
  ORBWEAVE_CHECK(
      RAND_bytes(reinterpret_cast<unsigned char*>(bytes.data()), static_cast<int>(num_bytes)) == 1);
  return absl::BytesToHexString(bytes);
}

/// The parts of "orbweave-join-2.PAYLOAD.MAC", the last two decoded.
struct TokenParts {
  std::string signed_text{};  ///< "orbweave-join-2.PAYLOAD"
  std::string payload{};
  std::string mac{};
};

absl::Status NoToken() { return absl::InvalidArgumentError("this is no join token"); }

absl::StatusOr<TokenParts> Split(std::string_view token) {
  const size_t dot = token.rfind('.');
  if (token.size() > kLongestToken || !token.starts_with(kPrefix) || dot < kPrefix.size())
    return NoToken();
  TokenParts parts{.signed_text = std::string(token.substr(0, dot))};
  if (!absl::WebSafeBase64Unescape(parts.signed_text.substr(kPrefix.size()), &parts.payload) ||
      !absl::WebSafeBase64Unescape(std::string(token.substr(dot + 1)), &parts.mac)) {
    return NoToken();
  }
  return parts;
}

absl::StatusOr<JoinClaims> ParseClaims(const std::string& payload) {
  const std::vector<std::string> lines = absl::StrSplit(payload, absl::MaxSplits('\n', 5));
  if (lines.size() != 6) return NoToken();
  JoinClaims claims{.fleet = lines[0], .nonce = lines[4], .authority_pem = lines[5]};
  const absl::StatusOr<Role> role = RoleFromName(lines[1]);
  if (!role.ok() || !IsTokenNonce(claims.nonce) || !CheckName(claims.fleet).ok() ||
      !absl::SimpleAtoi(lines[2], &claims.expires_unix_s) ||
      !absl::SimpleAtoi(lines[3], &claims.uses) || claims.uses == 0 || claims.uses > kMostUses) {
    return NoToken();
  }
  claims.role = *role;
  return claims;
}

}  // namespace

bool IsTokenNonce(std::string_view text) {
  return text.size() == 2 * kNonceBytes &&
         text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

std::string MakeTokenKey() { return RandomHex(kKeyBytes); }

std::string MakeJoinToken(const std::string& key, JoinClaims claims) {
  claims.nonce = RandomHex(kNonceBytes);
  const std::string payload = absl::StrCat(claims.fleet,
                                           "\n",
                                           std::string(RoleName(claims.role)),
                                           "\n",
                                           claims.expires_unix_s,
                                           "\n",
                                           claims.uses,
                                           "\n",
                                           claims.nonce,
                                           "\n",
                                           claims.authority_pem);
  const std::string text = absl::StrCat(std::string(kPrefix), absl::WebSafeBase64Escape(payload));
  return absl::StrCat(text, ".", absl::WebSafeBase64Escape(HmacSha256(key, text)));
}

absl::StatusOr<JoinClaims> ReadJoinToken(std::string_view token) {
  ORBWEAVE_ASSIGN_OR_RETURN(const TokenParts parts, Split(token));
  return ParseClaims(parts.payload);
}

absl::StatusOr<JoinClaims> VerifyJoinToken(const std::string& key,
                                           std::string_view token,
                                           int64_t now_unix_s) {
  const absl::StatusOr<TokenParts> parts = Split(token);
  if (!parts.ok()) return absl::PermissionDeniedError(parts.status().message());
  const std::string mac = HmacSha256(key, parts->signed_text);
  if (parts->mac.size() != mac.size() ||
      CRYPTO_memcmp(parts->mac.data(), mac.data(), mac.size()) != 0) {
    return absl::PermissionDeniedError("the join token was not made for this coordinator");
  }
  absl::StatusOr<JoinClaims> claims = ParseClaims(parts->payload);
  if (!claims.ok()) return absl::PermissionDeniedError(claims.status().message());
  if (now_unix_s >= claims->expires_unix_s)
    return absl::PermissionDeniedError("the join token has expired: ask for a new one");
  return claims;
}

}  // namespace orbweave
