// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/checks/find_contradicted_pairs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/geometry/sphere_cells.h"
#include "core/mapping/model/mapping_schedule.h"
#include "core/mapping/model/triangulate_tracks.h"
#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

using ::testing::Contains;

TEST(FindContradictedPairs, FindsNoneInATrueModel) {
  const StreetFixture street({.centres = StraightWalk(6, 3.0), .outlier_share = 0.1});
  EXPECT_TRUE(FindContradictedPairs(street.TriangulatedStateWith(FirstImages(6)), {}).empty());
}

TEST(FindContradictedPairs, FindsThePairThatJoinsTwoPlaces) {
  StreetFixture street({.centres = StraightWalk(30, 3.0), .points_per_metre = 20});
  TwoViewGeometry alike{.pair = {ImageId(2), ImageId(27)}, .kind = TwoViewKind::kGeneral};
  for (FeatureIndex f = 0; f < 200; ++f) alike.inliers.push_back({f, f});
  street.world.problem.pairs.push_back(alike);
  street.graph = BuildCorrespondenceGraph(street.world.problem).value();
  const std::vector<ImagePair> found =
      FindContradictedPairs(street.TriangulatedStateWith(FirstImages(30)), {});
  EXPECT_EQ(found, (std::vector<ImagePair>{alike.pair}));
}

TEST(JudgePairs, ExplainsEveryPairOfNeighboursInATrueModel) {
  const StreetFixture street({.centres = StraightWalk(6, 3.0), .outlier_share = 0.3});
  const JudgedPairs judged = JudgePairs(street.TriangulatedStateWith(FirstImages(6)), {});
  EXPECT_EQ(judged.explained.size(), street.world.problem.pairs.size());
}

TEST(JudgePairs, TracksOfOneThingThatNeverMetAreNoContradiction) {
  // Points of images 0 to 2 and of 3 to 5 from pairs of their own; then the pairs between them.
  StreetFixture street({.centres = StraightWalk(6, 1.0), .points_per_metre = 60});
  std::vector<TwoViewGeometry> all = street.world.problem.pairs;
  std::erase_if(street.world.problem.pairs, [](const TwoViewGeometry& pair) {
    return pair.pair.a.value < 3 && pair.pair.b.value >= 3;
  });
  street.graph = BuildCorrespondenceGraph(street.world.problem).value();
  MappingState apart = street.TriangulatedStateWith(FirstImages(6));
  ClusterProblem whole = street.world.problem;
  whole.pairs = std::move(all);
  const CorrespondenceGraph graph = BuildCorrespondenceGraph(whole).value();
  MappingState state(whole, graph);
  for (const ImageSlot image : FirstImages(6)) state.Register(image, apart.CamFromWorld(image));
  for (PointIndex point = 0; point < apart.EndOfPoints(); ++point) {
    if (apart.Exists(point)) state.AddPoint(apart.Point(point).position, apart.Point(point).nodes);
  }
  const JudgedPairs judged = JudgePairs(state, {});
  EXPECT_TRUE(judged.contradicted.empty());
  EXPECT_EQ(judged.explained.size(), whole.pairs.size());
}

/// What is said of the pair of the first two images when only `num_true` of 100 of its matches are.
JudgedPairs JudgedWithTrueMatches(size_t num_true) {
  StreetFixture street({.centres = StraightWalk(6, 3.0), .points_per_metre = 60});
  std::vector<FeatureMatch>& inliers = street.world.problem.pairs.front().inliers;
  EXPECT_GE(inliers.size(), 200U);
  std::vector<FeatureMatch> matches(inliers.begin(), inliers.begin() + num_true);
  for (size_t i = 0; matches.size() < 100; ++i)
    matches.push_back({inliers[100 + i].a, inliers[199 - i].b});
  const MappingState truth = street.TriangulatedStateWith(FirstImages(6));
  ClusterProblem problem = street.world.problem;
  problem.pairs.front().inliers = matches;
  const CorrespondenceGraph graph = BuildCorrespondenceGraph(problem).value();
  MappingState state(problem, graph);
  for (const ImageSlot image : FirstImages(6)) {
    state.Register(image, truth.CamFromWorld(image));
    TriangulateImage(state, image, LimitsOf({}));
  }
  return JudgePairs(state, {});
}

TEST(JudgePairs, AFewTrueMatchesDoNotMakeUpForTheRest) {
  const ImagePair first =
      StreetFixture({.centres = StraightWalk(6, 3.0)}).world.problem.pairs[0].pair;
  EXPECT_THAT(JudgedWithTrueMatches(18).contradicted, Contains(first));
  EXPECT_THAT(JudgedWithTrueMatches(50).explained, Contains(first));
}

TEST(JudgePairs, OnePosterIsNoEvidence) {
  // All of the look-alike matches lie in one patch of the second image.
  StreetFixture street({.centres = StraightWalk(30, 3.0), .points_per_metre = 60});
  TwoViewGeometry poster{.pair = {ImageId(2), ImageId(27)}, .kind = TwoViewKind::kGeneral};
  const ClusterImage& b = street.world.problem.images[27];
  for (FeatureIndex f = 0; f < b.bearings.size() && poster.inliers.size() < 60; ++f) {
    if (SphereCell(b.bearings[f], 4) == 6)
      poster.inliers.push_back({static_cast<FeatureIndex>(poster.inliers.size()), f});
  }
  ASSERT_GE(poster.inliers.size(), 30U);
  street.world.problem.pairs.push_back(poster);
  street.graph = BuildCorrespondenceGraph(street.world.problem).value();
  EXPECT_TRUE(FindContradictedPairs(street.TriangulatedStateWith(FirstImages(30)), {}).empty());
}

/// A street whose image 3 stands on the other side of image 2, with the points that its own pairs
/// still agree on: those with image 2 have none.
std::vector<ImagePair> ContradictedWhereAnImageIsOnTheWrongSide(TwoViewKind kind) {
  StreetFixture street({.centres = StraightWalk(6, 3.0), .points_per_metre = 40});
  for (TwoViewGeometry& pair : street.world.problem.pairs) pair.kind = kind;
  street.graph = BuildCorrespondenceGraph(street.world.problem).value();
  MappingState state(street.world.problem, street.graph);
  for (const ImageSlot image : FirstImages(6)) {
    Rigid3 cam_from_world = street.world.cams_from_world[image];
    if (image == 3) {
      const Eigen::Vector3d centre = street.world.cams_from_world[2].Centre();
      cam_from_world.translation =
          -(cam_from_world.rotation * (2.0 * centre - cam_from_world.Centre()));
    }
    state.Register(image, cam_from_world);
  }
  return FindContradictedPairs(state, {});
}

TEST(JudgePairs, PairsThatLostAllTheirPointsContradictAnImageOnTheWrongSide) {
  EXPECT_THAT(ContradictedWhereAnImageIsOnTheWrongSide(TwoViewKind::kGeneral),
              Contains(ImagePair{ImageId(2), ImageId(3)}));
}

TEST(JudgePairs, OneCentreOrOnePlaneSaysNothingOfSides) {
  EXPECT_TRUE(ContradictedWhereAnImageIsOnTheWrongSide(TwoViewKind::kPureRotation).empty());
  EXPECT_TRUE(ContradictedWhereAnImageIsOnTheWrongSide(TwoViewKind::kPlanar).empty());
}

TEST(JudgePairs, ATrueModelWithoutPointsIsNotContradicted) {
  for (const double spacing_m : {0.3, 3.0}) {
    const StreetFixture street(
        {.centres = StraightWalk(6, spacing_m), .points_per_metre = 40, .outlier_share = 0.5});
    const JudgedPairs judged = JudgePairs(street.StateWith(FirstImages(6)), {});
    EXPECT_TRUE(judged.contradicted.empty());
    EXPECT_TRUE(judged.explained.empty());
  }
}

}  // namespace
}  // namespace orbweave
