// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/session_owners.h"

#include "absl/strings/str_cat.h"

namespace orbweave {

absl::Status SessionOwners::CheckName(const Identity& peer, const std::string& worker_name) {
  if (MaySpeakFor(peer, worker_name)) return absl::OkStatus();
  return absl::PermissionDeniedError(absl::StrCat(peer.ToUri(),
                                                  " may join as ",
                                                  peer.name,
                                                  " or ",
                                                  peer.name,
                                                  "/..., not as '",
                                                  worker_name,
                                                  "'"));
}

void SessionOwners::Begin(uint64_t session, const std::string& worker_name, const Identity& peer) {
  const std::lock_guard lock(mutex_);
  if (const auto before = session_of_worker_.find(worker_name); before != session_of_worker_.end())
    Forget(before->second);
  if (owners_.size() == kMostSessions) Forget(sessions_.front());
  session_of_worker_[worker_name] = session;
  owners_[session] = {peer, worker_name, sessions_.insert(sessions_.end(), session)};
}

void SessionOwners::Forget(uint64_t session) {
  const auto owner = owners_.find(session);
  session_of_worker_.erase(owner->second.worker);
  sessions_.erase(owner->second.place);
  owners_.erase(owner);
}

absl::Status SessionOwners::Check(uint64_t session, const Identity& peer) const {
  const std::lock_guard lock(mutex_);
  const auto owner = owners_.find(session);
  if (owner == owners_.end())
    return absl::NotFoundError(absl::StrCat("session ", session, " is over: join again"));
  if (owner->second.identity != peer) {
    return absl::PermissionDeniedError(
        absl::StrCat("session ", session, " is not that of ", peer.ToUri()));
  }
  sessions_.splice(sessions_.end(), sessions_, owner->second.place);
  return absl::OkStatus();
}

}  // namespace orbweave
