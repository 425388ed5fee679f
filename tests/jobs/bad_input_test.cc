// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// What people really feed to programs. Every case ends with a message that names the thing and an
// exit code that says so; where anything usable is left, the rest of the job goes on.

#include <gmock/gmock.h>
#include <sqlite3.h>
#include <unistd.h>

#include <opencv2/imgproc.hpp>

#include "core/base/random.h"
#include "tests/core/pictures/encoded_images.h"
#include "tests/jobs/corridor_job.h"

namespace orbweave::testing {
namespace {

using ::testing::HasSubstr;

/// A panorama with enough texture for features; equal seeds give equal pictures.
cv::Mat Texture(int width, int height, uint64_t seed) {
  Random random(seed);
  cv::Mat image(height, width, CV_8UC3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width * 3; ++x)
      image.at<uint8_t>(y, x) = static_cast<uint8_t>(random.Index(256));
  }
  cv::GaussianBlur(image, image, cv::Size(), 3.0);
  cv::normalize(image, image, 0, 255, cv::NORM_MINMAX);
  return image;
}

std::string Jpeg(int width, int height, uint64_t seed) {
  return Encoded(Texture(width, height, seed), ".jpg");
}

CommandOutcome RunImages(const TemporaryFolder& folder, const std::vector<std::string>& more = {}) {
  std::vector<std::string> command = {
      ORBWEAVE_BINARY, "run", folder / "images", "--output", folder / "out", "--workers", "1"};
  command.insert(command.end(), more.begin(), more.end());
  return RunCommand(command);
}

std::string ReasonFor(const nlohmann::json& report, const std::string& name) {
  for (const auto& entry : report["not_registered"]) {
    if (entry["name"] == name) return entry["reason"];
  }
  return "";
}

/// Unrelated textures: enough for the job to go on, nothing to reconstruct.
void WriteGoodImages(const TemporaryFolder& folder) {
  WriteAll(folder / "images/good_1.jpg", Jpeg(512, 256, 1));
  WriteAll(folder / "images/good_2.jpg", Jpeg(512, 256, 2));
  WriteAll(folder / "images/good_3.jpg", Jpeg(512, 256, 3));
}

TEST(BadInput, BadImagesAreLeftOutByNameAndTheRestGoesOn) {
  const TemporaryFolder folder;
  WriteGoodImages(folder);
  const std::string good = ReadAll(folder / "images/good_1.jpg");
  WriteAll(folder / "images/copy.jpg", good);
  WriteAll(folder / "images/text.jpg", "this is a text file\n");
  WriteAll(folder / "images/square.jpg", Jpeg(256, 256, 4));
  const std::string other = Jpeg(512, 256, 5);
  WriteAll(folder / "images/truncated.jpg", other.substr(0, other.size() / 2));
  WriteAll(folder / "images/empty.jpg", "");
  WriteAll(folder / "images/smaller.jpg", Jpeg(256, 128, 6));
  const CommandOutcome run = RunImages(folder);
  const nlohmann::json report = ReportOf(folder / "out");
  ASSERT_TRUE(report.is_object()) << run.err;
  EXPECT_EQ(report["images_total"], 9);
  EXPECT_THAT(ReasonFor(report, "good_1.jpg") + ReasonFor(report, "copy.jpg"),
              HasSubstr("copy of"));
  EXPECT_THAT(ReasonFor(report, "text.jpg"), HasSubstr("image"));
  EXPECT_THAT(ReasonFor(report, "square.jpg"), HasSubstr("2:1"));
  EXPECT_THAT(ReasonFor(report, "truncated.jpg"), HasSubstr("truncated"));
  EXPECT_NE(ReasonFor(report, "empty.jpg"), "");
  EXPECT_THAT(ReasonFor(report, "smaller.jpg"), ::testing::Not(HasSubstr("size")));
  // Unrelated textures: nothing can be registered, and the exit code says so.
  EXPECT_EQ(report["registered"], 0);
  EXPECT_EQ(run.exit_code, 1);
}

/// What a run of these images says that ends with nothing, and names no fault of its own.
std::string VerdictOf(const std::map<std::string, std::string>& images) {
  const TemporaryFolder folder;
  for (const auto& [name, bytes] : images) WriteAll(folder / ("images/" + name), bytes);
  const CommandOutcome run = RunImages(folder);
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_EQ(ReportOf(folder / "out")["verdict"]["level"], "bad");
  return run.out + run.err;
}

TEST(BadInput, TooLittleToReconstructEndsWithWhatIsMissing) {
  const std::string panorama = Jpeg(512, 256, 1);
  EXPECT_THAT(VerdictOf({{"one.jpg", panorama}}), HasSubstr("one.jpg: no verified matches"));
  EXPECT_THAT(VerdictOf({{"a.jpg", panorama}, {"b.jpg", panorama}, {"c.jpg", panorama}}),
              HasSubstr("2 images: it is byte for byte a copy of a.jpg"));
}

TEST(BadInput, WhatRegistersNothingIsBadToWhoAsksForTheVerdict) {
  const TemporaryFolder folder;
  WriteAll(folder / "images/one.jpg", Jpeg(512, 256, 1));
  for (const char* level : {"doubtful", "bad"}) {
    const CommandOutcome run = RunImages(folder, {"--fail-on", level, "--dense"});
    EXPECT_EQ(run.exit_code, 4) << run.err;
    EXPECT_THAT(run.err, HasSubstr("judged bad"));
  }
  EXPECT_EQ(ReportOf(folder / "out")["registered"], 0);
}

TEST(BadInput, TinyPicturesAreNoReasonToFail) {
  std::map<std::string, std::string> tiny;
  for (int i = 0; i < 4; ++i) {
    tiny["tiny_" + std::to_string(i) + ".png"] =
        Encoded(cv::Mat(1, 2, CV_8UC3, cv::Scalar(40 * i, 7 * i, 90)), ".png");
  }
  EXPECT_THAT(VerdictOf(tiny), HasSubstr("4 images: no verified matches"));
}

/// A job of three images that waits for its first worker.
class WaitingJob : public ::testing::Test {
 protected:
  WaitingJob() {
    WriteGoodImages(folder_);
    run_.emplace(std::vector<std::string>{ORBWEAVE_BINARY,
                                          "run",
                                          folder_ / "images",
                                          "--output",
                                          folder_ / "out",
                                          "--workers",
                                          "0",
                                          "--listen",
                                          "unix:" + (folder_ / "s"),
                                          "--announce",
                                          folder_ / "c.json"});
    EXPECT_TRUE(WaitUntil([this] { return IsSubmitted(); }, 30.0)) << run_->ErrSoFar();
  }
  /// How it ends once somebody works.
  CommandOutcome End() {
    Command worker({ORBWEAVE_BINARY, "work", "--join", "@" + (folder_ / "c.json")});
    const CommandOutcome outcome = run_->Wait();
    worker.Wait();
    return outcome;
  }

  TemporaryFolder folder_;
  std::string changed_ = folder_ / "images/good_2.jpg";

 private:
  bool IsSubmitted() {
    const CommandOutcome status =
        RunCommand({ORBWEAVE_BINARY, "status", "--coordinator", "@" + (folder_ / "c.json")});
    return status.out.find("running") != std::string::npos;
  }
  std::optional<Command> run_;
};

TEST_F(WaitingJob, NamesAnImageThatWasChangedMeanwhile) {
  WriteAll(changed_, Jpeg(512, 256, 7));
  const CommandOutcome run = End();
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr(changed_ + " was changed after the job was submitted"));
  const CommandOutcome again = RunImages(folder_);
  EXPECT_EQ(ReportOf(folder_ / "out")["images_total"], 3) << again.err;
}

TEST_F(WaitingJob, NamesAnImageThatWasRemovedMeanwhile) {
  std::filesystem::remove(changed_);
  const CommandOutcome run = End();
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr(changed_ + ", which is gone"));
}

TEST(BadInput, AnEmptyFolderIsRefused) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "images");
  const CommandOutcome run = RunImages(folder);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("images"));
}

TEST(BadInput, AMissingFolderIsRefused) {
  const TemporaryFolder folder;
  const CommandOutcome run = RunImages(folder);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr(folder / "images"));
}

TEST(BadInput, AFolderOfUselessFilesFailsWithTheReasons) {
  const TemporaryFolder folder;
  WriteAll(folder / "images/text.jpg", "this is a text file\n");
  const CommandOutcome run = RunImages(folder);
  EXPECT_NE(run.exit_code, 0);
  EXPECT_THAT(run.err, HasSubstr("text.jpg"));
}

TEST(BadInput, AMaskOfAnotherShapeIsWarnedOfAndNotUsed) {
  const TemporaryFolder folder;
  WriteGoodImages(folder);
  WriteAll(folder / "masks/good_2.png", Encoded(cv::Mat::zeros(100, 128, CV_8UC1), ".png"));
  const CommandOutcome run = RunImages(folder, {"--masks", folder / "masks"});
  EXPECT_THAT(ReportOf(folder / "out")["warnings"].dump(), HasSubstr("good_2")) << run.err;
}

TEST(BadInput, GnssRowsThatFitNoImageAreWarnedOf) {
  const TemporaryFolder folder;
  WriteGoodImages(folder);
  WriteAll(folder / "gnss.csv",
           "name,latitude,longitude,altitude\ngood_1.jpg,47.5,8.5,400\nnobody.jpg,47.5,8.5,400\n");
  const CommandOutcome run = RunImages(folder, {"--gnss", folder / "gnss.csv"});
  const std::string warnings = ReportOf(folder / "out")["warnings"].dump();
  EXPECT_THAT(warnings, HasSubstr("nobody.jpg")) << run.err;
  EXPECT_THAT(warnings, HasSubstr("good_2.jpg"));
}

TEST(BadInput, SwappedLatitudeAndLongitudeAreRefused) {
  const TemporaryFolder folder;
  WriteGoodImages(folder);
  WriteAll(
      folder / "gnss.csv",
      "name,latitude,longitude,altitude\ngood_1.jpg,-122.4,37.5,10\ngood_2.jpg,-122.4,37.5,10\n");
  const CommandOutcome run = RunImages(folder, {"--gnss", folder / "gnss.csv"});
  EXPECT_NE(run.exit_code, 0);
  EXPECT_THAT(run.err, HasSubstr("swapped"));
}

TEST(BadInput, AMisspeltOptionNamesTheNearest) {
  const TemporaryFolder folder;
  WriteGoodImages(folder);
  const CommandOutcome run = RunImages(folder, {"--set", "mapping.min_inlier=20"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("mapping.min_inliers"));
}

TEST(BadInput, AnOptionOutOfRangeIsRefused) {
  const TemporaryFolder folder;
  WriteGoodImages(folder);
  const CommandOutcome run = RunImages(folder, {"--set", "matching.max_ratio=7"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("[0.1, 1]"));
}

/// Three images in clusters of two at most.
const std::vector<std::string> kCeresInClusters = {
    "--set", "bundle.solver=ceres", "--set", "partition.cluster_size=2"};

TEST(BadInput, OptionsThatCannotWorkTogetherAreRefusedByRun) {
  const TemporaryFolder folder;
  WriteGoodImages(folder);
  const CommandOutcome run = RunImages(folder, kCeresInClusters);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("add partition.cluster_size=0, or leave out bundle.solver=ceres"));
  const CommandOutcome dense = RunImages(folder, {"--dense", "--set", "sources.near_m=50"});
  EXPECT_EQ(dense.exit_code, 2);
  EXPECT_THAT(dense.err, HasSubstr("sources.far_m"));
}

TEST(BadInput, OptionsThatCannotWorkTogetherAreRefusedBySubmit) {
  const TemporaryFolder folder;
  WriteGoodImages(folder);
  const std::string address = "unix:" + (folder / "s");
  Command serve({ORBWEAVE_BINARY, "serve", "--listen", address, "--state", folder / "state"});
  ASSERT_TRUE(WaitUntil([&] { return serve.ErrSoFar().find("ready") != std::string::npos; }, 60.0));
  std::vector<std::string> submit = {
      ORBWEAVE_BINARY, "submit", "--coordinator", address, folder / "images"};
  submit.insert(submit.end(), kCeresInClusters.begin(), kCeresInClusters.end());
  const CommandOutcome outcome = RunCommand(submit);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err,
              HasSubstr("add partition.cluster_size=0, or leave out bundle.solver=ceres"));
  EXPECT_EQ(outcome.out, "");
  serve.Signal(SIGTERM);
  serve.Wait();
}

TEST(BadInput, AnOutputThatCannotBeWrittenIsRefusedBeforeAnyWork) {
  const TemporaryFolder folder;
  WriteGoodImages(folder);
  WriteAll(folder / "out", "a file where the folder should be");
  const CommandOutcome run = RunImages(folder);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("out"));
}

TEST(BadInput, ADatabaseThatIsNoneIsRefused) {
  const TemporaryFolder folder;
  WriteAll(folder / "x.db", "not a database at all");
  const CommandOutcome run = RunCommand(
      {ORBWEAVE_BINARY, "reconstruct", "--database", folder / "x.db", "--output", folder / "out"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("x.db"));
}

/// A copy of the corridor's database with one statement run on it.
CommandOutcome ReconstructEdited(const TemporaryFolder& folder, const std::string& sql) {
  std::filesystem::copy_file(CorridorFolder() + "/corridor.db", folder / "edited.db");
  sqlite3* database = nullptr;
  EXPECT_EQ(sqlite3_open((folder / "edited.db").c_str(), &database), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(database);
  return RunCommand({ORBWEAVE_BINARY,
                     "reconstruct",
                     "--database",
                     folder / "edited.db",
                     "--output",
                     folder / "out"});
}

TEST(BadInput, ADatabaseWithoutMatchesIsRefused) {
  const TemporaryFolder folder;
  const CommandOutcome run =
      ReconstructEdited(folder, "DELETE FROM matches; DELETE FROM two_view_geometries;");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("no matches"));
}

TEST(BadInput, ADatabaseWithAPinholeCameraIsRefused) {
  const TemporaryFolder folder;
  const CommandOutcome run = ReconstructEdited(folder, "UPDATE cameras SET model = 1;");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("PINHOLE"));
}

TEST(BadInput, ATraceparentThatIsNoneIsRefusedBeforeAnythingIsSent) {
  const CommandOutcome outcome = RunCommand({ORBWEAVE_BINARY,
                                             "submit",
                                             "--coordinator",
                                             "unix:/nobody",
                                             "--traceparent",
                                             "00-trace",
                                             "images"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("'00-trace' is no traceparent"));
}

TEST(BadInput, AListenerBeyondThisMachineIsRefused) {
  const TemporaryFolder folder;
  const CommandOutcome run =
      RunCommand({ORBWEAVE_BINARY, "serve", "--listen", "0.0.0.0:0", "--state", folder / "state"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("TLS"));
}

TEST(BadInput, AFullDiskStopsWithAMessageAndResumesWhenThereIsRoom) {
  const TemporaryFolder folder;
  const std::string disk = folder / "disk";
  std::filesystem::create_directories(disk);
  if (geteuid() != 0 ||
      RunCommand({"/bin/mount", "-t", "tmpfs", "-o", "size=2m", "none", disk}).exit_code != 0) {
    GTEST_SKIP() << "a small disk can be mounted by root alone";
  }
  const CommandOutcome full = RunCommand(ReconstructCorridor(disk + "/out", 1));
  EXPECT_NE(full.exit_code, 0);
  EXPECT_THAT(full.err, HasSubstr("disk"));
  EXPECT_EQ(RunCommand({"/bin/mount", "-o", "remount,size=400m", disk}).exit_code, 0);
  const CommandOutcome again = RunCommand(ReconstructCorridor(disk + "/out", 1));
  EXPECT_EQ(again.exit_code, 0) << again.err;
  RunCommand({"/bin/umount", disk});
}

}  // namespace
}  // namespace orbweave::testing
