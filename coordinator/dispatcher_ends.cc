// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// How attempts end that have no result, and what follows.

#include <algorithm>
#include <iterator>
#include <utility>

#include "absl/strings/str_cat.h"
#include "coordinator/dispatcher.h"
#include "core/pipeline/damaged_blob.h"

namespace orbweave {
namespace {

/// How often a job starts over because a blob it had made is gone.
constexpr uint32_t kMaxReruns = 3;

}  // namespace

void Dispatcher::CountFailures(const Digest& id, std::vector<FailedAttempt> failures) {
  Job& job = jobs_.At(id);
  auto first = failures.begin();  // after the last time that the job started over
  for (auto it = failures.begin(); it != failures.end() && job.reruns < kMaxReruns; ++it) {
    if (ClassifyFailure(it->code) != FailureClass::kInputLost) continue;
    ++job.reruns;
    first = it + 1;
  }
  failures.erase(failures.begin(), first);
  job.machine->Remember(failures);
}

void Dispatcher::EndAttempt(const LeaseEntry& entry, const absl::Status& error, double now_s) {
  // A task that has no place in its job yet is given out anew as if nothing had been.
  const auto code = entry.ref ? error.code() : absl::StatusCode::kCancelled;
  ends_.push_back({entry.epoch, std::string(error.message()), code});
  LogEvent event = Describe(entry, "task_not_done");
  if (ClassifyFailure(error.code()) != FailureClass::kReturned) event.level = LogLevel::kWarning;
  event.message = std::string(error.message());
  Log(event);
  if (entry.ref && jobs_.At(entry.job).IsRunning()) FailOrBeginAnew(entry, error, now_s);
  options_.changed();
}

void Dispatcher::FailOrBeginAnew(const LeaseEntry& entry, const absl::Status& error, double now_s) {
  Job& job = jobs_.At(entry.job);
  const std::optional<Digest> blob = BlobToBlame(error);
  if (blob && !job.machine->MakersOf(*blob, *entry.ref).empty())
    return MakeAgain(entry, *blob, error, now_s);
  const bool input_lost = ClassifyFailure(error.code()) == FailureClass::kInputLost;
  if (input_lost && job.reruns < kMaxReruns) {
    ++job.reruns;
    job.verify = true;
    // All bytes were right the last time, and still what they say does not fit.
    if (absl::IsDataLoss(error) && job.reruns > 1 && !std::exchange(job.damage.is_remade, true))
      std::ranges::move(job.machine->TasksReadBy(*entry.ref), std::back_inserter(spoilt_));
    return BeginAnew(job, now_s);
  }
  job.machine->TaskFailed({*entry.ref, entry.epoch}, error, now_s, roster_.Serving(now_s));
  if (!job.IsRunning()) VoidLeases(entry.job, "the job failed");
}

void Dispatcher::MakeAgain(const LeaseEntry& reader,
                           const Digest& blob,
                           const absl::Status& error,
                           double now_s) {
  Job& job = jobs_.At(reader.job);
  const std::string reason = absl::StrCat("it left blob ",
                                          blob.ToShortHex(),
                                          ", which ",
                                          job.machine->Describe(*reader.ref),
                                          " cannot read: ",
                                          error.message());
  job.damage.blobs.insert(blob);
  const std::vector<TaskRef> makers = job.machine->MakersOf(blob, *reader.ref);
  for (const TaskRef& maker : makers) NoteDamage(maker, reader, reason);
  if (++job.damage.reports <= options_.retry.job_retries) return BeginAnew(job, now_s);
  JobFails(reader.job,
           absl::StrCat("the job gave up after ",
                        job.damage.reports,
                        " damaged results, the last of ",
                        job.machine->Describe(makers.back()),
                        ": ",
                        reason),
           now_s);
}

void Dispatcher::NoteDamage(TaskRef maker, const LeaseEntry& reader, const std::string& reason) {
  Job& job = jobs_.At(reader.job);
  const JobMachine& machine = *job.machine;
  const Digest& task = machine.TaskId(maker);
  const std::string& worker = machine.WorkerOf(maker);
  job.damage.results.push_back({task, worker, absl::StatusCode::kDataLoss, reason});
  spoilt_.push_back(task);
  Log({.level = LogLevel::kWarning,
       .event = "result_damaged",
       .job = reader.job,
       .stage = machine.Spec(maker).stage,
       .part = maker.part,
       .task = task,
       .worker = worker,
       .message = reason});
}

void Dispatcher::BeginAnew(Job& job, double now_s) {
  BeginJob(JobSpec(job.machine->spec()), JobPlan(job.machine->plan()), job.number, now_s);
  job.machine->Remember(job.damage.results);
}

void Dispatcher::EndLost(const LeaseEntry& entry, const absl::Status& error, double now_s) {
  // Nor has one that was never handed out.
  const bool was_tried = !entry.waits && !starting_.contains(entry.epoch);
  EndAttempt(entry, was_tried ? error : absl::CancelledError(error.message()), now_s);
}

void Dispatcher::EndAllLost(const std::vector<LeaseEntry>& entries,
                            const std::string& reason,
                            double now_s) {
  for (const LeaseEntry& entry : entries) EndLost(entry, absl::UnavailableError(reason), now_s);
}

void Dispatcher::VoidLeases(const Digest& job, const std::string& reason) {
  for (const LeaseEntry& entry : book_.TakeJob(job)) EndVoid(entry, reason);
}

void Dispatcher::EndVoid(const LeaseEntry& entry, const std::string& reason) {
  ends_.push_back({.epoch = entry.epoch, .reason = reason});
  LogEvent event = Describe(entry, "task_not_done");
  event.message = reason;
  Log(event);
}

void Dispatcher::ExpireLeases(double now_s) {
  roster_.ForgetGone(now_s);
  for (const LeaseEntry& entry : book_.TakeExpired(now_s)) {
    LogEvent event = Describe(entry, "lease_expired");
    event.level = LogLevel::kWarning;
    Log(event);
    const bool came_back = entry.session != 0;
    EndLost(entry,
            came_back
                ? absl::UnavailableError(absl::StrCat("worker ", entry.worker, " went silent"))
                : absl::CancelledError(
                      absl::StrCat("worker ", entry.worker, " did not come back after a restart")),
            now_s);
  }
}

}  // namespace orbweave
