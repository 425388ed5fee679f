// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/drop_edges_against_headings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "tests/core/graph/bending_drive.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

std::set<ImagePair> DroppedOf(const std::vector<ViewEdge>& edges, const ImageManifest& manifest) {
  const EdgesByGnss result = DropEdgesAgainstHeadings(edges, manifest);
  EXPECT_EQ(result.kept.size() + result.dropped.size(), edges.size());
  std::set<ImagePair> pairs;
  for (const DroppedEdge& edge : result.dropped) pairs.insert(edge.pair);
  return pairs;
}

const std::set<ImagePair> kBackward = {
    {ImageId(5), ImageId(6)}, {ImageId(12), ImageId(13)}, {ImageId(20), ImageId(22)}};

TEST(DropEdgesAgainstHeadings, DropsExactlyThoseThatLeadTheOtherWay) {
  size_t of_thin_streets = 0;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const BendingDrive drive(30, seed);
    const std::set<ImagePair> dropped = DroppedOf(drive.Edges(2, kBackward), drive.manifest);
    EXPECT_TRUE(std::ranges::includes(kBackward, dropped)) << seed;
    of_thin_streets += dropped.size();
    EXPECT_EQ(DroppedOf(drive.Edges(4, kBackward), drive.manifest), kBackward) << seed;
    EXPECT_TRUE(DroppedOf(drive.Edges(3, {}), drive.manifest).empty()) << seed;
  }
  EXPECT_GE(of_thin_streets, 58U) << "of 60";
}

TEST(DropEdgesAgainstHeadings, DropsBothEdgesOfAnImageThatLeadTheOtherWayWherePositionsAreSmooth) {
  const std::set<ImagePair> backward = {{ImageId(14), ImageId(15)}, {ImageId(15), ImageId(16)}};
  size_t found = 0;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const BendingDrive drive(30, seed);
    const std::set<ImagePair> dropped = DroppedOf(drive.Edges(3, backward), drive.manifest);
    EXPECT_TRUE(std::ranges::includes(backward, dropped)) << seed;
    found += dropped.size();
  }
  EXPECT_GE(found, 36U) << "of 40";
}

TEST(DropEdgesAgainstHeadings, KeepsTheEdgesOfPositionsThatAreOff) {
  Random random(3);
  size_t lost = 0;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    BendingDrive drive(30, seed);
    for (const uint32_t image : {4U, 11U, 23U}) {
      const double angle = random.Uniform(-std::numbers::pi, std::numbers::pi);
      *drive.manifest.images[image].prior.position_in_enu +=
          random.Uniform(15.0, 60.0) * Vector3d(std::cos(angle), std::sin(angle), 0.0);
    }
    lost += DroppedOf(drive.Edges(3, {}), drive.manifest).size();
  }
  EXPECT_LT(lost, 6U) << "of the 360 edges of 60 such positions";
}

TEST(DropEdgesAgainstHeadings, SaysNothingWherePositionsAreMissingNearOrNoBetterThanTheSteps) {
  BendingDrive drive(30);
  const std::vector<ViewEdge> edges = drive.Edges(2, kBackward);
  for (ImageRecord& image : drive.manifest.images) image.prior.horizontal_sigma_m = 8.0;
  EXPECT_TRUE(DroppedOf(edges, drive.manifest).empty());
  for (ImageRecord& image : drive.manifest.images) image.prior.position_in_enu.reset();
  EXPECT_TRUE(DroppedOf(edges, drive.manifest).empty());
  EXPECT_TRUE(DroppedOf({}, {}).empty());
}

TEST(DropEdgesAgainstHeadings, SaysNothingOfALonelyPairAndOfPureRotations) {
  const BendingDrive drive(3);
  EXPECT_TRUE(DroppedOf({drive.BackwardEdge(0, 1)}, drive.manifest).empty());
  const BendingDrive longer(30);
  std::vector<ViewEdge> edges = longer.Edges(2, kBackward);
  for (ViewEdge& edge : edges) {
    if (!kBackward.contains(edge.pair)) continue;
    edge.kind = TwoViewKind::kPureRotation;
    edge.b_from_a.translation.setZero();
  }
  EXPECT_TRUE(DroppedOf(edges, longer.manifest).empty());
}

}  // namespace
}  // namespace orbweave
