// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// `orbweave inspect` on jobs from images and from a database.

#include <gmock/gmock.h>

#include <opencv2/imgcodecs.hpp>

#include "tests/jobs/corridor_job.h"

namespace orbweave::testing {
namespace {

using ::testing::HasSubstr;

CommandOutcome Inspect(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {ORBWEAVE_BINARY, "inspect"});
  return RunCommand(arguments);
}

TEST(Inspect, ShowsPairsAndImagesOfADatabaseJob) {
  const TemporaryFolder folder;
  const std::string model = folder / "model";
  ASSERT_EQ(RunCommand(ReconstructCorridor(model, 2)).exit_code, 0);

  const CommandOutcome pair = Inspect({model, "--pair", "4", "2"});
  EXPECT_EQ(pair.exit_code, 0) << pair.err;
  EXPECT_THAT(pair.out, HasSubstr("verified, general"));
  EXPECT_THAT(pair.out, HasSubstr("view graph used"));
  EXPECT_THAT(pair.out, HasSubstr("holds both"));
  const cv::Mat picture =
      cv::imread(model + "/inspect/pano_000004--pano_000002.png", cv::IMREAD_COLOR);
  EXPECT_EQ(picture.cols, 2048);

  const CommandOutcome far = Inspect({model, "--pair", "0", "59", "--output", folder / "far.png"});
  EXPECT_EQ(far.exit_code, 0) << far.err;
  EXPECT_THAT(far.out, HasSubstr("the database has no matches of it"));
  EXPECT_TRUE(std::filesystem::exists(folder / "far.png"));

  const CommandOutcome image = Inspect({model, "--image", "pano_000004"});
  EXPECT_EQ(image.exit_code, 0) << image.err;
  EXPECT_THAT(image.out, HasSubstr("registered in model 0"));
  EXPECT_THAT(image.out, HasSubstr("pano_000003.jpg"));
  EXPECT_TRUE(std::filesystem::exists(model + "/inspect/pano_000004.png"));

  // Looking changes nothing: the job is taken as it is.
  EXPECT_EQ(Inspect({model, "--image", "4"}).out, image.out);
}

TEST(Inspect, MatchesWhatAJobOfImagesDidNotTry) {
  const TemporaryFolder folder;
  ASSERT_EQ(RunCommand({ORBWEAVE_BINARY,
                        "synth",
                        "street",
                        "--panoramas",
                        "6",
                        "--size",
                        "512x256",
                        "--output",
                        folder / "street"})
                .exit_code,
            0);
  const std::string model = folder / "model";
  const std::string images = folder / "street/images";
  RunCommand({ORBWEAVE_BINARY,
              "run",
              images,
              "--output",
              model,
              "--set",
              "pairs.exhaustive_below=0",
              "--set",
              "pairs.sequence_window=2",
              "--set",
              "retrieval.num_neighbours=0"});
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(images))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  ASSERT_EQ(names.size(), 6U);

  const CommandOutcome tried = Inspect({model, "--pair", names[0], names[1]});
  EXPECT_THAT(tried.out, HasSubstr("pair       verified")) << tried.err;
  const CommandOutcome untried = Inspect({model, "--pair", names[0], names[5]});
  EXPECT_THAT(untried.out, HasSubstr("not tried: 5 apart in the sequence")) << untried.err;
  EXPECT_THAT(untried.out, HasSubstr("tried now"));

  // The pixels are read where the images lie.
  std::filesystem::remove_all(images);
  const CommandOutcome gone = Inspect({model, "--image", names[0]});
  EXPECT_EQ(gone.exit_code, 0) << gone.err;
}

TEST(Inspect, SaysWhatIsWrongWithItsArguments) {
  const TemporaryFolder folder;
  EXPECT_EQ(Inspect({folder.Path(), "--image", "a"}).exit_code, 2);
  EXPECT_THAT(Inspect({folder.Path(), "--image", "a"}).err, HasSubstr("not the output folder"));
  EXPECT_EQ(Inspect({folder.Path()}).exit_code, 2);
  EXPECT_EQ(Inspect({folder.Path(), "--pair", "a"}).exit_code, 2);
}

}  // namespace
}  // namespace orbweave::testing
