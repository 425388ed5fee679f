// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/list_missing_images.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/report/build_job_report.h"

namespace orbweave {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Six images in two clusters. Model 0 observes images 0 to 2, and 3 to 5 are loose in it.
JobResults SixImages() {
  JobResults results;
  for (uint32_t i = 0; i < 6; ++i) {
    ImageRecord& image = results.manifest.images.emplace_back();
    image.id = ImageId(i);
    image.name = std::to_string(i) + ".jpg";
  }
  results.view_graph.partition.clusters = {
      {.interior = {ImageId(0), ImageId(1), ImageId(2), ImageId(3)}},
      {.interior = {ImageId(4), ImageId(5)}}};
  AdjustedModel& model = results.models.emplace_back();
  for (uint32_t i = 0; i < 6; ++i) model.images[ImageId(i)].loose = i > 2;
  model.report.weak_images = {{"3.jpg", "its observations do not fix its pose"}};
  results.clusters = {{.cluster = 1, .not_registered = {{ImageId(4), "too few points"}}}};
  return results;
}

TEST(BuildJobReport, NamesLooseImagesWithTheirReasonsAndDoesNotCountThem) {
  const JobReport report = BuildJobReport(SixImages());
  EXPECT_EQ(report.registered, 3U);
  std::vector<std::string> missing;
  for (const Exclusion& image : report.not_registered)
    missing.push_back(image.name + ": " + image.reason);
  EXPECT_THAT(missing,
              ElementsAre(HasSubstr("3.jpg: its observations do not fix its pose; it is placed"),
                          HasSubstr("4.jpg: too few points; it is placed loosely"),
                          HasSubstr("5.jpg: no verified matches")));
  EXPECT_EQ(report.images[4].reason, "too few points");
  EXPECT_EQ(report.images[0].reason, "");
}

TEST(BuildJobReport, SaysThatAnImageHadOnlyPairsThatLookAlike) {
  JobResults results = SixImages();
  results.view_graph.dropped = {{.pair = {ImageId(0), ImageId(5)}, .cause = DropCause::kGnss},
                                {.pair = {ImageId(2), ImageId(5)}, .cause = DropCause::kGnss}};
  const JobReport report = BuildJobReport(results);
  EXPECT_THAT(report.images[5].reason, HasSubstr("2 verified pairs with others, and all told"));
  EXPECT_EQ(report.images[4].reason, "too few points");
}

TEST(BuildJobReport, SaysWhatBecameOfImagesWhoseModelIsGone) {
  JobResults results = SixImages();
  results.view_graph.edges = {{ImageId(4), ImageId(5)}};
  EXPECT_EQ(BuildJobReport(results).images[5].reason, "no model that it was part of lasted");
  results.left_out = {{"5.jpg", "its observations do not fix its pose"}};
  EXPECT_EQ(BuildJobReport(results).images[5].reason, "its observations do not fix its pose");
}

TEST(BuildJobReport, WarnsOnceOfAllLooseImagesWithTheReasonOfMost) {
  JobResults results = SixImages();
  EXPECT_THAT(BuildJobReport(results).warnings,
              ElementsAre("3 images are placed loosely, not registered; for example 3.jpg: its "
                          "observations do not fix its pose"));
  results.clusters = {{.cluster = 0, .not_registered = {{ImageId(3), "it has 102 observations"}}},
                      {.cluster = 1,
                       .not_registered = {{ImageId(4), "too few points"},
                                          {ImageId(5), "it has 315 observations"}}}};
  results.models[0].report.weak_images.clear();
  EXPECT_THAT(
      BuildJobReport(results).warnings,
      ElementsAre("3 images are placed loosely, not registered; for example 2 images, such as "
                  "3.jpg: it has 102 observations"));
}

TEST(BuildJobReport, AnImageThatAModelObservesIsNotLooseInAnother) {
  JobResults results = SixImages();
  AdjustedModel& second = results.models.emplace_back();
  second.images[ImageId(5)] = {};
  second.images[ImageId(0)].loose = true;
  const JobReport report = BuildJobReport(results);
  EXPECT_EQ(report.registered, 4U);
  EXPECT_FALSE(report.images[5].loose);
  EXPECT_EQ(report.images[5].model, 1U);
  EXPECT_FALSE(report.images[0].loose);
  EXPECT_EQ(report.images[0].model, 0U);
}

}  // namespace
}  // namespace orbweave
