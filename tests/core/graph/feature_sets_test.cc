// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/feature_sets.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

using Join = FeatureSets::Join;

const std::vector<FeatureRef> kFeatures = {
    {ImageId(0), 3}, {ImageId(0), 7}, {ImageId(2), 1}, {ImageId(5), 0}};

TEST(FeatureSets, JoinFeaturesOfDifferentImages) {
  FeatureSets sets(kFeatures);
  EXPECT_EQ(sets.TryJoin(0, 2), Join::kJoined);
  EXPECT_EQ(sets.TryJoin(2, 3), Join::kJoined);
  EXPECT_EQ(sets.Find(0), sets.Find(3));
  EXPECT_EQ(sets.SizeOf(2), 3U);
  EXPECT_EQ(sets.SizeOf(1), 1U);
}

TEST(FeatureSets, JoiningTwiceChangesNothing) {
  FeatureSets sets(kFeatures);
  EXPECT_EQ(sets.TryJoin(0, 2), Join::kJoined);
  EXPECT_EQ(sets.TryJoin(2, 0), Join::kAlreadyOne);
  EXPECT_EQ(sets.SizeOf(0), 2U);
}

TEST(FeatureSets, RefuseTwoFeaturesOfOneImageEvenAtSecondHand) {
  FeatureSets sets(kFeatures);
  EXPECT_EQ(sets.TryJoin(0, 2), Join::kJoined);
  EXPECT_EQ(sets.TryJoin(1, 3), Join::kJoined);
  EXPECT_EQ(sets.TryJoin(2, 3), Join::kConflict);
  EXPECT_NE(sets.Find(2), sets.Find(3));
}

}  // namespace
}  // namespace orbweave
