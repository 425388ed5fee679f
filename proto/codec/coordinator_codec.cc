// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "proto/codec/coordinator_codec.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

using DigestField = google::protobuf::RepeatedPtrField<std::string>;

void AddDigests(const std::vector<Digest>& digests, DigestField* field) {
  field->Reserve(static_cast<int>(digests.size()));
  for (const Digest& digest : digests) *field->Add() = ToProto(digest);
}

v1::StageStatus ToProto(const StageStatus& stage) {
  v1::StageStatus proto;
  proto.set_stage(stage.stage);
  proto.set_tasks_total(stage.tasks_total);
  proto.set_tasks_done(stage.tasks_done);
  proto.set_tasks_reused(stage.tasks_reused);
  proto.set_tasks_running(stage.tasks_running);
  proto.set_retries(stage.retries);
  proto.set_wall_s(stage.wall_s);
  proto.set_cpu_s(stage.cpu_s);
  proto.set_fraction_running(stage.fraction_running);
  proto.set_weight(stage.weight);
  proto.set_usual_runs(stage.usual_runs);
  proto.set_runs(stage.runs);
  proto.set_busy_s(stage.busy_s);
  proto.set_has_parts(stage.has_parts);
  return proto;
}

StageStatus FromProto(const v1::StageStatus& proto) {
  return {.stage = proto.stage(),
          .tasks_total = proto.tasks_total(),
          .tasks_done = proto.tasks_done(),
          .tasks_reused = proto.tasks_reused(),
          .tasks_running = proto.tasks_running(),
          .retries = proto.retries(),
          .wall_s = proto.wall_s(),
          .cpu_s = proto.cpu_s(),
          .fraction_running = proto.fraction_running(),
          .weight = proto.weight(),
          .usual_runs = proto.usual_runs(),
          .runs = proto.runs(),
          .busy_s = proto.busy_s(),
          .has_parts = proto.has_parts()};
}

v1::TaskCost ToProto(const TaskCost& cost) {
  v1::TaskCost proto;
  proto.set_wall_s(cost.wall_s);
  proto.set_cpu_s(cost.cpu_s);
  proto.set_bytes_in(cost.bytes_in);
  proto.set_bytes_out(cost.bytes_out);
  proto.set_peak_memory_bytes(cost.peak_memory_bytes);
  return proto;
}

TaskCost FromProto(const v1::TaskCost& proto) {
  return {.wall_s = proto.wall_s(),
          .cpu_s = proto.cpu_s(),
          .bytes_in = proto.bytes_in(),
          .bytes_out = proto.bytes_out(),
          .peak_memory_bytes = proto.peak_memory_bytes()};
}

/// Who says how long tasks take learns from them how long the next ones will.
absl::Status CheckCost(const TaskCost& cost) {
  constexpr double kLongest_s = 1e9;
  if (std::abs(cost.wall_s) <= kLongest_s && std::abs(cost.cpu_s) <= kLongest_s)
    return absl::OkStatus();
  return absl::InvalidArgumentError("a task took no number of seconds");
}

}  // namespace

std::string ToProto(const Digest& digest) { return {digest.bytes.begin(), digest.bytes.end()}; }

absl::StatusOr<Digest> DigestFromProto(std::string_view bytes) {
  Digest digest;
  if (bytes.size() != digest.bytes.size()) {
    return absl::InvalidArgumentError(absl::StrCat("a digest has 32 bytes, not ", bytes.size()));
  }
  std::copy(bytes.begin(), bytes.end(), digest.bytes.begin());
  return digest;
}

absl::StatusOr<std::vector<Digest>> DigestsFromProto(const DigestField& digests) {
  std::vector<Digest> decoded;
  decoded.reserve(static_cast<size_t>(digests.size()));
  for (const std::string& bytes : digests) {
    ORBWEAVE_ASSIGN_OR_RETURN(decoded.emplace_back(), DigestFromProto(bytes));
  }
  return decoded;
}

v1::TaskSpec ToProto(const TaskSpec& spec) {
  v1::TaskSpec proto;
  proto.set_stage(spec.stage);
  proto.set_version(spec.version);
  AddDigests(spec.inputs, proto.mutable_inputs());
  proto.set_options_text(spec.options_text);
  proto.set_part(spec.part);
  return proto;
}

absl::StatusOr<TaskSpec> FromProto(const v1::TaskSpec& proto) {
  TaskSpec spec{.stage = proto.stage(),
                .version = proto.version(),
                .options_text = proto.options_text(),
                .part = proto.part()};
  ORBWEAVE_ASSIGN_OR_RETURN(spec.inputs, DigestsFromProto(proto.inputs()));
  return spec;
}

v1::TaskResult ToProto(const TaskResult& result) {
  v1::TaskResult proto;
  AddDigests(result.outputs, proto.mutable_outputs());
  AddDigests(result.recipes, proto.mutable_recipes());
  proto.set_report_json(result.report_json);
  *proto.mutable_cost() = ToProto(result.cost);
  return proto;
}

absl::StatusOr<TaskResult> FromProto(const v1::TaskResult& proto) {
  TaskResult result{.report_json = proto.report_json(), .cost = FromProto(proto.cost())};
  ORBWEAVE_RETURN_IF_ERROR(CheckCost(result.cost));
  ORBWEAVE_ASSIGN_OR_RETURN(result.outputs, DigestsFromProto(proto.outputs()));
  ORBWEAVE_ASSIGN_OR_RETURN(result.recipes, DigestsFromProto(proto.recipes()));
  return result;
}

v1::TaskOutcome ToProto(const TaskOutcome& outcome) {
  v1::TaskOutcome proto;
  proto.set_stage(outcome.stage);
  proto.set_part(outcome.part);
  proto.set_id(ToProto(outcome.id));
  *proto.mutable_result() = ToProto(outcome.result);
  return proto;
}

absl::StatusOr<TaskOutcome> FromProto(const v1::TaskOutcome& proto) {
  TaskOutcome outcome{.stage = proto.stage(), .part = proto.part()};
  ORBWEAVE_ASSIGN_OR_RETURN(outcome.id, DigestFromProto(proto.id()));
  ORBWEAVE_ASSIGN_OR_RETURN(outcome.result, FromProto(proto.result()));
  return outcome;
}

v1::TaskTiming ToProto(const TaskTiming& timing) {
  v1::TaskTiming proto;
  proto.set_run(timing.run);
  proto.set_stage(timing.stage);
  proto.set_part(timing.part);
  proto.set_worker(timing.worker);
  proto.set_slot(timing.slot);
  proto.set_start_s(timing.start_s);
  proto.set_end_s(timing.end_s);
  proto.set_ok(timing.ok);
  return proto;
}

TaskTiming FromProto(const v1::TaskTiming& proto) {
  return {.run = proto.run(),
          .stage = proto.stage(),
          .part = proto.part(),
          .worker = proto.worker(),
          .slot = proto.slot(),
          .start_s = proto.start_s(),
          .end_s = proto.end_s(),
          .ok = proto.ok()};
}

v1::MeasuredTask ToProto(const MeasuredTask& task) {
  v1::MeasuredTask proto;
  proto.set_run(task.run);
  proto.set_stage(task.stage);
  proto.set_part(task.part);
  *proto.mutable_cost() = ToProto(task.cost);
  return proto;
}

MeasuredTask FromProto(const v1::MeasuredTask& proto) {
  return {.run = proto.run(),
          .stage = proto.stage(),
          .part = proto.part(),
          .cost = FromProto(proto.cost())};
}

v1::JobSpec ToProto(const JobSpec& job) {
  v1::JobSpec proto;
  proto.set_kind(job.kind);
  AddDigests(job.inputs, proto.mutable_inputs());
  proto.set_options_text(job.options_text);
  proto.set_label(job.label);
  proto.set_traceparent(job.traceparent);
  return proto;
}

absl::StatusOr<JobSpec> FromProto(const v1::JobSpec& proto) {
  JobSpec job{.kind = proto.kind(),
              .options_text = proto.options_text(),
              .label = proto.label(),
              .traceparent = proto.traceparent()};
  ORBWEAVE_ASSIGN_OR_RETURN(job.inputs, DigestsFromProto(proto.inputs()));
  return job;
}

v1::JobStatus ToProto(const JobStatus& status) {
  v1::JobStatus proto;
  proto.set_id(ToProto(status.id));
  proto.set_state(static_cast<uint32_t>(status.state));
  proto.set_error(status.error);
  *proto.mutable_spec() = ToProto(status.spec);
  proto.set_elapsed_s(status.elapsed_s);
  proto.set_unmet(status.unmet);
  proto.set_slots(status.slots);
  for (const StageStatus& stage : status.stages) *proto.add_stages() = ToProto(stage);
  return proto;
}

absl::StatusOr<JobStatus> FromProto(const v1::JobStatus& proto) {
  JobStatus status{.error = proto.error(),
                   .unmet = proto.unmet(),
                   .elapsed_s = proto.elapsed_s(),
                   .slots = proto.slots()};
  ORBWEAVE_ASSIGN_OR_RETURN(status.spec, FromProto(proto.spec()));
  ORBWEAVE_ASSIGN_OR_RETURN(status.id, DigestFromProto(proto.id()));
  ORBWEAVE_ASSIGN_OR_RETURN(status.state, JobStateFromProto(proto.state()));
  for (const v1::StageStatus& stage : proto.stages()) status.stages.push_back(FromProto(stage));
  return status;
}

absl::StatusOr<JobState> JobStateFromProto(uint32_t state) {
  if (state <= static_cast<uint32_t>(JobState::kCancelled)) return static_cast<JobState>(state);
  return absl::InvalidArgumentError(absl::StrCat("there is no job state ", state));
}

v1::WorkerStatus ToProto(const WorkerStatus& worker) {
  v1::WorkerStatus proto;
  proto.set_name(worker.name);
  proto.set_slots(worker.slots);
  proto.set_tasks_done(worker.tasks_done);
  proto.set_alive(worker.alive);
  proto.set_set_aside(worker.set_aside);
  proto.set_tasks_running(worker.tasks_running);
  proto.set_draining(worker.draining);
  return proto;
}

WorkerStatus FromProto(const v1::WorkerStatus& proto) {
  return {.name = proto.name(),
          .slots = proto.slots(),
          .tasks_done = proto.tasks_done(),
          .alive = proto.alive(),
          .set_aside = proto.set_aside(),
          .draining = proto.draining(),
          .tasks_running = proto.tasks_running()};
}

v1::JoinRequest ToProto(const WorkerInfo& worker) {
  v1::JoinRequest proto;
  proto.set_name(worker.name);
  proto.set_version(worker.version);
  proto.set_slots(worker.slots);
  for (const LeaseProgress& lease : worker.held) *proto.add_held() = ToProto(lease);
  proto.set_process(worker.process);
  proto.mutable_offers()->set_memory_bytes(worker.offers.memory_bytes);
  proto.mutable_offers()->set_threads(worker.offers.threads);
  proto.mutable_offers()->set_gpus(worker.offers.gpus);
  if (worker.stays_s) proto.set_stays_s(*worker.stays_s);
  return proto;
}

absl::StatusOr<WorkerInfo> FromProto(const v1::JoinRequest& proto) {
  WorkerInfo worker{.name = proto.name(),
                    .version = proto.version(),
                    .slots = proto.slots(),
                    .process = proto.process(),
                    .offers = {.memory_bytes = proto.offers().memory_bytes(),
                               .threads = proto.offers().threads(),
                               .gpus = proto.offers().gpus()}};
  if (proto.has_stays_s()) {
    if (!std::isfinite(proto.stays_s()) || proto.stays_s() < 0.0)
      return absl::InvalidArgumentError("a worker stays for a number of seconds");
    worker.stays_s = proto.stays_s();
  }
  for (const v1::LeaseProgress& lease : proto.held()) {
    ORBWEAVE_ASSIGN_OR_RETURN(worker.held.emplace_back(), FromProto(lease));
  }
  return worker;
}

v1::JoinReply ToProto(const JoinReply& reply) {
  v1::JoinReply proto;
  proto.set_session(reply.session);
  proto.set_lease_s(reply.lease_s);
  proto.set_heartbeat_s(reply.heartbeat_s);
  return proto;
}

JoinReply FromProto(const v1::JoinReply& proto) {
  return {
      .session = proto.session(), .lease_s = proto.lease_s(), .heartbeat_s = proto.heartbeat_s()};
}

v1::Lease ToProto(const Lease& lease) {
  v1::Lease proto;
  proto.set_task(ToProto(lease.task));
  proto.set_epoch(lease.epoch);
  *proto.mutable_spec() = ToProto(lease.spec);
  proto.set_slot(lease.slot);
  return proto;
}

absl::StatusOr<Lease> FromProto(const v1::Lease& proto) {
  Lease lease{.epoch = proto.epoch(), .slot = proto.slot()};
  ORBWEAVE_ASSIGN_OR_RETURN(lease.task, DigestFromProto(proto.task()));
  ORBWEAVE_ASSIGN_OR_RETURN(lease.spec, FromProto(proto.spec()));
  return lease;
}

v1::LeaseProgress ToProto(const LeaseProgress& progress) {
  v1::LeaseProgress proto;
  proto.set_task(ToProto(progress.task));
  proto.set_epoch(progress.epoch);
  proto.set_done(progress.progress.done);
  proto.set_total(progress.progress.total);
  proto.set_unit(progress.progress.unit);
  return proto;
}

absl::StatusOr<LeaseProgress> FromProto(const v1::LeaseProgress& proto) {
  LeaseProgress progress{.epoch = proto.epoch(),
                         .progress = {proto.done(), proto.total(), proto.unit()}};
  ORBWEAVE_ASSIGN_OR_RETURN(progress.task, DigestFromProto(proto.task()));
  return progress;
}

v1::HeartbeatReply ToProto(const HeartbeatReply& reply) {
  v1::HeartbeatReply proto;
  AddDigests(reply.cancelled, proto.mutable_cancelled());
  proto.set_shutdown(reply.shutdown);
  return proto;
}

absl::StatusOr<HeartbeatReply> FromProto(const v1::HeartbeatReply& proto) {
  HeartbeatReply reply{.shutdown = proto.shutdown()};
  ORBWEAVE_ASSIGN_OR_RETURN(reply.cancelled, DigestsFromProto(proto.cancelled()));
  return reply;
}

}  // namespace orbweave
