// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/registration/judge_by_gnss.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/mapping/registration/pose_on_gnss_steps.h"
#include "tests/core/mapping/gnss_walk.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr ImageSlot kImage = 6;
constexpr double kHouse_m = -7.0;
const double kFourPxRad = kStreetCamera.AngleFromPixels(4.0);

/// What image 6 sees of the model, and a facade to which it agrees from a house before where it is.
class RepeatedHouse {
 public:
  explicit RepeatedHouse(uint64_t seed) : walk(seed) {}

  [[nodiscard]] MappingState State() const { return walk.StateWithout(kImage); }
  [[nodiscard]] Rigid3 Wrong() const { return walk.Further(kImage, kHouse_m); }

  /// The first `true_points` that it sees, and `facade` points on one side.
  [[nodiscard]] SceneCorrespondences Seen(const MappingState& state,
                                          size_t true_points,
                                          int facade) const {
    SceneCorrespondences seen = FindSceneCorrespondences(state, kImage);
    const size_t count = std::min(true_points, seen.size());
    seen.nodes.resize(count);
    seen.points.resize(count);
    seen.bearings.resize(count);
    seen.positions.resize(count);
    Random random(5);
    for (int i = 0; i < facade; ++i) {
      const Rigid3 from = Wrong();
      const Vector3d bearing =
          Vector3d(random.Uniform(-0.6, 0.6), random.Uniform(-0.6, 0.2), 1.0).normalized();
      seen.nodes.push_back(static_cast<Node>(1000000 + i));
      seen.points.push_back(static_cast<PointIndex>(1000000 + i));
      seen.bearings.push_back(bearing);
      seen.positions.push_back(from.Inverse() * Vector3d(walk.model_from_world.scale *
                                                         random.Uniform(5.0, 7.0) * bearing));
    }
    return seen;
  }

  GnssWalk walk;
};

TEST(PoseOnGnssSteps, LeavesTheHouseThatLooksAlike) {
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    const RepeatedHouse house(seed);
    const MappingState state = house.State();
    const SceneCorrespondences seen = house.Seen(state, 60, 200);
    const auto pose =
        PoseOnGnssSteps(state, kImage, StepWitness(state, kImage), house.Wrong(), seen, kFourPxRad);
    ASSERT_TRUE(pose.has_value()) << "seed " << seed;
    EXPECT_LT((pose->Centre() - house.walk.InModel(kImage).Centre()).norm(),
              0.05 * house.walk.model_from_world.scale);
  }
}

TEST(PoseOnGnssSteps, DoesNotFollowAWrongPosition) {
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    RepeatedHouse house(seed);
    *house.walk.Prior(kImage).position_in_enu += Vector3d(20.0, 15.0, 0.0);
    const MappingState state = house.State();
    const SceneCorrespondences seen = house.Seen(state, 200, 0);
    const Rigid3 truth = house.walk.InModel(kImage);
    ASSERT_TRUE(StepWitness(state, kImage).Contradicts(truth.Centre()));
    EXPECT_FALSE(
        PoseOnGnssSteps(state, kImage, StepWitness(state, kImage), truth, seen, kFourPxRad));
  }
}

TEST(PoseOnGnssSteps, LeavesAloneWhatGnssDoesNotContradict) {
  const RepeatedHouse house(2);
  const MappingState state = house.State();
  const SceneCorrespondences seen = house.Seen(state, 60, 200);
  EXPECT_FALSE(PoseOnGnssSteps(
      state, kImage, StepWitness(state, kImage), house.walk.InModel(kImage), seen, kFourPxRad));
}

TEST(JudgeByGnss, FindsTheBetterPose) {
  const RepeatedHouse house(3);
  const MappingState state = house.State();
  const GnssVerdict verdict =
      JudgeByGnss(state, kImage, house.Wrong(), house.Seen(state, 60, 40), kFourPxRad);
  EXPECT_NE(verdict.opinion, GnssOpinion::kNone);
  ASSERT_TRUE(verdict.better.has_value());
  EXPECT_LT((verdict.better->Centre() - house.walk.InModel(kImage).Centre()).norm(), 0.05);
}

TEST(JudgeByGnss, IsNotAskedWherePointsAreAtOne) {
  RepeatedHouse house(4);
  *house.walk.Prior(kImage).position_in_enu += Vector3d(20.0, 15.0, 0.0);
  const MappingState state = house.State();
  const GnssVerdict verdict = JudgeByGnss(state,
                                          kImage,
                                          house.walk.InModel(kImage),
                                          FindSceneCorrespondences(state, kImage),
                                          kFourPxRad);
  EXPECT_EQ(verdict.opinion, GnssOpinion::kNone);
  EXPECT_FALSE(verdict.better.has_value());
}

/// A pose with which half of the points agree, in few places, and none elsewhere.
GnssVerdict VerdictOnFacade(const RepeatedHouse& house, const MappingState& state) {
  const int half = static_cast<int>(state.Visible(kImage).Count() / 2);
  return JudgeByGnss(state, kImage, house.Wrong(), house.Seen(state, 0, half), kFourPxRad);
}

TEST(JudgeByGnss, RefusesAPieceOfTheStreetButNotOneImage) {
  const RepeatedHouse house(6);
  MappingState state = house.State();
  EXPECT_EQ(VerdictOnFacade(house, state).opinion, GnssOpinion::kContradicted);
  state.SetPose(5, house.walk.Further(5, 2.0 * kHouse_m));
  EXPECT_EQ(VerdictOnFacade(house, state).opinion, GnssOpinion::kRefused);
}

TEST(JudgeByGnss, RefusesWhatHardlyAPointAgreesWith) {
  const RepeatedHouse house(7);
  const MappingState state = house.State();
  const int few = static_cast<int>(state.Visible(kImage).Count() / 5);
  const SceneCorrespondences seen = house.Seen(state, 0, few);
  EXPECT_EQ(JudgeByGnss(state, kImage, house.Wrong(), seen, kFourPxRad).opinion,
            GnssOpinion::kRefused);
}

TEST(JudgeByGnss, RefusesWhatIsFarFromWhereItsDriveWas) {
  RepeatedHouse house(6);
  house.walk.SetExactPositions();
  {
    const MappingState state = house.State();
    EXPECT_EQ(VerdictOnFacade(house, state).opinion, GnssOpinion::kContradicted);
  }
  house.walk.Image(kImage).is_position_of_drive = true;
  const MappingState state = house.State();
  EXPECT_EQ(VerdictOnFacade(house, state).opinion, GnssOpinion::kRefused);
}

TEST(IsGrosslyContradicted, OnlyWherePointsAreNotAtOneAndTheDriveTells) {
  RepeatedHouse house(6);
  house.walk.SetExactPositions();
  const auto is_contradicted = [&](const Rigid3& pose, size_t true_points, int facade) {
    const MappingState state = house.State();
    return IsGrosslyContradicted(
        state, kImage, pose, house.Seen(state, true_points, facade), kFourPxRad);
  };
  EXPECT_FALSE(is_contradicted(house.Wrong(), 0, 30));
  house.walk.Image(kImage).is_position_of_drive = true;
  EXPECT_TRUE(is_contradicted(house.Wrong(), 0, 30));
  EXPECT_FALSE(is_contradicted(house.walk.InModel(kImage), 10, 0)) << "it is where its drive was";
  *house.walk.Prior(kImage).position_in_enu += Vector3d(30.0, 40.0, 0.0);
  EXPECT_FALSE(is_contradicted(house.walk.InModel(kImage), 1000, 0)) << "all points say so";
}

TEST(JudgeByGnss, OnePlaceIsNotAtOne) {
  RepeatedHouse house(6);
  house.walk.SetExactPositions();
  const MappingState state = house.State();
  const int all = static_cast<int>(state.Visible(kImage).Count());
  SceneCorrespondences seen = house.Seen(state, 0, all);
  EXPECT_EQ(JudgeByGnss(state, kImage, house.Wrong(), seen, kFourPxRad).opinion, GnssOpinion::kNone)
      << "in several places";
  const Rigid3 from = house.Wrong();
  for (size_t i = 0; i < seen.size(); ++i) {
    seen.bearings[i] = Vector3d(0.01 + 1e-4 * static_cast<double>(i % 9), 0.02, 1.0).normalized();
    seen.positions[i] = from.Inverse() * Vector3d(2.0 * seen.bearings[i]);
  }
  EXPECT_NE(JudgeByGnss(state, kImage, from, seen, kFourPxRad).opinion, GnssOpinion::kNone);
}

}  // namespace
}  // namespace orbweave
