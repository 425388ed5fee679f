// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coordinator/journal/journal_meter.h"
#include "coordinator/metrics/metrics_snapshot.h"
#include "coordinator/metrics/metrics_text.h"
#include "core/pipeline/build_version.h"
#include "tests/support/command.h"
#include "tests/support/toy_job.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::TemporaryFolder;

/// The value of the metric with all these labels; -1 when there is none.
double ValueOf(const std::vector<prometheus::MetricFamily>& families,
               const std::string& name,
               const std::vector<std::string>& labels) {
  for (const prometheus::MetricFamily& family : families) {
    if (family.name != name) continue;
    for (const prometheus::ClientMetric& metric : family.metric) {
      std::vector<std::string> values;
      for (const auto& label : metric.label) values.push_back(label.value);
      if (values == labels) return metric.gauge.value + metric.counter.value;
    }
  }
  return -1.0;
}

TEST(SnapshotMetrics, DividesTheTasksOfRunningJobsByState) {
  const JobStatus running{.id = DigestOf("a"),
                          .elapsed_s = 10.0,
                          .stages = {{.stage = "s",
                                      .tasks_total = 8,
                                      .tasks_done = 4,
                                      .tasks_running = 1,
                                      .retries = 2,
                                      .busy_s = 10.0}}};
  JobStatus failed = running;
  failed.id = DigestOf("b");
  failed.state = JobState::kFailed;
  const auto families = SnapshotMetrics({running, failed}, {}, {}, 0);
  const std::string id = running.id.ToShortHex();
  EXPECT_EQ(ValueOf(families, "orbweave_tasks", {id, "s", "ready"}), 3.0);
  EXPECT_EQ(ValueOf(families, "orbweave_tasks", {id, "s", "running"}), 1.0);
  EXPECT_EQ(ValueOf(families, "orbweave_tasks", {id, "s", "done"}), 4.0);
  EXPECT_EQ(ValueOf(families, "orbweave_task_retries", {id, "s"}), 2.0);
  EXPECT_EQ(ValueOf(families, "orbweave_job_done_ratio", {id}), 0.5);
  EXPECT_EQ(ValueOf(families, "orbweave_job_eta_seconds", {id}), 10.0);
  EXPECT_EQ(ValueOf(families, "orbweave_tasks", {failed.id.ToShortHex(), "s", "done"}), -1.0)
      << "of jobs that ended only their number is told";
  EXPECT_EQ(ValueOf(families, "orbweave_jobs", {"running"}), 1.0);
  EXPECT_EQ(ValueOf(families, "orbweave_jobs", {"failed"}), 1.0);
  EXPECT_EQ(ValueOf(families, "orbweave_jobs", {"done"}), 0.0);
}

TEST(SnapshotMetrics, CountsTheSlotsOfWorkersThatAreThere) {
  const auto families =
      SnapshotMetrics({},
                      {{.name = "a", .slots = 4, .tasks_running = 3},
                       {.name = "b", .slots = 2, .draining = true, .tasks_running = 1},
                       {.name = "c", .slots = 8, .alive = false}},
                      {.bytes_in = 5, .bytes_out = 6},
                      7);
  for (const char* state : {"at_work", "draining", "gone"}) {
    EXPECT_EQ(ValueOf(families, "orbweave_workers", {state}), 1.0) << state;
  }
  EXPECT_EQ(ValueOf(families, "orbweave_slots", {}), 6.0);
  EXPECT_EQ(ValueOf(families, "orbweave_slots_busy", {}), 4.0);
  EXPECT_EQ(ValueOf(families, "orbweave_slots_wanted", {}), 7.0);
  EXPECT_EQ(ValueOf(families, "orbweave_blob_bytes_total", {"in"}), 5.0);
  EXPECT_EQ(ValueOf(families, "orbweave_blob_bytes_total", {"out"}), 6.0);
}

TEST(SnapshotMetrics, SaysNothingThatStrangersWrote) {
  const std::string hostile = "x\"} 1\norbweave_fake 7";
  const JobStatus job{.id = DigestOf("a"),
                      .error = hostile,
                      .spec = {.label = hostile},
                      .stages = {{.stage = "s", .tasks_total = 1}}};
  for (const auto& family : SnapshotMetrics({job}, {{.name = hostile}}, {}, 0)) {
    for (const auto& metric : family.metric) {
      for (const auto& label : metric.label) EXPECT_THAT(label.value, Not(HasSubstr("fake")));
    }
  }
}

TEST(MetricsText, TellsWhatAJobDid) {
  const TemporaryFolder folder;
  const SteadyClock clock;
  MetricsCounters counters;
  const auto open_journal =
      [&](const std::string& state_dir) -> absl::StatusOr<std::unique_ptr<Journal>> {
    ORBWEAVE_ASSIGN_OR_RETURN(auto journal, OpenJournal(state_dir));
    return MeterJournal(std::move(journal), [&](auto what, double wait_s, const auto& status) {
      counters.CountSave(what, wait_s, status);
    });
  };
  const auto coordinator =
      Coordinator::Open({.state_dir = folder / "state",
                         .find_plan = testing::FindToyPlan,
                         .open_journal = open_journal,
                         .log = [&](const LogEvent& event) { counters.CountEvent(event); }},
                        clock);
  ASSERT_TRUE(coordinator.ok()) << coordinator.status();
  Coordinator& api = **coordinator;
  const auto job = testing::PrepareToyJob(api, "1 2 3");
  const auto id = api.SubmitJob(*job);
  const uint64_t session = api.Join({.name = "w", .version = std::string(BuildVersion())})->session;
  const auto first = api.LeaseTask(session, 0, 10.0);
  ASSERT_TRUE(first.ok() && first->has_value());
  ASSERT_TRUE(api.FailTask(session, **first, absl::InternalError("once")).ok());
  const std::string labels = "{job=\"" + id->ToShortHex() + "\",stage=\"split\"";
  EXPECT_THAT(MetricsText(api, counters), HasSubstr("orbweave_task_retries" + labels + "} 1\n"));
  const testing::StageMap stages = testing::ToyStages();
  while (api.GetJob(*id)->state == JobState::kRunning) {
    const auto lease = api.LeaseTask(session, 0, 1.0);
    ASSERT_TRUE(lease.ok());
    if (!lease->has_value()) continue;
    const auto result = stages.at((*lease)->spec.stage)((*lease)->spec, api, {});
    ASSERT_TRUE(result.ok() && api.CompleteTask(session, **lease, *result).ok());
  }
  const std::string text = MetricsText(api, counters);
  EXPECT_THAT(text, HasSubstr("orbweave_events_total{event=\"task_done\",level=\"info\"} 5\n"));
  EXPECT_THAT(text,
              HasSubstr("orbweave_events_total{event=\"task_not_done\",level=\"warning\"} 1\n"));
  EXPECT_THAT(text, HasSubstr("orbweave_journal_save_seconds_count{what=\"start\"} 6\n"));
  EXPECT_THAT(text, HasSubstr("orbweave_journal_save_seconds_count{what=\"result\"} 5\n"));
  EXPECT_THAT(text, HasSubstr("orbweave_jobs{state=\"done\"} 1\n"));
  EXPECT_THAT(text, HasSubstr("orbweave_slots 1\n"));
  EXPECT_THAT(text, HasSubstr("orbweave_slots_wanted 3\n"));
  EXPECT_THAT(text, HasSubstr("orbweave_journal_save_errors_total{what=\"result\"} 0\n"));
  EXPECT_THAT(text, HasSubstr("orbweave_spans_total{outcome=\"dropped\"} 0\n"));
  // "1 2 3"; "1", "2", "3"; "1", "4", "9"; "14"; and two collections, which the coordinator makes.
  EXPECT_THAT(text, HasSubstr("orbweave_blob_bytes_total{direction=\"in\"} 13\n"));
}

}  // namespace
}  // namespace orbweave
