// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// `serve`, `work`, `status`, `jobs`, `cancel`, `retry`, `drain`, `forget` and `gc` as real
// processes: this executable plays the command, with the stages of the toy job.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "cli/commands/cancel_command.h"
#include "cli/commands/drain_command.h"
#include "cli/commands/exec_tasks_command.h"
#include "cli/commands/forget_command.h"
#include "cli/commands/gc_command.h"
#include "cli/commands/jobs_command.h"
#include "cli/commands/retry_command.h"
#include "cli/commands/serve_command.h"
#include "cli/commands/status_command.h"
#include "cli/commands/stop_command.h"
#include "cli/commands/work_command.h"
#include "cli/process/exit_code.h"
#include "tests/support/command.h"
#include "tests/support/command_or_tests.h"
#include "tests/support/toy_job.h"
#include "worker/grpc_coordinator_client.h"

namespace orbweave {
namespace {

using testing::Command;
using testing::CommandOutcome;
using ::testing::HasSubstr;
using testing::RunCommand;
using testing::TemporaryFolder;
using testing::WaitUntil;

std::vector<std::string> Orbweave(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "/proc/self/exe");
  return arguments;
}

/// A coordinator process on a socket in a folder of its own.
class ServiceCommands : public ::testing::Test {
 protected:
  ServiceCommands()
      : serve_(Orbweave(
            {"serve", "--listen", address_, "--state", folder_ / "state", "--lease", "10"})) {
    EXPECT_TRUE(
        WaitUntil([this] { return serve_.ErrSoFar().find("ready") != std::string::npos; }, 60.0));
  }

  TemporaryFolder folder_;
  std::string address_ = "unix:" + (folder_ / "s");
  Command serve_;
};

TEST_F(ServiceCommands, ServeEndsCleanlyWhenAskedTo) {
  serve_.Signal(SIGTERM);
  EXPECT_EQ(serve_.Wait().exit_code, kExitOk);
}

TEST_F(ServiceCommands, ASecondServeOnTheSameStateIsRefused) {
  const CommandOutcome second =
      RunCommand(Orbweave({"serve", "--listen", "127.0.0.1:0", "--state", folder_ / "state"}));
  EXPECT_EQ(second.exit_code, kExitUsage);
  EXPECT_THAT(second.err, HasSubstr("in use by another coordinator"));
}

TEST_F(ServiceCommands, ServeRefusesAnAddressThatOthersCanReach) {
  const CommandOutcome open =
      RunCommand(Orbweave({"serve", "--listen", "0.0.0.0:7171", "--state", folder_ / "other"}));
  EXPECT_EQ(open.exit_code, kExitUsage);
  EXPECT_THAT(open.err, HasSubstr("without TLS"));
}

TEST_F(ServiceCommands, AWorkerJoinsAndLeavesWhenAskedTo) {
  Command worker(Orbweave({"work", "--join", address_, "--name", "w", "--slots", "2"}));
  EXPECT_TRUE(WaitUntil(
      [this] {
        return serve_.ErrSoFar().find(R"("event":"worker_joined","worker":"w")") !=
               std::string::npos;
      },
      60.0));
  worker.Signal(SIGTERM);
  EXPECT_EQ(worker.Wait().exit_code, kExitStopped) << "an engine may have more for it to do";
  EXPECT_TRUE(WaitUntil(
      [this] {
        return serve_.ErrSoFar().find(R"("event":"worker_left","worker":"w")") != std::string::npos;
      },
      60.0));
  EXPECT_THAT(testing::ReadAll(folder_ / "state/logs/coordinator.log"), HasSubstr("worker_left"));
}

TEST_F(ServiceCommands, AWorkerWaitsForACoordinatorThatAnEngineStopped) {
  Command worker(Orbweave({"work", "--join", address_, "--name", "w"}));
  const auto joined = [](const Command& serve) {
    return WaitUntil([&] { return serve.ErrSoFar().find("worker_joined") != std::string::npos; },
                     60.0);
  };
  ASSERT_TRUE(joined(serve_)) << worker.ErrSoFar();
  serve_.Signal(SIGTERM);
  EXPECT_EQ(serve_.Wait().exit_code, kExitOk);
  Command again(
      Orbweave({"serve", "--listen", address_, "--state", folder_ / "state", "--lease", "10"}));
  EXPECT_TRUE(joined(again)) << worker.ErrSoFar();
  again.Signal(SIGINT);
  EXPECT_EQ(again.Wait().exit_code, kExitOk);
  EXPECT_EQ(worker.Wait().exit_code, kExitOk) << "sent home";
}

TEST(WorkCommand, SaysSoWhileItsCoordinatorIsAwayAndWaitsNoLongerThanItIsToldTo) {
  const TemporaryFolder folder;
  Command worker(Orbweave({"work", "--join", "unix:" + (folder / "nobody"), "--grace", "1000000"}));
  EXPECT_TRUE(WaitUntil(
      [&] { return worker.ErrSoFar().find("coordinator_away") != std::string::npos; }, 60.0));
  worker.Signal(SIGTERM);
  EXPECT_EQ(worker.Wait().exit_code, kExitStopped);
}

TEST(WorkCommand, GivesUpACoordinatorAfterItsPatience) {
  const TemporaryFolder folder;
  const CommandOutcome outcome =
      RunCommand(Orbweave({"work", "--join", "unix:" + (folder / "nobody"), "--patience", "1"}));
  EXPECT_EQ(outcome.exit_code, kExitUnavailable);
  EXPECT_THAT(outcome.err, HasSubstr("no coordinator answered for 1 s"));
}

TEST(WorkCommand, RefusesATimeThatIsOver) {
  const CommandOutcome outcome =
      RunCommand(Orbweave({"work", "--join", "unix:/nobody", "--until", "2020-01-01T00:00:00Z"}));
  EXPECT_EQ(outcome.exit_code, kExitUsage);
  EXPECT_THAT(outcome.err, HasSubstr("is over"));
}

TEST_F(ServiceCommands, AnIdleWorkerEndsByItself) {
  const CommandOutcome outcome =
      RunCommand(Orbweave({"work", "--join", address_, "--idle-exit", "0.5"}));
  EXPECT_EQ(outcome.exit_code, kExitOk) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("there was nothing to do"));
}

TEST_F(ServiceCommands, AnInterruptedWorkerSaysSo) {
  Command worker(Orbweave({"work", "--join", address_, "--name", "w"}));
  ASSERT_TRUE(WaitUntil(
      [this] { return serve_.ErrSoFar().find("worker_joined") != std::string::npos; }, 60.0));
  worker.Signal(SIGINT);
  EXPECT_EQ(worker.Wait().exit_code, kExitInterrupted);
}

TEST_F(ServiceCommands, StopEndsTheCoordinatorAndSendsItsWorkersHome) {
  Command worker(Orbweave({"work", "--join", address_, "--name", "w"}));
  ASSERT_TRUE(WaitUntil(
      [this] { return serve_.ErrSoFar().find("worker_joined") != std::string::npos; }, 60.0));
  const CommandOutcome stopped = RunCommand(Orbweave({"stop", "--coordinator", address_}));
  EXPECT_EQ(stopped.exit_code, kExitOk) << stopped.err;
  EXPECT_EQ(serve_.Wait().exit_code, kExitOk);
  EXPECT_EQ(worker.Wait().exit_code, kExitOk);
}

TEST(AnnouncedCoordinator, IsFoundWhereverItIsStarted) {
  const TemporaryFolder folder;
  const std::string file = folder / "coordinator.json";
  const auto serve = [&](const std::string& socket) {
    return Orbweave({"serve",
                     "--listen",
                     "unix:" + (folder / socket),
                     "--state",
                     folder / "state",
                     "--lease",
                     "10",
                     "--announce",
                     file});
  };
  const auto joined = [](const Command& coordinator) {
    return WaitUntil(
        [&] { return coordinator.ErrSoFar().find("worker_joined") != std::string::npos; }, 60.0);
  };
  Command worker(Orbweave({"work", "--join", "@" + file, "--name", "w"}));
  Command first(serve("first"));
  ASSERT_TRUE(joined(first)) << worker.ErrSoFar();
  first.Signal(SIGTERM);
  EXPECT_EQ(first.Wait().exit_code, kExitOk);
  Command second(serve("second"));
  ASSERT_TRUE(joined(second)) << worker.ErrSoFar();
  const CommandOutcome stopped = RunCommand(Orbweave({"stop", "--coordinator", "@" + file}));
  EXPECT_EQ(stopped.exit_code, kExitOk) << stopped.err;
  EXPECT_EQ(second.Wait().exit_code, kExitOk);
  EXPECT_EQ(worker.Wait().exit_code, kExitOk) << "sent home";
  EXPECT_FALSE(std::filesystem::exists(file)) << "there is none any more";
}

TEST_F(ServiceCommands, StatusAndCancelFollowAJob) {
  EXPECT_EQ(RunCommand(Orbweave({"status", "--coordinator", address_})).out,
            "no jobs\nno workers\n");
  GrpcCoordinatorClient client(address_);
  JobSpec spec{.kind = "sparse", .label = "street"};
  spec.inputs.push_back(*client.Put("sources"));
  const auto id = client.SubmitJob(spec);
  ASSERT_TRUE(id.ok()) << id.status();
  const CommandOutcome running = RunCommand(Orbweave({"status", "--coordinator", address_}));
  EXPECT_EQ(running.exit_code, kExitOk);
  EXPECT_THAT(running.out, HasSubstr("job " + id->ToShortHex() + "  running"));
  const CommandOutcome cancelled =
      RunCommand(Orbweave({"cancel", "--coordinator", address_, id->ToShortHex()}));
  EXPECT_EQ(cancelled.exit_code, kExitOk) << cancelled.err;
  const CommandOutcome json = RunCommand(Orbweave({"status", "--coordinator", address_, "--json"}));
  EXPECT_THAT(json.out, HasSubstr("\"state\":\"cancelled\""));
  EXPECT_EQ(RunCommand(Orbweave({"cancel", "--coordinator", address_, "ffff"})).exit_code,
            kExitUsage);
}

TEST_F(ServiceCommands, RetryLetsAnEndedJobGoOn) {
  GrpcCoordinatorClient client(address_);
  JobSpec spec{.kind = "sparse", .label = "street"};
  spec.inputs.push_back(*client.Put("sources"));
  const auto id = client.SubmitJob(spec);
  ASSERT_TRUE(id.ok()) << id.status();
  const std::vector<std::string> retry =
      Orbweave({"retry", "--coordinator", address_, id->ToShortHex()});
  EXPECT_EQ(RunCommand(retry).exit_code, kExitUsage) << "it is running";
  // This worker knows no stage of the job, which fails it.
  Command worker(Orbweave({"work", "--join", address_, "--name", "w"}));
  const auto listed = [this](const std::string& state) {
    return RunCommand(Orbweave({"jobs", "--coordinator", address_})).out.find(state) !=
           std::string::npos;
  };
  ASSERT_TRUE(WaitUntil([&] { return listed("failed"); }, 60.0));
  worker.Signal(SIGTERM);
  (void)worker.Wait();
  const CommandOutcome retried = RunCommand(retry);
  EXPECT_EQ(retried.exit_code, kExitOk) << retried.err;
  EXPECT_TRUE(listed("job " + id->ToShortHex() + "  running"));
}

TEST_F(ServiceCommands, StatusShowsWorkersWithoutAJob) {
  Command worker(Orbweave({"work", "--join", address_, "--name", "lone"}));
  const std::vector<std::string> status = Orbweave({"status", "--coordinator", address_});
  EXPECT_TRUE(
      WaitUntil([&] { return RunCommand(status).out.find("lone") != std::string::npos; }, 60.0));
  EXPECT_THAT(RunCommand(Orbweave({"status", "--coordinator", address_, "--json"})).out,
              HasSubstr(R"("name":"lone")"));
  worker.Signal(SIGTERM);
  (void)worker.Wait();
}

TEST_F(ServiceCommands, ADrainedWorkerEndsByItself) {
  const std::vector<std::string> drain = Orbweave({"drain", "--coordinator", address_, "node/*"});
  EXPECT_EQ(RunCommand(drain).exit_code, kExitUsage) << "there is no such worker yet";
  Command worker(Orbweave({"work", "--join", address_, "--name", "node/7"}));
  ASSERT_TRUE(WaitUntil([&] { return RunCommand(drain).exit_code == kExitOk; }, 60.0));
  EXPECT_TRUE(WaitUntil([&] { return !worker.Running(); }, 60.0));
  EXPECT_EQ(worker.Wait().exit_code, kExitOk);
}

TEST_F(ServiceCommands, ForgetAndGcFreeTheDisk) {
  GrpcCoordinatorClient client(address_);
  JobSpec spec{.kind = "sparse", .label = "street"};
  spec.inputs.push_back(*client.Put("sources"));
  const auto id = client.SubmitJob(spec);
  ASSERT_TRUE(id.ok()) << id.status();
  const std::vector<std::string> forget =
      Orbweave({"forget", "--coordinator", address_, id->ToShortHex()});
  EXPECT_EQ(RunCommand(forget).exit_code, kExitUsage) << "it is running";
  ASSERT_TRUE(client.CancelJob(*id).ok());
  const CommandOutcome forgotten = RunCommand(forget);
  EXPECT_EQ(forgotten.exit_code, kExitOk) << forgotten.err;
  EXPECT_THAT(forgotten.out, HasSubstr("forgot job " + id->ToShortHex() + " (street)"));
  const CommandOutcome dry = RunCommand(Orbweave({"gc", "--coordinator", address_, "--dry-run"}));
  EXPECT_EQ(dry.exit_code, kExitOk) << dry.err;
  EXPECT_THAT(dry.out, HasSubstr("used lately           1 blobs"));
  EXPECT_THAT(dry.out, HasSubstr("garbage               0 blobs"));
  EXPECT_EQ(RunCommand(Orbweave({"gc", "--coordinator", address_})).exit_code, kExitOk);
  EXPECT_EQ(RunCommand(Orbweave({"gc", "--coordinator", address_, "--unused-for", "0"})).exit_code,
            kExitUsage)
      << "what is about to be handed in would go";
}

TEST_F(ServiceCommands, JobsSurviveAKilledCoordinator) {
  const auto submit = [this] {
    GrpcCoordinatorClient client(address_);
    JobSpec spec{.kind = "sparse", .label = "street"};
    spec.inputs.push_back(*client.Put("sources"));
    return client.SubmitJob(spec);
  };
  ASSERT_TRUE(submit().ok());
  serve_.Signal(SIGKILL);
  EXPECT_EQ(serve_.Wait().exit_code, 128 + SIGKILL);
  Command again(Orbweave({"serve", "--listen", address_, "--state", folder_ / "state"}));
  ASSERT_TRUE(
      WaitUntil([&again] { return again.ErrSoFar().find("ready") != std::string::npos; }, 60.0));
  EXPECT_THAT(RunCommand(Orbweave({"status", "--coordinator", address_})).out,
              HasSubstr("running"));
}

TEST_F(ServiceCommands, StatusWaitsForACoordinatorThatIsAway) {
  serve_.Signal(SIGKILL);
  EXPECT_EQ(serve_.Wait().exit_code, 128 + SIGKILL);
  Command status(Orbweave({"status", "--coordinator", address_, "--patience", "60"}));
  EXPECT_TRUE(WaitUntil(
      [&status] { return status.ErrSoFar().find("waiting up to 60 s") != std::string::npos; },
      60.0));
  const Command again(Orbweave({"serve", "--listen", address_, "--state", folder_ / "state"}));
  const CommandOutcome outcome = status.Wait();
  EXPECT_EQ(outcome.exit_code, kExitOk) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("no jobs"));
}

TEST(StatusCommand, SaysSoWhenNobodyAnswersForLongEnough) {
  const TemporaryFolder folder;
  const CommandOutcome outcome = RunCommand(
      Orbweave({"status", "--coordinator", "unix:" + (folder / "nobody"), "--patience", "2.5"}));
  EXPECT_EQ(outcome.exit_code, kExitUnavailable);
  EXPECT_THAT(outcome.err, HasSubstr("waiting up to 2.5 s\norbweave: no coordinator answers at"));
}

/// One task, for which there is no worker.
absl::StatusOr<JobPlan> FindWaitingPlan(std::string_view kind) {
  const InputRule input{InputRule::Kind::kJobInput, "", 0};
  return JobPlan{std::string(kind), {{.stage = "wait", .version = "1", .inputs = {input}}}};
}

/// What `orbweave` would do with these arguments.
void AddCommands(CLI::App& app, SelectedCommand& selected) {
  static const testing::StageMap stages = testing::ToyStages();
  static const StageLookup lookup = testing::LookupIn(stages);
  AddServeCommand(app, selected, FindWaitingPlan);
  AddWorkCommand(app, selected);
  AddExecTasksCommand(app, selected, lookup);
  AddStatusCommand(app, selected);
  AddCancelCommand(app, selected);
  AddJobsCommand(app, selected);
  AddRetryCommand(app, selected);
  AddDrainCommand(app, selected);
  AddForgetCommand(app, selected);
  AddStopCommand(app, selected);
  AddGcCommand(app, selected);
}

}  // namespace
}  // namespace orbweave

int main(int argc, char** argv) {
  return orbweave::testing::RunCommandOrTests(argc, argv, orbweave::AddCommands);
}
