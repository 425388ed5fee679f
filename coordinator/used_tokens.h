// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "core/base/status.h"
#include "security/join_token.h"

namespace orbweave {

/// How often join tokens were used, one file each in a folder of the coordinator's state, kept
/// until they would have expired anyway. Thread-safe; one process at a time.
class UsedTokens {
 public:
  /// Creates `folder` and forgets what had expired at `now_unix_s`.
  [[nodiscard]] static absl::StatusOr<UsedTokens> Open(const std::string& folder,
                                                       int64_t now_unix_s);

  /// Notes one more use of a token on disk, before anything is given for it; the number of this
  /// use, from 1 to `claims.uses`. PermissionDenied: it was used as often before. Errors of the
  /// disk: it counts as not used, and nothing may be given.
  [[nodiscard]] absl::StatusOr<uint32_t> Use(const JoinClaims& claims);

 private:
  explicit UsedTokens(std::string folder) : folder_(std::move(folder)) {}

  std::string folder_;
  std::unique_ptr<std::mutex> mutex_ = std::make_unique<std::mutex>();
};

}  // namespace orbweave
