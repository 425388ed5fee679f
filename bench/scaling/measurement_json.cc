// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bench/scaling/measurement_json.h"

#include "absl/strings/str_cat.h"
#include "core/io/json_text.h"

namespace orbweave {
namespace {

Json JsonOf(const MeasuredTask& task) {
  const TaskCost& cost = task.cost;
  return {{"run", task.run},
          {"stage", task.stage},
          {"part", task.part},
          {"wall_s", cost.wall_s},
          {"cpu_s", cost.cpu_s},
          {"bytes_in", cost.bytes_in},
          {"bytes_out", cost.bytes_out},
          {"peak_memory_bytes", cost.peak_memory_bytes}};
}

Json JsonOf(const TaskTiming& timing) {
  return {{"run", timing.run},
          {"stage", timing.stage},
          {"part", timing.part},
          {"worker", timing.worker},
          {"slot", timing.slot},
          {"start_s", timing.start_s},
          {"end_s", timing.end_s},
          {"ok", timing.ok}};
}

template <typename Values>
Json ListOf(const Values& values) {
  Json list = Json::array();
  for (const auto& value : values) list.push_back(JsonOf(value));
  return list;
}

MeasuredTask TaskOf(const Json& json) {
  return {.run = json.at("run"),
          .stage = json.at("stage"),
          .part = json.at("part"),
          .cost = {.wall_s = json.at("wall_s"),
                   .cpu_s = json.at("cpu_s"),
                   .bytes_in = json.at("bytes_in"),
                   .bytes_out = json.at("bytes_out"),
                   .peak_memory_bytes = json.at("peak_memory_bytes")}};
}

TaskTiming TimingOf(const Json& json) {
  return {.run = json.at("run"),
          .stage = json.at("stage"),
          .part = json.at("part"),
          .worker = json.at("worker"),
          .slot = json.at("slot"),
          .start_s = json.at("start_s"),
          .end_s = json.at("end_s"),
          .ok = json.at("ok")};
}

JobMeasurement MeasurementOf(const Json& json) {
  JobMeasurement measurement{
      .label = json.at("label"),
      .panoramas = json.at("panoramas"),
      .registered = json.at("registered"),
      .residual_px_rms = json.at("residual_px_rms"),
      .workers = json.at("workers"),
      .wall_s = json.at("wall_s"),
      .overhead = {.task_s = json.at("task_overhead_s"), .stage_s = json.at("stage_overhead_s")},
      .coordinator_cpu_s = json.at("coordinator_cpu_s"),
      .coordinator_peak_bytes = json.at("coordinator_peak_bytes"),
      .slots = json.at("slots")};
  for (const Json& task : json.at("tasks")) measurement.tasks.push_back(TaskOf(task));
  for (const Json& timing : json.at("timings")) measurement.timings.push_back(TimingOf(timing));
  return measurement;
}

}  // namespace

std::string MeasurementJson(const JobMeasurement& measurement) {
  return JsonText({{"label", measurement.label},
                   {"panoramas", measurement.panoramas},
                   {"registered", measurement.registered},
                   {"residual_px_rms", measurement.residual_px_rms},
                   {"workers", measurement.workers},
                   {"slots", measurement.slots},
                   {"wall_s", measurement.wall_s},
                   {"task_overhead_s", measurement.overhead.task_s},
                   {"stage_overhead_s", measurement.overhead.stage_s},
                   {"coordinator_cpu_s", measurement.coordinator_cpu_s},
                   {"coordinator_peak_bytes", measurement.coordinator_peak_bytes},
                   {"tasks", ListOf(measurement.tasks)},
                   {"timings", ListOf(measurement.timings)}});
}

absl::StatusOr<JobMeasurement> ParseMeasurement(std::string_view json) {
  try {
    return MeasurementOf(Json::parse(json));
  } catch (const Json::exception& error) {
    return absl::DataLossError(absl::StrCat("no measurement of a job: ", error.what()));
  }
}

}  // namespace orbweave
