// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "coordinator/jobs/job_machine.h"
#include "core/pipeline/worker_api.h"

namespace orbweave {

/// Who holds what until when.
struct LeaseEntry {
  uint64_t epoch = 0;
  Digest task{};
  Digest job{};
  std::optional<TaskRef>
      ref{};  ///< nothing: of an earlier generation, its stage is not planned yet
  std::string worker{};
  uint32_t slot = 0;
  uint64_t session = 0;  ///< 0: of an earlier generation, its holder has not come back yet
  double until_s = 0.0;
  bool waits = false;  ///< behind another lease of its slot, which has the slot's process
};

/// FailedPrecondition: whoever comes under this lease comes too late.
[[nodiscard]] absl::Status StaleLease(uint64_t epoch, const Digest& task);

/// The leases that are out. A lease is named by its epoch, which is never given twice: whoever
/// comes with an epoch that is not in the book is late. Pure bookkeeping: time is handed in. Not
/// thread-safe.
class LeaseBook {
 public:
  /// Decides whether it waits.
  void Grant(LeaseEntry entry);

  /// Moves the end of a lease to `until_s`; nullptr when the book does not have it for this
  /// session.
  const LeaseEntry* Renew(uint64_t epoch, const Digest& task, uint64_t session, double until_s);
  /// Strikes a lease out. FailedPrecondition when the book does not have it for this session.
  [[nodiscard]] absl::StatusOr<LeaseEntry> Take(uint64_t epoch,
                                                const Digest& task,
                                                uint64_t session);

  /// A worker begins a session: those of its leases that it lists are of this session now and end
  /// at `until_s`; its others are struck out and returned.
  [[nodiscard]] std::vector<LeaseEntry> Adopt(std::string_view worker,
                                              const std::vector<LeaseProgress>& held,
                                              uint64_t session,
                                              double until_s);
  /// Leases of a job without a place in it; valid until the book changes.
  [[nodiscard]] std::vector<LeaseEntry*> AwaitingPlace(const Digest& job);

  /// How many leases a slot holds.
  [[nodiscard]] size_t CountAt(const WorkerSlot& place) const;
  /// The leases of a worker whose tasks run, but for those of slot `but`.
  [[nodiscard]] std::vector<const LeaseEntry*> RunningBeside(const WorkerSlot& but) const;
  /// Whether a worker holds leases of a job.
  [[nodiscard]] bool Holds(const std::string& worker, const Digest& job) const;
  /// How many slots of a worker hold leases, of those that do.
  [[nodiscard]] std::map<std::string, uint32_t> BusySlots() const;

  /// Strike out and return, in order of epoch.
  [[nodiscard]] std::vector<LeaseEntry> TakeTask(const Digest& job, TaskRef ref);
  [[nodiscard]] std::vector<LeaseEntry> TakeExpired(double now_s);
  [[nodiscard]] std::vector<LeaseEntry> TakeSession(uint64_t session);
  [[nodiscard]] std::vector<LeaseEntry> TakeJob(const Digest& job);

 private:
  template <typename Predicate>
  std::vector<LeaseEntry> TakeIf(Predicate predicate);
  /// The same for leases whose workers go on: what waited behind them begins.
  template <typename Predicate>
  std::vector<LeaseEntry> TakeEndedIf(Predicate predicate);
  /// Its slot does not hold `gone` any more.
  void Forget(const LeaseEntry& gone);
  /// The slot of `gone` is free for the lease that waited longest.
  void LetNextBegin(const LeaseEntry& gone);

  static constexpr double kNoEnd = std::numeric_limits<double>::infinity();
  std::map<uint64_t, LeaseEntry> entries_;
  std::map<WorkerSlot, std::set<uint64_t>> epochs_at_;  ///< of the leases that slots hold
  double earliest_end_s_ = kNoEnd;  ///< no lease ends before: most often there is nothing to expire
};

}  // namespace orbweave
