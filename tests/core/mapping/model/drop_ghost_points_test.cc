// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/drop_ghost_points.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/mapping/model/filter_points.h"
#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

RayStreetOptions Walk() { return {.centres = StraightWalk(7, 3.0), .noise_px = 0.0}; }

Node NodeIn(const MappingState& state, PointIndex point, ImageSlot image) {
  for (const Node node : state.Point(point).nodes) {
    if (state.Graph().image_of_node[node] == image) return node;
  }
  return static_cast<Node>(-1);
}

/// Points that both images and one more see, beside the way: every `step`-th.
std::vector<PointIndex> SeenByBoth(const MappingState& state,
                                   ImageSlot one,
                                   ImageSlot other,
                                   size_t step) {
  std::vector<PointIndex> seen;
  size_t count = 0;
  for (const PointIndex point : AllPoints(state)) {
    if (state.Point(point).nodes.size() < 3 || !state.IsSeenBy(point, one) ||
        !state.IsSeenBy(point, other))
      continue;
    if (count++ % step == 0) seen.push_back(point);
  }
  return seen;
}

/// Leaves these points to two images, `far` times as far from the middle between them.
void LeaveToTwo(MappingState& state,
                const std::vector<PointIndex>& points,
                ImageSlot one,
                ImageSlot other,
                double far) {
  const Vector3d middle = 0.5 * (state.Centre(one) + state.Centre(other));
  for (const PointIndex point : points) {
    const std::vector<Node> nodes = {NodeIn(state, point, one), NodeIn(state, point, other)};
    const Vector3d position = middle + far * (state.Point(point).position - middle);
    state.RemovePoint(point);
    state.AddPoint(position, nodes);
  }
}

uint32_t CountOfTwo(const MappingState& state, ImageSlot one, ImageSlot other) {
  uint32_t count = 0;
  for (const PointIndex point : AllPoints(state)) {
    count += state.Point(point).nodes.size() == 2 && state.IsSeenBy(point, one) &&
                     state.IsSeenBy(point, other)
                 ? 1
                 : 0;
  }
  return count;
}

class DropGhostPointsTest : public ::testing::Test {
 protected:
  DropGhostPointsTest() : street_(Walk()), state_(street_.TriangulatedStateWith(FirstImages(7))) {}
  StreetFixture street_;
  MappingState state_;
};

TEST_F(DropGhostPointsTest, LeavesAStreetAlone) {
  ASSERT_GT(state_.NumPoints(), 50U);
  EXPECT_EQ(DropGhostPoints(state_), 0U);
}

TEST_F(DropGhostPointsTest, RemovesAWallBehindTheWall) {
  LeaveToTwo(state_, SeenByBoth(state_, 2, 4, 2), 2, 4, 2.0);
  const uint32_t ghosts = CountOfTwo(state_, 2, 4);
  const uint32_t all = state_.NumPoints();
  ASSERT_GT(ghosts, 50U);
  const uint32_t removed = DropGhostPoints(state_);
  EXPECT_GT(removed, 3 * ghosts / 4) << "all but those along the way, which nobody is between";
  EXPECT_LE(removed, ghosts);
  EXPECT_EQ(state_.NumPoints(), all - removed);
  EXPECT_EQ(DropGhostPoints(state_), 0U);
}

TEST_F(DropGhostPointsTest, RemovesAWallBeforeTheWall) {
  LeaveToTwo(state_, SeenByBoth(state_, 2, 4, 2), 2, 4, 0.6);
  const uint32_t ghosts = CountOfTwo(state_, 2, 4);
  EXPECT_GT(DropGhostPoints(state_), ghosts / 2);
}

TEST_F(DropGhostPointsTest, KeepsWhatLiesWhereOthersSeeIt) {
  LeaveToTwo(state_, SeenByBoth(state_, 2, 4, 2), 2, 4, 1.0);
  ASSERT_GT(CountOfTwo(state_, 2, 4), 50U) << "an image between them that stands elsewhere";
  EXPECT_EQ(DropGhostPoints(state_), 0U);
}

TEST_F(DropGhostPointsTest, KeepsAFewAmongManyThatAThirdSees) {
  LeaveToTwo(state_, SeenByBoth(state_, 2, 4, 8), 2, 4, 2.0);
  ASSERT_GT(CountOfTwo(state_, 2, 4), 10U);
  EXPECT_EQ(DropGhostPoints(state_), 0U);
}

TEST_F(DropGhostPointsTest, KeepsWhatNobodyStandsBetween) {
  LeaveToTwo(state_, SeenByBoth(state_, 2, 3, 2), 2, 3, 2.0);
  ASSERT_GT(CountOfTwo(state_, 2, 3), 50U);
  EXPECT_EQ(DropGhostPoints(state_), 0U);
}

TEST_F(DropGhostPointsTest, DoesNotKnowAScale) {
  LeaveToTwo(state_, SeenByBoth(state_, 2, 4, 2), 2, 4, 2.0);
  MappingState small = state_;
  Scale(small, 1e-3);
  EXPECT_EQ(DropGhostPoints(small), DropGhostPoints(state_));
}

}  // namespace
}  // namespace orbweave
