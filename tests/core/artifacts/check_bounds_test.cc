// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/artifacts/check_bounds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace orbweave {
namespace {

using ::testing::HasSubstr;

ImageManifest Images(uint32_t count) {
  ImageManifest manifest;
  for (uint32_t i = 0; i < count; ++i) manifest.images.push_back({.id = ImageId(i)});
  return manifest;
}

/// Two clusters that share image 1.
Partition TwoClusters() {
  return {.clusters = {{.images = {ImageId(0), ImageId(1)}, .interior = {ImageId(0)}},
                       {.images = {ImageId(1), ImageId(2)}, .interior = {ImageId(1), ImageId(2)}}},
          .seams = {{.cluster_a = 0, .cluster_b = 1, .shared = {ImageId(1)}}}};
}

/// A submodel of each.
std::vector<Submodel> TwoSubmodels() {
  std::vector<Submodel> submodels = {{.cluster = 0}, {.cluster = 1}};
  submodels[0].reconstruction.images = {{ImageId(0), {}}, {ImageId(1), {}}};
  submodels[1].reconstruction.images = {{ImageId(2), {}}};
  return submodels;
}

Alignment Aligned() {
  return {.world_from_submodel = {{}, {}},
          .world = {0, 0},
          .submodels = {{.cluster = 0, .num_images = 2}, {.cluster = 1, .num_images = 1}}};
}

void ExpectDamaged(const absl::Status& status, const std::string& words) {
  EXPECT_TRUE(absl::IsDataLoss(status)) << status;
  EXPECT_THAT(status.message(), HasSubstr(words));
}

TEST(CheckBounds, TakesWhatFits) {
  EXPECT_TRUE(CheckNumber(1, 2, "one").ok());
  EXPECT_TRUE(CheckPairs({}, Images(0)).ok());
  EXPECT_TRUE(CheckPartition(TwoClusters(), Images(3)).ok());
  EXPECT_TRUE(CheckPartition({}, {}).ok()) << "before the first round";
  const std::vector<OverlapRequest> requests = {{.cluster_a = 0, .cluster_b = 1}};
  EXPECT_TRUE(CheckRequests(requests, TwoClusters()).ok());
  EXPECT_TRUE(CheckAlignedClusters(Aligned(), TwoClusters()).ok());
  EXPECT_TRUE(CheckSubmodels(TwoSubmodels(), Aligned(), TwoClusters()).ok());
}

TEST(CheckPairs, RefusesAnImageThatThereIsNot) {
  const std::vector<TwoViewGeometry> pairs = {{.pair = {ImageId(0), ImageId(3)}}};
  EXPECT_TRUE(CheckPairs(pairs, Images(4)).ok());
  ExpectDamaged(CheckPairs(pairs, Images(3)), "a verified pair has image 3 of 3");
}

TEST(CheckPartition, RefusesImagesAndClustersThatThereAreNot) {
  ExpectDamaged(CheckPartition(TwoClusters(), Images(2)), "cluster 1 has image 2 of 2");
  Partition partition = TwoClusters();
  partition.seams[0].cluster_b = 2;
  ExpectDamaged(CheckPartition(partition, Images(3)), "a seam names cluster 2 of 2");
  partition.seams[0] = {.cluster_a = 1, .cluster_b = 1};
  ExpectDamaged(CheckPartition(partition, Images(3)), "with itself");
}

TEST(CheckRequests, RefusesAClusterThatThereIsNot) {
  const std::vector<OverlapRequest> requests = {{.cluster_a = 1, .cluster_b = 4000000000U}};
  ExpectDamaged(CheckRequests(requests, TwoClusters()), "cluster 4000000000 of 2");
  ExpectDamaged(CheckRequests(requests, {}), "cluster 1 of 0");
}

TEST(CheckSubmodels, RefusesAnAlignmentOfOthers) {
  Alignment alignment = Aligned();
  alignment.submodels[1].cluster = 7;
  ExpectDamaged(CheckAlignedClusters(alignment, TwoClusters()), "cluster 7 of 2");
  ExpectDamaged(CheckSubmodels(TwoSubmodels(), alignment, TwoClusters()), "other clusters");
  alignment.submodels.pop_back();
  ExpectDamaged(CheckSubmodels(TwoSubmodels(), alignment, TwoClusters()), "other submodels");
}

TEST(CheckSubmodels, RefusesImagesOfOtherClusters) {
  std::vector<Submodel> submodels = TwoSubmodels();
  submodels[1].reconstruction.images[ImageId(0)] = {};
  ExpectDamaged(CheckSubmodels(submodels, Aligned(), TwoClusters()), "cluster 1 has no image 0");
  submodels = TwoSubmodels();
  submodels[1].cluster = 2;
  ExpectDamaged(CheckSubmodels(submodels, Aligned(), TwoClusters()), "cluster 2 of 2");
}

}  // namespace
}  // namespace orbweave
