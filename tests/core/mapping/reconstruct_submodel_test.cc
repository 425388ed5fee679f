// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/reconstruct_submodel.h"

#include <gtest/gtest.h>

#include "tests/core/mapping/broken_street.h"

namespace orbweave {
namespace {

TEST(ReconstructSubmodel, StartsAgainWhereASmallModelCannotGrow) {
  // Five images apart from the rest hold the pair that ranks first; joined to it by one pair whose
  // matches are wrong, so that everything counts as within reach.
  std::vector<Eigen::Vector3d> centres = StraightWalk(12, 3.0);
  for (const Eigen::Vector3d& centre : StraightWalk(3, 2.0)) {
    centres.push_back(centre + Eigen::Vector3d(300.0, 0.0, 0.0));
  }
  StreetFixture street({.centres = centres});
  TwoViewGeometry bridge = street.world.problem.pairs.back();
  bridge.pair = {ImageId(11), ImageId(12)};
  bridge.inliers.resize(30);
  const size_t features = street.world.problem.images[11].bearings.size();
  for (FeatureMatch& match : bridge.inliers)
    match.a = match.a % static_cast<FeatureIndex>(features);
  street.world.problem.pairs.push_back(bridge);
  for (TwoViewGeometry& pair : street.world.problem.pairs) {
    if (pair.pair == ImagePair{ImageId(12), ImageId(14)}) pair.median_angle_rad = 0.5;
  }
  const CorrespondenceGraph graph = BuildCorrespondenceGraph(street.world.problem).value();
  const std::vector<uint8_t> available(15, 1);
  RegistrationLog log(15);
  const SubmodelResult result =
      ReconstructSubmodel(street.world.problem, graph, available, {}, log, {}).value();
  ASSERT_TRUE(result.state.has_value());
  EXPECT_EQ(result.state->Registered().size(), 12U);
  EXPECT_TRUE(result.state->IsRegistered(0));
}

TEST(ReconstructSubmodel, GoesOnByGnssWhereNoPointCarriesTheScale) {
  for (const bool has_gnss : {true, false}) {
    BrokenStreet street({.has_gnss = has_gnss, .random_rotations = true});
    street.DetachPairsBetween();
    const std::vector<uint8_t> available(BrokenStreet::kImages, 1);
    RegistrationLog log(BrokenStreet::kImages);
    const SubmodelResult result =
        ReconstructSubmodel(street.World().problem, street.Graph(), available, {}, log, {}).value();
    ASSERT_TRUE(result.state.has_value());
    EXPECT_EQ(result.state->IsInEnu(), has_gnss);
    if (!has_gnss) {
      EXPECT_EQ(result.state->Registered().size(), BrokenStreet::kFirstOfSecond);
      continue;
    }
    ASSERT_EQ(result.state->Registered().size(), BrokenStreet::kImages);
    for (ImageSlot image = 0; image < BrokenStreet::kImages; ++image)
      EXPECT_LT((result.state->Centre(image) - street.PlaceInEnu(image)).norm(), 3.0) << image;
  }
}

TEST(ReconstructSubmodel, HasNoAnswerWithoutAPair) {
  StreetFixture street({.centres = StraightWalk(4, 3.0)});
  street.world.problem.pairs.clear();
  const CorrespondenceGraph graph = BuildCorrespondenceGraph(street.world.problem).value();
  const std::vector<uint8_t> available(4, 1);
  RegistrationLog log(4);
  EXPECT_FALSE(ReconstructSubmodel(street.world.problem, graph, available, {}, log, {})
                   .value()
                   .state.has_value());
}

}  // namespace
}  // namespace orbweave
