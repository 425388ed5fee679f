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

#include "coordinator/jobs/retry_policy.h"
#include "coordinator/jobs/stage_run.h"
#include "coordinator/journal/journal.h"
#include "core/pipeline/job_api.h"
#include "core/pipeline/job_plan.h"
#include "core/pipeline/loop_guard.h"

namespace orbweave {

/// A task's place in its job.
struct TaskRef {
  uint32_t run = 0;  ///< of a stage: loops run a stage several times
  uint32_t part = 0;
  friend auto operator<=>(const TaskRef&, const TaskRef&) = default;
};

/// One attempt at a task.
struct AttemptRef {
  TaskRef task{};
  uint64_t epoch = 0;
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
///           a task that runs far longer than its siblings is leased once more; the first result
///           counts
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
  [[nodiscard]] const StageNeeds& Needs(TaskRef ref) const { return RuleOf(ref.run).needs; }
  /// The stage whose tasks are given out now; nullptr: none is ready.
  [[nodiscard]] const StageRule* StageToGiveOut() const;
  /// How long its tasks usually take; see StageRun::usual_s.
  [[nodiscard]] double UsualTime_s() const { return runs_.empty() ? 0.0 : runs_.back().usual_s(); }

  /// The stage whose tasks are to be written down now: all that come before it are done.
  [[nodiscard]] std::optional<uint32_t> StageToPlan() const;
  /// Whether a task may be ready, or wait too long for the one who does it, now or later.
  [[nodiscard]] bool MayHaveWork() const;
  /// The same of this moment.
  [[nodiscard]] bool MayHaveWork(double now_s) const;
  /// Tasks that are ready, wait to be tried again, or run; at least one as long as the job runs.
  [[nodiscard]] uint64_t CountOpenTasks() const;
  /// The task that a worker had better do next in this slot; see ChoosePart.
  [[nodiscard]] std::optional<TaskRef> NextReady(const WorkerSlot& at,
                                                 const std::vector<std::string>& alive,
                                                 double now_s,
                                                 bool ahead = false) const;
  /// Where a task is, while it is ready.
  [[nodiscard]] std::optional<TaskRef> FindReady(const Digest& task) const;
  /// A task that `worker` may do beside the one who does it already: no task is ready, this one
  /// runs much longer than its siblings did, and few others of all `slots` run twice.
  [[nodiscard]] std::optional<TaskRef> NextStraggler(const std::string& worker,
                                                     uint32_t slots,
                                                     double now_s) const;
  /// Workers that failed a task, each once.
  [[nodiscard]] std::set<std::string> FailedOn(TaskRef ref) const;
  /// The tasks that left a blob, when their stage last ran, of stages that come no later than that
  /// of `reader`.
  [[nodiscard]] std::vector<TaskRef> MakersOf(const Digest& blob, TaskRef reader) const;
  /// Ids of the tasks of all stages that this task's stage reads, when they last ran.
  [[nodiscard]] std::vector<Digest> TasksReadBy(TaskRef ref) const;
  /// Who did a task; no name: it was found done.
  [[nodiscard]] const std::string& WorkerOf(TaskRef ref) const { return Task(ref).done_by.worker; }
  [[nodiscard]] std::string Describe(TaskRef ref) const { return Task(ref).Describe(); }
  /// Whether this very attempt is the one whose result was taken.
  [[nodiscard]] bool WasDoneBy(const Digest& task, uint64_t epoch) const;

  /// Attempts that failed before a restart: they count when the stage of their task begins.
  void Remember(const std::vector<FailedAttempt>& failures);
  /// The planned stage has these tasks; those with a result in `found` are done already. The job
  /// fails when they are a round of a loop that would never end (LoopGuard).
  void StageBegins(std::vector<TaskSpec> tasks,
                   std::vector<std::optional<TaskResult>> found,
                   double now_s);
  void TaskLeased(TaskRef ref, const TaskHolder& holder, double now_s);
  void TaskProgressed(AttemptRef ref, const Progress& progress);
  /// Ends every attempt at the task.
  void TaskDone(AttemptRef ref, TaskResult result, double now_s);
  /// See retry_policy.h for what becomes of which error. `serving`: the workers that there are.
  void TaskFailed(AttemptRef ref,
                  const absl::Status& error,
                  double now_s,
                  const std::vector<std::string>& serving = {});
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
  [[nodiscard]] const TaskRecord& Task(TaskRef ref) const { return runs_[ref.run].tasks[ref.part]; }
  [[nodiscard]] const StageRule& RuleOf(uint32_t run) const {
    return plan_.stages[runs_[run].stage];
  }
  [[nodiscard]] TaskRecord& Task(TaskRef ref) { return runs_[ref.run].tasks[ref.part]; }
  /// The stage that comes after the last run; the number of stages: none.
  [[nodiscard]] uint32_t NextStage() const;
  /// The last run of a stage; the number of runs: there is none.
  [[nodiscard]] uint32_t LastRunOf(uint32_t stage) const;
  /// Of the run that begins.
  void FindHomes();
  void TakeFound(std::vector<std::optional<TaskResult>> found);
  void CountPastFailures(double now_s);
  /// Strikes out an attempt and notes its time; how long it took.
  double AttemptEnds(AttemptRef ref, bool ok, double now_s);
  void CountFailure(TaskRecord& task,
                    const std::string& worker,
                    const absl::Status& error,
                    bool another_may_try,
                    double now_s);
  void JobEnds(JobState state, double now_s);
  void EndIfAllDone(double now_s);

  JobSpec spec_;
  JobPlan plan_;
  LoopGuard loops_{};
  RetryPolicy policy_;
  double submitted_s_;
  double ended_s_ = 0.0;
  JobState state_ = JobState::kRunning;
  std::string error_;
  size_t num_tasks_ = 0;        ///< of all runs
  uint32_t num_failures_ = 0;   ///< of attempts
  std::vector<StageRun> runs_;  ///< in order
  std::vector<std::vector<TaskResult>> results_;
  std::map<Digest, TaskRef> refs_;
  std::map<Digest, std::vector<FailedAttempt>> past_failures_;  ///< by task
  std::vector<TaskTiming> timings_;
  std::map<WorkerSlot, double> free_since_s_;  ///< when a task last ended there
};

}  // namespace orbweave
