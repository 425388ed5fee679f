// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// A run that workers of others join, and the ways to hand a job to a coordinator and to get its
// results.

#include <gmock/gmock.h>

#include "tests/jobs/corridor_job.h"

namespace orbweave::testing {
namespace {

using ::testing::HasSubstr;

std::vector<std::string> Orbweave(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), ORBWEAVE_BINARY);
  return arguments;
}

/// The corridor without workers of its own.
class JoinedRun : public ::testing::Test {
 protected:
  std::vector<std::string> Reconstruct(const std::string& socket) {
    std::vector<std::string> arguments = ReconstructCorridor(output_, 0);
    for (const std::string& more :
         {std::string("--listen"), "unix:" + (folder_ / socket), std::string("--announce"), file_})
      arguments.push_back(more);
    return arguments;
  }
  std::vector<std::string> Work() { return Orbweave({"work", "--join", "@" + file_}); }

  TemporaryFolder folder_;
  std::string output_ = folder_ / "model";
  std::string file_ = folder_ / "coordinator.json";
};

TEST_F(JoinedRun, IsDoneByThoseWhoJoinAndSendsThemHome) {
  Command worker(Work());
  const CommandOutcome run = RunCommand(Reconstruct("s"));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(worker.Wait().exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(file_)) << "it is over";
  const CommandOutcome alone = RunCommand(ReconstructCorridor(folder_ / "alone", 1));
  ASSERT_EQ(alone.exit_code, 0) << alone.err;
  EXPECT_EQ(ReadAll(output_ + "/points.ply"), ReadAll(folder_ / "alone/points.ply"));
}

TEST_F(JoinedRun, AnEngineMayStopAndStartItElsewhere) {
  Command worker(Work());
  {
    Command run(Reconstruct("first"));
    ASSERT_TRUE(WaitUntil([&] { return FinishedTasks(output_) >= 2; }, 60)) << run.ErrSoFar();
    run.Signal(SIGTERM);
    EXPECT_EQ(run.Wait().exit_code, 75);
  }
  EXPECT_TRUE(worker.Running()) << "it waits for the next one";
  const CommandOutcome again = RunCommand(Reconstruct("second"));
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(worker.Wait().exit_code, 0);
}

TEST_F(JoinedRun, KeepsItsJournalWhereItIsTold) {
  std::vector<std::string> arguments = ReconstructCorridor(output_, 1);
  arguments.push_back("--journal-folder");
  arguments.push_back(folder_ / "disk");
  ASSERT_EQ(RunCommand(arguments).exit_code, 0);
  std::filesystem::remove_all(folder_ / "disk");  // the machine is lost, after its end
  const CommandOutcome again = RunCommand(arguments);
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(ComputedTasks(output_), 0U);
}

TEST_F(JoinedRun, ThatNobodyCouldJoinIsRefused) {
  const CommandOutcome run = RunCommand(ReconstructCorridor(output_, 0));
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("--workers 0 needs --listen"));
}

/// A coordinator with a worker.
class HandedIn : public ::testing::Test {
 protected:
  HandedIn()
      : serve_(Orbweave({"serve", "--listen", address_, "--state", folder_ / "state"})),
        worker_(Orbweave({"work", "--join", address_, "--slots", "2"})) {
    EXPECT_TRUE(WaitUntil([this] { return std::filesystem::exists(folder_ / "s"); }, 20));
  }

  TemporaryFolder folder_;
  std::string address_ = "unix:" + (folder_ / "s");
  Command serve_;
  Command worker_;
};

TEST_F(HandedIn, ADatabaseIsReconstructedAndItsResultsFetched) {
  const CommandOutcome submitted = RunCommand(Orbweave({"submit",
                                                        "--coordinator",
                                                        address_,
                                                        "--database",
                                                        CorridorFolder() + "/corridor.db",
                                                        "--gnss",
                                                        CorridorFolder() + "/gnss.csv"}));
  ASSERT_EQ(submitted.exit_code, 0) << submitted.err;
  const std::string job = submitted.out.substr(0, 8);
  const std::vector<std::string> fetch =
      Orbweave({"fetch", "--coordinator", address_, job, "--output", folder_ / "model"});
  CommandOutcome fetched = RunCommand(fetch);
  if (fetched.exit_code != 0) {
    EXPECT_THAT(fetched.err, HasSubstr("still runs"));
  }
  ASSERT_TRUE(WaitUntil([&] { return (fetched = RunCommand(fetch)).exit_code == 0; }, 100))
      << fetched.err;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "model/report.json"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "model/sparse/0/images.bin"));
}

TEST_F(HandedIn, ADenseCloudIsComputedOverTheSameWorkers) {
  ASSERT_EQ(RunCommand(Orbweave({"synth",
                                 "street",
                                 "--panoramas",
                                 "8",
                                 "--size",
                                 "512x256",
                                 "--output",
                                 folder_ / "street"}))
                .exit_code,
            0);
  const CommandOutcome submitted = RunCommand(Orbweave({"submit",
                                                        "--coordinator",
                                                        address_,
                                                        folder_ / "street/images",
                                                        "--dense",
                                                        "--output",
                                                        folder_ / "model"}));
  EXPECT_EQ(submitted.exit_code, 0) << submitted.err;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "model/report.json"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "model/dense/cloud.las"));
}

TEST_F(HandedIn, NothingIsRefused) {
  const CommandOutcome nothing = RunCommand(Orbweave({"submit", "--coordinator", address_}));
  EXPECT_EQ(nothing.exit_code, 2);
  EXPECT_THAT(nothing.err, HasSubstr("IMAGES or --database"));
}

}  // namespace
}  // namespace orbweave::testing
