// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/retriangulate_pairs.h"

#include <gtest/gtest.h>

#include "core/mapping/model/filter_points.h"
#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

TEST(RetriangulatePairs, FillsPairsThatDriftEmptied) {
  const StreetFixture street({.centres = StraightWalk(4, 3.0), .noise_px = 0.3});
  const MappingState full = street.TriangulatedStateWith(FirstImages(4));
  // No point was ever made, as if all images had stood elsewhere before.
  MappingState state = street.StateWith(FirstImages(4));
  EXPECT_GT(RetriangulatePairs(state, TrackLimits{}), 0U);
  EXPECT_GE(state.NumObservations(), 0.9 * full.NumObservations());
}

TEST(RetriangulatePairs, LeavesWellReconstructedPairsAlone) {
  const StreetFixture street({.centres = StraightWalk(4, 3.0), .noise_px = 0.3});
  MappingState state = street.TriangulatedStateWith(FirstImages(4));
  const std::vector<PointIndex> points = AllPoints(state);
  for (size_t i = 0; i < points.size(); i += 10) state.RemovePoint(points[i]);
  EXPECT_EQ(RetriangulatePairs(state, TrackLimits{}), 0U);
}

}  // namespace
}  // namespace orbweave
