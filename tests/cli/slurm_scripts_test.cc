// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// The scripts as Slurm runs them, with programs in Slurm's place that note how they were called.

#include "cli/slurm/slurm_scripts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <tuple>

#include "absl/strings/match.h"
#include "absl/strings/str_split.h"
#include "cli/process/exit_code.h"
#include "tests/support/command.h"

namespace orbweave {
namespace {

namespace fs = std::filesystem;
using testing::Command;
using testing::CommandOutcome;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::ReadAll;
using testing::WaitUntil;

class SlurmScripts : public ::testing::Test {
 protected:
  SlurmScripts() {
    fs::create_directories(launch_.Folder());
    fs::create_directory(folder_ / "bin");
    for (const char* name : {"sbatch", "scontrol", "scancel"}) Program(name, "");
    Program("squeue", R"(case "$*" in *%T*) cat "$STATE" ;; *) cat "$QUEUE" ;; esac)");
    Write("state", "RUNNING\n");
    Write("queue", "");
    Write("calls", "");
  }

  void Write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  }
  /// A program that notes its call and does `action`.
  void Program(const std::string& name, const std::string& action) {
    const std::string path = folder_ / "bin/" + name;
    std::ofstream(path) << "#!/bin/bash\necho \"" << name << " $*\" >>'" << folder_ / "calls"
                        << "'\n"
                        << action << "\n";
    fs::permissions(path, fs::perms::owner_all);
  }
  /// `script` as the batch script of job 7, in which "scontrol requeue" ends it as Slurm does.
  std::vector<std::string> Batch(const std::string& script) {
    Write("script", script);
    Program("sleep", "exec /bin/sleep 0.2");
    return {"/usr/bin/env",
            "PATH=" + (folder_ / "bin") + ":/usr/bin:/bin",
            "SLURM_JOB_ID=7",
            "SLURM_ARRAY_JOB_ID=" + array_,
            "SLURM_ARRAY_TASK_ID=2",
            "STATE=" + (folder_ / "state"),
            "QUEUE=" + (folder_ / "queue"),
            "TMPDIR=" + folder_.Path(),
            "bash",
            folder_ / "script"};
  }
  std::string Calls() { return ReadAll(folder_ / "calls"); }

  testing::TemporaryFolder folder_;
  std::string array_{};  ///< that the job is of; empty: none
  SlurmLaunch launch_{.name = "orbweave-model",
                      .program = folder_ / "bin/orbweave",
                      .work_folder = folder_.Path(),
                      .output = folder_ / "it's a model",
                      .run_arguments = {"my images", "--set", "a=$b"},
                      .min_nodes = 3,
                      .max_nodes = 3,
                      .cpus = 2,
                      .time = "0:10:00",
                      .sbatch = {"--account=city"},
                      .coordinator_sbatch = {"--partition=long"},
                      .workers_sbatch = {"--mem=64G"}};
};

TEST_F(SlurmScripts, TheCoordinatorSubmitsWorkersRunsTheJobAndCancelsWhoStillWaits) {
  Program("orbweave", "exit 4");
  const CommandOutcome outcome = testing::RunCommand(Batch(CoordinatorScript(launch_)));
  EXPECT_EQ(outcome.exit_code, kExitVerdict) << outcome.err;
  EXPECT_THAT(Calls(), HasSubstr("orbweave run my images --set a=$b --output " + launch_.output));
  EXPECT_THAT(Calls(), HasSubstr("--workers 0 --listen 0.0.0.0:0 --tls " + launch_.Folder()));
  EXPECT_THAT(Calls(),
              HasSubstr("sbatch --parsable --array=1-3 " + launch_.Folder() + "/workers.sbatch"));
  EXPECT_THAT(Calls(),
              HasSubstr("scancel --quiet --me --state=PENDING --name=" + launch_.WorkersName()));
  EXPECT_THAT(Calls(), Not(HasSubstr("requeue")));
}

TEST_F(SlurmScripts, TheCoordinatorSubmitsOnlyWorkersThatAreMissing) {
  Program("orbweave", "/bin/sleep 0.5");
  Write("queue", "12_1\n12_3\n");
  EXPECT_EQ(testing::RunCommand(Batch(CoordinatorScript(launch_))).exit_code, kExitOk);
  EXPECT_THAT(Calls(), HasSubstr("sbatch --parsable --array=1-1 "));
}

TEST_F(SlurmScripts, AsManyWorkersAsThereIsWorkForWithinBounds) {
  launch_.max_nodes = 8;
  Write("queue", "12_1\n12_2\n12_3\n");
  for (const auto& [slots, more] : {std::pair("9", 2), {"100", 5}, {"6", 0}, {"0", 0}}) {
    Write("calls", "");
    Program("orbweave",
            std::string("case $1 in status) echo ") + slots + " ;; *) /bin/sleep 0.7 ;; esac");
    EXPECT_EQ(testing::RunCommand(Batch(CoordinatorScript(launch_))).exit_code, kExitOk);
    EXPECT_THAT(Calls(), HasSubstr("orbweave status --coordinator @" + launch_.Folder()));
    if (more == 0) {
      EXPECT_THAT(Calls(), Not(HasSubstr("sbatch"))) << slots;
    } else {
      EXPECT_THAT(Calls(),
                  HasSubstr("sbatch --parsable --export=ALL,ORBWEAVE_IDLE_EXIT=120 --array=1-" +
                            std::to_string(more) + " "));
    }
  }
}

TEST_F(SlurmScripts, WithoutAnAnswerThereAreTheFewestWorkers) {
  launch_.max_nodes = 8;
  Program("orbweave", "case $1 in status) exit 3 ;; *) /bin/sleep 0.7 ;; esac");
  EXPECT_EQ(testing::RunCommand(Batch(CoordinatorScript(launch_))).exit_code, kExitOk);
  EXPECT_THAT(Calls(), HasSubstr("sbatch --parsable --array=1-3 "));
  EXPECT_THAT(Calls(), Not(HasSubstr("IDLE_EXIT")));
}

TEST_F(SlurmScripts, AWorkerBeyondTheFewestLeavesWhenItIsIdle) {
  Program("orbweave", "exit 0");
  std::vector<std::string> batch = Batch(WorkersScript(launch_));
  EXPECT_EQ(testing::RunCommand(batch).exit_code, kExitOk);
  EXPECT_THAT(Calls(), Not(HasSubstr("--idle-exit")));
  batch.insert(batch.begin() + 1, "ORBWEAVE_IDLE_EXIT=120");
  EXPECT_EQ(testing::RunCommand(batch).exit_code, kExitOk);
  EXPECT_THAT(Calls(), HasSubstr("--idle-exit 120"));
}

TEST_F(SlurmScripts, TheCoordinatorSubmitsNoneWhileSlurmDoesNotAnswer) {
  Program("orbweave", "/bin/sleep 0.5");
  Program("squeue", "exit 1");
  EXPECT_EQ(testing::RunCommand(Batch(CoordinatorScript(launch_))).exit_code, kExitOk);
  EXPECT_THAT(Calls(), Not(HasSubstr("sbatch")));
}

/// How often the script slept for 30 s before each line of `calls` that begins with `begin`.
std::vector<size_t> PausesBefore(const std::string& calls, const std::string& begin) {
  std::vector<size_t> pauses;
  size_t sleeps = 0;
  for (const absl::string_view line : absl::StrSplit(calls, '\n')) {
    if (absl::StartsWith(line, "sleep 30")) ++sleeps;
    if (absl::StartsWith(line, begin)) pauses.push_back(std::exchange(sleeps, 0));
  }
  return pauses;
}

TEST_F(SlurmScripts, WorkersAreSubmittedOnceAMinuteAtMost) {
  launch_.max_nodes = 8;
  Program("orbweave",
          "[ $1 = status ] && { echo 100; exit; }; until [ $(grep -c ^squeue '" +
              (folder_ / "calls") + "') -ge 4 ]; do /bin/sleep 0.02; done");
  std::vector<std::string> batch = Batch(CoordinatorScript(launch_));
  Program("sleep", "exec /bin/sleep 0.02");
  EXPECT_EQ(testing::RunCommand(batch).exit_code, kExitOk);
  const std::vector<size_t> pauses = PausesBefore(Calls(), "squeue --noheader --array");
  ASSERT_GE(pauses.size(), 4U) << Calls();
  for (size_t i = 1; i < 4; ++i) EXPECT_EQ(pauses[i], 2U) << Calls();
}

TEST_F(SlurmScripts, TheCoordinatorLooksEveryHalfMinuteWhileNobodyIsMissing) {
  Write("queue", "12_1\n12_2\n12_3\n");
  Program(
      "orbweave",
      "until [ $(grep -c ^squeue '" + (folder_ / "calls") + "') -ge 4 ]; do /bin/sleep 0.02; done");
  std::vector<std::string> batch = Batch(CoordinatorScript(launch_));
  Program("sleep", "exec /bin/sleep 0.02");
  EXPECT_EQ(testing::RunCommand(batch).exit_code, kExitOk);
  const std::vector<size_t> pauses = PausesBefore(Calls(), "squeue --noheader --array");
  ASSERT_GE(pauses.size(), 4U) << Calls();
  for (size_t i = 1; i < 4; ++i) EXPECT_EQ(pauses[i], 1U) << Calls();
}

TEST_F(SlurmScripts, TheCoordinatorBacksOffWhileSlurmTakesNoWorkers) {
  Program("sbatch", "exit 1");
  Program(
      "orbweave",
      "until [ $(grep -c ^sbatch '" + (folder_ / "calls") + "') -ge 4 ]; do /bin/sleep 0.02; done");
  std::vector<std::string> batch = Batch(CoordinatorScript(launch_));
  Program("sleep", "exec /bin/sleep 0.02");
  EXPECT_EQ(testing::RunCommand(batch).exit_code, kExitOk);
  const std::vector<size_t> pauses = PausesBefore(Calls(), "sbatch");
  ASSERT_GE(pauses.size(), 4U) << Calls();
  EXPECT_THAT(std::vector<size_t>(pauses.begin(), pauses.begin() + 4),
              ::testing::ElementsAre(0, 2, 4, 8))
      << Calls();
}

TEST_F(SlurmScripts, WithAStoreWorkersLeaveTheFolderAlone) {
  EXPECT_THAT(WorkersScript(launch_), HasSubstr("--blobs"));
  for (const std::vector<std::string>& given :
       {std::vector<std::string>{"images", "--store", "s3://b/p"},
        std::vector<std::string>{"images", "--store=s3://b/p"}}) {
    launch_.run_arguments = given;
    EXPECT_THAT(WorkersScript(launch_), Not(HasSubstr("--blobs")));
  }
}

TEST_F(SlurmScripts, SigtermIsHandedOnAndTheJobRequeued) {
  Program("orbweave", "trap 'echo told >>calls; exit 75' TERM; while :; do /bin/sleep 0.05; done");
  for (const std::string& script : {CoordinatorScript(launch_), WorkersScript(launch_)}) {
    Write("calls", "");
    Command batch(Batch("cd " + ShellWord(folder_.Path()) + "\n" + script));
    ASSERT_TRUE(WaitUntil([&] { return Calls().find("orbweave ") != std::string::npos; }, 20.0));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    batch.Signal(SIGTERM);
    batch.Signal(SIGTERM);
    EXPECT_EQ(batch.Wait().exit_code, kExitStopped);
    const std::string calls = Calls();
    EXPECT_EQ(calls.find("told"), calls.rfind("told")) << "once";
    EXPECT_THAT(calls, HasSubstr("scontrol requeue 7"));
  }
}

TEST_F(SlurmScripts, TheCoordinatorStaysWhileWorkersThatEndWithItHandIn) {
  Program("orbweave",
          "trap 'echo told >>\"" + (folder_ / "calls") +
              "\"; exit 75' TERM; while :; do /bin/sleep 0.05; done");
  // The time that is left, and how many seconds of it the script sleeps before it hands SIGTERM on.
  for (const auto& [left_s, most, least] : {std::tuple(55, 40, 1), {10, 0, 0}, {3000, 0, 0}}) {
    Write("calls", "");
    Program("scontrol",
            "echo \"JobId=7 EndTime=$(date -d '" + std::to_string(left_s) +
                " seconds' +%Y-%m-%dT%H:%M:%S) X=1\"");
    const std::vector<std::string> arguments = Batch(CoordinatorScript(launch_));
    Program("sleep", "exec /bin/sleep 0.01");
    Command batch(arguments);
    ASSERT_TRUE(WaitUntil([&] { return Calls().find("orbweave ") != std::string::npos; }, 20.0));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    batch.Signal(SIGTERM);
    EXPECT_EQ(batch.Wait().exit_code, kExitStopped);
    const std::string calls = Calls();
    int slept = 0;
    for (const absl::string_view line : absl::StrSplit(calls.substr(0, calls.find("told")), '\n'))
      slept += line == "sleep 1" ? 1 : 0;
    EXPECT_LE(slept, most) << calls;
    EXPECT_GE(slept, least) << calls;
  }
}

TEST_F(SlurmScripts, AWorkerSpeaksForItselfAndNotForTheArrayItIsOf) {
  array_ = "7";  // as its last job is numbered
  Program("orbweave", "exit 75");
  EXPECT_EQ(testing::RunCommand(Batch(WorkersScript(launch_))).exit_code, kExitStopped);
  EXPECT_THAT(Calls(), HasSubstr("scontrol show job --oneliner 7_2\n"));
  EXPECT_THAT(Calls(), HasSubstr("squeue --noheader --format=%T --jobs=7_2\n"));
  EXPECT_THAT(Calls(), HasSubstr("scontrol requeue 7_2\n"));
}

TEST_F(SlurmScripts, AJobThatSomebodyCancelsIsNotRequeued) {
  Program("orbweave", "trap 'exit 75' TERM; while :; do /bin/sleep 0.05; done");
  Write("state", "COMPLETING\n");
  Command batch(Batch(WorkersScript(launch_)));
  ASSERT_TRUE(WaitUntil([&] { return Calls().find("orbweave ") != std::string::npos; }, 20.0));
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  batch.Signal(SIGTERM);
  EXPECT_EQ(batch.Wait().exit_code, kExitStopped);
  EXPECT_THAT(Calls(), Not(HasSubstr("requeue")));
}

TEST_F(SlurmScripts, AWorkerIsToldWhenItsMachineIsTakenBack) {
  Program("orbweave", "exit 0");
  Program("scontrol",
          "echo 'JobId=7 StartTime=2026-11-23T17:00:00 EndTime=2026-11-23T18:00:00 X=1'");
  EXPECT_EQ(testing::RunCommand(Batch(WorkersScript(launch_))).exit_code, kExitOk);
  const std::string end =
      testing::RunCommand({"/bin/date", "-d", "2026-11-23T17:59:50", "+%s"}).out;
  EXPECT_THAT(Calls(), HasSubstr("--until " + end.substr(0, end.size() - 1) + " --grace 50"));
  EXPECT_THAT(Calls(), HasSubstr("--join @" + launch_.Folder() + "/coordinator.json"));
  Write("calls", "");
  Program("scontrol", "echo 'JobId=7 EndTime=Unknown'");
  EXPECT_EQ(testing::RunCommand(Batch(WorkersScript(launch_))).exit_code, kExitOk);
  EXPECT_THAT(Calls(), Not(HasSubstr("--until")));
}

TEST_F(SlurmScripts, SayWhatTheSiteWants) {
  for (const std::string& script : {CoordinatorScript(launch_), WorkersScript(launch_)}) {
    EXPECT_THAT(script, HasSubstr("\n#SBATCH --account=city\n"));
    EXPECT_THAT(script, HasSubstr("\n#SBATCH --time=0:10:00\n"));
    EXPECT_THAT(script, HasSubstr("\n#SBATCH --requeue\n"));
  }
  EXPECT_THAT(WorkersScript(launch_), HasSubstr("\n#SBATCH --cpus-per-task=2\n"));
  EXPECT_THAT(WorkersScript(launch_), HasSubstr("\n#SBATCH --mem=64G\n"));
  EXPECT_THAT(WorkersScript(launch_), Not(HasSubstr("--partition")));
  EXPECT_THAT(CoordinatorScript(launch_), HasSubstr("\n#SBATCH --partition=long\n"));
  EXPECT_THAT(CoordinatorScript(launch_), Not(HasSubstr("--mem")));
}

TEST_F(SlurmScripts, WorkersKeepCopiesOfBlobsWhereTheNodeSays) {
  Program("orbweave", "exit 0");
  EXPECT_THAT(WorkersScript(launch_), Not(HasSubstr("--scratch")));
  launch_.scratch = "$TMPDIR/a b";
  launch_.scratch_size = "50GiB";
  EXPECT_EQ(testing::RunCommand(Batch(WorkersScript(launch_))).exit_code, kExitOk);
  EXPECT_THAT(Calls(), HasSubstr("--scratch " + folder_.Path() + "/a b --scratch-size 50GiB"));
}

TEST(ShellWordWithNames, ExpandsNamesAndNothingElse) {
  const auto echo = [](const std::string& text) {
    return testing::RunCommand({"/usr/bin/env",
                                "NODE=n 7",
                                "/bin/bash",
                                "-c",
                                "printf %s " + ShellWordWithNames(text)})
        .out;
  };
  EXPECT_EQ(echo("/scratch/$NODE/${NODE}x"), "/scratch/n 7/n 7x");
  for (const std::string text : {"$(id)", "`id`", "a\"b", "\\", "$1$", "it's", "a\\$ b", ""})
    EXPECT_EQ(echo(text), text);
}

TEST(ShellWord, IsOneWordWhateverIsInIt) {
  for (const std::string text : {"plain", "two words", "it's", "$HOME `id` \"x\" \\", "a\nb", ""}) {
    const CommandOutcome outcome =
        testing::RunCommand({"/bin/bash", "-c", "printf %s " + ShellWord(text)});
    EXPECT_EQ(outcome.out, text);
  }
}

}  // namespace
}  // namespace orbweave
