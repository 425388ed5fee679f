// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/alignment/review_seams.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orbweave {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<ImageId> Images(uint32_t begin, uint32_t end) {
  std::vector<ImageId> images;
  for (uint32_t i = begin; i < end; ++i) images.emplace_back(i);
  return images;
}

/// Three clusters of 20 images in a row; neighbours share `overlap` images.
Partition Row(uint32_t overlap) {
  const uint32_t half = overlap / 2;
  return {.clusters = {{.images = Images(0, 20 + half), .interior = Images(0, 20)},
                       {.images = Images(20 - half, 40 + half), .interior = Images(20, 40)},
                       {.images = Images(40 - half, 60), .interior = Images(40, 60)}},
          .seams = {{.cluster_a = 0, .cluster_b = 1, .shared = Images(20 - half, 20 + half)},
                    {.cluster_a = 1, .cluster_b = 2, .shared = Images(40 - half, 40 + half)}}};
}

/// One whole submodel per cluster, every seam good.
Alignment AllWell() {
  return {.world = {0, 0, 0},
          .submodels = {{.cluster = 0, .num_images = 22},
                        {.cluster = 1, .num_images = 24},
                        {.cluster = 2, .num_images = 22}},
          .seams = {{.submodel_a = 0, .submodel_b = 1, .condition_number = 4.0},
                    {.submodel_a = 1, .submodel_b = 2, .condition_number = 4.0}}};
}

const PartitionOptions kOptions{.overlap = 4, .reviews = 2, .max_overlap = 10};

TEST(ReviewSeams, AsksForNothingWhenAllSeamsHold) {
  const PartitionReview review = ReviewSeams(Row(4), AllWell(), {}, kOptions);
  EXPECT_EQ(review.rounds, 0U);
  EXPECT_THAT(review.requests, IsEmpty());
}

TEST(ReviewSeams, DoublesTheOverlapOfASeamThatCouldNotBeUsed) {
  Alignment alignment = AllWell();
  alignment.world = {0, 0, 1};
  alignment.seams[1].used = false;
  alignment.seams[1].reason = "2 common images and 0 common tracks are too few";
  const PartitionReview review = ReviewSeams(Row(4), alignment, {}, kOptions);
  EXPECT_EQ(review.rounds, 1U);
  ASSERT_EQ(review.requests.size(), 1U);
  EXPECT_EQ(review.requests[0].cluster_a, 1U);
  EXPECT_EQ(review.requests[0].cluster_b, 2U);
  EXPECT_EQ(review.requests[0].images, 8U);
  EXPECT_EQ(review.requests[0].reason, alignment.seams[1].reason);
}

TEST(ReviewSeams, AsksWhereTheModelsHaveNoCommonImage) {
  Alignment alignment = AllWell();
  alignment.seams.pop_back();
  const PartitionReview review = ReviewSeams(Row(4), alignment, {}, kOptions);
  ASSERT_EQ(review.requests.size(), 1U);
  EXPECT_THAT(review.requests[0].reason, HasSubstr("no common image"));
}

TEST(ReviewSeams, AsksWhereASimilarityIsBadlyDetermined) {
  Alignment alignment = AllWell();
  alignment.seams[0].condition_number = 2000.0;
  const PartitionReview review = ReviewSeams(Row(4), alignment, {}, kOptions);
  ASSERT_EQ(review.requests.size(), 1U);
  EXPECT_EQ(review.requests[0].cluster_a, 0U);
  EXPECT_THAT(review.requests[0].reason, HasSubstr("2000"));
}

TEST(ReviewSeams, LeavesContradictedSeamsAlone) {
  Alignment alignment = AllWell();
  alignment.seams[0].used = false;
  alignment.seams[0].contradicted = true;
  EXPECT_THAT(ReviewSeams(Row(4), alignment, {}, kOptions).requests, IsEmpty());
}

TEST(ReviewSeams, AClusterThatFellApartAsksAtAllItsSeams) {
  Alignment alignment = AllWell();
  alignment.submodels[1].num_images = 9;
  const PartitionReview review = ReviewSeams(Row(4), alignment, {}, kOptions);
  ASSERT_EQ(review.requests.size(), 2U);
  EXPECT_THAT(review.requests[0].reason, HasSubstr("cluster 1 fell apart: 9 of its 24 images"));
}

TEST(ReviewSeams, PiecesInOneWorldAreNotFallenApart) {
  Alignment alignment = AllWell();
  alignment.submodels[1].num_images = 9;
  alignment.submodels.push_back({.cluster = 1, .num_images = 9});
  alignment.world = {0, 0, 0, 0};
  EXPECT_THAT(ReviewSeams(Row(4), alignment, {}, kOptions).requests, IsEmpty());
  alignment.world = {0, 0, 0, 1};
  EXPECT_EQ(ReviewSeams(Row(4), alignment, {}, kOptions).requests.size(), 2U);
}

TEST(ReviewSeams, KeepsEarlierRequestsAndStopsAtTheLargestOverlapAndTheLastRound) {
  Alignment alignment = AllWell();
  alignment.seams[0].used = false;
  alignment.seams[0].reason = "weak";
  const PartitionReview first{.rounds = 1, .requests = {{0, 1, 8, "weak"}, {1, 2, 8, "weak"}}};
  const PartitionReview second = ReviewSeams(Row(8), alignment, first, kOptions);
  EXPECT_EQ(second.rounds, 2U);
  ASSERT_EQ(second.requests.size(), 2U);
  EXPECT_EQ(second.requests[0].images, 10U) << "not more than the largest overlap";
  EXPECT_EQ(second.requests[1].images, 8U) << "as it was";
  EXPECT_EQ(ReviewSeams(Row(10), alignment, second, kOptions).rounds, 2U);
  PartitionOptions patient = kOptions;
  patient.reviews = 9;
  EXPECT_EQ(ReviewSeams(Row(10), alignment, second, patient).rounds, 2U)
      << "the largest overlap did not help";
}

TEST(ReviewSeams, ASeamThatHadNoMoreToLendDoesNotAskAgain) {
  Alignment alignment = AllWell();
  alignment.seams[0].used = false;
  alignment.seams[0].reason = "weak";
  const PartitionReview first{.rounds = 1, .requests = {{0, 1, 8, "weak"}}};
  EXPECT_EQ(ReviewSeams(Row(6), alignment, first, kOptions).rounds, 1U);
}

TEST(ReviewSeams, WithoutSubmodelsEveryClusterAsks) {
  EXPECT_EQ(ReviewSeams(Row(4), {}, {}, kOptions).requests.size(), 2U);
  EXPECT_EQ(ReviewSeams({}, {}, {}, kOptions).rounds, 0U);
}

}  // namespace
}  // namespace orbweave
