// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "coordinator/retry_policy.h"
#include "core/pipeline/coordinator_api.h"
#include "core/pipeline/job_plan.h"

namespace orbweave {

/// A task's place in its job.
struct TaskRef {
  uint32_t run = 0;  ///< of a stage: loops run a stage several times
  uint32_t part = 0;
  friend auto operator<=>(const TaskRef&, const TaskRef&) = default;
};

/// Who works on a task, for the record.
struct TaskHolder {
  uint64_t epoch = 0;
  std::string worker{};
  uint32_t slot = 0;
};

/// One job as a state machine: events go in with the time at which they happened, what may be done
/// next comes out. No clock, no files, no threads: equal events give equal states.
///
///   stage:  unplanned --StageBegins--> running --all its tasks done--> done   (one after the
///   other;
///           the stages of a loop again and again)
///   task:   ready --TaskLeased--> leased --TaskDone--> done
///                   ^----TaskFailed------'      (ready again after a wait; too often: the job
///                   fails)
///   job:    running --> done | failed | cancelled
class JobMachine {
 public:
  JobMachine(JobSpec spec, JobPlan plan, RetryPolicy policy, double now_s);

  [[nodiscard]] const JobSpec& spec() const { return spec_; }
  [[nodiscard]] const JobPlan& plan() const { return plan_; }
  [[nodiscard]] JobState state() const { return state_; }
  [[nodiscard]] const std::string& error() const { return error_; }
  /// What each part of each stage left behind when the stage last ran.
  [[nodiscard]] const std::vector<std::vector<TaskResult>>& results() const { return results_; }
  [[nodiscard]] const TaskSpec& Spec(TaskRef ref) const { return Task(ref).spec; }
  [[nodiscard]] const Digest& TaskId(TaskRef ref) const { return Task(ref).id; }

  /// The stage whose tasks are to be written down now: all that come before it are done.
  [[nodiscard]] std::optional<uint32_t> StageToPlan() const;
  /// The task that `worker` had better do now: of a loop's stage the first part that it had the
  /// last time, which it may still know, else one that nobody in `alive` had, else the last part of
  /// somebody else; of other stages the first part. A task that failed here waits for another
  /// worker while one that has not failed it is in `alive`.
  [[nodiscard]] std::optional<TaskRef> NextReady(const std::string& worker,
                                                 const std::vector<std::string>& alive,
                                                 double now_s) const;
  /// Where a task is, while it is ready.
  [[nodiscard]] std::optional<TaskRef> FindReady(const Digest& task) const;
  /// Whether this very attempt is the one whose result was taken.
  [[nodiscard]] bool WasDoneBy(const Digest& task, uint64_t epoch) const;

  /// The planned stage has these tasks; those with a result in `found` are done already.
  void StageBegins(std::vector<TaskSpec> tasks,
                   std::vector<std::optional<TaskResult>> found,
                   double now_s);
  void TaskLeased(TaskRef ref, const TaskHolder& holder, double now_s);
  void TaskProgressed(TaskRef ref, const Progress& progress);
  void TaskDone(TaskRef ref, TaskResult result, double now_s);
  /// Of class kReturned, kPermanent or kTransient (see retry_policy.h; a lost input counts as
  /// transient).
  void TaskFailed(TaskRef ref, const absl::Status& error, double now_s);
  void JobFails(const std::string& error, double now_s);
  void JobIsCancelled(double now_s);

  /// All but the workers.
  [[nodiscard]] JobStatus Status(double now_s) const;
  /// Of the last run of each stage.
  [[nodiscard]] std::vector<TaskOutcome> Outcomes() const;
  [[nodiscard]] const std::vector<TaskTiming>& Timings() const { return timings_; }
  /// Of all runs.
  [[nodiscard]] std::vector<MeasuredTask> Costs() const;

 private:
  struct TaskRecord {
    TaskSpec spec{};
    Digest id{};
    bool done = false;
    TaskHolder holder{};
    double leased_s = 0.0;
    double not_before_s = 0.0;
    uint32_t failures = 0;
    std::vector<std::string> failed_on{};
    Progress progress{};
    TaskCost cost{};
  };
  struct StageRun {
    uint32_t stage = 0;                ///< of the plan
    std::optional<uint32_t> before{};  ///< the run of the same stage before this one
    std::vector<TaskRecord> tasks{};
    std::set<uint32_t> ready{};
    std::set<uint32_t> running{};
    uint32_t done = 0;
    uint32_t reused = 0;
    uint32_t retries = 0;
    std::optional<double> first_lease_s{};
    double last_result_s = 0.0;
    double cpu_s = 0.0;
  };

  [[nodiscard]] const TaskRecord& Task(TaskRef ref) const { return runs_[ref.run].tasks[ref.part]; }
  [[nodiscard]] TaskRecord& Task(TaskRef ref) { return runs_[ref.run].tasks[ref.part]; }
  /// The stage that comes after the last run; the number of stages: none.
  [[nodiscard]] uint32_t NextStage() const;
  /// Who did this part when the stage last ran; empty: nobody.
  [[nodiscard]] const std::string& HolderBefore(const StageRun& run, uint32_t part) const;
  [[nodiscard]] bool MayTake(const TaskRecord& task,
                             const std::string& worker,
                             const std::vector<std::string>& alive,
                             double now_s) const;
  static void AddTo(StageStatus& status, const StageRun& run);
  void AttemptEnds(TaskRef ref, bool ok, double now_s);
  void JobEnds(JobState state, double now_s);
  void EndIfAllDone(double now_s);

  JobSpec spec_;
  JobPlan plan_;
  RetryPolicy policy_;
  double submitted_s_;
  double ended_s_ = 0.0;
  JobState state_ = JobState::kRunning;
  std::string error_;
  std::vector<StageRun> runs_;  ///< in order
  std::vector<std::vector<TaskResult>> results_;
  std::map<Digest, TaskRef> refs_;
  std::vector<TaskTiming> timings_;
};

}  // namespace orbweave
