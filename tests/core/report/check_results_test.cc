// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/check_results.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace orbweave {
namespace {

using ::testing::HasSubstr;

ImageManifest Images(uint32_t count) {
  ImageManifest manifest;
  for (uint32_t i = 0; i < count; ++i) manifest.images.push_back({.id = ImageId(i)});
  return manifest;
}

/// Two clusters of three images.
Partition TwoClusters() {
  return {.clusters = {{.images = {ImageId(0), ImageId(1)}, .interior = {ImageId(0)}},
                       {.images = {ImageId(1), ImageId(2)}, .interior = {ImageId(2)}}},
          .seams = {{.cluster_a = 0, .cluster_b = 1}}};
}

std::vector<ClusterSummary> Reconstructed() {
  return {{.cluster = 0, .submodels = {{2, 10}}},
          {.cluster = 1, .submodels = {{1, 10}}, .not_registered = {{ImageId(2), "too few"}}}};
}

void ExpectDamaged(const absl::Status& status, const std::string& words) {
  EXPECT_TRUE(absl::IsDataLoss(status)) << status;
  EXPECT_THAT(status.message(), HasSubstr(words));
}

TEST(CheckResults, TakesWhatFits) {
  EXPECT_TRUE(CheckManifest(Images(3)).ok());
  EXPECT_TRUE(CheckPartition(TwoClusters(), Images(3)).ok());
  EXPECT_TRUE(CheckClusters(Reconstructed(), TwoClusters(), Images(3)).ok());
  EXPECT_TRUE(CheckAlignment({.world = {0, 0}, .seams = {{.submodel_a = 0, .submodel_b = 1}}},
                             Reconstructed())
                  .ok());
  EXPECT_TRUE(CheckModel({{ImageId(2), {}}}, Images(3)).ok());
}

TEST(CheckResults, RefusesImagesThatThereAreNot) {
  ExpectDamaged(CheckPartition(TwoClusters(), Images(2)), "cluster 1 has image 2 of 2");
  ExpectDamaged(CheckClusters(Reconstructed(), TwoClusters(), Images(2)), "image 2 of 2");
  ExpectDamaged(CheckModel({{ImageId(7), {}}}, Images(3)), "image 7 of 3");
  ImageManifest renamed = Images(3);
  renamed.images[1].id = ImageId(4000000000U);
  ExpectDamaged(CheckManifest(renamed), "image 1 is called 4000000000");
  std::vector<ClusterSummary> pairs = Reconstructed();
  pairs[0].explained_pairs = {{ImageId(0), ImageId(9)}};
  ExpectDamaged(CheckClusters(pairs, TwoClusters(), Images(3)), "image 9 of 3");
  std::vector<ClusterSummary> parted = Reconstructed();
  parted[0].parted_pairs = {{.pair = {ImageId(0), ImageId(8)}}};
  ExpectDamaged(CheckClusters(parted, TwoClusters(), Images(3)), "image 8 of 3");
  ExpectDamaged(CheckCarriers({{.images = {ImageId(6)}}}, Images(3)), "image 6 of 3");
}

TEST(CheckResults, RefusesClustersAndSubmodelsThatThereAreNot) {
  std::vector<ClusterSummary> clusters = Reconstructed();
  clusters[1].cluster = 2;
  ExpectDamaged(CheckClusters(clusters, TwoClusters(), Images(3)), "cluster 2 of 2");
  ExpectDamaged(CheckAlignment({.world = {0, 0}, .seams = {{.submodel_a = 0, .submodel_b = 2}}},
                               Reconstructed()),
                "submodel 2 of 2");
  ExpectDamaged(CheckAlignment({.world = {0}}, Reconstructed()), "alignment of 1 of 2");
  Partition partition = TwoClusters();
  partition.seams[0].cluster_b = 5;
  ExpectDamaged(CheckPartition(partition, Images(3)), "cluster 5 of 2");
  partition.seams[0].cluster_b = 0;
  ExpectDamaged(CheckPartition(partition, Images(3)), "with itself");
}

TEST(CheckResults, RefusesPosesThatNobodyCanComputeWith) {
  for (const double far : {1e300, -1e12, std::numeric_limits<double>::quiet_NaN()}) {
    RegisteredImage image;
    image.cam_from_world.translation.x() = far;
    ExpectDamaged(CheckModel({{ImageId(0), image}}, Images(3)), "stands nowhere");
  }
}

TEST(CheckResults, RefusesDenseResultsThatNameNothing) {
  DensePlan plan{.panoramas = {{.file = {.image = ImageId(1)}}}, .omitted = {{ImageId(2), "sky"}}};
  EXPECT_TRUE(CheckDensePlan(plan, Images(3)).ok());
  ExpectDamaged(CheckDensePlan(plan, Images(2)), "image 2 of 2");
  ExpectDamaged(CheckDensePlan(plan, Images(1)), "image 1 of 1");
  plan.panoramas[0].unit_m = 1e-300;
  ExpectDamaged(CheckDensePlan(plan, Images(3)), "unit");
  EXPECT_TRUE(CheckTile({.points = {{.position_in_world = {1.0, 2.0, 3.0}}}}).ok());
  ExpectDamaged(CheckTile({.points = {{.position_in_world = {1e300, 2.0, 3.0}}}}), "nowhere");
}

}  // namespace
}  // namespace orbweave
