// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "coordinator/journal.h"
#include "core/pipeline/job_api.h"
#include "core/pipeline/worker_api.h"

namespace orbweave {

/// The workers that ever joined, by name, each with its present session. A worker is alive while it
/// was heard within `silence_s`; it is set aside once it has failed three tasks that others then
/// did, without doing one in between, and until another process of it joins. Pure bookkeeping: time
/// is handed in. Not thread-safe.
class WorkerRoster {
 public:
  explicit WorkerRoster(double silence_s) : silence_s_(silence_s) {}

  /// A worker of an earlier generation is to be blamed.
  void Remember(const WorkerBlame& blame);
  /// Those whose blames have changed since this was last asked.
  [[nodiscard]] std::vector<WorkerBlame> TakeBlames();
  [[nodiscard]] bool HasBlames() const { return !changed_.empty(); }

  /// Begins session `session` of a worker, which ends the one it had.
  void Join(const WorkerInfo& worker, uint64_t session, double now_s);
  /// NotFound: a session is unknown, or over.
  [[nodiscard]] absl::Status Check(uint64_t session) const;
  /// Notes that a session was heard. NotFound: it is unknown, or over.
  [[nodiscard]] absl::Status Hear(uint64_t session, double now_s);
  /// Ends a session; the worker stays listed as not alive.
  void End(uint64_t session);
  /// Gives a worker no more tasks until it joins anew. NotFound: it has no session.
  [[nodiscard]] absl::Status Drain(std::string_view name);
  [[nodiscard]] bool IsDraining(uint64_t session) const;
  /// A worker handed in a result of which others had failed: what counts against them, and that
  /// it works itself.
  void CountTask(uint64_t session, const std::set<std::string>& failed_on);

  [[nodiscard]] std::string NameOf(uint64_t session) const;
  [[nodiscard]] std::optional<uint64_t> SessionOf(std::string_view name) const;
  /// Workers that are given tasks: alive, not to leave, and not set aside. When all that remain are
  /// set aside, they are given tasks all the same.
  [[nodiscard]] std::vector<std::string> Serving(double now_s) const;
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
    uint32_t tasks_done = 0;
    bool draining = false;
    uint64_t process = 0;
    uint32_t blames = 0;  ///< tasks it failed and others did, since it did one itself
  };
  void SetBlames(const std::string& name, uint32_t blames);
  [[nodiscard]] static bool IsSetAside(const Record& record);
  [[nodiscard]] bool IsAlive(const Record& record, double now_s) const;

  double silence_s_;
  std::map<std::string, Record, std::less<>> records_;
  std::map<uint64_t, std::string> names_;  ///< of sessions that are not over
  std::set<std::string> changed_;          ///< whose blames have
};

}  // namespace orbweave
