// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bench/scaling/engine_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/scaling/engine_study_html.h"
#include "bench/scaling/engine_study_text.h"
#include "bench/scaling/measurement_json.h"

namespace orbweave {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

/// A job of `tasks` tasks of a second each on `nodes`, which took `wall_s`.
JobMeasurement Job(uint32_t nodes, uint32_t tasks, double wall_s, uint32_t panoramas) {
  JobMeasurement job{.label = "a street",
                     .panoramas = panoramas,
                     .registered = panoramas,
                     .workers = nodes,
                     .wall_s = wall_s,
                     .coordinator_cpu_s = 0.002 * tasks};
  for (uint32_t part = 0; part < tasks; ++part) {
    job.tasks.push_back({.run = 0,
                         .stage = "match_images",
                         .part = part,
                         .cost = {.wall_s = 1.0, .cpu_s = 1.0, .bytes_in = 100, .bytes_out = 10}});
    job.timings.push_back({.run = 0,
                           .stage = "match_images",
                           .part = part,
                           .worker = std::to_string(part % nodes),
                           .start_s = 1.0 * (part / nodes),
                           .end_s = 1.0 * (part / nodes) + 1.0});
  }
  return job;
}

std::vector<StudyRun> Runs() {
  return {{ScalingKind::kStrong, 0, Job(1, 8, 8.0, 80)},
          {ScalingKind::kWeak, 0, Job(1, 2, 2.0, 20)},
          {ScalingKind::kStrong, 0, Job(2, 8, 4.0, 80)},
          {ScalingKind::kWeak, 0, Job(2, 4, 2.5, 40)},
          {ScalingKind::kStrong, 1, Job(2, 8, 5.0, 80)},
          {ScalingKind::kStrong, 0, Job(4, 8, 4.0, 80)}};
}

TEST(EngineStudy, ComparesNodesWithTheFewest) {
  const EngineStudy study = BuildEngineStudy(Runs(), {"local", 16});
  EXPECT_THAT(NodesOf(study, ScalingKind::kStrong), ElementsAre(1, 2, 4));
  EXPECT_THAT(NodesOf(study, ScalingKind::kWeak), ElementsAre(1, 2));
  ASSERT_EQ(study.points.size(), 6U);
  EXPECT_DOUBLE_EQ(study.points[0].efficiency, 1.0);
  EXPECT_DOUBLE_EQ(study.points[1].efficiency, 1.0) << "4 s on two nodes";
  EXPECT_DOUBLE_EQ(study.points[2].efficiency, 0.8) << "5 s on two nodes";
  EXPECT_DOUBLE_EQ(study.points[3].efficiency, 0.5) << "4 s on four nodes";
  EXPECT_DOUBLE_EQ(study.points[5].efficiency, 0.8) << "weak, 2.5 s instead of 2 s";
  EXPECT_EQ(study.points[0].read_bytes, 800U);
  EXPECT_NEAR(study.points[0].coordinator_ms_per_task, 2.0, 1e-12);
  EXPECT_EQ(study.crowded_from, 0U);
}

TEST(EngineStudy, HoldsTheSimulatorAgainstEachRun) {
  const EngineStudy study = BuildEngineStudy(Runs(), {"local", 16});
  EXPECT_NEAR(study.points[0].simulation_error, 0.0, 0.01);
  EXPECT_NEAR(study.points[3].simulated_s, 2.0, 0.01);
  EXPECT_NEAR(study.points[3].simulation_error, -0.5, 0.01) << "two of four nodes did nothing";
  EXPECT_THAT(JudgeSimulator(study), HasSubstr("Only 3 of 6 runs"));
  EXPECT_THAT(JudgeSimulator(study), HasSubstr("doubtful"));
  EXPECT_THAT(JudgeSimulator(BuildEngineStudy({Runs().front()}, {"local", 16})),
              HasSubstr("All 1 runs took what is simulated"));
}

TEST(EngineStudy, SaysFromWhereOnItMeasuresTheMachine) {
  const EngineStudy study = BuildEngineStudy(Runs(), {"netns", 3});
  EXPECT_EQ(study.crowded_from, 4U);
  EXPECT_THAT(FormatEngineStudy(study), HasSubstr("From 4 nodes on they ask for more processors"));
  EXPECT_THAT(EngineStudyHtml(study), HasSubstr("From 4 nodes on they ask for more processors"));
  EXPECT_THAT(FormatEngineStudy(BuildEngineStudy(Runs(), {"slurm", 0})),
              Not(HasSubstr("ask for more processors")));
}

TEST(EngineStudy, ThePageTellsAllThatIsAskedOfIt) {
  std::vector<StudyRun> runs = Runs();
  runs[0].job.links = {{"node <1>", 5'000'000, 7'000'000}};
  const std::string page = EngineStudyHtml(BuildEngineStudy(runs, {"netns", 16}));
  for (const char* part : {"Strong scaling, measured",
                           "Weak scaling, measured",
                           "Where the time of slots went",
                           "barrier",
                           "serial stage",
                           "Bytes by link",
                           "node &lt;1&gt;",
                           "The coordinator",
                           "The simulator against each run"})
    EXPECT_THAT(page, HasSubstr(part));
  EXPECT_THAT(EngineStudyHtml(BuildEngineStudy(Runs(), {"local", 16})),
              HasSubstr("was not counted"));
}

TEST(MeasurementJson, IsReadBackAsItWas) {
  const JobMeasurement job = Job(2, 3, 2.5, 40);
  const auto read = ParseMeasurement(MeasurementJson(job));
  ASSERT_TRUE(read.ok()) << read.status();
  EXPECT_EQ(MeasurementJson(*read), MeasurementJson(job));
  EXPECT_EQ(read->timings.size(), 3U);
  EXPECT_EQ(read->timings[1].worker, "1");
  EXPECT_EQ(read->tasks[2].cost.bytes_in, 100U);
  EXPECT_EQ(read->workers, 2U);
}

TEST(MeasurementJson, RefusesWhatIsNone) {
  const std::string whole = MeasurementJson(Job(1, 1, 1.0, 2));
  for (const std::string& text : {std::string(),
                                  std::string("{}"),
                                  std::string("[]"),
                                  whole.substr(0, whole.size() / 2),
                                  std::string("null")})
    EXPECT_TRUE(absl::IsDataLoss(ParseMeasurement(text).status())) << text;
}

}  // namespace
}  // namespace orbweave
