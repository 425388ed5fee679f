// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// The global adjustment spread over workers: the bytes of one process, also when workers or the
// whole run are killed between its rounds.

#include <filesystem>

#include "tests/jobs/corridor_job.h"

namespace orbweave::testing {
namespace {

std::vector<std::string> InBlocks(const std::string& output, int workers) {
  std::vector<std::string> command = ReconstructCorridor(output, workers);
  command.insert(command.end(), {"--set", "blocks.distribute_from=0"});
  return command;
}

const nlohmann::json& StageOf(const nlohmann::json& report, const std::string& name) {
  for (const auto& stage : report["stages"]) {
    if (stage["name"] == name) return stage;
  }
  static const nlohmann::json none;
  return none;
}

uint32_t ComputedBlocks(const std::string& output) {
  const nlohmann::json report = ReportOf(output);
  return StageOf(report, "adjust_block").value("tasks_computed", 0U);
}

/// Tasks of the job, and of those the ones before the first round of the adjustment.
struct Undisturbed {
  TemporaryFolder folder{};
  std::string output = folder / "undisturbed";
  size_t tasks = 0;
  size_t before_adjustment = 0;

  Undisturbed() {
    const CommandOutcome run = RunCommand(InBlocks(output, 2));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const nlohmann::json report = ReportOf(output);
    for (const auto& stage : report["stages"]) tasks += stage["tasks_computed"].get<size_t>();
    size_t in_rounds = 1;  // conclude_adjustment
    for (const char* name : {"steer_adjustment", "adjust_block"})
      in_rounds += StageOf(report, name).value("tasks_computed", size_t{0});
    before_adjustment = tasks - in_rounds;
  }
};

const Undisturbed& Expected() {
  static const Undisturbed undisturbed;
  return undisturbed;
}

TEST(AdjustmentInBlocks, GivesTheBytesOfOneTask) {
  const TemporaryFolder folder;
  const std::string together = folder / "together";
  const CommandOutcome run = RunCommand(ReconstructCorridor(together, 1));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(ComputedBlocks(together), 0U);
  EXPECT_GT(ComputedBlocks(Expected().output), 20U);
  ExpectSameModel(together, Expected().output);
}

/// The job is disturbed after this share of the adjustment's tasks.
class KilledBetweenRounds : public ::testing::TestWithParam<double> {
 protected:
  [[nodiscard]] size_t Moment() const {
    const auto rounds = static_cast<double>(Expected().tasks - Expected().before_adjustment);
    return Expected().before_adjustment + static_cast<size_t>(GetParam() * rounds);
  }
};

TEST_P(KilledBetweenRounds, AWorkerCostsItsHalfStepAlone) {
  const TemporaryFolder folder;
  const std::string output = folder / "killed";
  const size_t moment = Moment();
  Command run(InBlocks(output, 2));
  ASSERT_TRUE(WaitUntil([&] { return FinishedTasks(output) >= moment; }, 120)) << run.ErrSoFar();
  const std::vector<pid_t> workers = ChildrenOf(run.Pid());
  ASSERT_TRUE(run.Running()) << "the job ended before a worker could be killed";
  ASSERT_FALSE(workers.empty());
  kill(workers.back(), SIGKILL);
  const CommandOutcome outcome = run.Wait();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  ExpectSameModel(Expected().output, output);
}

TEST_P(KilledBetweenRounds, ARestartGoesOnAtTheRoundItWasIn) {
  const TemporaryFolder folder;
  const std::string output = folder / "resumed";
  const size_t moment = Moment();
  {
    Command run(InBlocks(output, 2));
    ASSERT_TRUE(WaitUntil([&] { return FinishedTasks(output) >= moment; }, 120)) << run.ErrSoFar();
    run.Signal(SIGKILL);
    (void)run.Wait();
  }
  const CommandOutcome again = RunCommand(InBlocks(output, 2));
  ASSERT_EQ(again.exit_code, 0) << again.err;
  size_t computed = 0;
  const nlohmann::json report = ReportOf(output);
  for (const auto& stage : report["stages"]) computed += stage["tasks_computed"].get<size_t>();
  EXPECT_LE(computed, Expected().tasks - moment);
  ExpectSameModel(Expected().output, output);
}

INSTANTIATE_TEST_SUITE_P(Moments, KilledBetweenRounds, ::testing::Values(0.05, 0.35, 0.65, 0.9));

}  // namespace
}  // namespace orbweave::testing
