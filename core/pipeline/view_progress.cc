// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/view_progress.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace orbweave {
namespace {

/// What the stages of a job on images usually cost, in percent of the whole.
constexpr std::array<std::pair<std::string_view, double>, 14> kWeights = {{
    {"ingest_images", 1.0},
    {"extract_features", 30.0},
    {"select_image_pairs", 3.0},
    {"match_images", 25.0},
    {"verify_matches", 10.0},
    {"partition_view_graph", 1.0},
    {"reconstruct_cluster", 28.0},
    {"list_seams", 0.1},
    {"fit_seams", 1.0},
    {"align_submodels", 0.1},
    {"join_submodels", 0.5},
    {"assemble_block", 0.5},
    {"steer_adjustment", 1.0},
    {"adjust_block", 9.0},
}};

/// Rounds that the global adjustment in blocks usually takes.
constexpr double kUsualRounds = 26.0;

double WeightOf(const std::string& stage) {
  for (const auto& [name, weight] : kWeights) {
    if (name == stage) return weight;
  }
  return 1.0;
}

/// How many stages lie behind: all before the one at work, or, between two stages, before the one
/// that comes next. In a loop later stages may have tasks of the round before.
size_t CountPastStages(const JobStatus& job) {
  if (job.state == JobState::kDone) return job.stages.size();
  size_t past = 0;
  for (size_t s = 0; s < job.stages.size(); ++s) {
    const StageStatus& stage = job.stages[s];
    if (stage.tasks_done < stage.tasks_total) return s;
    if (stage.tasks_total > 0) past = s + 1;
  }
  return past;
}

double FractionOf(double tasks, uint32_t total) {
  return total == 0 ? 0.0 : std::min(1.0, tasks / static_cast<double>(total));
}

/// The share of the adjustment's rounds that have begun, as far as one can tell before its end.
double ShareOfRounds(const JobStatus& job) {
  for (const StageStatus& stage : job.stages) {
    if (stage.stage == "steer_adjustment") return FractionOf(stage.tasks_total / kUsualRounds, 1);
  }
  return 1.0;
}

bool IsInRounds(const std::string& stage) {
  return stage == "steer_adjustment" || stage == "adjust_block";
}

/// Whether the adjustment's loop is at work: both its stages have tasks, the one that follows none.
bool IsAdjusting(const JobStatus& job) {
  bool adjusts = false;
  for (const StageStatus& stage : job.stages) {
    if (stage.stage == "adjust_block") adjusts = stage.tasks_total > 0;
    if (stage.stage == "conclude_adjustment" && stage.tasks_total > 0) return false;
  }
  return adjusts && job.state == JobState::kRunning;
}

}  // namespace

ProgressView ViewProgress(const JobStatus& status) {
  const size_t past = CountPastStages(status);
  const double rounds = IsAdjusting(status) ? ShareOfRounds(status) : 1.0;
  double total = 0.0;
  double done = 0.0;
  double reused = 0.0;
  for (size_t s = 0; s < status.stages.size(); ++s) {
    const StageStatus& stage = status.stages[s];
    const double weight = WeightOf(stage.stage);
    total += weight;
    const double share = IsInRounds(stage.stage) ? rounds : 1.0;
    reused += weight * share * FractionOf(stage.tasks_reused, stage.tasks_total);
    done +=
        weight * share *
        (s < past ? 1.0 : FractionOf(stage.tasks_done + stage.fraction_running, stage.tasks_total));
  }
  ProgressView view;
  view.fraction = total > 0.0 ? done / total : 0.0;
  const double computed = total > 0.0 ? (done - reused) / total : 0.0;
  if (computed > 0.02) view.eta_s = status.elapsed_s * (1.0 - view.fraction) / computed;
  if (past == status.stages.size()) return view;
  const StageStatus& active = status.stages[past];
  view.stage = active.stage;
  view.tasks_done = active.tasks_done + active.fraction_running;
  view.tasks_total = active.tasks_total;
  if (active.wall_s > 0.0)
    view.tasks_per_s = (active.tasks_done - active.tasks_reused) / active.wall_s;
  return view;
}

}  // namespace orbweave
