// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/pairs_of_job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

#include "core/base/random.h"
#include "core/geometry/rotation.h"
#include "core/report/check_contradicted_pairs.h"
#include "core/report/check_pairs.h"

namespace orbweave {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kDegree_rad = EIGEN_PI / 180.0;

Eigen::Vector3d RandomVector(Random& random) {
  return {random.Normal(), random.Normal(), random.Normal()};
}

/// A street of 40 panoramas, 3 m apart and turned at random, in two clusters that share none of
/// them: its right pairs between 17 ... 19 and 20 ... 22 are in neither.
JobResults Street(Random& random) {
  JobResults results;
  AdjustedModel& model = results.models.emplace_back();
  results.clusters.resize(2);
  for (uint32_t i = 0; i < 40; ++i) {
    ImageRecord& image = results.manifest.images.emplace_back();
    image.id = ImageId(i);
    image.name = std::to_string(i) + ".jpg";
    const Eigen::Vector3d at(3.0 * i, 0.2 * random.Normal(), 0.0);
    model.images[ImageId(i)].cam_from_world =
        Rigid3::FromCentre(RotationFromVector(RandomVector(random)), at);
  }
  for (uint32_t a = 17; a < 20; ++a) {
    for (uint32_t b = 20; b < 23; ++b) {
      Rigid3 b_from_a = model.images[ImageId(b)].cam_from_world *
                        model.images[ImageId(a)].cam_from_world.Inverse();
      b_from_a.translation.normalize();
      results.view_graph.edges.push_back({ImageId(a), ImageId(b)});
      results.view_graph.crossing.push_back({{ImageId(a), ImageId(b)}, b_from_a});
    }
  }
  return results;
}

/// Everything behind image 19 stands elsewhere, as if its cluster had been put there.
void MoveBehind(const Rigid3& other_from_world, JobResults& results) {
  for (auto& [id, image] : results.models[0].images) {
    if (id.value > 19) image.cam_from_world = image.cam_from_world * other_from_world.Inverse();
  }
}

TEST(JudgePairsOfJob, ARightModelExplainsPairsBetweenItsClusters) {
  Random random(1);
  const JobResults results = Street(random);
  const PairsOfJob judged = JudgePairsOfJob(results);
  EXPECT_EQ(judged.explained.size(), 9U);
  EXPECT_THAT(judged.contradicted, IsEmpty());
}

TEST(JudgePairsOfJob, ClustersThatAreFoldedOntoEachOtherContradictThem) {
  Random random(2);
  JobResults results = Street(random);
  MoveBehind({.translation = Eigen::Vector3d(-40.0, 0.0, 0.0)}, results);
  const PairsOfJob judged = JudgePairsOfJob(results);
  EXPECT_EQ(judged.contradicted.size(), 9U);
  const BorneOutByGnss gnss(results);
  EXPECT_EQ(CheckPairs(results, judged, gnss).level, CheckLevel::kBad);
  EXPECT_EQ(CheckContradictedPairs(results, judged, gnss)->level, CheckLevel::kBad);
}

TEST(JudgePairsOfJob, SubmodelsThatAreFoldedOntoEachOtherContradictWhatLedFromOneToTheOther) {
  Random random(2);
  JobResults results = Street(random);
  results.clusters[0].parted_pairs = std::exchange(results.view_graph.crossing, {});
  EXPECT_EQ(JudgePairsOfJob(results).explained.size(), 9U);
  MoveBehind({.translation = Eigen::Vector3d(-40.0, 0.0, 0.0)}, results);
  EXPECT_EQ(JudgePairsOfJob(results).contradicted.size(), 9U);
}

TEST(JudgePairsOfJob, ClustersThatTurnOtherwiseContradictThem) {
  Random random(3);
  JobResults results = Street(random);
  const Eigen::Vector3d joint(57.0, 0.0, 0.0);
  const Eigen::Quaterniond turn = RotationFromVector({0.0, 0.0, 40.0 * kDegree_rad});
  MoveBehind({turn, joint - turn * joint}, results);
  EXPECT_EQ(JudgePairsOfJob(results).contradicted.size(), 9U);
}

TEST(JudgePairsOfJob, ANearImageIsAskedForItsTurnAlone) {
  Random random(4);
  JobResults results = Street(random);
  std::map<ImageId, RegisteredImage>& images = results.models[0].images;
  Rigid3& pose = images.at(ImageId(20)).cam_from_world;
  pose = Rigid3::FromCentre(pose.rotation,
                            images.at(ImageId(19)).cam_from_world.Centre() -
                                Eigen::Vector3d(0.5, 0.0, 0.0));  // half a metre behind it
  EXPECT_TRUE(JudgePairsOfJob(results).explained.contains({ImageId(19), ImageId(20)}));
}

TEST(JudgePairsOfJob, PairsOfTwoModelsAreNotAskedNorThoseThatAClusterContradicts) {
  Random random(5);
  JobResults results = Street(random);
  AdjustedModel& other = results.models.emplace_back();
  for (uint32_t i = 20; i < 40; ++i)
    other.images.insert(results.models[0].images.extract(ImageId(i)));
  const ImagePair pair{ImageId(3), ImageId(4)};
  results.clusters[0].explained_pairs = {pair};
  EXPECT_THAT(JudgePairsOfJob(results).explained, ElementsAre(pair));
  results.clusters[1].contradicted_pairs = {pair, {ImageId(3), ImageId(400)}};
  EXPECT_THAT(JudgePairsOfJob(results).explained, IsEmpty());
  EXPECT_THAT(JudgePairsOfJob(results).contradicted, ElementsAre(pair));
}

}  // namespace
}  // namespace orbweave
