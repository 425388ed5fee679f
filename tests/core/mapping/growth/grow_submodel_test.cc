// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/growth/grow_submodel.h"

#include <gtest/gtest.h>

#include "core/mapping/growth/initialise_from_pair.h"
#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

uint32_t PairOf(const CorrespondenceGraph& graph, ImageSlot a, ImageSlot b) {
  for (uint32_t p = 0; p < graph.pairs.size(); ++p) {
    if (graph.pairs[p].a == a && graph.pairs[p].b == b) return p;
  }
  return 0;
}

TEST(GrowSubmodel, ReachesEveryImageFromTheMiddle) {
  const StreetFixture street({.centres = StraightWalk(14, 3.0)});
  MappingState state = street.StateWith({});
  const LinkedPair& seed = street.graph.pairs[PairOf(street.graph, 6, 7)];
  ASSERT_TRUE(InitialiseFromPair(state, seed, {}, {}).value());
  RegistrationLog log(14);
  const std::vector<uint8_t> available(14, 1);
  const GrowthReport report = GrowSubmodel(state, available, {}, log, {}).value();
  EXPECT_EQ(state.Registered().size(), 14U);
  EXPECT_EQ(report.num_local_adjustments, 12);
  EXPECT_GE(report.num_global_adjustments, 2);
  EXPECT_LE(report.num_global_adjustments, 8);
}

TEST(GrowSubmodel, LeavesImagesAloneThatAreNotAvailable) {
  const StreetFixture street({.centres = StraightWalk(10, 3.0)});
  MappingState state = street.StateWith({});
  ASSERT_TRUE(
      InitialiseFromPair(state, street.graph.pairs[PairOf(street.graph, 2, 3)], {}, {}).value());
  RegistrationLog log(10);
  std::vector<uint8_t> available(10, 1);
  available[0] = 0;
  available[8] = 0;
  ASSERT_TRUE(GrowSubmodel(state, available, {}, log, {}).ok());
  EXPECT_EQ(state.Registered().size(), 8U);
  EXPECT_FALSE(state.IsRegistered(0));
  EXPECT_FALSE(state.IsRegistered(8));
}

}  // namespace
}  // namespace orbweave
