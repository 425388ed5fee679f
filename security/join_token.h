// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "security/identity.h"

namespace orbweave {

/// What a join token says. It is worth so many certificates of `role` in `fleet`.
struct JoinClaims {
  std::string fleet{};
  Role role = Role::kWorker;
  int64_t expires_unix_s = 0;
  uint32_t uses = 1;            ///< from 1 to kMostUses
  std::string nonce{};          ///< 32 hexadecimal digits that name this token
  std::string authority_pem{};  ///< the authority by which its bearer knows the coordinator
};

inline constexpr uint32_t kMostUses = 100'000;

/// Whether a token may have this nonce.
[[nodiscard]] bool IsTokenNonce(std::string_view text);

/// Random bytes for MakeJoinToken, as 64 hexadecimal digits: a secret.
[[nodiscard]] std::string MakeTokenKey();

/// `claims` with a new nonce, and their HMAC-SHA256 under `key`, as one line of text: a secret.
[[nodiscard]] std::string MakeJoinToken(const std::string& key, JoinClaims claims);

/// What a token says, true or not: for its bearer, who cannot know. InvalidArgument: no token.
[[nodiscard]] absl::StatusOr<JoinClaims> ReadJoinToken(std::string_view token);

/// What a token says when it was made with `key` and is valid at `now_unix_s`. PermissionDenied
/// otherwise; no message repeats any of it.
[[nodiscard]] absl::StatusOr<JoinClaims> VerifyJoinToken(const std::string& key,
                                                         std::string_view token,
                                                         int64_t now_unix_s);

}  // namespace orbweave
