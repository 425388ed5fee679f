// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/scene/ids.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

TEST(ImagePair, IsOrderedWhenMade) {
  EXPECT_EQ(MakePair(ImageId(7), ImageId(2)), (ImagePair{ImageId(2), ImageId(7)}));
  EXPECT_EQ(MakePair(ImageId(2), ImageId(7)), MakePair(ImageId(7), ImageId(2)));
}

TEST(FeatureRef, SortsByImageThenFeature) {
  EXPECT_LT((FeatureRef{ImageId(1), 9}), (FeatureRef{ImageId(2), 0}));
  EXPECT_LT((FeatureRef{ImageId(1), 3}), (FeatureRef{ImageId(1), 4}));
}

TEST(FeatureMatch, SortsByFirstThenSecondFeature) {
  EXPECT_LT((FeatureMatch{1, 9}), (FeatureMatch{2, 0}));
  EXPECT_LT((FeatureMatch{1, 3}), (FeatureMatch{1, 4}));
}

}  // namespace
}  // namespace orbweave
