// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/format_status.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "cli/progress_bar.h"

namespace orbweave {

std::string_view JobStateName(JobState state) {
  switch (state) {
    case JobState::kRunning:
      return "running";
    case JobState::kDone:
      return "done";
    case JobState::kFailed:
      return "failed";
    case JobState::kCancelled:
      return "cancelled";
  }
  return "unknown";
}

std::string FormatJobStatus(const JobStatus& status) {
  std::string text = absl::StrFormat("job %s  %s  %s  %s\n",
                                     status.id.ToShortHex(),
                                     std::string(JobStateName(status.state)),
                                     FormatDuration(status.elapsed_s),
                                     status.spec.label);
  if (!status.error.empty()) absl::StrAppend(&text, "  ", status.error, "\n");
  for (const StageStatus& stage : status.stages) {
    if (stage.tasks_total == 0) continue;
    absl::StrAppend(
        &text,
        absl::StrFormat(
            "  %-22s %6u/%u tasks  %u reused  %u running  %u retries  %s wall  %s cpu\n",
            stage.stage,
            stage.tasks_done,
            stage.tasks_total,
            stage.tasks_reused,
            stage.tasks_running,
            stage.retries,
            FormatDuration(stage.wall_s),
            FormatDuration(stage.cpu_s)));
  }
  const auto alive = std::count_if(status.workers.begin(),
                                   status.workers.end(),
                                   [](const WorkerStatus& worker) { return worker.alive; });
  absl::StrAppend(&text, "  workers: ", alive, " alive of ", status.workers.size(), "\n");
  for (const WorkerStatus& worker : status.workers) {
    if (worker.alive && worker.set_aside)
      absl::StrAppend(
          &text, "  set aside: ", worker.name, ", which failed tasks that others did\n");
    if (worker.alive && worker.draining)
      absl::StrAppend(&text, "  leaving: ", worker.name, ", when its tasks are done\n");
  }
  return text;
}

std::string JobStatusToJson(const JobStatus& status) {
  nlohmann::json stages = nlohmann::json::array();
  for (const StageStatus& stage : status.stages) {
    stages.push_back({{"stage", stage.stage},
                      {"tasks_total", stage.tasks_total},
                      {"tasks_done", stage.tasks_done},
                      {"tasks_reused", stage.tasks_reused},
                      {"tasks_running", stage.tasks_running},
                      {"retries", stage.retries},
                      {"wall_s", stage.wall_s},
                      {"cpu_s", stage.cpu_s}});
  }
  nlohmann::json workers = nlohmann::json::array();
  for (const WorkerStatus& worker : status.workers) {
    workers.push_back({{"name", worker.name},
                       {"slots", worker.slots},
                       {"tasks_done", worker.tasks_done},
                       {"alive", worker.alive},
                       {"set_aside", worker.set_aside},
                       {"draining", worker.draining}});
  }
  const nlohmann::json job = {{"id", status.id.ToHex()},
                              {"state", std::string(JobStateName(status.state))},
                              {"error", status.error},
                              {"label", status.spec.label},
                              {"elapsed_s", status.elapsed_s},
                              {"fraction", ViewProgress(status).fraction},
                              {"stages", std::move(stages)},
                              {"workers", std::move(workers)}};
  return job.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace orbweave
