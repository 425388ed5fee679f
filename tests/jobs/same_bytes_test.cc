// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/jobs/corridor_job.h"

namespace orbweave::testing {
namespace {

TEST(SameBytes, OneTwoAndThreeWorkersWriteTheSameModel) {
  const TemporaryFolder folder;
  for (int workers = 1; workers <= 3; ++workers) {
    const std::string output = folder / std::to_string(workers);
    const CommandOutcome run = RunCommand(ReconstructCorridor(output, workers));
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(ReportOf(output)["registered"], 60) << ReportOf(output).dump(1);
    EXPECT_GE(ReportOf(output)["clusters"].size(), 3U);
  }
  ExpectSameModel(folder / "1", folder / "2");
  ExpectSameModel(folder / "1", folder / "3");
}

TEST(SameBytes, EveryWorkerGetsATask) {
  const TemporaryFolder folder;
  const std::string output = folder / "out";
  const CommandOutcome run = RunCommand(ReconstructCorridor(output, 2));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json report = ReportOf(output);
  ASSERT_EQ(report["workers"].size(), 2U);
  for (const auto& worker : report["workers"])
    EXPECT_GT(worker["tasks_done"], 0) << report["workers"].dump();
}

}  // namespace
}  // namespace orbweave::testing
