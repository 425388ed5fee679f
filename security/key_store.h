// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "security/identity.h"
#include "security/revocations.h"

namespace orbweave {

/// The folder that `orbweave keys` keeps: `authority/` (ca.crt, ca.key, token.key, revoked) and one
/// TlsFolder per name. All files have mode 0600, all folders 0700. Nothing is ever overwritten.

/// A new fleet: its authority, and folders `coordinator`, `client` and `admin`. The coordinator's
/// gets ca.key and token.key too, so that it can take join tokens. AlreadyExists: there are keys.
[[nodiscard]] absl::Status MakeKeyStore(const std::string& store,
                                        const std::string& fleet,
                                        const std::vector<std::string>& hosts,
                                        int64_t now_unix_s);

struct NewKeys {
  Role role = Role::kWorker;
  std::string name{};
  std::vector<std::string> hosts{};  ///< of a coordinator: where it is reached
  int64_t valid_s = 365 * 86400;
};

/// A new key and certificate in the TlsFolder `store/name`. AlreadyExists: the name is taken.
/// FailedPrecondition: it is revoked.
[[nodiscard]] absl::Status AddKeys(const std::string& store,
                                   const NewKeys& keys,
                                   int64_t now_unix_s);

/// Shuts out `more`, for good: adds them to what is revoked in `authority/` and in the folders of
/// all coordinators, who heed it from the next call on. InvalidArgument: no such name, serial or
/// token can be, or it is a coordinator's, whose callers would not ask. NotFound: no key store.
[[nodiscard]] absl::Status Revoke(const std::string& store, const Revocations& more);

/// A join token for so many workers, written to `path`; its nonce, by which it can be revoked.
/// NotFound: no key store.
[[nodiscard]] absl::StatusOr<std::string> WriteJoinToken(const std::string& store,
                                                         const std::string& path,
                                                         int64_t expires_unix_s,
                                                         uint32_t uses = 1);

}  // namespace orbweave
