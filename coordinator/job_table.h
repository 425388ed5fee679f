// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "coordinator/jobs/job_machine.h"
#include "coordinator/prepare_stage.h"
#include "core/pipeline/worker_api.h"

namespace orbweave {

/// What tasks of a job left that others could not read.
struct JobDamage {
  std::vector<FailedAttempt> results{};  ///< each counts as a failure of the task that left it
  std::set<Digest> blobs{};
  uint32_t reports = 0;    ///< of blobs that could not be read
  bool is_remade = false;  ///< whatever a task read was made again, since nobody knew what it was

  [[nodiscard]] bool IsIn(const TaskResult& result) const;
};

/// A job and its machine.
struct Job {
  uint64_t number = 0;
  uint64_t run = 0;          ///< which run of the job the machine is
  uint64_t since_epoch = 0;  ///< see JobEntry
  bool verify = true;        ///< see JobSnapshot
  bool is_saved = true;      ///< its end is in the journal
  bool had_ended = false;    ///< before the coordinator was started; nobody asked for it since
  uint32_t reruns = 0;
  JobDamage damage{};
  std::unique_ptr<JobMachine> machine{};

  [[nodiscard]] bool IsRunning() const { return machine->state() == JobState::kRunning; }
};

/// The jobs a coordinator knows. Pure bookkeeping: time is handed in. Not thread-safe.
class JobTable {
 public:
  /// Lets a job begin (or begin anew, under the number it has): a machine in its first state.
  Job& Begin(
      const JobSpec& spec, JobPlan plan, uint64_t number, const RetryPolicy& retry, double now_s);

  void Forget(const Digest& id);

  /// nullptr: there is none.
  [[nodiscard]] Job* Find(const Digest& id);
  [[nodiscard]] Job& At(const Digest& id) { return jobs_.at(id); }
  [[nodiscard]] const Job& At(const Digest& id) const { return jobs_.at(id); }
  /// By number: the oldest is served first.
  [[nodiscard]] const std::map<uint64_t, Digest>& order() const { return order_; }
  [[nodiscard]] uint64_t NextNumber() const {
    return order_.empty() ? 1 : order_.rbegin()->first + 1;
  }

  [[nodiscard]] size_t NumRunning() const;
  /// JobMachine::CountOpenTasks of all jobs, but those that had ended: nothing of them is computed.
  [[nodiscard]] uint64_t CountOpenTasks() const;

  /// The oldest job with a stage to plan; with an end to save.
  [[nodiscard]] std::optional<Digest> ToPlan() const;
  [[nodiscard]] std::optional<Digest> ToSave() const;
  [[nodiscard]] JobSnapshot Snapshot(const Digest& id, uint32_t stage) const;
  /// Whether the result of this very lease was taken.
  [[nodiscard]] bool WasDoneBy(const Lease& lease) const;

 private:
  std::map<Digest, Job> jobs_;
  std::map<uint64_t, Digest> order_;
  uint64_t last_run_ = 0;
};

}  // namespace orbweave
