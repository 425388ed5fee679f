// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/worker_session.h"

#include "worker/retry.h"

namespace orbweave {

absl::StatusOr<JoinReply> WorkerSession::Get(const std::stop_token& stop) {
  const std::lock_guard lock(mutex_);
  if (reply_.session != 0) return reply_;
  if (stop.stop_requested()) return absl::CancelledError("the worker is stopping");
  const auto may_pass = [](const absl::Status& status) {  // a server that ends cancels its calls
    return absl::IsUnavailable(status) || absl::IsCancelled(status);
  };
  absl::StatusOr<JoinReply> joined =
      Retry({.stop = stop, .is_passing = may_pass, .goes_on = away_}, [this] { return Join(); });
  if (!joined.ok())
    return stop.stop_requested() ? absl::CancelledError("the worker is stopping") : joined.status();
  reply_ = *joined;
  return reply_;
}

absl::StatusOr<JoinReply> WorkerSession::Join() {
  info_.held = leases_.List();
  info_.stays_s = stays_s_();
  ORBWEAVE_ASSIGN_OR_RETURN(const JoinReply reply, api_.Join(info_));
  ORBWEAVE_RETURN_IF_ERROR(store_.Check());
  return reply;
}

void WorkerSession::Forget(uint64_t session) {
  const std::lock_guard lock(mutex_);
  if (reply_.session == session) reply_.session = 0;
}

void WorkerSession::Leave() {
  const std::lock_guard lock(mutex_);
  if (reply_.session == 0) return;
  (void)api_.Leave(reply_.session);  // a coordinator that is gone learns of it by silence
  reply_.session = 0;
}

}  // namespace orbweave
