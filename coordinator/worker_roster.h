// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "coordinator/journal/journal.h"
#include "core/pipeline/job_api.h"
#include "core/pipeline/worker_api.h"

namespace orbweave {

/// The workers that joined, by name, each with its present session. A worker is alive while it was
/// heard within `silence_s`; it is set aside once it has failed three tasks that others then did,
/// without doing one in between, or left three results that nobody could read and others then left
/// in other bytes, and until another process of it joins. One that is gone is
/// forgotten after a day, or when a thousand are that were heard later; of these, those set aside
/// are forgotten last. Pure bookkeeping: time is handed in. Not thread-safe.
class WorkerRoster {
 public:
  explicit WorkerRoster(double silence_s) : silence_s_(silence_s) {}

  /// A worker of an earlier generation is to be blamed.
  void Remember(const WorkerBlame& blame, double now_s);
  /// Forgets those that have been gone for long; quick where there is nothing to do.
  void ForgetGone(double now_s);
  /// Those whose blames have changed since this was last asked; of one that is forgotten none is
  /// left.
  [[nodiscard]] std::vector<WorkerBlame> TakeBlames();
  [[nodiscard]] bool HasBlames() const { return !changed_.empty(); }

  /// Begins session `session` of a worker, which ends the one it had.
  void Join(const WorkerInfo& worker, uint64_t session, double now_s);
  /// NotFound: a session is unknown, or over.
  [[nodiscard]] absl::Status Check(uint64_t session) const;
  /// InvalidArgument: the worker of a session has no such slot. NotFound: see Check.
  [[nodiscard]] absl::Status CheckSlot(uint64_t session, uint32_t slot) const;
  /// Notes that a session was heard. NotFound: it is unknown, or over.
  [[nodiscard]] absl::Status Hear(uint64_t session, double now_s);
  /// Ends a session; the worker stays listed as not alive.
  void End(uint64_t session);
  /// Gives the workers that are meant by `name` no more tasks until they join anew; their names,
  /// see AdminApi::DrainWorkers.
  [[nodiscard]] absl::StatusOr<std::vector<std::string>> Drain(std::string_view name);
  [[nodiscard]] bool IsDraining(uint64_t session) const;
  /// A worker handed in a result of which others had failed: what counts against them, and that
  /// it works itself.
  void CountTask(uint64_t session, const std::set<std::string>& failed_on);

  /// A worker left a result that could not be read, and another one left a better one.
  void CountDamage(const std::string& name);

  [[nodiscard]] std::string NameOf(uint64_t session) const;
  [[nodiscard]] std::optional<uint64_t> SessionOf(std::string_view name) const;
  /// Workers that are given tasks: alive, not to leave, and not set aside. When all that remain are
  /// set aside, they are given tasks all the same.
  [[nodiscard]] std::vector<std::string> Serving(double now_s) const;
  /// How long a worker will be there yet; infinite where it has not said.
  [[nodiscard]] double StaysFor(std::string_view name, double now_s) const;
  /// The longest that any worker will be there that is given tasks; infinite when there is none.
  [[nodiscard]] double LongestStay(double now_s) const;
  /// Slots of those workers.
  [[nodiscard]] uint32_t SlotsAtWork(double now_s) const;
  /// Slots of all workers that are alive.
  [[nodiscard]] uint32_t Slots(double now_s) const;
  [[nodiscard]] std::vector<WorkerStatus> Status(double now_s) const;
  /// Those of `workers` that can do a task of these needs when they do nothing else.
  [[nodiscard]] std::vector<std::string> Able(const std::vector<std::string>& workers,
                                              const StageNeeds& needs) const;
  /// Whether a worker has room for a task beside those that took `taken` of it.
  [[nodiscard]] bool HasRoom(std::string_view name,
                             const StageNeeds& taken,
                             const StageNeeds& needs) const;
  /// What is missing that no worker that is given tasks will ever have; empty: one has it all, or
  /// there is none at all.
  [[nodiscard]] std::string Missing(const StageNeeds& needs, double now_s) const;

 private:
  struct Record {
    uint64_t session = 0;  ///< 0: none
    double heard_s = 0.0;
    uint32_t slots = 1;
    WorkerOffers offers{};
    double leaves_s = std::numeric_limits<double>::infinity();
    uint32_t tasks_done = 0;
    bool draining = false;
    uint64_t process = 0;
    uint32_t blames = 0;   ///< tasks it failed and others did, since it did one itself
    uint32_t damages = 0;  ///< results of this process that could not be read
    [[nodiscard]] uint32_t Faults() const { return std::max(blames, damages); }
  };
  void SetBlames(const std::string& name, uint32_t blames);
  /// Those with a session whose names begin with `prefix`.
  [[nodiscard]] std::vector<std::string> PresentFrom(std::string_view prefix) const;
  [[nodiscard]] static bool IsSetAside(const Record& record);
  [[nodiscard]] bool IsAlive(const Record& record, double now_s) const;
  void Forget(const std::string& name);

  double silence_s_;
  std::map<std::string, Record, std::less<>> records_;
  std::map<uint64_t, std::string> names_;  ///< of sessions that are not over
  std::set<std::string> changed_;          ///< whose blames have
  double next_look_s_ = 0.0;               ///< for those that are gone
  size_t next_look_size_ = 0;              ///< of records, as well
};

}  // namespace orbweave
