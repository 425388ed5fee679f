// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// Real worker processes: this very executable, called with `work` by the fleet, does the stages of
// the toy job.

#include "cli/fleet/local_fleet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "cli/commands/drain_command.h"
#include "cli/commands/exec_tasks_command.h"
#include "cli/commands/work_command.h"
#include "cli/process/exit_code.h"
#include "tests/support/command.h"
#include "tests/support/command_or_tests.h"
#include "tests/support/http_get.h"
#include "tests/support/toy_job.h"
#include "tests/support/wait_for_end.h"

namespace orbweave {
namespace {

using testing::FindToyPlan;
using ::testing::HasSubstr;
using testing::PrepareToyJob;
using testing::Square;
using testing::TemporaryFolder;
using testing::ToyAnswer;
using testing::ToyStages;

/// The toy stages; squaring 666 aborts the process that does it, and squaring 13 for the first time
/// kills that process or its worker. A file remembers that it happened.
testing::StageMap DeadlyStages() {
  testing::StageMap stages = ToyStages();
  stages["square"] = [](const TaskSpec& spec, BlobAccess& blobs, const StageContext& context) {
    const char* marker = std::getenv("ORBWEAVE_TEST_MARKER");
    const auto number = blobs.Get(spec.inputs.at(0));
    if (number.ok() && *number == "666") std::abort();
    if (marker != nullptr && number.ok() && *number == "13" && !std::filesystem::exists(marker)) {
      std::ofstream(marker) << "killed";
      const bool is_worker = std::string_view(std::getenv("ORBWEAVE_TEST_VICTIM")) == "worker";
      ::kill(is_worker ? ::getppid() : ::getpid(), SIGKILL);
      std::this_thread::sleep_for(std::chrono::seconds(60));
    }
    return Square(spec, blobs, context);
  };
  return stages;
}

LocalFleetOptions FleetOptions(const std::string& state, uint32_t workers) {
  return {.coordinator = {.state_dir = state,
                          .retry = {.first_wait_s = 0.05},
                          .find_plan = FindToyPlan},
          .workers = workers};
}

TEST(LocalFleet, RunsAJobOnWorkerProcesses) {
  const TemporaryFolder folder;
  const auto fleet = LocalFleet::Start(FleetOptions(folder / "state", 2));
  ASSERT_TRUE(fleet.ok()) << fleet.status();
  const auto job = PrepareToyJob((*fleet)->coordinator(), "1 2 3 4 5 6 7 8", "toy.pause=true\n");
  int updates = 0;
  const auto status = (*fleet)->RunJob(*job, [&updates](const JobStatus&) { ++updates; }, {});
  ASSERT_TRUE(status.ok()) << status.status();
  EXPECT_EQ(status->state, JobState::kDone) << status->error;
  EXPECT_GT(updates, 0);
  EXPECT_EQ(*ToyAnswer((*fleet)->coordinator(), status->id), "204");
  const auto workers = (*fleet)->coordinator().ListWorkers();
  ASSERT_EQ(workers->size(), 2U);
  for (const WorkerStatus& worker : *workers) EXPECT_GT(worker.tasks_done, 0U) << worker.name;
  EXPECT_EQ((*fleet)->restarts(), 0U);
}

TEST(LocalFleet, ShowsItsPagesWhileItRuns) {
  const TemporaryFolder folder;
  LocalFleetOptions options = FleetOptions(folder / "state", 1);
  options.monitoring.http = "127.0.0.1:0";
  const auto fleet = LocalFleet::Start(options);
  ASSERT_TRUE(fleet.ok()) << fleet.status();
  const auto job = PrepareToyJob((*fleet)->coordinator(), "1 2 3");
  ASSERT_TRUE((*fleet)->RunJob(*job, {}, {}).ok());
  const std::string log = testing::ReadAll(folder / "state/logs/coordinator.log");
  const size_t begin = log.find("127.0.0.1:", log.find("http_ready"));
  ASSERT_NE(begin, std::string::npos) << log;
  const std::string http = log.substr(begin, log.find('"', begin) - begin);
  EXPECT_THAT(testing::HttpGet(http, "/livez"), HasSubstr("\r\n\r\nok\n"));
  const std::string metrics = testing::HttpGet(http, "/metrics");
  EXPECT_THAT(metrics, HasSubstr("orbweave_events_total{event=\"job_done\",level=\"info\"} 1\n"));
  EXPECT_THAT(metrics, HasSubstr("orbweave_journal_save_seconds_count"));
}

TEST(LocalFleet, PagesThatCannotBeServedAreToldAtOnce) {
  const TemporaryFolder folder;
  LocalFleetOptions options = FleetOptions(folder / "state", 1);
  options.monitoring.http = "0.0.0.0:0";
  EXPECT_EQ(LocalFleet::Start(options).status().code(), absl::StatusCode::kInvalidArgument);
  options.monitoring = {.otlp = "ftp://nowhere"};
  EXPECT_EQ(LocalFleet::Start(options).status().code(), absl::StatusCode::kInvalidArgument);
}

/// Squares 12, 13 and 14 on a fleet where 13 brings death the first time.
class Deadly : public ::testing::TestWithParam<const char*> {
 protected:
  Deadly() {
    ::setenv("ORBWEAVE_TEST_MARKER", (folder_ / "killed").c_str(), 1);
    ::setenv("ORBWEAVE_TEST_VICTIM", GetParam(), 1);
  }
  ~Deadly() override {
    ::unsetenv("ORBWEAVE_TEST_MARKER");
    ::unsetenv("ORBWEAVE_TEST_VICTIM");
  }

  TemporaryFolder folder_;
};

TEST_P(Deadly, CostsNothingButTime) {
  const auto fleet = LocalFleet::Start(FleetOptions(folder_ / "state", 2));
  ASSERT_TRUE(fleet.ok()) << fleet.status();
  const auto job = PrepareToyJob((*fleet)->coordinator(), "12 13 14");
  const auto status = (*fleet)->RunJob(*job, {}, {});
  ASSERT_TRUE(status.ok()) << status.status();
  EXPECT_EQ(status->state, JobState::kDone) << status->error;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "killed"));
  EXPECT_EQ(status->stages[1].retries, 1U);
  EXPECT_EQ((*fleet)->restarts(), std::string_view(GetParam()) == "worker" ? 1U : 0U);
  EXPECT_EQ(*ToyAnswer((*fleet)->coordinator(), status->id), "509");
}

INSTANTIATE_TEST_SUITE_P(LocalFleet, Deadly, ::testing::Values("worker", "task"));

TEST(LocalFleet, ATaskThatKillsWhoeverDoesItFailsTheJobAndIsNamed) {
  const TemporaryFolder folder;
  const auto fleet = LocalFleet::Start(FleetOptions(folder / "state", 2));
  ASSERT_TRUE(fleet.ok()) << fleet.status();
  const auto job = PrepareToyJob((*fleet)->coordinator(), "1 666 2");
  const auto status = (*fleet)->RunJob(*job, {}, {});
  ASSERT_TRUE(status.ok()) << status.status();
  EXPECT_EQ(status->state, JobState::kFailed);
  EXPECT_THAT(status->error, HasSubstr("stage square, part 1"));
  EXPECT_THAT(status->error, HasSubstr("lost its process 3 times"));
  EXPECT_THAT(status->error, HasSubstr("signal 6 (Aborted)"));
  EXPECT_THAT(status->error, HasSubstr(DigestOf("666").ToShortHex()));
  EXPECT_EQ((*fleet)->restarts(), 0U) << "the workers live on";
}

/// A worker process beside a coordinator, in the middle of a job of twenty squares.
class Leaver : public ::testing::Test {
 protected:
  void SetUp() override {
    auto started = LocalFleet::Start(FleetOptions(folder_ / "state", 0));
    ASSERT_TRUE(started.ok()) << started.status();
    fleet_ = *std::move(started);
    job_ = *Api().SubmitJob(*PrepareToyJob(
        Api(), "1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20", "toy.pause=true\n"));
    worker_ = std::make_unique<testing::Command>(std::vector<std::string>{
        "/proc/self/exe", "work", "--join", fleet_->address(), "--name", "leaver"});
    const auto holds_a_square = [this] {
      return worker_->ErrSoFar().find("\"stage\":\"square\"") != std::string::npos;
    };
    ASSERT_TRUE(testing::WaitUntil(holds_a_square, 60.0)) << worker_->ErrSoFar();
  }

  ClientApi& Api() { return fleet_->coordinator(); }
  StageStatus Squares() { return Api().GetJob(job_)->stages[1]; }

  void ExpectThatItFinishedAndLeft(int exit_code) {
    const testing::CommandOutcome outcome = worker_->Wait();
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_GT(Squares().tasks_done, 0U) << "what ran\n" << outcome.err;
    EXPECT_LT(Squares().tasks_done, 20U) << "and no more";
    EXPECT_EQ(Squares().tasks_running, 0U);
    EXPECT_EQ(Squares().retries, 0U);
    EXPECT_FALSE(Api().ListWorkers()->at(0).alive);
  }

  TemporaryFolder folder_;
  std::unique_ptr<LocalFleet> fleet_;
  Digest job_{};
  std::unique_ptr<testing::Command> worker_;
};

TEST_F(Leaver, FinishesItsTaskAfterSigterm) {
  worker_->Signal(SIGTERM);
  ExpectThatItFinishedAndLeft(kExitStopped);
}

TEST_F(Leaver, FinishesItsTaskWhenItIsDrained) {
  const testing::CommandOutcome drained = testing::RunCommand(
      {"/proc/self/exe", "drain", "--coordinator", fleet_->address(), "leaver"});
  EXPECT_EQ(drained.exit_code, kExitOk) << drained.err;
  ExpectThatItFinishedAndLeft(kExitOk);
  const testing::CommandOutcome again = testing::RunCommand(
      {"/proc/self/exe", "drain", "--coordinator", fleet_->address(), "leaver"});
  EXPECT_EQ(again.exit_code, kExitUsage);
  EXPECT_THAT(again.err, HasSubstr("there is no worker leaver"));
}

TEST(LocalFleet, AnInterruptedJobGoesOnWhenItIsRunAgain) {
  const TemporaryFolder folder;
  const std::string numbers = "1 2 3 4 5 6";
  std::stop_source stop;
  {
    const auto fleet = LocalFleet::Start(FleetOptions(folder / "state", 1));
    ASSERT_TRUE(fleet.ok()) << fleet.status();
    const auto job = PrepareToyJob((*fleet)->coordinator(), numbers, "toy.pause=true\n");
    const auto stop_after_two = [&stop](const JobStatus& status) {
      if (status.stages[1].tasks_done >= 2) stop.request_stop();
    };
    EXPECT_TRUE(
        absl::IsCancelled((*fleet)->RunJob(*job, stop_after_two, stop.get_token()).status()));
  }
  const auto fleet = LocalFleet::Start(FleetOptions(folder / "state", 1));
  ASSERT_TRUE(fleet.ok()) << fleet.status();
  const auto job = PrepareToyJob((*fleet)->coordinator(), numbers, "toy.pause=true\n");
  const auto status = (*fleet)->RunJob(*job, {}, {});
  ASSERT_TRUE(status.ok()) << status.status();
  EXPECT_EQ(status->state, JobState::kDone);
  EXPECT_GE(status->stages[1].tasks_reused, 2U);
  EXPECT_LT(status->stages[1].tasks_reused, 6U);
  EXPECT_EQ(*ToyAnswer((*fleet)->coordinator(), status->id), "91");
}

TEST(LocalFleet, WorksInAFolderWhosePathIsTooLongForASocket) {
  const TemporaryFolder folder;
  const auto fleet =
      LocalFleet::Start(FleetOptions(folder / (std::string(120, 'x') + "/state"), 1));
  ASSERT_TRUE(fleet.ok()) << fleet.status();
  const auto job = PrepareToyJob((*fleet)->coordinator(), "3");
  const auto status = (*fleet)->RunJob(*job, {}, {});
  ASSERT_TRUE(status.ok()) << status.status();
  EXPECT_EQ(*ToyAnswer((*fleet)->coordinator(), status->id), "9");
}

TEST(LocalFleet, RefusesAStateFolderInUse) {
  const TemporaryFolder folder;
  const auto first = LocalFleet::Start(FleetOptions(folder / "state", 0));
  ASSERT_TRUE(first.ok());
  EXPECT_TRUE(
      absl::IsFailedPrecondition(LocalFleet::Start(FleetOptions(folder / "state", 0)).status()));
}

/// What `orbweave` would do with these arguments.
void AddCommands(CLI::App& app, SelectedCommand& selected) {
  static const testing::StageMap stages = DeadlyStages();
  static const StageLookup lookup = testing::LookupIn(stages);
  AddWorkCommand(app, selected);
  AddDrainCommand(app, selected);
  AddExecTasksCommand(app, selected, lookup);
}

}  // namespace
}  // namespace orbweave

int main(int argc, char** argv) {
  return orbweave::testing::RunCommandOrTests(argc, argv, orbweave::AddCommands);
}
