// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// `orbweave bench scaling` as a process, on corridors small enough for a test.

#include <gmock/gmock.h>

#include "tests/jobs/corridor_job.h"

namespace orbweave::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

nlohmann::json ScalingOf(const std::string& folder) {
  return nlohmann::json::parse(ReadAll(folder + "/scaling.json"), nullptr, false);
}

const nlohmann::json* StageNamed(const nlohmann::json& report, const std::string& name) {
  for (const nlohmann::json& stage : report["stages"]) {
    if (stage["name"] == name) return &stage;
  }
  return nullptr;
}

TEST(BenchScaling, RunsCorridorsAndPredictsMoreWorkers) {
  const TemporaryFolder folder;
  const CommandOutcome bench = RunCommand({ORBWEAVE_BINARY,
                                           "bench",
                                           "scaling",
                                           "--panoramas",
                                           "30,60",
                                           "--workers",
                                           "1,2",
                                           "--predict",
                                           "6000",
                                           "--set",
                                           "partition.cluster_size=16",
                                           "--output",
                                           folder.Path()});
  ASSERT_EQ(bench.exit_code, 0) << bench.err;
  EXPECT_THAT(bench.out, HasSubstr("| reconstruct_cluster |"));
  EXPECT_THAT(bench.out, HasSubstr("6,000, extrapolated"));
  EXPECT_FALSE(std::filesystem::exists(folder / ".scratch"));
  const nlohmann::json report = ScalingOf(folder.Path());
  ASSERT_TRUE(report.is_object());
  ASSERT_EQ(report["runs"].size(), 3U) << "30 on one worker, 60 on one and on two";
  for (const nlohmann::json& run : report["runs"]) {
    EXPECT_EQ(run["registered"], run["panoramas"]);
    EXPECT_GT(run["cpu_s"], 0.0);
    EXPECT_GT(run["coordinator_peak_bytes"], 1 << 20);
  }
  const nlohmann::json* adjust = StageNamed(report, "adjust_block");
  ASSERT_NE(adjust, nullptr) << "the adjustment is distributed";
  EXPECT_GT((*adjust)["runs"], 2);
  EXPECT_LT((*adjust)["serial_share"], 1.0);
  EXPECT_GT((*adjust)["bytes_in_per_panorama"], 0.0);
  EXPECT_GT((*adjust)["peak_memory_bytes"], 1 << 20);
  EXPECT_TRUE((*adjust)["growth_exponent"].is_number());
  EXPECT_EQ((*StageNamed(report, "partition_view_graph"))["serial_share"], 1.0);
  ASSERT_EQ(report["weak_scaling"].size(), 7U);
  EXPECT_NEAR(report["weak_scaling"][0]["efficiency"], 1.0, 1e-9);
  for (const nlohmann::json& point : report["weak_scaling"]) {
    EXPECT_TRUE(point["simulated"]);
    EXPECT_LE(point["efficiency"], 1.0 + 1e-9);
  }
}

TEST(BenchScaling, PredictionsKeepTheLawsOfSchedules) {
  const TemporaryFolder folder;
  ASSERT_EQ(RunCommand(ReconstructCorridor(folder / "model", 2)).exit_code, 0);
  const CommandOutcome bench = RunCommand(
      {ORBWEAVE_BINARY, "bench", "scaling", "--job", folder / "model", "--output", folder / "out"});
  ASSERT_EQ(bench.exit_code, 0) << bench.err;
  const nlohmann::json report = ScalingOf(folder / "out");
  EXPECT_EQ(report["panoramas"], 60);
  EXPECT_TRUE(report["runs"].empty()) << "nothing was run now";
  EXPECT_FALSE(report["assumptions"]["overhead_measured"]);
  EXPECT_TRUE(report["weak_scaling"].empty()) << "one job does not tell how stages grow";
  ASSERT_EQ(report["predictions"].size(), 1U);
  const nlohmann::json& prediction = report["predictions"][0];
  EXPECT_TRUE(prediction["simulated"]);
  EXPECT_FALSE(prediction["extrapolated"]);
  double before_s = HUGE_VAL;
  for (const nlohmann::json& point : prediction["points"]) {
    EXPECT_LE(point["wall_s"], before_s);
    EXPECT_LE(point["efficiency"], 1.0 + 1e-12);
    EXPECT_GE(point["wall_s"], prediction["critical_path_s"]);
    before_s = point["wall_s"];
  }
  EXPECT_EQ(prediction["points"].back()["workers"], 1000);
}

TEST(BenchScaling, APageHasNothingOutsideIt) {
  const TemporaryFolder folder;
  ASSERT_EQ(RunCommand(ReconstructCorridor(folder / "model", 1)).exit_code, 0);
  const CommandOutcome bench =
      RunCommand({ORBWEAVE_BINARY, "bench", "scaling", "--job", folder / "model"});
  ASSERT_EQ(bench.exit_code, 0) << bench.err;
  const std::string page = ReadAll(folder / "model/scaling.html");
  EXPECT_THAT(page, HasSubstr("simulated"));
  EXPECT_THAT(page, HasSubstr("<svg"));
  EXPECT_THAT(page, HasSubstr("(assumed)"));
  for (const char* outside : {"http:", "https:", "src=", "<link", "<script"})
    EXPECT_THAT(page, Not(HasSubstr(outside)));
}

TEST(BenchScaling, SaysWhatIsMissing) {
  const TemporaryFolder folder;
  EXPECT_EQ(RunCommand({ORBWEAVE_BINARY, "bench", "scaling"}).exit_code, 2);
  const CommandOutcome nothing =
      RunCommand({ORBWEAVE_BINARY, "bench", "scaling", "--job", folder.Path()});
  EXPECT_EQ(nothing.exit_code, 2);
  EXPECT_THAT(nothing.err, HasSubstr("is not the output folder of a job"));
}

}  // namespace
}  // namespace orbweave::testing
