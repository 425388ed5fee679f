// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bench/scaling/scaling_json.h"

#include "bench/scaling/engine_study_text.h"
#include "core/io/json_text.h"

namespace orbweave {
namespace {

Json JsonOf(const ScalingRun& run) {
  return {{"panoramas", run.panoramas},
          {"registered", run.registered},
          {"workers", run.workers},
          {"wall_s", run.wall_s},
          {"cpu_s", run.cpu_s},
          {"efficiency", run.efficiency > 0.0 ? Json(run.efficiency) : Json(nullptr)},
          {"simulated_s", run.simulated_s},
          {"residual_px_rms", run.residual_px_rms},
          {"coordinator_peak_bytes", run.coordinator_peak_bytes}};
}

Json JsonOf(const ScalingStage& stage) {
  return {{"name", stage.name},
          {"runs", stage.runs},
          {"tasks", stage.tasks},
          {"cpu_s", stage.cpu_s},
          {"serial_share", stage.serial_share},
          {"growth_exponent", stage.growth_exponent ? Json(*stage.growth_exponent) : Json(nullptr)},
          {"bytes_in_per_panorama", stage.bytes_in_per_panorama},
          {"bytes_out_per_panorama", stage.bytes_out_per_panorama},
          {"peak_memory_bytes", stage.peak_memory_bytes}};
}

Json JsonOf(const ScalingPoint& point) {
  return {{"workers", point.workers},
          {"wall_s", point.wall_s},
          {"efficiency", point.efficiency},
          {"stage_s", point.stage_s}};
}

Json JsonOf(const ScalingWeakPoint& point) {
  return {{"simulated", true},
          {"workers", point.workers},
          {"panoramas", point.panoramas},
          {"wall_s", point.wall_s},
          {"efficiency", point.efficiency}};
}

Json JsonOf(const ScalingPrediction& prediction);
Json JsonOf(const LinkTraffic& link);
Json JsonOf(const StudyPoint& point);

template <typename Values>
Json ListOf(const Values& values) {
  Json list = Json::array();
  for (const auto& value : values) list.push_back(JsonOf(value));
  return list;
}

Json JsonOf(const ScalingPrediction& prediction) {
  return {{"simulated", true},
          {"panoramas", prediction.panoramas},
          {"extrapolated", prediction.extrapolated},
          {"critical_path_s", prediction.critical_path_s},
          {"critical_stage_s", prediction.critical_stage_s},
          {"points", ListOf(prediction.points)}};
}

Json JsonOf(const ScalingAssumptions& assumed) {
  return {{"worker_gbit_per_s", assumed.worker_gbit_per_s},
          {"coordinator_gbit_per_s", assumed.coordinator_gbit_per_s},
          {"overhead_measured", assumed.overhead_measured},
          {"task_overhead_s", assumed.task_overhead_s},
          {"stage_overhead_s", assumed.stage_overhead_s},
          {"coordinator_s_per_task", assumed.coordinator_s_per_task}};
}

Json JsonOf(const LinkTraffic& link) {
  return {{"node", link.node}, {"in_bytes", link.in_bytes}, {"out_bytes", link.out_bytes}};
}

Json JsonOf(const TimeShares& shares) {
  Json json = Json::object();
  for (const auto& [name, share] : TimeCauses()) json[name] = shares.*share;
  return json;
}

Json JsonOf(const StudyPoint& point) {
  return {{"scaling", ScalingKindName(point.kind)},
          {"nodes", point.nodes},
          {"repeat", point.repeat},
          {"panoramas", point.panoramas},
          {"wall_s", point.wall_s},
          {"cpu_s", point.cpu_s},
          {"efficiency", point.efficiency},
          {"simulated_s", point.simulated_s},
          {"simulation_error", point.simulation_error},
          {"coordinator_cpu_s", point.coordinator_cpu_s},
          {"coordinator_ms_per_task", point.coordinator_ms_per_task},
          {"read_bytes", point.read_bytes},
          {"written_bytes", point.written_bytes},
          {"links", ListOf(point.links)},
          {"slot_s", JsonOf(point.shares)}};
}

Json JsonOf(const EngineStudy& study) {
  return {{"engine", study.facts.engine},
          {"machine_processors", study.facts.machine_processors},
          {"slots", study.slots},
          {"processors_per_slot", study.processors_per_slot},
          {"link_gbit_per_s", study.link_gbit_per_s},
          {"crowded_from", study.crowded_from},
          {"remarks", RemarksOn(study)},
          {"simulator", JudgeSimulator(study)},
          {"points", ListOf(study.points)}};
}

}  // namespace

std::string ScalingJson(const ScalingReport& report) {
  return JsonText({{"version", report.version},
                   {"title", report.title},
                   {"processors", report.processors},
                   {"load_average", report.load_average},
                   {"panoramas", report.panoramas},
                   {"runs", ListOf(report.runs)},
                   {"stages", ListOf(report.stages)},
                   {"predictions", ListOf(report.predictions)},
                   {"weak_scaling", ListOf(report.weak)},
                   {"assumptions", JsonOf(report.assumptions)},
                   {"study", report.study ? JsonOf(*report.study) : Json(nullptr)}});
}

}  // namespace orbweave
