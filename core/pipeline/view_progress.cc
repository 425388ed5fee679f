// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/view_progress.h"

#include <algorithm>

namespace orbweave {
namespace {

/// Before so much of a job is computed its rate is not known.
constexpr double kTooEarly = 0.02;

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

double Computed(const StageStatus& stage) {
  return static_cast<double>(stage.tasks_done) - stage.tasks_reused;
}

/// The stages of one long loop.
struct Loop {
  size_t first = 0;
  size_t end = 0;
  bool is_at_work = false;  ///< all its stages have tasks, the one that follows has none
  uint32_t runs = 0;
  double usual_runs = 1.0;

  [[nodiscard]] bool Holds(size_t stage) const { return stage >= first && stage < end; }
  /// Of the loop's rounds that have begun, as far as one can tell before its end.
  [[nodiscard]] double Share() const { return is_at_work ? std::min(1.0, runs / usual_runs) : 1.0; }
};

/// The plan's long loop; empty where there is none.
Loop LoopOf(const JobStatus& job) {
  const auto is_long = [](const StageStatus& stage) { return stage.usual_runs > 1.0; };
  const auto first = std::ranges::find_if(job.stages, is_long);
  const auto end = std::find_if_not(first, job.stages.end(), is_long);
  Loop loop{.first = static_cast<size_t>(first - job.stages.begin()),
            .end = static_cast<size_t>(end - job.stages.begin())};
  if (first == end) return loop;
  const bool goes_on = end == job.stages.end() || end->tasks_total == 0;
  loop.is_at_work = job.state == JobState::kRunning && goes_on && (end - 1)->tasks_total > 0;
  loop.runs = first->runs;
  loop.usual_runs = first->usual_runs;
  return loop;
}

/// What is done of a job, in weights.
struct Progressed {
  double total = 0.0;
  double done = 0.0;
  double reused = 0.0;
};

Progressed Weigh(const JobStatus& job, size_t past, const Loop& loop) {
  Progressed sum;
  for (size_t s = 0; s < job.stages.size(); ++s) {
    const StageStatus& stage = job.stages[s];
    const double share = loop.Holds(s) ? loop.Share() : 1.0;
    const double fraction =
        s < past ? 1.0 : FractionOf(stage.tasks_done + stage.fraction_running, stage.tasks_total);
    sum.total += stage.weight;
    sum.done += stage.weight * share * fraction;
    sum.reused += stage.weight * share * FractionOf(stage.tasks_reused, stage.tasks_total);
  }
  return sum;
}

/// Seconds that tasks took per weight of what was computed; 0: nothing was.
double RateOf(const JobStatus& job, const Loop& loop) {
  double busy_s = 0.0;
  double weight = 0.0;
  for (size_t s = 0; s < job.stages.size(); ++s) {
    const StageStatus& stage = job.stages[s];
    if (stage.tasks_total == 0 || stage.busy_s <= 0.0) continue;
    const double share = loop.Holds(s) ? loop.Share() : 1.0;
    busy_s += stage.busy_s;
    weight += stage.weight * share * Computed(stage) / stage.tasks_total;
  }
  return weight > 0.0 ? busy_s / weight : 0.0;
}

/// Seconds that one slot would have to work for what is not done of a stage.
double WorkLeft(const StageStatus& stage, double rate, double rounds_left) {
  if (stage.tasks_total == 0) return stage.weight * rate;
  const double computed = Computed(stage);
  const double tasks_left =
      std::max(0.0, stage.tasks_total - stage.tasks_done - stage.fraction_running);
  const double mean_s =
      computed > 0.0 ? stage.busy_s / computed : stage.weight * rate / stage.tasks_total;
  return tasks_left * mean_s + rounds_left * stage.busy_s / std::max(1U, stage.runs);
}

/// How many tasks of a stage can be at work at a time.
double WidthOf(const StageStatus& stage, double slots) {
  if (!stage.has_parts) return 1.0;
  if (stage.tasks_total == 0) return slots;
  const double tasks = static_cast<double>(stage.tasks_total) / std::max(1U, stage.runs);
  return std::clamp(tasks, 1.0, slots);
}

double TimeLeft(const JobStatus& job, size_t past, const Loop& loop) {
  const double rate = RateOf(job, loop);
  if (rate <= 0.0) return -1.0;
  const double slots = std::max(1U, job.slots);
  const double rounds_left = loop.is_at_work ? std::max(0.0, loop.usual_runs - loop.runs) : 0.0;
  double left_s = 0.0;
  for (size_t s = 0; s < job.stages.size(); ++s) {
    const bool repeats = loop.is_at_work && loop.Holds(s);
    if (s < past && !repeats) continue;
    const StageStatus& stage = job.stages[s];
    left_s += WorkLeft(stage, rate, repeats ? rounds_left : 0.0) / WidthOf(stage, slots);
  }
  return left_s;
}

}  // namespace

ProgressView ViewProgress(const JobStatus& status) {
  const size_t past = CountPastStages(status);
  const Loop loop = LoopOf(status);
  const Progressed sum = Weigh(status, past, loop);
  ProgressView view;
  view.fraction = sum.total > 0.0 ? sum.done / sum.total : 0.0;
  const bool is_too_early = sum.done - sum.reused <= kTooEarly * sum.total;
  if (!is_too_early) view.eta_s = TimeLeft(status, past, loop);
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
