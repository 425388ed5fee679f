// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/moves_along.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

using Eigen::Vector3d;

TEST(MovesAlong, LeadFromThePlaceBeforeToThePlaceAfter) {
  const std::vector<Vector3d> places = {{0, 0, 0}, {2, 0, 0}, {4, 1, 0}, {4, 3, 1}};
  const std::vector<MoveAlong> moves = MovesAlong(places);
  ASSERT_EQ(moves.size(), 4U);
  EXPECT_EQ(moves[0].moved, Vector3d(2, 0, 0));
  EXPECT_EQ(moves[1].moved, Vector3d(4, 1, 0));
  EXPECT_EQ(moves[2].moved, Vector3d(2, 3, 1));
  EXPECT_EQ(moves[3].moved, Vector3d(0, 2, 1));
  EXPECT_EQ(moves[3].first, 2U);
  EXPECT_EQ(moves[3].last, 3U);
}

TEST(MovesAlong, LeadNowhereWhereACarrierStands) {
  std::vector<Vector3d> places;
  for (int i = 0; i < 10; ++i) places.emplace_back(3.0 * i, 0.0, 0.0);
  for (int i = 0; i < 3; ++i) places.emplace_back(27.0 + 0.01 * i, 0.0, 0.0);
  const std::vector<MoveAlong> moves = MovesAlong(places);
  EXPECT_FALSE(moves[9].moved.isZero());
  EXPECT_TRUE(moves[11].moved.isZero());
  EXPECT_TRUE(moves[12].moved.isZero());
}

TEST(MovesAlong, DoNotLeadAcrossAGap) {
  std::vector<Vector3d> places;
  for (int i = 0; i < 5; ++i) places.emplace_back(3.0 * i, 0.0, 0.0);
  for (int i = 0; i < 5; ++i) places.emplace_back(80.0, 60.0 + 3.0 * i, 0.0);
  const std::vector<MoveAlong> moves = MovesAlong(places);
  EXPECT_EQ(moves[4].moved, Vector3d(3, 0, 0));
  EXPECT_EQ(moves[4].last, 4U);
  EXPECT_EQ(moves[5].moved, Vector3d(0, 3, 0));
  EXPECT_EQ(moves[5].first, 5U);
}

TEST(MovesAlong, DoNotLeadAcrossAnyOfManyGaps) {
  std::vector<Vector3d> places;
  for (int stretch = 0; stretch < 5; ++stretch) {
    for (int i = 0; i < 4; ++i) places.emplace_back(8.0 * i, 400.0 * stretch, 0.0);
  }
  const std::vector<MoveAlong> moves = MovesAlong(places);
  for (const MoveAlong& move : moves) EXPECT_EQ(move.moved.normalized(), Vector3d::UnitX());
}

TEST(MovesAlong, ACameraCarriedFromStandToStandGoesAllTheWay) {
  std::vector<Vector3d> places;
  for (int stand = 0; stand < 8; ++stand) {
    for (const double tremble : {0.0, 0.02, -0.01}) places.emplace_back(8.0 * stand, tremble, 0.0);
  }
  const std::vector<MoveAlong> moves = MovesAlong(places);
  EXPECT_GT(moves[5].moved.x(), 7.9);
  EXPECT_TRUE(moves[4].moved.isZero());
}

TEST(MovesAlong, AFastStretchIsNoGap) {
  std::vector<Vector3d> places;
  for (int i = 0; i < 10; ++i) places.emplace_back(2.0 * i, 0.0, 0.0);
  for (int i = 0; i < 5; ++i) places.emplace_back(20.0 + 14.0 * i, 0.0, 0.0);
  const std::vector<MoveAlong> moves = MovesAlong(places);
  EXPECT_EQ(moves[11].moved, Vector3d(28, 0, 0));
}

TEST(MovesAlong, NeedTwoPlaces) {
  EXPECT_TRUE(MovesAlong({}).empty());
  const std::vector<Vector3d> one = {Vector3d::Ones()};
  EXPECT_TRUE(MovesAlong(one).front().moved.isZero());
}

}  // namespace
}  // namespace orbweave
