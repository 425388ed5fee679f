// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/progress/format_status.h"

#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "cli/progress/progress_bar.h"
#include "core/io/printable_text.h"

namespace orbweave {
namespace {

std::string WorkerStateName(const WorkerStatus& worker) {
  if (!worker.alive) return "gone";
  if (worker.draining) return "draining";
  return worker.set_aside ? "set aside: failed tasks that others did" : "at work";
}

/// In ASCII, whatever strangers wrote.
std::string OneLine(const nlohmann::json& value) {
  return value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

nlohmann::json EtaToJson(const ProgressView& view) {
  return view.eta_s >= 0.0 ? nlohmann::json(view.eta_s) : nlohmann::json();
}

}  // namespace

std::string FormatJobLine(const JobStatus& status) {
  const ProgressView view = ViewProgress(status);
  std::string text = absl::StrFormat("job %s  %-9s  %3.0f %%  %s",
                                     status.id.ToShortHex(),
                                     std::string(JobStateName(status.state)),
                                     100.0 * view.fraction,
                                     FormatDuration(status.elapsed_s));
  if (status.state == JobState::kRunning && view.eta_s >= 0.0) {
    absl::StrAppend(&text, "  about ", FormatDuration(view.eta_s), " left");
  }
  return absl::StrCat(text, "  ", PrintableText(status.spec.label), "\n");
}

std::string FormatJobStatus(const JobStatus& status) {
  std::string text = FormatJobLine(status);
  if (!status.error.empty()) absl::StrAppend(&text, "  ", PrintableText(status.error, "\n"), "\n");
  if (!status.unmet.empty()) absl::StrAppend(&text, "  waits: ", PrintableText(status.unmet), "\n");
  absl::StrAppend(&text,
                  absl::StrFormat("  %-22s %13s %8s %8s %8s %12s %12s\n",
                                  "stage",
                                  "done",
                                  "reused",
                                  "running",
                                  "retries",
                                  "wall",
                                  "cpu"));
  for (const StageStatus& stage : status.stages) {
    if (stage.tasks_total == 0) continue;
    absl::StrAppend(&text,
                    absl::StrFormat("  %-22s %13s %8u %8u %8u %12s %12s\n",
                                    PrintableText(stage.stage),
                                    absl::StrCat(stage.tasks_done, "/", stage.tasks_total),
                                    stage.tasks_reused,
                                    stage.tasks_running,
                                    stage.retries,
                                    FormatDuration(stage.wall_s),
                                    FormatDuration(stage.cpu_s)));
  }
  return text;
}

std::string FormatWorkers(const std::vector<WorkerStatus>& workers) {
  if (workers.empty()) return "no workers\n";
  std::string text =
      absl::StrFormat("  %-22s %13s %8s %8s  %s\n", "worker", "done", "slots", "running", "state");
  for (const WorkerStatus& worker : workers) {
    absl::StrAppend(&text,
                    absl::StrFormat("  %-22s %13u %8u %8u  %s\n",
                                    PrintableText(worker.name),
                                    worker.tasks_done,
                                    worker.slots,
                                    worker.tasks_running,
                                    WorkerStateName(worker)));
  }
  return text;
}

std::string JobStatusToJson(const JobStatus& status) {
  const ProgressView view = ViewProgress(status);
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
  const nlohmann::json job = {{"id", status.id.ToHex()},
                              {"state", std::string(JobStateName(status.state))},
                              {"error", status.error},
                              {"unmet", status.unmet},
                              {"label", status.spec.label},
                              {"elapsed_s", status.elapsed_s},
                              {"fraction", view.fraction},
                              {"eta_s", EtaToJson(view)},
                              {"stages", std::move(stages)}};
  return OneLine(job);
}

std::string WorkersToJson(const std::vector<WorkerStatus>& workers) {
  nlohmann::json list = nlohmann::json::array();
  for (const WorkerStatus& worker : workers) {
    list.push_back({{"name", worker.name},
                    {"slots", worker.slots},
                    {"tasks_done", worker.tasks_done},
                    {"tasks_running", worker.tasks_running},
                    {"alive", worker.alive},
                    {"set_aside", worker.set_aside},
                    {"draining", worker.draining}});
  }
  return OneLine({{"workers", std::move(list)}});
}

}  // namespace orbweave
