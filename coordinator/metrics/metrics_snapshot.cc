// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/metrics/metrics_snapshot.h"

#include <map>
#include <string>
#include <utility>

#include "core/pipeline/view_progress.h"

namespace orbweave {
namespace {

using Labels = std::vector<prometheus::ClientMetric::Label>;
using prometheus::MetricFamily;
using prometheus::MetricType;

MetricFamily Gauges(const std::string& name, const std::string& help) {
  return {.name = name, .help = help, .type = MetricType::Gauge, .metric = {}};
}

void AddGauge(MetricFamily& family, Labels labels, double value) {
  prometheus::ClientMetric& metric = family.metric.emplace_back();
  metric.label = std::move(labels);
  metric.gauge.value = value;
}

MetricFamily CountJobs(const std::vector<JobStatus>& jobs) {
  std::map<JobState, double> counts = {{JobState::kRunning, 0.0},
                                       {JobState::kDone, 0.0},
                                       {JobState::kFailed, 0.0},
                                       {JobState::kCancelled, 0.0}};
  for (const JobStatus& job : jobs) ++counts[job.state];
  MetricFamily family = Gauges("orbweave_jobs", "Jobs by state");
  for (const auto& [state, count] : counts) {
    AddGauge(family, {{"state", std::string(JobStateName(state))}}, count);
  }
  return family;
}

void AddTasks(MetricFamily& family, const std::string& job, const StageStatus& stage) {
  const auto add = [&](const char* state, uint32_t count) {
    AddGauge(family, {{"job", job}, {"stage", stage.stage}, {"state", state}}, count);
  };
  add("ready", stage.tasks_total - stage.tasks_done - stage.tasks_running);
  add("running", stage.tasks_running);
  add("done", stage.tasks_done);
}

void AddRunningJobs(const std::vector<JobStatus>& jobs, std::vector<MetricFamily>& families) {
  MetricFamily tasks = Gauges("orbweave_tasks", "Tasks of running jobs by state");
  MetricFamily retries = Gauges("orbweave_task_retries", "Failed attempts that were repeated");
  MetricFamily ratio = Gauges("orbweave_job_done_ratio", "How much of a running job is done");
  MetricFamily eta = Gauges("orbweave_job_eta_seconds", "Time a running job still takes");
  for (const JobStatus& job : jobs) {
    if (job.state != JobState::kRunning) continue;
    const std::string id = job.id.ToShortHex();
    for (const StageStatus& stage : job.stages) {
      AddTasks(tasks, id, stage);
      AddGauge(retries, {{"job", id}, {"stage", stage.stage}}, stage.retries);
    }
    const ProgressView view = ViewProgress(job);
    AddGauge(ratio, {{"job", id}}, view.fraction);
    if (view.eta_s >= 0.0) AddGauge(eta, {{"job", id}}, view.eta_s);
  }
  for (MetricFamily* family : {&tasks, &retries, &ratio, &eta}) {
    families.push_back(std::move(*family));
  }
}

void AddWorkers(const std::vector<WorkerStatus>& workers, std::vector<MetricFamily>& families) {
  double at_work = 0.0;
  double draining = 0.0;
  double gone = 0.0;
  double slots = 0.0;
  double busy = 0.0;
  for (const WorkerStatus& worker : workers) {
    ++(!worker.alive ? gone : worker.draining ? draining : at_work);
    if (!worker.alive) continue;
    slots += worker.slots;
    busy += worker.tasks_running;
  }
  MetricFamily& by_state = families.emplace_back(Gauges("orbweave_workers", "Workers by state"));
  AddGauge(by_state, {{"state", "at_work"}}, at_work);
  AddGauge(by_state, {{"state", "draining"}}, draining);
  AddGauge(by_state, {{"state", "gone"}}, gone);
  AddGauge(families.emplace_back(Gauges("orbweave_slots", "Slots of workers")), {}, slots);
  AddGauge(families.emplace_back(Gauges("orbweave_slots_busy", "Slots with a task")), {}, busy);
}

MetricFamily CountBytes(const BlobTraffic& traffic) {
  MetricFamily family{.name = "orbweave_blob_bytes_total",
                      .help = "Bytes of blobs that were put (in) and got (out)",
                      .type = MetricType::Counter,
                      .metric = {}};
  const auto add = [&family](const char* direction, uint64_t bytes) {
    prometheus::ClientMetric& metric = family.metric.emplace_back();
    metric.label = {{"direction", direction}};
    metric.counter.value = static_cast<double>(bytes);
  };
  add("in", traffic.bytes_in);
  add("out", traffic.bytes_out);
  return family;
}

}  // namespace

std::vector<MetricFamily> SnapshotMetrics(const std::vector<JobStatus>& jobs,
                                          const std::vector<WorkerStatus>& workers,
                                          const BlobTraffic& traffic,
                                          uint32_t slots_wanted) {
  std::vector<MetricFamily> families = {CountJobs(jobs)};
  AddRunningJobs(jobs, families);
  AddWorkers(workers, families);
  MetricFamily& wanted = families.emplace_back(
      Gauges("orbweave_slots_wanted", "Slots there is work for, the most of the last minute"));
  AddGauge(wanted, {}, slots_wanted);
  families.push_back(CountBytes(traffic));
  return families;
}

}  // namespace orbweave
