// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/traces/job_spans.h"

#include <utility>

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

uint64_t SpanIdOf(const Digest& job, uint64_t since_epoch, std::string_view what) {
  const uint64_t id = DigestBuilder()
                          .AddField("orbweave span")
                          .AddField(job.ToHex())
                          .AddField(absl::StrCat(since_epoch))
                          .AddField(what)
                          .Finish()
                          .ToSeed();
  return id == 0 ? 1 : id;
}

/// A job that is to be told of; nothing: who asked for it keeps no trace.
std::optional<TraceSpan> SpanOfJob(const LogEvent& event, uint64_t now_ns) {
  TraceSpan span{.trace_id = event.job.ToHex().substr(0, 32),
                 .id = SpanIdOf(event.job, event.since_epoch.value_or(0), "job"),
                 .name = "job",
                 .start_ns = now_ns,
                 .texts = {{"orbweave.job", event.job.ToHex()}, {"orbweave.label", event.message}}};
  if (const absl::StatusOr<Traceparent> parent = ParseTraceparent(event.traceparent); parent.ok()) {
    if (!parent->is_sampled) return std::nullopt;
    span.trace_id = parent->trace_id;
    span.parent_id = parent->parent_id;
  }
  return span;
}

}  // namespace

std::string SpanIdText(uint64_t id) { return absl::StrCat(absl::Hex(id, absl::kZeroPad16)); }

std::vector<TraceSpan> JobSpans::Take(const LogEvent& event, uint64_t now_ns) {
  std::vector<TraceSpan> ended;
  const std::string& what = event.event;
  if (what == "task_leased") {
    AttemptBegins(event, now_ns, ended);
  } else if (what == "task_done" || what == "task_not_done") {
    AttemptEnds(event, now_ns, ended);
  } else if (what == "job_submitted" || what == "job_resumed") {
    JobBegins(event, now_ns);
  } else if (what == "job_done" || what == "job_failed" || what == "job_cancelled") {
    JobEnds(event, now_ns, ended);
  }
  return ended;
}

void JobSpans::JobBegins(const LogEvent& event, uint64_t now_ns) {
  jobs_.erase(event.job);
  std::optional<TraceSpan> span = SpanOfJob(event, now_ns);
  if (!span) return;
  span->texts["orbweave.begun_by"] = event.event;
  jobs_[event.job] = {.since_epoch = event.since_epoch.value_or(0), .span = *std::move(span)};
}

void JobSpans::JobEnds(const LogEvent& event, uint64_t now_ns, std::vector<TraceSpan>& ended) {
  const auto found = jobs_.find(event.job);
  if (found == jobs_.end()) return;
  EndStage(found->second, ended);
  TraceSpan& span = ended.emplace_back(std::move(found->second.span));
  jobs_.erase(found);
  span.end_ns = now_ns;
  span.texts["orbweave.ended_by"] = event.event;
  if (event.event == "job_failed") span.error = event.message;
}

void JobSpans::AttemptBegins(const LogEvent& event,
                             uint64_t now_ns,
                             std::vector<TraceSpan>& ended) {
  const auto job = jobs_.find(event.job);
  if (job == jobs_.end() || !event.run) return;
  StageSpan& stage = StageOf(event, job->second, now_ns, ended);
  ++stage.tasks;
  TraceSpan span{.trace_id = stage.span.trace_id,
                 .id = event.epoch ^ job->second.span.id,
                 .parent_id = SpanIdText(stage.span.id),
                 .name = absl::StrCat(event.stage, " task"),
                 .start_ns = now_ns,
                 .texts = {{"orbweave.stage", event.stage},
                           {"orbweave.task", event.task.ToHex()},
                           {"orbweave.worker", event.worker}},
                 .numbers = {{"orbweave.run", *event.run},
                             {"orbweave.part", event.part.value_or(0)},
                             {"orbweave.slot", event.slot.value_or(0)},
                             {"orbweave.epoch", event.epoch}}};
  if (span.id == 0) span.id = job->second.span.id;
  const WorkerSlot at{event.worker, event.slot.value_or(0)};
  epochs_at_[at].push_back(event.epoch);
  attempts_[event.epoch] = {at, std::move(span)};
}

JobSpans::StageSpan& JobSpans::StageOf(const LogEvent& lease,
                                       JobSpan& job,
                                       uint64_t now_ns,
                                       std::vector<TraceSpan>& ended) {
  if (job.stage && job.stage->run == *lease.run) return *job.stage;
  if (job.stage && job.stage->run > *lease.run) ++job.times_anew;
  EndStage(job, ended);
  const std::string what = absl::StrCat("run ", *lease.run, " ", job.times_anew);
  job.stage = StageSpan{.run = *lease.run,
                        .span = {.trace_id = job.span.trace_id,
                                 .id = SpanIdOf(lease.job, job.since_epoch, what),
                                 .parent_id = SpanIdText(job.span.id),
                                 .name = lease.stage,
                                 .start_ns = now_ns,
                                 .end_ns = now_ns,
                                 .texts = {{"orbweave.stage", lease.stage}},
                                 .numbers = {{"orbweave.run", *lease.run}}}};
  return *job.stage;
}

void JobSpans::EndStage(JobSpan& job, std::vector<TraceSpan>& ended) {
  if (!job.stage) return;
  job.stage->span.numbers["orbweave.attempts"] = job.stage->tasks;
  job.stage->span.numbers["orbweave.attempts_failed"] = job.stage->failed;
  ended.push_back(std::move(job.stage->span));
  job.stage.reset();
}

void JobSpans::AttemptEnds(const LogEvent& event, uint64_t now_ns, std::vector<TraceSpan>& ended) {
  const auto found = attempts_.find(event.epoch);
  if (found == attempts_.end()) return;
  const WorkerSlot at = std::move(found->second.at);
  TraceSpan& span = ended.emplace_back(std::move(found->second.span));
  attempts_.erase(found);
  LetNextBegin(at, event.epoch, now_ns);
  span.end_ns = now_ns;
  const bool has_failed = event.level != LogLevel::kInfo;
  if (has_failed) span.error = event.message;
  if (event.event == "task_not_done") span.texts["orbweave.not_done"] = event.message;
  const auto job = jobs_.find(event.job);
  if (job == jobs_.end() || !job->second.stage) return;
  job->second.stage->span.end_ns = now_ns;
  job->second.stage->failed += has_failed ? 1 : 0;
}

void JobSpans::LetNextBegin(const WorkerSlot& at, uint64_t gone, uint64_t now_ns) {
  const auto slot = epochs_at_.find(at);
  std::erase(slot->second, gone);
  for (const uint64_t epoch : slot->second) attempts_.at(epoch).span.start_ns = now_ns;
  if (slot->second.empty()) epochs_at_.erase(slot);
}

}  // namespace orbweave
