// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/find_contradicted_pairs.h"

#include <gtest/gtest.h>

#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

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

}  // namespace
}  // namespace orbweave
