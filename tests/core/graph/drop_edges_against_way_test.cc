// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/drop_edges_against_way.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/core/graph/bending_drive.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

std::set<ImagePair> DroppedOf(const std::vector<ViewEdge>& edges, const ImageManifest& manifest) {
  const SiftedEdges result = DropEdgesAgainstWay(edges, manifest);
  EXPECT_EQ(result.kept.size() + result.dropped.size(), edges.size());
  for (const DroppedEdge& edge : result.dropped) EXPECT_EQ(edge.cause, DropCause::kSequence);
  return PairsOf(result.dropped);
}

ImagePair Pair(uint32_t a, uint32_t b) { return {ImageId(a), ImageId(b)}; }

/// Positions say nothing here.
BendingDrive WithoutGnss(uint32_t count, uint64_t seed) {
  BendingDrive drive(count, seed);
  for (ImageRecord& image : drive.manifest.images) image.prior.position_in_enu.reset();
  return drive;
}

TEST(DropEdgesAgainstWay, DropsWhatLeadsBackAndNothingElse) {
  // Both nearest edges of image 5 among them.
  const std::set<ImagePair> backward = {
      Pair(4, 5), Pair(5, 6), Pair(12, 13), Pair(20, 22), Pair(17, 18)};
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const BendingDrive drive = WithoutGnss(30, seed);
    EXPECT_EQ(DroppedOf(drive.Edges(3, backward), drive.manifest), backward) << seed;
    EXPECT_TRUE(DroppedOf(drive.Edges(2, {}), drive.manifest).empty()) << seed;
  }
}

TEST(DropEdgesAgainstWay, FollowsTimesAndNotIds) {
  const BendingDrive drive = WithoutGnss(30, 1);
  BendingDrive reversed = drive;
  for (ImageRecord& image : reversed.manifest.images)
    image.capture_time_s = 100.0 - static_cast<double>(image.id.value);
  const std::set<ImagePair> backward = {Pair(4, 5), Pair(12, 13)};
  EXPECT_EQ(DroppedOf(reversed.Edges(3, backward), reversed.manifest), backward);
}

/// A dead end: what leads back after it leads onward.
TEST(DropEdgesAgainstWay, KeepsTheEdgesOfADriveThatTurnsRound) {
  for (uint64_t seed = 0; seed < 10; ++seed) {
    const BendingDrive there = WithoutGnss(15, seed);
    BendingDrive drive = there;
    for (uint32_t i = 0; i < 13; ++i) {
      drive.cams_from_world.push_back(there.cams_from_world[13 - i]);
      drive.manifest.images.push_back({.id = ImageId(15 + i)});
    }
    std::vector<ViewEdge> edges = drive.Edges(3, {});
    std::erase_if(edges, [&](const ViewEdge& edge) {  // images of one place show no direction
      return (drive.cams_from_world[edge.pair.a.value].Centre() -
              drive.cams_from_world[edge.pair.b.value].Centre())
                 .norm() < 1.0;
    });
    EXPECT_TRUE(DroppedOf(edges, drive.manifest).empty()) << seed;
  }
}

/// Names in no order of the street: most images have no edge with the next one.
TEST(DropEdgesAgainstWay, SaysNothingOfImagesInNoOrder) {
  const BendingDrive drive = WithoutGnss(30, 4);
  BendingDrive mixed = drive;
  for (uint32_t i = 0; i < 30; ++i) mixed.cams_from_world[i] = drive.cams_from_world[(7 * i) % 30];
  std::vector<ViewEdge> edges;
  for (uint32_t a = 0; a < 30; ++a) {
    for (uint32_t b = a + 1; b < 30; ++b) {
      if ((mixed.cams_from_world[a].Centre() - mixed.cams_from_world[b].Centre()).norm() < 26.0)
        edges.push_back(mixed.TrueEdge(a, b));
    }
  }
  EXPECT_TRUE(DroppedOf(edges, mixed.manifest).empty());
  EXPECT_TRUE(DroppedOf({}, {}).empty());
}

/// A drive that was left off twice, for so many images each. What it took up elsewhere looks like
/// the street ahead of where it was left off, seen from the other side: these pairs go on along a
/// way that nobody drove.
TEST(DropEdgesAgainstWay, KeepsTheEdgesOfADriveThatWasLeftOffAndTakenUpElsewhere) {
  constexpr uint32_t kMissing = 15;
  BendingDrive drive(50);  // 0 to 12, 28 to 30, 46 to 49
  BendingDrive alike = drive;
  for (uint32_t i = 28; i < 50; ++i) {
    const uint32_t missing = i < 46 ? kMissing : 2 * kMissing;
    const Eigen::AngleAxisd other_side(-0.05 * missing - 3.14159265, Vector3d::UnitZ());
    alike.cams_from_world[i] = Rigid3::FromCentre(drive.cams_from_world[i].rotation * other_side,
                                                  drive.cams_from_world[i - missing].Centre());
  }
  const auto is_missing = [](uint32_t i) { return (i > 12 && i < 28) || (i > 30 && i < 46); };
  for (ImageRecord& image : drive.manifest.images) {
    image.drive = is_missing(image.id.value) ? 1 : 0;
    image.name = std::to_string(image.id.value) + ".jpg";
  }
  std::vector<ViewEdge> edges = drive.Edges(3, {});
  std::erase_if(edges, [&](const ViewEdge& edge) {
    return is_missing(edge.pair.a.value) || is_missing(edge.pair.b.value);
  });
  for (const uint32_t later : {28U, 29U, 30U}) {
    for (uint32_t i = 8; i < 13; ++i) edges.push_back(alike.TrueEdge(i, later));
    for (uint32_t i = 46; i < 50; ++i) edges.push_back(alike.TrueEdge(later, i));
  }
  EXPECT_TRUE(DroppedOf(edges, drive.manifest).empty());
}

TEST(DropEdgesAgainstWay, SaysNothingOfThinEndsAndPureRotations) {
  const BendingDrive drive = WithoutGnss(4, 2);
  EXPECT_TRUE(DroppedOf({drive.TrueEdge(0, 1), drive.BackwardEdge(1, 2), drive.TrueEdge(2, 3)},
                        drive.manifest)
                  .empty());
  const BendingDrive longer = WithoutGnss(30, 2);
  std::vector<ViewEdge> edges = longer.Edges(3, {Pair(12, 13)});
  for (ViewEdge& edge : edges) {
    if (edge.pair == Pair(12, 13)) edge.kind = TwoViewKind::kPureRotation;
  }
  EXPECT_TRUE(DroppedOf(edges, longer.manifest).empty());
}

}  // namespace
}  // namespace orbweave
