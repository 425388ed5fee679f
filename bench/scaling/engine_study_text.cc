// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bench/scaling/engine_study_text.h"

#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/io/page/html_text.h"

namespace orbweave {
namespace {

std::string Sentence(const EngineStudy& study) {
  std::string text =
      absl::StrCat("Nodes are ",
                   study.facts.engine == "local"   ? "processes of one machine"
                   : study.facts.engine == "netns" ? "network namespaces of one machine"
                                                   : "allocations of Slurm",
                   ", with ",
                   study.slots,
                   study.slots == 1 ? " slot" : " slots",
                   " each");
  if (study.processors_per_slot != 1.0)
    absl::StrAppend(
        &text, ", which have ", ShortText(study.processors_per_slot), " of a processor each");
  if (study.link_gbit_per_s > 0.0)
    absl::StrAppend(&text, ", and a link of ", ShortText(1e3 * study.link_gbit_per_s), " Mbit/s");
  return text + ".";
}

}  // namespace

std::string ScalingKindName(ScalingKind kind) {
  return kind == ScalingKind::kStrong ? "strong" : "weak";
}

const std::vector<std::pair<std::string, double TimeShares::*>>& TimeCauses() {
  static const std::vector<std::pair<std::string, double TimeShares::*>> causes = {
      {"computing", &TimeShares::computing_s},
      {"transfer", &TimeShares::waiting_s},
      {"lease", &TimeShares::leasing_s},
      {"barrier", &TimeShares::barrier_s},
      {"serial stage", &TimeShares::serial_s},
      {"between stages", &TimeShares::planning_s},
      {"repeated", &TimeShares::repeated_s}};
  return causes;
}

std::vector<std::string> RemarksOn(const EngineStudy& study) {
  std::vector<std::string> remarks = {Sentence(study)};
  if (study.crowded_from > 0) {
    remarks.push_back(absl::StrCat("From ",
                                   study.crowded_from,
                                   study.crowded_from == 1 ? " node" : " nodes",
                                   " on they ask for more processors than the ",
                                   study.facts.machine_processors,
                                   " of this machine: there times and efficiency are those of the "
                                   "machine, and only overhead and bytes those of the fleet."));
  } else if (study.facts.machine_processors > 0) {
    remarks.push_back(absl::StrCat("All share the ",
                                   study.facts.machine_processors,
                                   " processors of one machine, their caches and its disk; work "
                                   "beside them makes times longer."));
  }
  if (study.facts.engine == "slurm")
    remarks.push_back(
        "Large blobs go by the folder that all nodes see; its traffic is counted by tasks alone.");
  return remarks;
}

std::string JudgeSimulator(const EngineStudy& study) {
  size_t right = 0;
  double worst = 0.0;
  for (const StudyPoint& point : study.points) {
    if (std::abs(point.simulation_error) <= kMostSimulationError) ++right;
    if (std::abs(point.simulation_error) > std::abs(worst)) worst = point.simulation_error;
  }
  const std::string worst_text = absl::StrFormat("%+.0f %%", 100.0 * worst);
  if (right == study.points.size())
    return absl::StrCat(
        "All ", right, " runs took what is simulated, to 15 % (worst ", worst_text, ").");
  return absl::StrCat("Only ",
                      right,
                      " of ",
                      study.points.size(),
                      " runs took what is simulated, to 15 % (worst ",
                      worst_text,
                      "): what is simulated for more nodes is as doubtful.");
}

std::string FormatEngineStudy(const EngineStudy& study) {
  std::string text;
  for (const std::string& remark : RemarksOn(study)) absl::StrAppend(&text, remark, "\n");
  absl::StrAppend(&text,
                  "\n| scaling | nodes | panoramas | wall s | efficiency | simulated s | error | "
                  "coordinator CPU s | ms a task |");
  for (const auto& cause : TimeCauses()) absl::StrAppend(&text, " ", cause.first, " |");
  absl::StrAppend(&text, "\n|---|---|---|---|---|---|---|---|---|");
  for (size_t i = 0; i < TimeCauses().size(); ++i) text += "---|";
  text += "\n";
  for (const StudyPoint& point : study.points) {
    absl::StrAppendFormat(&text,
                          "| %s | %u | %s | %.2f | %.2f | %.2f | %+.0f %% | %.2f | %.2f |",
                          ScalingKindName(point.kind),
                          point.nodes,
                          CountText(point.panoramas),
                          point.wall_s,
                          point.efficiency,
                          point.simulated_s,
                          100.0 * point.simulation_error,
                          point.coordinator_cpu_s,
                          point.coordinator_ms_per_task);
    for (const auto& [name, share] : TimeCauses())
      absl::StrAppendFormat(&text, " %.0f %% |", 100.0 * point.shares.*share / point.shares.Sum());
    text += "\n";
  }
  return text + "\n" + JudgeSimulator(study) + "\n\n";
}

}  // namespace orbweave
