// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <list>
#include <map>
#include <mutex>
#include <string>

#include "core/base/status.h"
#include "security/identity.h"

namespace orbweave {

/// Which certificate began which worker session: nobody else may speak in it. A session that began
/// before this process did is unknown, so that its worker joins again and proves who it is; so is
/// one in which nobody spoke since a hundred thousand others began. Thread-safe.
class SessionOwners {
 public:
  /// PermissionDenied: this certificate is not that worker's.
  [[nodiscard]] static absl::Status CheckName(const Identity& peer, const std::string& worker_name);
  /// `worker_name` joined; its session before this one is over.
  void Begin(uint64_t session, const std::string& worker_name, const Identity& peer);
  /// PermissionDenied: the session is another's. NotFound: unknown, join again.
  [[nodiscard]] absl::Status Check(uint64_t session, const Identity& peer) const;

 private:
  static constexpr size_t kMostSessions = 100'000;
  struct Owner {
    Identity identity{};
    std::string worker{};
    std::list<uint64_t>::iterator place{};
  };
  void Forget(uint64_t session);

  mutable std::mutex mutex_;
  std::map<uint64_t, Owner> owners_;
  mutable std::list<uint64_t> sessions_;  ///< in which somebody spoke last come last
  std::map<std::string, uint64_t> session_of_worker_;
};

}  // namespace orbweave
