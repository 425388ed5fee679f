// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// Seams that the usual overlap does not hold together, clusters by hand, images placed by GNSS.

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/jobs/corridor_job.h"

namespace orbweave::testing {
namespace {

using ::testing::HasSubstr;

std::string MakeStreet(const TemporaryFolder& folder, const std::vector<std::string>& more) {
  std::vector<std::string> command = {
      ORBWEAVE_BINARY, "synth", "corridor", "--output", folder / "street"};
  command.insert(command.end(), more.begin(), more.end());
  const CommandOutcome made = RunCommand(command);
  EXPECT_EQ(made.exit_code, 0) << made.err;
  return folder / "street";
}

/// Four clusters. A tunnel that shows little splits the second, whose remainder beyond the tunnel
/// has too little in common with the third.
std::string MakeWeakStreet(const TemporaryFolder& folder) {
  return MakeStreet(folder,
                    {"--panoramas",
                     "80",
                     "--features-per-panorama",
                     "300",
                     "--tunnel-panoramas",
                     "24",
                     "--tunnel-features",
                     "36",
                     "--seed",
                     "6"});
}

std::string NameOf(uint32_t image) {
  const std::string number = std::to_string(image);
  return "pano_" + std::string(6 - number.size(), '0') + number + ".jpg";
}

/// Clusters of consecutive panoramas, so many each.
std::string ClustersByHand(const std::vector<uint32_t>& sizes) {
  std::string csv = "name,cluster\n";
  uint32_t image = 0;
  for (size_t cluster = 0; cluster < sizes.size(); ++cluster) {
    for (uint32_t i = 0; i < sizes[cluster]; ++i)
      csv += NameOf(image++) + ",cluster " + std::to_string(cluster) + "\n";
  }
  return csv;
}

/// Cuts the weak street where it is weak, with a small overlap.
std::vector<std::string> CutWeakly(const TemporaryFolder& folder) {
  WriteAll(folder / "clusters.csv", ClustersByHand({31, 16, 17, 16}));
  return {"--clusters", folder / "clusters.csv", "--set", "partition.overlap=2"};
}

CommandOutcome Reconstruct(const std::string& street,
                           const std::string& output,
                           const std::vector<std::string>& more) {
  std::vector<std::string> command = {ORBWEAVE_BINARY,
                                      "reconstruct",
                                      "--database",
                                      street + "/corridor.db",
                                      "--gnss",
                                      street + "/gnss.csv",
                                      "--output",
                                      output};
  command.insert(command.end(), more.begin(), more.end());
  return RunCommand(command);
}

/// Tasks of a stage in report.json.
int TasksOf(const nlohmann::json& report, const std::string& stage, const char* key) {
  for (const auto& row : report["stages"]) {
    if (row["name"] == stage) return row[key];
  }
  return -1;
}

/// Whether some submodels of clusters 1 and 2 hold together.
bool MiddleIsJoined(const nlohmann::json& report) {
  return std::ranges::any_of(report["seams"], [](const nlohmann::json& seam) {
    return seam["clusters"] == nlohmann::json{1, 2} && seam["used"] == true &&
           seam["verdict"] == "good";
  });
}

TEST(WeakSeam, AReviewJoinsWhatTheUsualOverlapLeavesApart) {
  const TemporaryFolder folder;
  const std::string street = MakeWeakStreet(folder);
  const std::vector<std::string> with = CutWeakly(folder);
  std::vector<std::string> without = with;
  without.insert(without.end(), {"--set", "partition.reviews=0"});
  ASSERT_EQ(Reconstruct(street, folder / "left", without).exit_code, 0);
  const nlohmann::json left = ReportOf(folder / "left");
  EXPECT_FALSE(MiddleIsJoined(left)) << left["seams"].dump(1);

  ASSERT_EQ(Reconstruct(street, folder / "mended", with).exit_code, 0);
  const nlohmann::json mended = ReportOf(folder / "mended");
  EXPECT_GT(left["models"], 1);
  EXPECT_EQ(mended["models"], 1) << mended["seams"].dump(1);
  EXPECT_EQ(mended["registered"], 80);
  EXPECT_THAT(mended["warnings"].dump(), HasSubstr("clusters 1 and 2 were reconstructed again"));
  // Two reviews of four clusters: twelve if all were made anew each time.
  const int computed = TasksOf(mended, "reconstruct_cluster", "tasks_computed");
  EXPECT_GT(computed, 4);
  EXPECT_LE(computed, 10) << "clusters got no more images";
}

TEST(WeakSeam, AReviewLeavesTheSameBytesForAnyNumberOfWorkersAndARestartComputesNothing) {
  const TemporaryFolder folder;
  const std::string street = MakeWeakStreet(folder);
  for (const char* workers : {"1", "3", "3"}) {
    std::vector<std::string> options = CutWeakly(folder);
    options.insert(options.end(), {"--workers", workers});
    const CommandOutcome run = Reconstruct(street, folder / workers, options);
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  ExpectSameModel(folder / "1", folder / "3");
  EXPECT_EQ(TasksOf(ReportOf(folder / "3"), "reconstruct_cluster", "tasks_computed"), 0);
}

TEST(LooseImages, ArePlacedByGnssWhereATunnelShowsNothing) {
  const TemporaryFolder folder;
  const std::string street = MakeStreet(
      folder, {"--panoramas", "60", "--tunnel-panoramas", "10", "--tunnel-features", "30"});
  ASSERT_EQ(Reconstruct(street, folder / "out", {}).exit_code, 0);
  ASSERT_EQ(
      Reconstruct(street, folder / "without", {"--set", "global.attach_loose=false"}).exit_code, 0);
  const nlohmann::json report = ReportOf(folder / "out");
  const int registered = report["registered"];
  EXPECT_LT(registered, 60);
  EXPECT_EQ(report["not_registered"].size(), static_cast<size_t>(60 - registered));
  EXPECT_THAT(report["warnings"].dump(), HasSubstr("placed loosely"));
  EXPECT_THAT(ReadAll(folder / "out/cameras.csv"), HasSubstr(",loose"));
  EXPECT_EQ(ReadAll(folder / "without/cameras.csv").find(",loose"), std::string::npos);
  EXPECT_EQ(ReportOf(folder / "without")["registered"], registered);
}

TEST(ClustersByHand, AreTakenInsteadOfAutomaticOnes) {
  const TemporaryFolder folder;
  WriteAll(folder / "clusters.csv", ClustersByHand({25, 35}));
  const CommandOutcome run =
      Reconstruct(CorridorFolder(), folder / "out", {"--clusters", folder / "clusters.csv"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json report = ReportOf(folder / "out");
  EXPECT_EQ(report["registered"], 60);
  ASSERT_EQ(report["clusters"].size(), 2U);
  EXPECT_EQ(report["clusters"][0]["interior"], 25);
  EXPECT_EQ(report["clusters"][1]["interior"], 35);
}

TEST(ClustersByHand, ThatForgetAnImageAreRefusedByName) {
  const TemporaryFolder folder;
  WriteAll(folder / "clusters.csv", ClustersByHand({25, 34}));
  const CommandOutcome run =
      Reconstruct(CorridorFolder(), folder / "out", {"--clusters", folder / "clusters.csv"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("pano_000059.jpg"));
}

}  // namespace
}  // namespace orbweave::testing
