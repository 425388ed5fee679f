// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <stop_token>
#include <string>

#include "core/pipeline/blob_access.h"
#include "core/pipeline/log_event.h"
#include "core/pipeline/worker_api.h"
#include "worker/task_executor.h"

namespace orbweave {

/// When a worker ends of itself; infinite: never for that reason.
struct WorkerTerm {
  static constexpr double kNever_s = std::numeric_limits<double>::infinity();

  double idle_s = kNever_s;      ///< without a task, though the coordinator is there
  double patience_s = kNever_s;  ///< with a coordinator that does not answer
  /// From its start on: then it takes no more tasks, and leaves when those it has are done.
  double lifetime_s = kNever_s;
  /// From its start on: it has to be gone by then. It gets no task that usually takes longer, and
  /// ends as if told to, the grace before.
  double stays_s = kNever_s;
};

/// Why a worker left.
enum class WorkerEnd {
  kDismissed,  ///< the coordinator needs it no more
  kIdle,       ///< there was nothing to do for so long
  kStopped,    ///< it was told to end, or its time was up: there may be more to do
};

struct WorkerOptions {
  std::string name{};  ///< unique among the workers of a coordinator
  uint32_t slots = 1;  ///< tasks at a time
  WorkerOffers offers{};
  int threads_per_task = 1;
  double grace_s = 30.0;  ///< for tasks that run when the worker is told to end
  double poll_s = 10.0;   ///< how long one question for a task waits at the coordinator
  size_t cache_bytes = size_t{512} << 20;
  std::string blob_folder{};     ///< see SharedStore
  std::string scratch_folder{};  ///< of a ScratchTier; empty: none
  uint64_t scratch_bytes = uint64_t{16} << 30;
  WorkerTerm term{};
  EventLog log{};
};

/// Works for the coordinator until `stop`, until its term is over or until it says to leave: asks
/// for tasks, has them run by one executor per slot, hands in what came out, and beats. Then it
/// takes no more tasks, finishes those that run, and leaves; what is not done within the grace
/// after `stop` is given back, and so is all when the coordinator dismisses its workers. Outlasts a
/// coordinator that is away for a while. FailedPrecondition when the coordinator does not
/// take this worker (another version), or the blob folder is not its; PermissionDenied or
/// Unauthenticated when it refuses its certificate; Unavailable: it did not answer for as long as
/// the term's patience. `blobs`: those of the coordinator.
[[nodiscard]] absl::StatusOr<WorkerEnd> RunWorker(WorkerApi& coordinator,
                                                  BlobAccess& blobs,
                                                  const MakeTaskExecutor& make_executor,
                                                  const WorkerOptions& options,
                                                  const std::stop_token& stop);

}  // namespace orbweave
