// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/check_options_together.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <initializer_list>
#include <string>
#include <vector>

#include "stages/preset_options.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;

PipelineOptions With(std::initializer_list<const char*> assignments) {
  PipelineOptions options;
  for (const char* assignment : assignments) {
    EXPECT_TRUE(SetPipelineOption(options, assignment).ok()) << assignment;
  }
  return options;
}

std::string ProblemOf(std::initializer_list<const char*> assignments, const JobShape& job) {
  const absl::Status status = CheckOptionsTogether(With(assignments), job);
  EXPECT_TRUE(status.ok() || status.code() == absl::StatusCode::kInvalidArgument);
  return std::string(status.message());
}

TEST(CheckOptionsTogether, PassesTheDefaults) {
  for (const size_t num_images : {0U, 1U, 3U, 40U, 5000U}) {
    EXPECT_EQ(ProblemOf({}, {.num_images = num_images}), "");
    EXPECT_EQ(ProblemOf({}, {.num_images = num_images, .has_matches = true}), "");
  }
}

TEST(CheckOptionsTogether, RefusesCeresWhereTheGraphMayBeDivided) {
  const JobShape street{.num_images = 100};
  EXPECT_EQ(ProblemOf({"bundle.solver=ceres"}, street), "");  // stays one cluster
  EXPECT_THAT(ProblemOf({"bundle.solver=ceres", "partition.min_clusters=3"}, street),
              HasSubstr("partition.cluster_size=0"));
  EXPECT_EQ(ProblemOf({"bundle.solver=ceres", "partition.cluster_size=0"}, street), "");
  EXPECT_EQ(ProblemOf({"bundle.solver=ceres", "partition.min_clusters=1"}, street), "");
  EXPECT_EQ(ProblemOf({"bundle.solver=ceres", "partition.min_clusters=1"}, {.num_images = 149}),
            "");  // stays one cluster
  EXPECT_NE(ProblemOf({"bundle.solver=ceres", "partition.min_clusters=1"}, {.num_images = 150}),
            "");
  EXPECT_EQ(ProblemOf({"bundle.solver=ceres", "partition.min_clusters=3"}, {.num_images = 31}),
            "");  // too few for two
  EXPECT_NE(ProblemOf({"bundle.solver=ceres", "partition.min_clusters=3"}, {.num_images = 32}), "");
}

TEST(CheckOptionsTogether, RefusesCeresForClustersByHand) {
  const auto problem = [](size_t clusters) {
    return ProblemOf({"bundle.solver=ceres"},
                     {.num_images = 100, .num_clusters_by_hand = clusters});
  };
  EXPECT_THAT(problem(2), HasSubstr("no clusters by hand"));
  EXPECT_EQ(problem(1), "");
}

TEST(CheckOptionsTogether, RefusesCeresWhereSubproblemsAreDistributed) {
  const JobShape job{.num_images = 1000};
  EXPECT_THAT(ProblemOf({"bundle.solver=ceres", "partition.cluster_size=0"}, job),
              HasSubstr("raise blocks.distribute_from"));
  EXPECT_EQ(
      ProblemOf({"bundle.solver=ceres", "partition.cluster_size=0", "blocks.distribute_from=1001"},
                job),
      "");
}

/// Options over the defaults of the paper, as commands read them.
std::string ProblemUnderPaper(std::vector<std::string> assignments) {
  assignments.insert(assignments.begin(), "mapping.preset=paper");
  return std::string(
      CheckOptionsTogether(OptionsOverPreset("", "", assignments).value(), {.num_images = 10})
          .message());
}

TEST(CheckOptionsTogether, RefusesWhatThePresetWouldIgnore) {
  EXPECT_EQ(ProblemUnderPaper({}), "");
  EXPECT_EQ(ProblemUnderPaper({"bundle.residual=erp_px", "mapping.max_error_px=3"}), "");
  for (const std::string ignored : {"mapping.start=global",
                                    "bundle.residual=angle",
                                    "bundle.loss=cauchy",
                                    "mapping.local_window=6",
                                    "mapping.two_view_below=0"}) {
    EXPECT_THAT(ProblemUnderPaper({ignored}), HasSubstr(ignored.substr(0, ignored.find('='))));
    EXPECT_EQ(ProblemOf({ignored.c_str()}, {.num_images = 10}), "");
  }
}

TEST(CheckOptionsTogether, RefusesLessOverlapAfterAReviewThanBefore) {
  const JobShape street{.num_images = 200};
  EXPECT_THAT(ProblemOf({"partition.overlap=60"}, street),
              HasSubstr("partition.max_overlap=48 is less than partition.overlap=60"));
  EXPECT_EQ(ProblemOf({"partition.overlap=48"}, street), "");
  EXPECT_EQ(ProblemOf({"partition.overlap=60", "partition.max_overlap=60"}, street), "");
  EXPECT_EQ(ProblemOf({"partition.overlap=60", "partition.reviews=0"}, street), "");
  EXPECT_EQ(ProblemOf({"partition.overlap=60"}, {.num_images = 40}), "");  // stays one cluster
}

TEST(CheckOptionsTogether, LooksAtWhatACloudReads) {
  EXPECT_THAT(ProblemOf({"sources.near_m=50"}, {.num_images = 10}), HasSubstr("sources.far_m=40"));
  EXPECT_TRUE(CheckDenseOptions(With({"sources.near_m=50", "sources.far_m=60"}).sources).ok());
  EXPECT_FALSE(CheckDenseOptions(With({"sources.near_m=40"}).sources).ok());
  EXPECT_THAT(
      CheckDenseOptions(With({"sources.min_angle_deg=30", "sources.max_angle_deg=30"}).sources)
          .message(),
      HasSubstr("sources.max_angle_deg=30"));
}

TEST(CheckOptionsTogether, RefusesToKeepNoModelAtAll) {
  EXPECT_THAT(ProblemOf({"mapping.min_component_images=11"}, {.num_images = 10}),
              HasSubstr("keeps no model of so few"));
  EXPECT_EQ(ProblemOf({"mapping.min_component_images=10"}, {.num_images = 10}), "");
}

TEST(CheckOptionsTogether, RefusesMoreInliersThanFeatures) {
  const auto problem = [](bool has_matches) {
    return ProblemOf({"features.max_features=100", "two_view.min_inliers=101"},
                     {.num_images = 10, .has_matches = has_matches});
  };
  EXPECT_THAT(problem(false), HasSubstr("two_view.min_inliers=101"));
  EXPECT_EQ(problem(true), "");  // the features of a database are its own
}

TEST(CheckOptionsTogether, RefusesToPairNothing) {
  const auto problem = [](size_t num_images) {
    return ProblemOf(
        {"pairs.sequence_window=0", "pairs.gnss_max_neighbours=0", "retrieval.num_neighbours=0"},
        {.num_images = num_images});
  };
  EXPECT_THAT(problem(40), HasSubstr("no two images would be paired"));
  EXPECT_EQ(problem(39), "");  // every two are
}

}  // namespace
}  // namespace orbweave
