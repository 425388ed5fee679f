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

std::vector<std::string> StudyBy(const std::string& engine, const std::string& output) {
  return {ORBWEAVE_BINARY,
          "bench",
          "scaling",
          "--engine",
          engine,
          "--nodes",
          "1,2",
          "--strong",
          "40",
          "--weak",
          "20",
          "--set",
          "partition.cluster_size=16",
          "--output",
          output};
}

/// What every engine leaves.
void ExpectStudy(const nlohmann::json& study, const std::string& engine) {
  ASSERT_TRUE(study.is_object());
  EXPECT_EQ(study["engine"], engine);
  ASSERT_EQ(study["points"].size(), 4U) << "one and two nodes, strong and weak";
  for (const nlohmann::json& point : study["points"]) {
    EXPECT_EQ(point["panoramas"], point["scaling"] == "strong" || point["nodes"] == 2 ? 40 : 20);
    EXPECT_GT(point["wall_s"], 0.0);
    EXPECT_GT(point["efficiency"], 0.0);
    EXPECT_GT(point["simulated_s"], 0.0);
    EXPECT_GT(point["coordinator_cpu_s"], 0.0);
    EXPECT_GT(point["read_bytes"], 0);
    double slots_s = 0.0;
    for (const auto& [cause, seconds] : point["slot_s"].items()) slots_s += seconds.get<double>();
    const double all_s = point["nodes"].get<double>() * point["wall_s"].get<double>();
    EXPECT_NEAR(slots_s, all_s, 0.05 * all_s) << "every second has a cause";
  }
  EXPECT_THAT(study["simulator"].get<std::string>(),
              ::testing::AnyOf(HasSubstr("of 4 runs"), HasSubstr("All 4 runs")));
}

TEST(BenchScaling, AStudyRunsMoreAndMoreLocalNodes) {
  const TemporaryFolder folder;
  const CommandOutcome bench = RunCommand(StudyBy("local", folder.Path()));
  ASSERT_EQ(bench.exit_code, 0) << bench.err;
  ExpectStudy(ScalingOf(folder.Path())["study"], "local");
  EXPECT_THAT(bench.out, HasSubstr("| weak | 2 | 40 |"));
  const std::string page = ReadAll(folder / "scaling.html");
  EXPECT_THAT(page, HasSubstr("Strong scaling, measured"));
  for (const char* outside : {"http:", "https:", "src=", "<link", "<script"})
    EXPECT_THAT(page, Not(HasSubstr(outside)));
}

TEST(BenchScaling, AStudyRunsNodesInNamespacesAndCountsTheirBytes) {
  if (RunCommand({"/bin/sh", "-c", "ip netns add orbweave-try && ip netns delete orbweave-try"})
          .exit_code != 0)
    GTEST_SKIP() << "only root makes network namespaces, and not everywhere";
  const TemporaryFolder folder;
  std::vector<std::string> command = StudyBy("netns", folder.Path());
  command.insert(command.end(), {"--node-processors", "0.5", "--link-mbit", "100"});
  Command running(command);
  const std::string own = "orbweave-" + std::to_string(running.Pid()) + "-";
  const CommandOutcome bench = running.Wait();
  ASSERT_EQ(bench.exit_code, 0) << bench.err;
  const nlohmann::json study = ScalingOf(folder.Path())["study"];
  ExpectStudy(study, "netns");
  EXPECT_EQ(study["processors_per_slot"], 0.5);
  EXPECT_NEAR(study["link_gbit_per_s"].get<double>(), 0.1, 1e-9);
  for (const nlohmann::json& point : study["points"]) {
    ASSERT_EQ(point["links"].size(), point["nodes"]);
    for (const nlohmann::json& link : point["links"]) {
      EXPECT_GT(link["in_bytes"], 100'000) << "matches and the program's greetings";
      EXPECT_GT(link["out_bytes"], 10'000);
    }
  }
  EXPECT_THAT(RunCommand({"/bin/sh", "-c", "ip netns list"}).out, Not(HasSubstr(own)))
      << "nothing is left of it";
}

TEST(BenchScaling, AStudySaysWhatItNeeds) {
  const TemporaryFolder folder;
  const auto run = [&](const std::vector<std::string>& more) {
    std::vector<std::string> command = {
        ORBWEAVE_BINARY, "bench", "scaling", "--output", folder.Path()};
    command.insert(command.end(), more.begin(), more.end());
    return RunCommand(command);
  };
  const CommandOutcome sizeless = run({"--engine", "local"});
  EXPECT_EQ(sizeless.exit_code, 2);
  EXPECT_THAT(sizeless.err, HasSubstr("--strong or --weak"));
  EXPECT_EQ(run({"--engine", "cloud", "--strong", "20"}).exit_code, 2);
  EXPECT_EQ(run({"--engine", "local", "--strong", "20", "--panoramas", "20"}).exit_code, 2);
  EXPECT_EQ(run({"--engine", "local", "--strong", "20", "--cpus", "2"}).exit_code, 2);
  EXPECT_EQ(run({"--strong", "20"}).exit_code, 2);
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
