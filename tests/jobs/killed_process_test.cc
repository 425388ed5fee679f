// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// A worker or the whole run killed for real: the job ends with the bytes of an undisturbed one.

#include "tests/jobs/corridor_job.h"

namespace orbweave::testing {
namespace {

std::string Undisturbed(const TemporaryFolder& folder) {
  const std::string output = folder / "undisturbed";
  const CommandOutcome run = RunCommand(ReconstructCorridor(output, 2));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return output;
}

TEST(KilledProcess, AWorkerKilledInTheMiddleOfTheJobIsReplaced) {
  const TemporaryFolder folder;
  const std::string expected = Undisturbed(folder);
  const std::string output = folder / "killed";
  Command run(ReconstructCorridor(output, 2));
  ASSERT_TRUE(WaitUntil([&] { return FinishedTasks(output) >= 3; }, 60)) << run.ErrSoFar();
  const std::vector<pid_t> workers = ChildrenOf(run.Pid());
  ASSERT_EQ(workers.size(), 2U);
  ASSERT_TRUE(run.Running()) << "the job ended before a worker could be killed";
  kill(workers[0], SIGKILL);
  const CommandOutcome outcome = run.Wait();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  ExpectSameModel(expected, output);
}

TEST(KilledProcess, ATasksProcessKilledInTheMiddleOfTheJobLeavesTheWorkersAlone) {
  const TemporaryFolder folder;
  const std::string expected = Undisturbed(folder);
  const std::string output = folder / "killed";
  Command run(ReconstructCorridor(output, 2));
  ASSERT_TRUE(WaitUntil([&] { return FinishedTasks(output) >= 3; }, 60)) << run.ErrSoFar();
  const std::vector<pid_t> workers = ChildrenOf(run.Pid());
  ASSERT_EQ(workers.size(), 2U);
  for (const pid_t worker : workers) {
    for (const pid_t process : ChildrenOf(worker)) kill(process, SIGKILL);
  }
  ASSERT_TRUE(run.Running()) << "the job ended before a process could be killed";
  EXPECT_EQ(ChildrenOf(run.Pid()), workers);
  const CommandOutcome outcome = run.Wait();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  ExpectSameModel(expected, output);
}

TEST(KilledProcess, AKilledRunResumesWithoutRepeatingFinishedTasks) {
  const TemporaryFolder folder;
  const std::string expected = Undisturbed(folder);
  const std::string output = folder / "resumed";
  {
    Command run(ReconstructCorridor(output, 2));
    ASSERT_TRUE(WaitUntil([&] { return FinishedTasks(output) >= 3; }, 60)) << run.ErrSoFar();
    run.Signal(SIGKILL);
    EXPECT_EQ(run.Wait().exit_code, 128 + SIGKILL);
  }
  const CommandOutcome again = RunCommand(ReconstructCorridor(output, 2));
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_GE(ReusedTasks(output), 3U);
  ExpectSameModel(expected, output);
}

TEST(KilledProcess, InterruptStopsCleanlyAndResumes) {
  const TemporaryFolder folder;
  const std::string output = folder / "interrupted";
  {
    Command run(ReconstructCorridor(output, 2));
    ASSERT_TRUE(WaitUntil([&] { return FinishedTasks(output) >= 2; }, 60)) << run.ErrSoFar();
    const std::vector<pid_t> workers = ChildrenOf(run.Pid());
    run.Signal(SIGINT);
    const CommandOutcome stopped = run.Wait();
    EXPECT_EQ(stopped.exit_code, 130) << stopped.err;
    for (const pid_t worker : workers)
      EXPECT_NE(kill(worker, 0), 0) << "worker " << worker << " still runs";
  }
  const CommandOutcome again = RunCommand(ReconstructCorridor(output, 2));
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_GE(ReusedTasks(output), 2U);
}

TEST(KilledProcess, ASecondRunComputesNothing) {
  const TemporaryFolder folder;
  const std::string output = Undisturbed(folder);
  const std::string points = ReadAll(output + "/points.ply");
  const CommandOutcome again = RunCommand(ReconstructCorridor(output, 2));
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(ComputedTasks(output), 0U);
  EXPECT_EQ(ReadAll(output + "/points.ply"), points);
}

TEST(KilledProcess, AChangedOptionRepeatsOnlyWhatDependsOnIt) {
  const TemporaryFolder folder;
  const std::string output = Undisturbed(folder);
  std::vector<std::string> changed = ReconstructCorridor(output, 2);
  changed.insert(changed.end(), {"--set", "global.rounds=3"});
  const CommandOutcome again = RunCommand(changed);
  ASSERT_EQ(again.exit_code, 0) << again.err;
  // join_submodels, steer_adjustment and conclude_adjustment; blocks come out as they were.
  EXPECT_EQ(ComputedTasks(output), 3U);
}

}  // namespace
}  // namespace orbweave::testing
