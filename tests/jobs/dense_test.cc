// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// The dense line as users run it: on a small rendered street, with real processes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "core/io/text_fields.h"
#include "tests/jobs/corridor_job.h"

namespace orbweave::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

CommandOutcome Orbweave(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), ORBWEAVE_BINARY);
  return RunCommand(arguments);
}

/// All files of a cloud but for its reports, which have times, and the job's own.
std::map<std::string, std::string> FilesOf(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = fs::relative(entry.path(), folder).string();
    const bool is_left_out = name.starts_with(".orbweave") || name.starts_with("report.");
    if (entry.is_regular_file() && !is_left_out) files[name] = ReadAll(entry.path().string());
  }
  return files;
}

nlohmann::json DenseReportOf(const std::string& folder) {
  return nlohmann::json::parse(ReadAll(folder + "/report.json"));
}

class DenseTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    const CommandOutcome street = Orbweave({"synth",
                                            "street",
                                            "--panoramas",
                                            "8",
                                            "--size",
                                            "512x256",
                                            "--output",
                                            *folder_ / "street"});
    ASSERT_EQ(street.exit_code, 0) << street.err;
    const CommandOutcome run = Orbweave({"run",
                                         *folder_ / "street/images",
                                         "--gnss",
                                         *folder_ / "street/gnss.csv",
                                         "--masks",
                                         *folder_ / "street/masks",
                                         "--output",
                                         *folder_ / "model",
                                         "--dense",
                                         "--workers",
                                         "2"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    said_ = run.out;
  }
  static void TearDownTestSuite() { delete folder_; }

  static TemporaryFolder* folder_;
  static std::string said_;  ///< by the run that made model and cloud
};

TemporaryFolder* DenseTest::folder_ = nullptr;
std::string DenseTest::said_;

/// What stands behind the summary of the cloud.
std::string AfterTheCloud(const std::string& said) {
  const std::string last_of_cloud = "tiles/*.ply, from_above.png\n";
  const size_t at = said.find(last_of_cloud);
  return at == std::string::npos ? "" : said.substr(at + last_of_cloud.size());
}

TEST_F(DenseTest, SaysTheVerdictOnTheModelLast) {
  const std::string level = ReportOf(*folder_ / "model")["verdict"]["level"];
  EXPECT_THAT(AfterTheCloud(said_), HasSubstr("  verdict     " + level + "\n")) << said_;
}

TEST_F(DenseTest, WritesTheCloudOfAModelThatIsDoubtedAndThenFails) {
  // Positions that nobody took.
  const std::string right = ReadAll(*folder_ / "street/gnss.csv");
  std::string table;
  int row = 0;
  for (const std::string_view line : SplitLines(right)) {
    std::vector<std::string> cells = SplitFields(line, ',');
    if (row > 0) cells[1] = std::to_string(NumberFromText(cells[1]).value() + row % 3 * 1e-3);
    ++row;
    for (size_t i = 0; i < cells.size(); ++i) table += (i > 0 ? "," : "") + cells[i];
    table += "\n";
  }
  WriteAll(*folder_ / "wrong.csv", table);
  const std::string copy = *folder_ / "doubted";
  fs::copy(*folder_ / "model", copy, fs::copy_options::recursive);
  fs::remove_all(copy + "/dense");
  const CommandOutcome run = Orbweave({"run",
                                       *folder_ / "street/images",
                                       "--gnss",
                                       *folder_ / "wrong.csv",
                                       "--masks",
                                       *folder_ / "street/masks",
                                       "--output",
                                       copy,
                                       "--dense",
                                       "--fail-on",
                                       "doubtful",
                                       "--workers",
                                       "2"});
  EXPECT_EQ(run.exit_code, 4) << run.out << run.err;
  EXPECT_TRUE(fs::exists(copy + "/dense/cloud.las"));
  const std::string level = ReportOf(copy)["verdict"]["level"];
  EXPECT_THAT(AfterTheCloud(run.out), HasSubstr("  verdict     " + level + "\n")) << run.out;
  EXPECT_THAT(run.err, HasSubstr("judged " + level));
}

TEST_F(DenseTest, LeavesOneCloudInTilesAndItsReport) {
  const std::string cloud = *folder_ / "model/dense";
  const nlohmann::json report = DenseReportOf(cloud);
  EXPECT_GT(report["points"], 10000) << report.dump(1);
  EXPECT_EQ(report["panoramas"], 8);
  uint64_t points = 0;
  for (const auto& tile : report["tiles"]) {
    points += tile["points"].get<uint64_t>();
    EXPECT_TRUE(fs::exists(fs::path(cloud) / tile["file"].get<std::string>()));
  }
  EXPECT_EQ(points, report["points"].get<uint64_t>());
  const std::string las = ReadAll(cloud + "/cloud.las");
  EXPECT_EQ(las.substr(0, 4), "LASF");
  EXPECT_THAT(las.substr(0, 4000), HasSubstr("UTM zone"));
}

TEST_F(DenseTest, LeavesPicturesOfTheCloudAndOfDepthMaps) {
  const std::string cloud = *folder_ / "model/dense";
  EXPECT_EQ(ReadAll(cloud + "/from_above.png").substr(1, 3), "PNG");
  EXPECT_FALSE(ReadAll(cloud + "/from_above.pgw").empty());
  EXPECT_THAT(ReadAll(cloud + "/from_above.png.aux.xml"), HasSubstr("UTM zone"));
  const std::string page = ReadAll(cloud + "/report.html");
  EXPECT_THAT(page, HasSubstr("street_0000.jpg"));
  EXPECT_THAT(page, HasSubstr("data:image/jpeg;base64,"));
}

TEST_F(DenseTest, CutsTilesIntoPiecesWithTheSamePoints) {
  const std::string copy = *folder_ / "pieces";
  fs::copy(*folder_ / "model", copy, fs::copy_options::recursive);
  const CommandOutcome dense =
      Orbweave({"dense", copy, "--set", "tiles.max_points=5000", "--workers", "2"});
  ASSERT_EQ(dense.exit_code, 0) << dense.err;
  const nlohmann::json whole = DenseReportOf(*folder_ / "model/dense");
  const nlohmann::json cut = DenseReportOf(copy + "/dense");
  EXPECT_EQ(cut["points"], whole["points"]);
  EXPECT_EQ(cut["points_by_sigma"], whole["points_by_sigma"]);
  EXPECT_GT(cut["tiles"].size(), whole["tiles"].size());
  for (const auto& stage : cut["stages"]) {
    if (stage["name"] != "fuse_panorama") continue;
    EXPECT_EQ(stage["tasks_computed"], 0);
  }
  EXPECT_EQ(ReadAll(copy + "/dense/from_above.png"),
            ReadAll(*folder_ / "model/dense/from_above.png"));
}

TEST_F(DenseTest, RefusesOptionsThatCannotWorkTogether) {
  const std::vector<std::string> wrong = {
      "--set", "sources.min_angle_deg=20", "--set", "sources.max_angle_deg=10"};
  const std::vector<std::vector<std::string>> commands = {{"dense", *folder_ / "model"},
                                                          {"dense",
                                                           "--colmap",
                                                           *folder_ / "model/sparse/0",
                                                           "--images",
                                                           *folder_ / "street/images",
                                                           "--output",
                                                           *folder_ / "refused"}};
  for (std::vector<std::string> command : commands) {
    command.insert(command.end(), wrong.begin(), wrong.end());
    const CommandOutcome dense = Orbweave(command);
    EXPECT_EQ(dense.exit_code, 2) << command[1];
    EXPECT_THAT(dense.err, HasSubstr("sources.max_angle_deg=10"));
  }
}

TEST_F(DenseTest, OneAndThreeWorkersWriteTheSameBytes) {
  const auto before = FilesOf(*folder_ / "model/dense");
  for (const std::string workers : {"1", "3"}) {
    const std::string copy = *folder_ / ("copy" + workers);
    const CommandOutcome dense = Orbweave({"dense",
                                           "--colmap",
                                           *folder_ / "model/sparse/0",
                                           "--images",
                                           *folder_ / "street/images",
                                           "--masks",
                                           *folder_ / "street/masks",
                                           "--output",
                                           copy,
                                           "--workers",
                                           workers});
    ASSERT_EQ(dense.exit_code, 0) << dense.err;
  }
  const auto one = FilesOf(*folder_ / "copy1");
  EXPECT_GT(one.size(), 2U);
  EXPECT_TRUE(one == FilesOf(*folder_ / "copy3"));
  // A second run computes nothing and changes nothing.
  const CommandOutcome again = Orbweave({"dense", *folder_ / "model", "--workers", "1"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_TRUE(FilesOf(*folder_ / "model/dense") == before);
}

TEST_F(DenseTest, KilledAgainAndAgainItGoesOnToTheSameBytes) {
  const auto command_to = [](const std::string& output) {
    return std::vector<std::string>{ORBWEAVE_BINARY,
                                    "dense",
                                    "--colmap",
                                    *folder_ / "model/sparse/0",
                                    "--images",
                                    *folder_ / "street/images",
                                    "--output",
                                    output,
                                    "--workers",
                                    "2"};
  };
  const std::string expected = *folder_ / "undisturbed";
  ASSERT_EQ(RunCommand(command_to(expected)).exit_code, 0);
  const std::string output = *folder_ / "killed";
  int kills = 0;
  for (const size_t finished : {2, 8, 15, 22}) {  // views, depths, checks, fusions
    Command run(command_to(output));
    ASSERT_TRUE(WaitUntil([&] { return FinishedTasks(output) >= finished; }, 60)) << run.ErrSoFar();
    run.Signal(SIGKILL);
    kills += run.Wait().exit_code == 128 + SIGKILL ? 1 : 0;
  }
  EXPECT_GE(kills, 3);
  const CommandOutcome end = RunCommand(command_to(output));
  ASSERT_EQ(end.exit_code, 0) << end.err;
  const auto undisturbed = FilesOf(expected);
  EXPECT_GT(undisturbed.size(), 2U);
  EXPECT_TRUE(undisturbed == FilesOf(output));
}

TEST_F(DenseTest, GoesOnWithoutAPictureAndNamesIt) {
  const std::string images = *folder_ / "some";
  fs::create_directories(images);
  for (int i = 1; i < 8; ++i) {
    const std::string name = "street_000" + std::to_string(i) + ".jpg";
    fs::copy_file(*folder_ / ("street/images/" + name), images + "/" + name);
  }
  const CommandOutcome dense = Orbweave({"dense",
                                         "--colmap",
                                         *folder_ / "model/sparse/0",
                                         "--images",
                                         images,
                                         "--output",
                                         *folder_ / "cloud_of_some"});
  ASSERT_EQ(dense.exit_code, 0) << dense.err;
  const nlohmann::json report = DenseReportOf(*folder_ / "cloud_of_some");
  EXPECT_GT(report["points"], 5000);
  EXPECT_THAT(report["without_depth"].dump(), HasSubstr("street_0000.jpg"));
}

TEST_F(DenseTest, StopsOnAFullDiskAndGoesOnWhenThereIsRoom) {
  const std::string copy = *folder_ / "full";
  fs::copy(*folder_ / "model", copy, fs::copy_options::recursive);
  const auto expected = FilesOf(copy + "/dense");
  fs::remove_all(copy + "/dense");
  fs::create_directories(copy + "/dense");
  // A file is written under another name first, which ends in the process: `exec` keeps it.
  const CommandOutcome full = RunCommand({"/bin/sh",
                                          "-c",
                                          "ln -s /dev/full \"$0/dense/cloud.las.tmp$$\" && "
                                          "exec \"$1\" dense \"$0\"",
                                          copy,
                                          ORBWEAVE_BINARY});
  EXPECT_EQ(full.exit_code, 1) << full.err;
  EXPECT_THAT(full.err, HasSubstr("disk full"));
  EXPECT_FALSE(fs::exists(copy + "/dense/cloud.las"));
  const CommandOutcome again = Orbweave({"dense", copy});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_TRUE(FilesOf(copy + "/dense") == expected);
  for (const auto& stage : DenseReportOf(copy + "/dense")["stages"])
    EXPECT_EQ(stage["tasks_computed"], 0) << stage["name"];
}

TEST_F(DenseTest, BenchTellsTimesAndThatCloudsAreTheSame) {
  const std::string output = *folder_ / "bench";
  const CommandOutcome bench = Orbweave({"bench",
                                         "dense",
                                         "--panoramas",
                                         "4",
                                         "--width",
                                         "512",
                                         "--workers",
                                         "1,2",
                                         "--output",
                                         output});
  ASSERT_EQ(bench.exit_code, 0) << bench.err;
  EXPECT_THAT(bench.out, HasSubstr("| estimate_depths | 4 |"));
  EXPECT_THAT(bench.out, HasSubstr("within  5 cm"));
  const auto json = nlohmann::json::parse(ReadAll(output + "/dense.json"));
  ASSERT_EQ(json["runs"].size(), 2U);
  EXPECT_EQ(json["runs"][0]["cloud"], json["runs"][1]["cloud"]);
  EXPECT_GT(json["runs"][0]["points"], 1000);
  EXPECT_FALSE(fs::exists(output + "/.scratch"));
}

TEST_F(DenseTest, SaysWhatIsWrongWithItsArguments) {
  EXPECT_THAT(Orbweave({"dense"}).err, HasSubstr("--colmap"));
  EXPECT_EQ(Orbweave({"dense", *folder_ / "street"}).exit_code, 2);
  const std::string strangers = *folder_ / "strangers";
  fs::create_directories(strangers);
  fs::copy_file(*folder_ / "street/images/street_0003.jpg", strangers + "/somewhere.jpg");
  const CommandOutcome other = Orbweave({"dense",
                                         "--colmap",
                                         *folder_ / "model/sparse/0",
                                         "--images",
                                         strangers,
                                         "--output",
                                         *folder_ / "none"});
  EXPECT_EQ(other.exit_code, 2) << other.err;
  EXPECT_THAT(other.err, HasSubstr("somewhere.jpg"));
}

}  // namespace
}  // namespace orbweave::testing
