// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/base/stage_context.h"
#include "core/pipeline/task.h"
#include "core/pipeline/worker_offers.h"

namespace orbweave {

/// A lease that a worker holds, and how far its task is.
struct LeaseProgress {
  Digest task{};
  uint64_t epoch = 0;
  Progress progress{};
};

struct WorkerInfo {
  std::string name{};     ///< unique among workers
  std::string version{};  ///< build version; another one than the coordinator's is refused
  uint32_t slots = 1;
  std::vector<LeaseProgress> held{};  ///< leases of its last session that it goes on with
  uint64_t process = 0;  ///< a random number that names its process; 0: another one every time
  WorkerOffers offers{};
  /// How long it will be there yet, where that is known: it gets no task that usually takes longer.
  std::optional<double> stays_s{};
};

struct JoinReply {
  uint64_t session = 0;
  double lease_s = 30.0;
  double heartbeat_s = 5.0;
};

struct Lease {
  Digest task{};
  uint64_t epoch = 0;  ///< fencing: a result under an older epoch is refused
  TaskSpec spec{};
  uint32_t slot = 0;
};

struct HeartbeatReply {
  std::vector<Digest> cancelled{};  ///< leases to give up
  bool shutdown = false;            ///< finish nothing more; leave
};

/// What a worker asks of its coordinator. Every method is safe to call from several threads and
/// safe to repeat. Codes common to all: Unavailable (connection; try again).
class WorkerApi {
 public:
  virtual ~WorkerApi() = default;
  /// FailedPrecondition: another version. InvalidArgument: a name, a number of slots or offers that
  /// no worker has. A known name begins a new session; the worker goes on
  /// with the leases it lists (the next heartbeat tells which are not its own any more), and its
  /// others are void.
  [[nodiscard]] virtual absl::StatusOr<JoinReply> Join(const WorkerInfo& worker) = 0;
  /// A task to do, or nullopt when none became ready within wait_s (or a minute, so that nobody is
  /// waited for who has gone). Ends once `left` is requested, where the task would go to nobody.
  /// InvalidArgument: no number of seconds, or no slot of this worker. NotFound: unknown session
  /// (join again). Aborted: it was asked again for the same slot meanwhile. Cancelled: the worker
  /// is to finish what it has, and to leave; or `left`.
  [[nodiscard]] virtual absl::StatusOr<std::optional<Lease>> LeaseTask(
      uint64_t session, uint32_t slot, double wait_s, const std::stop_token& left) = 0;
  [[nodiscard]] absl::StatusOr<std::optional<Lease>> LeaseTask(uint64_t session,
                                                               uint32_t slot,
                                                               double wait_s) {
    return LeaseTask(session, slot, wait_s, {});
  }
  /// Renews the leases listed. NotFound: unknown session.
  [[nodiscard]] virtual absl::StatusOr<HeartbeatReply> Heartbeat(
      uint64_t session, const std::vector<LeaseProgress>& leases) = 0;
  /// FailedPrecondition: stale epoch, the result was not taken (harmless). NotFound: unknown
  /// session (join again). Aborted: a blob that the result names is not in the store; folders that
  /// machines share over a network show some seconds late what another one wrote.
  [[nodiscard]] virtual absl::Status CompleteTask(uint64_t session,
                                                  const Lease& lease,
                                                  const TaskResult& result) = 0;
  /// The error's code decides what becomes of the task (coordinator/retry_policy.cc has the table):
  /// InvalidArgument and its like are permanent and fail the job, where there is another worker
  /// once that says so too; Cancelled gives the task back; others are tried again, so often. Where
  /// the error names a damaged blob (BlobToBlame), what made it is done again. Answers as
  /// CompleteTask.
  [[nodiscard]] virtual absl::Status FailTask(uint64_t session,
                                              const Lease& lease,
                                              const absl::Status& error) = 0;
  [[nodiscard]] virtual absl::Status Leave(uint64_t session) = 0;
};

}  // namespace orbweave
