// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/mending/close_drift.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "core/mapping/adjustment/adjust_global.h"
#include "core/mapping/checks/find_contradicted_pairs.h"
#include "core/mapping/lengths/matches_in_planes.h"
#include "tests/core/mapping/torn_street.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr ImageSlot kTorn = 8;

/// One pair alone leads from before kTorn to behind it, and by matches to the sides of the street.
void LeaveOnePairAcross(TornStreet& street) {
  StreetFixture& fixture = street.Fixture();
  std::erase_if(fixture.world.problem.pairs, [](const TwoViewGeometry& pair) {
    return pair.pair.a.value < kTorn && pair.pair.b.value >= kTorn &&
           pair.pair.b.value - pair.pair.a.value > 1;
  });
  const Eigen::Vector3d along = Eigen::Vector3d::UnitX();
  const Eigen::Quaterniond& turn = fixture.world.cams_from_world[kTorn].rotation;
  for (TwoViewGeometry& pair : fixture.world.problem.pairs) {
    if (pair.pair != ImagePair{ImageId(kTorn - 1), ImageId(kTorn)}) continue;
    std::erase_if(pair.inliers, [&](const FeatureMatch& match) {
      const Eigen::Vector3d& ray = fixture.world.problem.images[kTorn].bearings[match.b];
      return std::abs((turn.conjugate() * ray).dot(along)) > 0.6;
    });
  }
  fixture.graph = BuildCorrespondenceGraph(fixture.world.problem).value();
}

void MakePoints(MappingState& state) {
  for (const ImageSlot image : state.Registered()) TriangulateImage(state, image, TrackLimits{});
}

/// With points on either side of the image before kTorn, from where on all is turned.
MappingState Drifted(const TornStreet& street, double angle_rad) {
  MappingState state = street.Right();
  TornStreet::TurnFrom(kTorn, angle_rad, state);
  MakePoints(state);
  return state;
}

/// How far the street turns more than it should where it was torn.
double TurnOf(const TornStreet& street, const MappingState& state) {
  const auto turn = [](const MappingState& of) {
    return (of.CamFromWorld(kTorn) * of.CamFromWorld(kTorn - 1).Inverse()).rotation;
  };
  return turn(state).angularDistance(turn(street.Right()));
}

bool Close(MappingState& state) {
  const auto is_closed = CloseDrift(state, {}, {});
  EXPECT_TRUE(is_closed.ok()) << is_closed.status();
  return is_closed.ok() && *is_closed;
}

TEST(CloseDrift, BringsTogetherWhatNoAdjustmentDoes) {
  TornStreet street;
  LeaveOnePairAcross(street);
  for (const double angle_deg : {2.5, -3.5}) {
    MappingState adjusted = Drifted(street, angle_deg * kDegree);
    MappingState closed = adjusted;
    ASSERT_TRUE(AdjustFinalModel(adjusted, {}, {}).ok());
    EXPECT_GT(TurnOf(street, adjusted), 1.0 * kDegree) << "else this test shows nothing";
    EXPECT_TRUE(Close(closed));
    EXPECT_LT(TurnOf(street, closed), 0.05 * kDegree);
    EXPECT_TRUE(JudgePairs(closed, {}).contradicted.empty());
  }
}

/// Beside each other images look alike because they are: whatever days they are of, and however far
/// the model has them apart.
TEST(CloseDrift, BringsTogetherWhatStandsFarAskewBesideIt) {
  TornStreet street;
  for (ImageSlot image = kTorn; image < TornStreet::kImages; ++image)
    street.Fixture().world.problem.images[image].drive = 1;
  LeaveOnePairAcross(street);
  MappingState closed = Drifted(street, 14.0 * kDegree);
  EXPECT_TRUE(Close(closed));
  EXPECT_LT(TurnOf(street, closed), 0.05 * kDegree);
  EXPECT_TRUE(JudgePairs(closed, {}).contradicted.empty());
}

TEST(CloseDrift, LeavesARightModelAsItIs) {
  const TornStreet street;
  MappingState state = Drifted(street, 0.0);
  const size_t observations = state.NumObservations();
  EXPECT_FALSE(Close(state));
  EXPECT_EQ(state.NumObservations(), observations);
}

/// Two images with matches, of nothing that is there, as if they stood as they do in `state`.
void AddLookAlikes(ImageSlot a, ImageSlot b, const MappingState& state, TornStreet& street) {
  ClusterProblem& problem = street.Fixture().world.problem;
  Random random(5);
  TwoViewGeometry pair{.pair = {ImageId(a), ImageId(b)}, .kind = TwoViewKind::kGeneral};
  pair.b_from_a = state.CamFromWorld(b) * state.CamFromWorld(a).Inverse();
  const auto add = [](const Eigen::Vector3d& seen, ClusterImage& image) {
    image.bearings.push_back(seen.normalized());
    image.sigma_rad.push_back(image.sigma_rad.back());
    image.colors.push_back(image.colors.back());
    return static_cast<FeatureIndex>(image.bearings.size() - 1);
  };
  for (int i = 0; i < 80; ++i) {
    const Eigen::Vector3d in_a = 15.0 * testing::RandomDirection(random);
    pair.inliers.push_back(
        {add(in_a, problem.images[a]), add(pair.b_from_a * in_a, problem.images[b])});
  }
  pair.b_from_a.translation.normalize();
  problem.pairs.push_back(pair);
  street.Fixture().graph = BuildCorrespondenceGraph(problem).value();
}

TEST(CloseDrift, DoesNotFollowPlacesThatOnlyLookAlike) {
  TornStreet street;
  MappingState turned = street.Right();
  TornStreet::TurnFrom(kTorn, 3.0 * kDegree, turned);
  AddLookAlikes(5, 11, turned, street);
  MappingState state = street.Right();
  MakePoints(state);
  const std::vector<LinkedPair>& pairs = state.Graph().pairs;
  const auto alike = std::ranges::find_if(
      pairs, [](const LinkedPair& pair) { return pair.a == 5 && pair.b == 11; });
  const auto within = [&](double tolerance_px) {
    const auto matches = OwnMatches(state, *alike, 8.0);
    return std::ranges::count_if(
        matches, [&](const PosedMatch& match) { return match.Agrees(tolerance_px); });
  };
  const double five_degrees_px = 5.0 * kDegree / AngleFromPixels(state, 0, 1.0);
  ASSERT_LT(within(8.0), 40) << "else this test shows nothing";
  ASSERT_GT(within(five_degrees_px), 60) << "else this test shows nothing";
  EXPECT_FALSE(Close(state));
  for (ImageSlot image = 0; image < TornStreet::kImages; ++image)
    EXPECT_LT((state.Centre(image) - TornStreet::Centre(image)).norm(), 1e-9) << image;
}

TEST(CloseDrift, StopsWhenAsked) {
  const TornStreet street;
  MappingState state = Drifted(street, 3.0 * kDegree);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(CloseDrift(state, {}, {.stop = stop.get_token()}).status().code(),
            absl::StatusCode::kCancelled);
}

}  // namespace
}  // namespace orbweave
