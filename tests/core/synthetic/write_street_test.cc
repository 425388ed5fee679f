// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/write_street.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "core/synthetic/realistic_street.h"

namespace orbweave {
namespace {

namespace fs = std::filesystem;

/// Content by path below the folder.
std::map<std::string, std::string> FilesBelow(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream file(entry.path(), std::ios::binary);
    files[fs::relative(entry.path(), folder).string()] = {std::istreambuf_iterator<char>(file), {}};
  }
  return files;
}

class WriteStreetTest : public testing::Test {
 protected:
  ~WriteStreetTest() override { fs::remove_all(folder_); }

  std::map<std::string, std::string> Written(const std::string& name, int num_threads) {
    const fs::path output = folder_ / name;
    const StreetOptions options{.panoramas = 5, .width_px = 96, .gnss_gap_share = 0.3};
    EXPECT_TRUE(WriteStreet(options, output.string(), {.num_threads = num_threads}).ok());
    return FilesBelow(output);
  }

  const fs::path folder_ = fs::path(testing::TempDir()) /
                           (std::string("write_street_") +
                            testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(WriteStreetTest, WritesTheSameBytesOnAnyNumberOfThreads) {
  const auto one = Written("one", 1);
  const auto three = Written("three", 3);
  EXPECT_EQ(one.size(), 5U + 5U + 4U);
  EXPECT_TRUE(one == three);
}

TEST_F(WriteStreetTest, RealisticStreetsAreTheSameForTheSameSeedOnAnyNumberOfThreads) {
  std::map<std::string, std::string> files[3];
  for (const int k : {0, 1, 2}) {
    const StreetOptions options =
        RealisticStreet({.panoramas = 7, .width_px = 96, .seed = k == 2 ? 6 : 5});
    const fs::path output = folder_ / std::to_string(k);
    ASSERT_TRUE(WriteStreet(options, output.string(), {.num_threads = 1 + 2 * k}).ok());
    files[k] = FilesBelow(output);
  }
  EXPECT_TRUE(files[0] == files[1]);
  EXPECT_TRUE(files[0]["images/street_0003.jpg"] != files[2]["images/street_0003.jpg"]);
  const std::string& gnss = files[0]["gnss.csv"];
  EXPECT_EQ(gnss.substr(0, gnss.find('\n')),
            "name,latitude,longitude,altitude,accuracy,heading,time,drive");
  EXPECT_NE(gnss.find(",day1\n"), std::string::npos);
}

TEST_F(WriteStreetTest, JpegQualityChangesImagesAlone) {
  std::map<std::string, std::string> files[2];
  for (const int k : {0, 1}) {
    const StreetOptions options{
        .panoramas = 2, .width_px = 96, .hardships = {.jpeg_quality = k == 0 ? 95 : 40}};
    const fs::path output = folder_ / std::to_string(k);
    ASSERT_TRUE(WriteStreet(options, output.string(), {}).ok());
    files[k] = FilesBelow(output);
  }
  for (const auto& [path, bytes] : files[0]) {
    if (path.starts_with("images/")) {
      EXPECT_LT(files[1][path].size(), 0.7 * static_cast<double>(bytes.size()));
    } else {
      EXPECT_TRUE(files[1][path] == bytes) << path;
    }
  }
}

TEST_F(WriteStreetTest, TablesNameEveryImageButThoseInTheGap) {
  auto files = Written("tables", 1);
  for (int i = 0; i < 5; ++i) {
    const std::string name = "street_000" + std::to_string(i);
    EXPECT_TRUE(files.contains("images/" + name + ".jpg"));
    EXPECT_TRUE(files.contains("masks/" + name + ".png"));
    EXPECT_NE(files["truth.csv"].find(name + ".jpg,"), std::string::npos);
  }
  const std::string& gnss = files["gnss.csv"];
  EXPECT_EQ(std::count(gnss.begin(), gnss.end(), '\n'), 1 + 4);
  EXPECT_EQ(gnss.substr(0, gnss.find('\n')), "name,latitude,longitude,altitude,accuracy,heading");
}

TEST_F(WriteStreetTest, RefusesOptionsOutOfRangeAndFoldersThatCannotBe) {
  EXPECT_EQ(WriteStreet({.panoramas = 0}, folder_.string(), {}).code(),
            absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(WriteStreet({.hardships = {.jpeg_quality = 101}}, folder_.string(), {}).code(),
            absl::StatusCode::kInvalidArgument);
  fs::create_directories(folder_);
  std::ofstream(folder_ / "file") << "in the way";
  EXPECT_EQ(WriteStreet({.panoramas = 1, .width_px = 64}, (folder_ / "file").string(), {}).code(),
            absl::StatusCode::kUnavailable);
}

TEST_F(WriteStreetTest, StopsOnRequestWithoutClaimingToBeComplete) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(
      WriteStreet({.panoramas = 2, .width_px = 64}, folder_.string(), {.stop = stop.get_token()})
          .code(),
      absl::StatusCode::kCancelled);
  EXPECT_FALSE(fs::exists(folder_ / "truth.csv"));
}

}  // namespace
}  // namespace orbweave
