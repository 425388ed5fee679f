// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// From pixels to a georeferenced model: a small rendered street through the real command.

#include <gmock/gmock.h>

#include "core/estimators/compare_poses.h"
#include "core/io/colmap/colmap_model.h"
#include "core/io/gnss/reference_poses.h"
#include "tests/jobs/corridor_job.h"

namespace orbweave::testing {
namespace {

PoseErrors ErrorsOf(const std::string& output, const std::string& truth_path) {
  const auto truth = ParseReferencePoses(ReadAll(truth_path), "truth.csv");
  const auto model = ReadColmapModel(output + "/sparse/0");
  EXPECT_TRUE(truth.ok() && model.ok());
  std::vector<Rigid3> estimated;
  std::vector<Rigid3> reference;
  for (const ColmapImage& image : model->images) {
    estimated.push_back(image.cam_from_world);
    reference.push_back(truth->at(image.name));
  }
  return ComparePoses(estimated, reference).value_or(PoseErrors{.position_rmse_m = 1e9});
}

TEST(StreetJob, RecoversTheRenderedStreet) {
  const TemporaryFolder folder;
  const CommandOutcome rendered = RunCommand({ORBWEAVE_BINARY,
                                              "synth",
                                              "street",
                                              "--panoramas",
                                              "16",
                                              "--size",
                                              "1024x512",
                                              "--output",
                                              folder / "street"});
  ASSERT_EQ(rendered.exit_code, 0) << rendered.err;
  const CommandOutcome run = RunCommand({ORBWEAVE_BINARY,
                                         "run",
                                         folder / "street/images",
                                         "--gnss",
                                         folder / "street/gnss.csv",
                                         "--masks",
                                         folder / "street/masks",
                                         "--output",
                                         folder / "model",
                                         "--set",
                                         "features.max_features=4000"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json report = ReportOf(folder / "model");
  EXPECT_EQ(report["registered"], 16) << report["not_registered"].dump();
  EXPECT_LT(report["residual_px_mean"], 0.5);
  EXPECT_TRUE(report["gnss"]["used"]) << report["gnss"].dump();
  const PoseErrors errors = ErrorsOf(folder / "model", folder / "street/truth.csv");
  EXPECT_LT(errors.position_rmse_m, 0.02);
  EXPECT_LT(errors.rotation_median_deg, 0.05);
  EXPECT_LT(errors.unaligned_rmse_m, 4.0);  // bias of 1 m, noise of 1.5 m on few positions
  for (const char* file : {"points.ply",
                           "cameras.csv",
                           "trajectory.geojson",
                           "georeference.json",
                           "report.html",
                           "trace.json",
                           "sparse/0/cameras.bin"}) {
    EXPECT_FALSE(ReadAll(folder / (std::string("model/") + file)).empty()) << file;
  }
}

/// Nobody says that they are far apart: the first pairs do.
TEST(StreetJob, TakesFacadeViewsOfPanoramasFarApartWithoutPositions) {
  const TemporaryFolder folder;
  const CommandOutcome rendered = RunCommand({ORBWEAVE_BINARY,
                                              "synth",
                                              "street",
                                              "--panoramas",
                                              "8",
                                              "--spacing",
                                              "14",
                                              "--size",
                                              "1024x512",
                                              "--output",
                                              folder / "street"});
  ASSERT_EQ(rendered.exit_code, 0) << rendered.err;
  std::vector<std::string> command = {ORBWEAVE_BINARY,
                                      "run",
                                      folder / "street/images",
                                      "--masks",
                                      folder / "street/masks",
                                      "--output",
                                      folder / "model"};
  const CommandOutcome run = RunCommand(command);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json report = ReportOf(folder / "model");
  EXPECT_TRUE(report["wider_pairs"]["facades"]) << report["wider_pairs"].dump();
  EXPECT_GT(report["pairs_by_rung"]["facades"], 7) << report["pairs_by_rung"].dump();
  EXPECT_EQ(report["registered"], 8) << report["not_registered"].dump();
  EXPECT_LT(ErrorsOf(folder / "model", folder / "street/truth.csv").position_rmse_m, 0.1);

  command.insert(command.end(), {"--set", "features.facades=off"});
  ASSERT_EQ(RunCommand(command).exit_code, 0);
  const nlohmann::json without = ReportOf(folder / "model");
  EXPECT_FALSE(without["wider_pairs"]["facades"]);
  EXPECT_EQ(without["pairs_by_rung"]["facades"], 0);
}

/// Numbers that other programs reach on the same images; see docs/benchmarks.md.
struct Sequence {
  const char* name;
  bool masks;
  int images;
  int points;
  double max_residual_px;
  double min_track_length;
};

class RealSequence : public ::testing::TestWithParam<Sequence> {};

TEST_P(RealSequence, IsRegisteredWholeInOneModel) {
  const Sequence& sequence = GetParam();
  const std::string data = std::string(ORBWEAVE_SOURCE_DIR) + "/../shared/data/" + sequence.name;
  if (!std::filesystem::is_directory(data)) GTEST_SKIP() << data << " is not here";
  const TemporaryFolder folder;
  std::vector<std::string> command = {
      ORBWEAVE_BINARY, "run", data + "/images", "--output", folder / "model"};
  if (sequence.masks) command.insert(command.end(), {"--masks", data + "/masks"});
  const CommandOutcome run = RunCommand(command);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json report = ReportOf(folder / "model");
  EXPECT_EQ(report["registered"], sequence.images) << report["not_registered"].dump();
  EXPECT_FALSE(std::filesystem::exists(folder / "model/sparse/1"));
  EXPECT_GE(report["points"], sequence.points);
  EXPECT_LE(report["residual_px_mean"], sequence.max_residual_px);
  EXPECT_GE(report["mean_track_length"], sequence.min_track_length);
}

INSTANTIATE_TEST_SUITE_P(SharedData,
                         RealSequence,
                         ::testing::Values(Sequence{"openmvg_flat360", false, 11, 7000, 0.73, 4.4},
                                           Sequence{"npr_towers", true, 30, 6700, 0.73, 4.4},
                                           Sequence{"npr_tram", true, 30, 5000, 0.73, 4.4}),
                         [](const auto& sequence) { return std::string(sequence.param.name); });

}  // namespace
}  // namespace orbweave::testing
