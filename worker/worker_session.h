// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <mutex>
#include <stop_token>

#include "core/pipeline/worker_api.h"
#include "worker/held_leases.h"
#include "worker/shared_store.h"

namespace orbweave {

/// A worker's membership: joins, and joins again when the coordinator has forgotten the session (it
/// was restarted, or it heard nothing for too long). Thread-safe.
class WorkerSession {
 public:
  /// `store` is checked with each session. `stays_s`: see WorkerInfo. `away` is told whenever the
  /// coordinator could not be joined, and why; false: it is waited for no more.
  WorkerSession(WorkerApi& api,
                SharedStore& store,
                WorkerInfo info,
                HeldLeases& leases,
                std::function<std::optional<double>()> stays_s,
                std::function<bool(const absl::Status& why)> away)
      : api_(api),
        store_(store),
        info_(std::move(info)),
        leases_(leases),
        stays_s_(std::move(stays_s)),
        away_(std::move(away)) {}

  /// The present session, joining first when there is none; waits while the coordinator is
  /// Unavailable, which it is in the end only when `away` says so. Cancelled: stopped before it
  /// could join. FailedPrecondition: the coordinator does not want this worker. Errors of
  /// SharedStore::Check.
  [[nodiscard]] absl::StatusOr<JoinReply> Get(const std::stop_token& stop);
  /// `session` is over: the next Get joins again, with the leases that are held then.
  void Forget(uint64_t session);
  /// Leaves, when there is a session to leave.
  void Leave();

 private:
  [[nodiscard]] absl::StatusOr<JoinReply> Join();

  WorkerApi& api_;
  SharedStore& store_;
  WorkerInfo info_;
  HeldLeases& leases_;
  std::function<std::optional<double>()> stays_s_;
  std::function<bool(const absl::Status& why)> away_;
  std::mutex mutex_;
  JoinReply reply_{};  ///< session 0: none
};

}  // namespace orbweave
