// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/checks/misleading_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

/// A walk of eight images with turned panoramas, whose pairs may be changed before they are asked.
struct Walk {
  StreetFixture street{
      {.centres = StraightWalk(8, 3.0), .points_per_metre = 40, .random_rotations = true}};

  uint32_t NumberOf(uint32_t a, uint32_t b) const {
    const auto& pairs = street.graph.pairs;
    const auto found = std::ranges::find_if(
        pairs, [&](const LinkedPair& pair) { return pair.a == a && pair.b == b; });
    return static_cast<uint32_t>(found - pairs.begin());
  }
  TwoViewGeometry& PairOf(uint32_t a, uint32_t b) {
    return street.world.problem.pairs[street.graph.pairs[NumberOf(a, b)].index];
  }
  /// Whether the pair is misleading in the true model, of which these pairs are explained.
  bool IsMisleading(uint32_t a, uint32_t b, std::vector<ImagePair> explained = {}) const {
    std::vector<uint8_t> is_explained(street.graph.pairs.size(), 0);
    for (const auto& [x, y] : explained) is_explained[NumberOf(x.value, y.value)] = 1;
    const MappingState state = street.StateWith(FirstImages(8));
    return MisleadingPairs(state, is_explained).IsMisleading(NumberOf(a, b));
  }
};

ImagePair Pair(uint32_t a, uint32_t b) { return {ImageId(a), ImageId(b)}; }

TEST(MisleadingPairs, AreThoseThatLeadBackWhereTheCameraGoesOn) {
  for (const auto& [a, b] : {std::pair(0U, 1U), std::pair(3U, 4U), std::pair(3U, 5U)}) {
    Walk walk;
    EXPECT_FALSE(walk.IsMisleading(a, b));
    walk.PairOf(a, b).b_from_a.translation *= -1.0;
    EXPECT_TRUE(walk.IsMisleading(a, b)) << a << " " << b;
  }
}

TEST(MisleadingPairs, FarImagesMaySeeEachOtherFromAnywhere) {
  Walk walk;
  walk.PairOf(1, 6).b_from_a.translation *= -1.0;
  EXPECT_FALSE(walk.IsMisleading(1, 6));
}

TEST(MisleadingPairs, AnImageThatTheModelHasOnTheWrongSideSaysNothingOfThePair) {
  Walk walk;
  Rigid3& wrong = walk.street.world.cams_from_world[4];
  wrong = Rigid3::FromCentre(wrong.rotation, Vector3d(4.0, 0.0, 0.0));  // behind image 2 of 6 m
  EXPECT_FALSE(walk.IsMisleading(3, 4));
  EXPECT_FALSE(walk.IsMisleading(4, 5));
}

TEST(MisleadingPairs, AreThoseThatTurnOtherwiseThanTwoExplainedOnesByWayOfAThirdImage) {
  Walk walk;
  Rigid3& b_from_a = walk.PairOf(2, 4).b_from_a;
  const Eigen::Quaterniond truth = b_from_a.rotation;
  const auto turn = [&](double degrees) {
    b_from_a.rotation =
        truth * Eigen::AngleAxisd(degrees * 3.14159265 / 180.0, Vector3d(0.6, 0.0, 0.8));
  };
  turn(5.0);
  EXPECT_TRUE(walk.IsMisleading(2, 4, {Pair(2, 3), Pair(3, 4)}));
  EXPECT_TRUE(walk.IsMisleading(2, 4, {Pair(2, 5), Pair(4, 5)}) ==
              (walk.PairOf(2, 5).inliers.size() >= walk.PairOf(2, 4).inliers.size()));
  EXPECT_FALSE(walk.IsMisleading(2, 4, {Pair(2, 3)}));
  EXPECT_FALSE(walk.IsMisleading(2, 4));
  turn(1.0);
  EXPECT_FALSE(walk.IsMisleading(2, 4, {Pair(2, 3), Pair(3, 4)}));
}

TEST(MisleadingPairs, WeakPairsDoNotOutweighAStrongOne) {
  Walk walk;
  walk.PairOf(2, 4).b_from_a.rotation *=
      Eigen::Quaterniond(Eigen::AngleAxisd(0.1, Vector3d::UnitY()));
  walk.PairOf(2, 3).inliers.resize(walk.PairOf(2, 4).inliers.size() - 1);
  EXPECT_FALSE(walk.IsMisleading(2, 4, {Pair(2, 3), Pair(3, 4)}));
}

/// The pair of images 2 and 4 leads so many degrees off its way.
void LeadOff(double degrees, Walk& walk) {
  Rigid3& b_from_a = walk.PairOf(2, 4).b_from_a;
  const Vector3d way = b_from_a.Centre();
  const Eigen::AngleAxisd turn(degrees * 3.14159265 / 180.0, way.unitOrthogonal());
  b_from_a = Rigid3::FromCentre(b_from_a.rotation, turn * way);
}

TEST(MisleadingPairs, AreThoseThatLeadOtherwiseThanTwoExplainedOnesByWayOfAThirdImage) {
  const std::vector<ImagePair> by_way_of_3 = {Pair(2, 3), Pair(3, 4)};
  Walk walk;
  EXPECT_FALSE(walk.IsMisleading(2, 4, by_way_of_3));
  LeadOff(3.0, walk);
  EXPECT_FALSE(walk.IsMisleading(2, 4, by_way_of_3));
  LeadOff(12.0, walk);
  EXPECT_TRUE(walk.IsMisleading(2, 4, by_way_of_3));
  EXPECT_FALSE(walk.IsMisleading(2, 4, {Pair(3, 4)})) << "one of them may be what is wrong";
  walk.PairOf(3, 4).inliers.resize(walk.PairOf(2, 4).inliers.size() - 1);
  EXPECT_FALSE(walk.IsMisleading(2, 4, by_way_of_3)) << "a weak one";
}

/// A walk that turns by 90 degrees at image 3, whose pair of images 2 and 4 leads otherwise.
struct Corner : Walk {
  Corner() {
    auto& poses = street.world.cams_from_world;
    poses[4] = Rigid3::FromCentre(poses[4].rotation, poses[3].Centre() + Vector3d(0.0, 3.0, 0.0));
    for (const auto& [a, b] : {std::pair(2U, 4U), std::pair(3U, 4U)})
      PairOf(a, b).b_from_a = poses[b] * poses[a].Inverse();
  }
  bool IsMisleadingBy(double degrees) {
    const auto& poses = street.world.cams_from_world;
    Rigid3& b_from_a = PairOf(2, 4).b_from_a;
    const Rigid3 truth = poses[4] * poses[2].Inverse();
    const Vector3d axis = poses[2].rotation * Vector3d::UnitZ();
    b_from_a = Rigid3::FromCentre(
        truth.rotation, Eigen::AngleAxisd(degrees * 3.14159265 / 180.0, axis) * truth.Centre());
    return IsMisleading(2, 4, {Pair(2, 3), Pair(3, 4)});
  }
  void GivePositions(double sigma_m) {
    for (uint32_t i = 2; i <= 4; ++i) {
      PosePrior& prior = street.world.problem.images[i].prior;
      prior.position_in_enu = street.world.cams_from_world[i].Centre();
      prior.horizontal_sigma_m = sigma_m;
    }
  }
};

/// Any direction between those of the two ways is right for some lengths of them, and lengths are
/// what may be wrong.
TEST(MisleadingPairs, LengthsOfTheWaysDoNotMatter) {
  Corner corner;
  for (const double degrees : {-50.0, -40.0, -35.0, 0.0, 35.0, 40.0, 50.0})
    EXPECT_EQ(corner.IsMisleadingBy(degrees), std::abs(degrees) > 49.0) << degrees;
}

/// Both ways are 3 m: with sigmas of 0.2 m one may be 1.49 times as long as the other, and the pair
/// lead 11 degrees otherwise.
TEST(MisleadingPairs, LengthsThatGnssKnowsDo) {
  Corner corner;
  corner.GivePositions(0.2);
  for (const double degrees : {-40.0, -20.0, -10.0, 0.0, 10.0, 20.0, 40.0})
    EXPECT_EQ(corner.IsMisleadingBy(degrees), std::abs(degrees) > 19.0) << degrees;
}

TEST(MisleadingPairs, PositionsThatKnowNoLengthsOrContradictTheModelSayNothing) {
  Corner vague;
  vague.GivePositions(3.0);
  EXPECT_FALSE(vague.IsMisleadingBy(40.0));
  Corner off;
  off.GivePositions(0.2);
  off.street.world.problem.images[4].prior.position_in_enu->y() += 3.0;
  EXPECT_FALSE(off.IsMisleadingBy(20.0));
}

/// A walk whose pair of images 1 and 4 leads otherwise, turning as it should, and is explained
/// nowhere but by way of two others.
struct LongWalk : Walk {
  static std::vector<ImagePair> Chain() { return {Pair(1, 2), Pair(2, 3), Pair(3, 4)}; }
  void Turn(double degrees) {
    const Eigen::AngleAxisd turn(degrees * 3.14159265 / 180.0, Vector3d::UnitY());
    Rigid3& b_from_a = PairOf(1, 4).b_from_a;
    const Eigen::Quaterniond& b_from_world = street.world.cams_from_world[4].rotation;
    b_from_a.translation =
        b_from_world * (turn * (b_from_world.conjugate() * b_from_a.translation));
  }
};

TEST(MisleadingPairs, AreThoseThatLeadOtherwiseThanAChainOfStrongOnes) {
  LongWalk walk;
  EXPECT_FALSE(walk.IsMisleading(1, 4, LongWalk::Chain()));
  walk.Turn(3.0);
  EXPECT_FALSE(walk.IsMisleading(1, 4, LongWalk::Chain()));
  walk.Turn(70.0);
  EXPECT_TRUE(walk.IsMisleading(1, 4, LongWalk::Chain()));
  EXPECT_FALSE(walk.IsMisleading(1, 4, {Pair(1, 2), Pair(2, 3)}));
  EXPECT_FALSE(walk.IsMisleading(1, 4, {Pair(1, 2), Pair(3, 4)}));
}

TEST(MisleadingPairs, AreThoseThatTurnOtherwiseThanAChainOfStrongOnes) {
  for (const double degrees : {1.0, 5.0}) {
    LongWalk walk;
    walk.PairOf(1, 4).b_from_a.rotation *=
        Eigen::Quaterniond(Eigen::AngleAxisd(degrees * 3.14159265 / 180.0, Vector3d::UnitX()));
    EXPECT_EQ(walk.IsMisleading(1, 4, LongWalk::Chain()), degrees > 2.0);
    EXPECT_FALSE(walk.IsMisleading(1, 4, {Pair(1, 2), Pair(2, 3)}));
    walk.PairOf(2, 3).inliers.resize(walk.PairOf(1, 4).inliers.size() - 1);
    EXPECT_FALSE(walk.IsMisleading(1, 4, LongWalk::Chain()));
  }
}

TEST(MisleadingPairs, NoChainIsStrongerThanItsWeakestPair) {
  LongWalk walk;
  walk.Turn(70.0);
  walk.PairOf(2, 3).inliers.resize(walk.PairOf(1, 4).inliers.size() - 1);
  EXPECT_FALSE(walk.IsMisleading(1, 4, LongWalk::Chain()));
}

/// Beside a tear the pairs of the chain do not lead as the model does.
TEST(MisleadingPairs, NoChainLeadsAcrossATear) {
  LongWalk walk;
  for (uint32_t image = 3; image < 8; ++image) {
    Rigid3& pose = walk.street.world.cams_from_world[image];
    pose = Rigid3::FromCentre(pose.rotation, pose.Centre() + Vector3d(0.0, 0.0, 4.0));
  }
  EXPECT_FALSE(walk.IsMisleading(1, 4, LongWalk::Chain()));
}

/// A walk whose pair of images 2 and 4 has rays that hardly part, those of others by 20 degrees.
struct StillWalk : Walk {
  StillWalk() {
    for (TwoViewGeometry& geometry : street.world.problem.pairs) geometry.median_angle_rad = 0.35;
    PairOf(2, 4).median_angle_rad = 0.02;
  }
  bool StandsStill() const { return IsMisleading(2, 4, {Pair(2, 3), Pair(3, 4)}); }
};

TEST(MisleadingPairs, AreThoseThatStandStillWhereTwoExplainedOnesGoOn) {
  StillWalk walk;
  EXPECT_TRUE(walk.StandsStill());
  EXPECT_FALSE(walk.IsMisleading(2, 4, {Pair(2, 3)}));
  EXPECT_FALSE(walk.IsMisleading(2, 4));
  walk.PairOf(2, 4).median_angle_rad = 0.1;
  EXPECT_FALSE(walk.StandsStill());
}

TEST(MisleadingPairs, ACameraThatComesBackSeesTheSame) {
  StillWalk walk;
  walk.PairOf(3, 4).b_from_a.translation *= -1.0;
  EXPECT_FALSE(walk.StandsStill());
}

TEST(MisleadingPairs, NeitherAStopNorWeakPairsSayThatItWentOn) {
  StillWalk stop;
  stop.PairOf(3, 4).median_angle_rad = 0.03;
  EXPECT_FALSE(stop.StandsStill());
  StillWalk weak;
  weak.PairOf(2, 3).inliers.resize(weak.PairOf(2, 4).inliers.size() / 2 - 1);
  EXPECT_FALSE(weak.StandsStill());
}

}  // namespace
}  // namespace orbweave
