// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/predict_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "core/geometry/rotation.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kStrong = -200.0;

/// Panoramas of a drive along x that turns towards y behind the third, each turned as it likes.
class Drive {
 public:
  Drive() {
    Random random(1);
    const std::vector<Vector3d> centres = {{0.0, 0.0, 0.0},
                                           {8.0, 0.2, 0.0},
                                           {16.0, 0.0, 0.0},
                                           {17.0, 8.0, 0.0},
                                           {17.0, 16.0, 0.0},
                                           {8.0, 16.0, 0.0}};
    for (const Vector3d& centre : centres)
      cams_from_world_.push_back(Rigid3::FromCentre(testing::RandomRotation(random), centre));
  }

  [[nodiscard]] size_t Size() const { return cams_from_world_.size(); }
  [[nodiscard]] Rigid3 PoseOf(uint32_t a, uint32_t b) const {
    Rigid3 pose = cams_from_world_[b] * cams_from_world_[a].Inverse();
    pose.translation.normalize();
    return pose;
  }
  [[nodiscard]] MatchedPair Verified(uint32_t a, uint32_t b, double evidence = kStrong) const {
    return {.pair = {ImageId(a), ImageId(b)},
            .kind = TwoViewKind::kGeneral,
            .num_moved = 300,
            .log10_false_alarms = evidence,
            .b_from_a = PoseOf(a, b)};
  }
  [[nodiscard]] std::vector<PredictedPair> Predict(const std::vector<MatchedPair>& matched) const {
    std::vector<ImagePair> tried;
    for (uint32_t a = 0; a < Size(); ++a) {
      for (uint32_t b = a + 1; b < Size(); ++b) tried.push_back({ImageId(a), ImageId(b)});
    }
    return PredictPairs(tried, matched, Size());
  }

 private:
  std::vector<Rigid3> cams_from_world_{};
};

TEST(PredictPairs, FollowsTheChain) {
  const Drive drive;
  const std::vector<PredictedPair> predicted = drive.Predict(
      {drive.Verified(0, 1), drive.Verified(1, 2), drive.Verified(2, 3), drive.Verified(3, 4)});
  ASSERT_EQ(predicted.size(), 2U);  // around the corner the way turns too far
  EXPECT_EQ(predicted[0].pair, (ImagePair{ImageId(0), ImageId(2)}));
  EXPECT_EQ(predicted[1].pair, (ImagePair{ImageId(2), ImageId(4)}));
  for (const PredictedPair& pair : predicted)
    EXPECT_TRUE(pair.pose.AgreesWith(drive.PoseOf(pair.pair.a.value, pair.pair.b.value)));
}

TEST(PredictPairs, SaysNothingOfVerifiedPairsAndOfThoseThatWereNotTried) {
  const Drive drive;
  const std::vector<MatchedPair> all = {
      drive.Verified(0, 1), drive.Verified(1, 2), drive.Verified(0, 2, -5.0)};
  EXPECT_TRUE(drive.Predict(all).empty());
  EXPECT_TRUE(PredictPairs({}, {all.data(), 2}, drive.Size()).empty());
}

/// From the middle image's side, whichever of its pairs is named the other way round.
TEST(PredictPairs, DoesNotCareWhichImageOfAPairComesFirst) {
  const Drive drive;
  const std::vector<PredictedPair> over_last =
      drive.Predict({drive.Verified(2, 4), drive.Verified(2, 3), drive.Verified(0, 2)});
  for (const PredictedPair& pair : over_last)
    EXPECT_TRUE(pair.pose.AgreesWith(drive.PoseOf(pair.pair.a.value, pair.pair.b.value)));
}

TEST(PredictPairs, NeedsPairsThatAreBeyondDoubtAndHaveABaseline) {
  const Drive drive;
  EXPECT_TRUE(drive.Predict({drive.Verified(0, 1), drive.Verified(1, 2, -20.0)}).empty());
  MatchedPair still = drive.Verified(1, 2);
  still.kind = TwoViewKind::kPureRotation;
  EXPECT_TRUE(drive.Predict({drive.Verified(0, 1), still}).empty());
}

/// One pair of a place that looks alike, with more evidence than all others.
TEST(PredictPairs, BelievesTheTurnThatMostChainsHave) {
  Drive drive;
  std::vector<MatchedPair> matched = {drive.Verified(0, 1), drive.Verified(1, 4)};
  MatchedPair wrong = drive.Verified(2, 4, 10.0 * kStrong);
  wrong.b_from_a.rotation = wrong.b_from_a.rotation * RotationFromVector({0.0, 1.5, 0.0});
  matched.push_back(drive.Verified(0, 2, 10.0 * kStrong));
  matched.push_back(wrong);
  matched.push_back(drive.Verified(0, 3));
  matched.push_back(drive.Verified(3, 4));
  const auto find = [](const std::vector<PredictedPair>& predicted) {
    return std::ranges::find(predicted, ImagePair{ImageId(0), ImageId(4)}, &PredictedPair::pair);
  };
  const std::vector<PredictedPair> predicted = drive.Predict(matched);
  ASSERT_NE(find(predicted), predicted.end());
  EXPECT_TRUE(find(predicted)->pose.AgreesWith(drive.PoseOf(0, 4)));
  std::mt19937 random(5);
  for (int round = 0; round < 5; ++round) {
    std::shuffle(matched.begin(), matched.end(), random);
    const std::vector<PredictedPair> again = drive.Predict(matched);
    ASSERT_EQ(again.size(), predicted.size());
    for (size_t i = 0; i < again.size(); ++i) {
      EXPECT_EQ(again[i].pair, predicted[i].pair);
      EXPECT_EQ(again[i].pose.rotation.coeffs(), predicted[i].pose.rotation.coeffs());
    }
  }
}

}  // namespace
}  // namespace orbweave
