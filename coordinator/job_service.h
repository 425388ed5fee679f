// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <mutex>
#include <string_view>

#include "coordinator/dispatcher.h"
#include "coordinator/journal/journal.h"
#include "core/base/clock.h"
#include "core/pipeline/job_plan.h"

namespace orbweave {

/// Where jobs come in and go out, the journal first: a job is durable before it begins. What the
/// service is given outlives it. Thread-safe.
class JobService {
 public:
  /// `mutex` guards `dispatcher`. While `max_running_jobs` run, no more are taken.
  JobService(std::mutex& mutex,
             Dispatcher& dispatcher,
             Journal& journal,
             PlanLookup find_plan,
             uint32_t max_running_jobs,
             const Clock& clock)
      : mutex_(mutex),
        dispatcher_(dispatcher),
        journal_(journal),
        find_plan_(std::move(find_plan)),
        max_running_jobs_(max_running_jobs),
        clock_(clock) {}

  /// Takes up the jobs of the journal where they were. With `leases_survive` the attempts that were
  /// open go on under their leases, if their workers come back in time; otherwise they have ended.
  [[nodiscard]] absl::Status Resume(bool leases_survive);
  /// See JobApi::SubmitJob.
  [[nodiscard]] absl::StatusOr<Digest> Submit(const JobSpec& spec);
  /// See JobApi::ForgetJob.
  [[nodiscard]] absl::Status Forget(const Digest& id);
  /// Notes in the journal how a job ended, unless that was done.
  void SaveEnd(const Digest& id);

 private:
  [[nodiscard]] absl::Status ResumeJobs();
  [[nodiscard]] absl::Status ResumeBlames();
  [[nodiscard]] absl::Status ResumeAttempts(bool leases_survive);

  std::mutex& mutex_;
  Dispatcher& dispatcher_;
  Journal& journal_;
  PlanLookup find_plan_;
  uint32_t max_running_jobs_;
  const Clock& clock_;
  std::mutex saving_mutex_;  ///< one writer of jobs at a time; taken before mutex_
};

}  // namespace orbweave
