// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/checks/check_against_pairs.h"

#include <gtest/gtest.h>

#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

TEST(CheckAgainstPairs, FindsNoFaultInTheTruth) {
  const StreetFixture street({.centres = StraightWalk(12, 3.0), .outlier_share = 0.2});
  const PairCheck check =
      CheckAgainstPairs(street.TriangulatedStateWith(FirstImages(12)), MappingOptions{});
  EXPECT_EQ(check.agreeing_share, 1.0);
  EXPECT_GT(check.explained_share, 0.6);
  EXPECT_EQ(check.joined_share, 1.0);
  EXPECT_LT(check.worst_image_ratio, 1.5);
  EXPECT_EQ(FaultOf(check), "");
}

TEST(CheckAgainstPairs, FindsAModelBentWherePairsAreStraight) {
  const StreetFixture street({.centres = StraightWalk(12, 3.0)});
  MappingState state = street.TriangulatedStateWith(FirstImages(12));
  for (ImageSlot image = 0; image < 12; ++image) {
    const Eigen::Quaterniond bend = RotationFromVector({0.0, 0.05 * image, 0.0});
    state.SetPose(
        image,
        {bend * state.CamFromWorld(image).rotation, bend * state.CamFromWorld(image).translation});
  }
  const PairCheck check = CheckAgainstPairs(state, MappingOptions{});
  EXPECT_LT(check.agreeing_share, 0.2);
  EXPECT_NE(FaultOf(check).find("in pairs that agree"), std::string::npos) << FaultOf(check);
}

TEST(CheckAgainstPairs, FindsTwoHalvesThatShareNoPoints) {
  const StreetFixture street({.centres = StraightWalk(12, 3.0)});
  MappingState state = street.TriangulatedStateWith(FirstImages(12));
  for (PointIndex point = 0; point < state.EndOfPoints(); ++point) {
    bool sees[2] = {false, false};
    for (const Node node : state.Point(point).nodes) {
      sees[street.graph.image_of_node[node] < 8 ? 0 : 1] = true;
    }
    if (sees[0] && sees[1]) state.RemovePoint(point);
  }
  const PairCheck check = CheckAgainstPairs(state, MappingOptions{});
  EXPECT_LE(check.joined_share, 8.0 / 12.0);
  EXPECT_GE(check.joined_share, 0.5);
  EXPECT_NE(FaultOf(check), "");
}

TEST(CheckAgainstPairs, FindsAnImageThatIsWorseThanTheOthers) {
  const StreetFixture street({.centres = StraightWalk(12, 3.0)});
  MappingState state = street.TriangulatedStateWith(FirstImages(12));
  const Eigen::Quaterniond turn =
      RotationFromVector({0.0, kStreetCamera.AngleFromPixels(4.0), 0.0});
  state.SetPose(5,
                {turn * state.CamFromWorld(5).rotation, turn * state.CamFromWorld(5).translation});
  const PairCheck check = CheckAgainstPairs(state, MappingOptions{});
  EXPECT_GT(check.worst_image_ratio, 3.0);
  EXPECT_NE(FaultOf(check).find("an image's errors"), std::string::npos) << FaultOf(check);
}

TEST(CheckAgainstPairs, FindsAFaultWhereNothingSpeaksForTheModel) {
  const StreetFixture street({.centres = StraightWalk(4, 3.0)});
  EXPECT_NE(FaultOf(CheckAgainstPairs(street.StateWith({0}), MappingOptions{})), "");
}

}  // namespace
}  // namespace orbweave
