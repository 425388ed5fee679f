// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/checks/parted_pairs.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

TwoViewGeometry Pair(uint32_t a, uint32_t b, TwoViewKind kind = TwoViewKind::kGeneral) {
  return {.pair = {ImageId(a), ImageId(b)},
          .kind = kind,
          .b_from_a = {.translation = Eigen::Vector3d(0.1 * a, 0.1 * b, 0.5)}};
}

Reconstruction Submodel(uint32_t first, uint32_t last) {
  Reconstruction submodel;
  for (uint32_t i = first; i <= last; ++i) submodel.images[ImageId(i)] = {};
  return submodel;
}

TEST(PartedPairs, AreGeneralOnesOfWhichNoSubmodelHasBothImages) {
  ClusterProblem problem;
  problem.pairs = {Pair(1, 2),
                   Pair(2, 3),
                   Pair(2, 4, TwoViewKind::kPureRotation),
                   Pair(2, 4),
                   Pair(3, 4),
                   Pair(4, 9)};
  const std::vector<CrossingPair> parted =
      PartedPairs(problem, std::vector{Submodel(1, 2), Submodel(3, 5)});
  ASSERT_EQ(parted.size(), 3U);
  EXPECT_EQ(parted[0].pair, (ImagePair{ImageId(2), ImageId(3)}));
  EXPECT_EQ(parted[1].pair, (ImagePair{ImageId(2), ImageId(4)}));
  EXPECT_EQ(parted[1].b_from_a.translation, problem.pairs[3].b_from_a.translation);
  EXPECT_EQ(parted[2].pair, (ImagePair{ImageId(4), ImageId(9)})) << "9 is in another cluster";
}

}  // namespace
}  // namespace orbweave
