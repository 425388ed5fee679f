// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "core/base/status.h"

namespace orbweave {

/// The join tokens that were used, one file each in a folder of the coordinator's state, kept until
/// they would have expired anyway. Thread-safe; one process at a time.
class UsedTokens {
 public:
  /// Creates `folder` and forgets what had expired at `now_unix_s`.
  [[nodiscard]] static absl::StatusOr<UsedTokens> Open(const std::string& folder,
                                                       int64_t now_unix_s);

  /// Notes the use of a token on disk, before anything is given for it. PermissionDenied: it was
  /// used before. Errors of the disk: it counts as not used, and nothing may be given.
  [[nodiscard]] absl::Status Use(const std::string& nonce, int64_t expires_unix_s);

 private:
  explicit UsedTokens(std::string folder) : folder_(std::move(folder)) {}

  std::string folder_;
  std::unique_ptr<std::mutex> mutex_ = std::make_unique<std::mutex>();
};

}  // namespace orbweave
