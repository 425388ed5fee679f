// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/reconstructed_share.h"

#include <gtest/gtest.h>

#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

TEST(ReconstructedShare, CountsMatchesThatEndedInACommonPoint) {
  const StreetFixture street({.centres = StraightWalk(2, 3.0)});
  ASSERT_EQ(street.graph.pairs.size(), 1U);
  const LinkedPair& pair = street.graph.pairs[0];
  MappingState state = street.StateWith(FirstImages(2));
  EXPECT_EQ(ReconstructedShare(state, pair), 0.0);
  const auto& matches = street.world.problem.pairs[0].inliers;
  for (size_t i = 0; i < matches.size() / 2; ++i) {
    const std::vector<Node> nodes = {street.graph.node_of_feature[0][matches[i].a],
                                     street.graph.node_of_feature[1][matches[i].b]};
    state.AddPoint(Eigen::Vector3d::UnitZ(), nodes);
  }
  const auto half = static_cast<double>(matches.size() / 2);
  EXPECT_EQ(ReconstructedShare(state, pair), half / static_cast<double>(matches.size()));
}

}  // namespace
}  // namespace orbweave
