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
  const SiftedEdges result = DropEdgesAgainstHeadings(edges, manifest);
  EXPECT_EQ(result.kept.size() + result.dropped.size(), edges.size());
  return PairsOf(result.dropped);
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

/// Houses that look alike: a pair of far images with a geometry that has nothing to do with where
/// they are, a quarter turn off or none.
ViewEdge LookAlike(const BendingDrive& drive, uint32_t a, uint32_t b, Random& random) {
  ViewEdge edge = drive.TrueEdge(a, b);
  const double quarters = std::floor(random.Uniform(0.0, 4.0));
  edge.b_from_a.rotation =
      Eigen::Quaterniond(Eigen::AngleAxisd(quarters * std::numbers::pi / 2.0, Vector3d::UnitY())) *
      edge.b_from_a.rotation;
  const double azimuth = random.Uniform(-std::numbers::pi, std::numbers::pi);
  edge.b_from_a.translation = Vector3d(std::sin(azimuth), 0.0, std::cos(azimuth));
  return edge;
}

TEST(DropEdgesAgainstHeadings, DropsMostLookAlikesAndNothingElse) {
  size_t found = 0;
  size_t all = 0;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const BendingDrive drive(30, seed);
    std::vector<ViewEdge> edges = drive.Edges(3, {});
    std::set<ImagePair> alike;
    Random random(seed);
    for (uint32_t a = 0; a < 24; a += 2) {
      for (const uint32_t b : {a + 6, (a + 11) % 30}) {
        edges.push_back(LookAlike(drive, std::min(a, b), std::max(a, b), random));
        alike.insert(edges.back().pair);
      }
    }
    const std::set<ImagePair> dropped = DroppedOf(edges, drive.manifest);
    EXPECT_TRUE(std::ranges::includes(alike, dropped)) << seed;
    found += dropped.size();
    all += alike.size();
  }
  // One in four has the right rotation, and of these one in four leads where it should by chance.
  EXPECT_GE(static_cast<double>(found), 0.9 * static_cast<double>(all));
}

TEST(DropEdgesAgainstHeadings, LookAlikesAndPositionsThatAreOffTogetherCostNoRightEdge) {
  size_t lost = 0;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    BendingDrive drive(40, seed);
    std::vector<ViewEdge> edges = drive.Edges(4, {});
    std::set<ImagePair> alike;
    Random random(seed);
    for (uint32_t a = 0; a < 30; a += 3) {
      edges.push_back(LookAlike(drive, a, a + 8, random));
      alike.insert(edges.back().pair);
    }
    for (const uint32_t image : {7U, 8U, 9U, 21U, 23U, 33U}) {
      const double angle = random.Uniform(-std::numbers::pi, std::numbers::pi);
      *drive.manifest.images[image].prior.position_in_enu +=
          random.Uniform(15.0, 60.0) * Vector3d(std::cos(angle), std::sin(angle), 0.0);
    }
    for (const ImagePair& pair : DroppedOf(edges, drive.manifest)) lost += !alike.contains(pair);
  }
  EXPECT_LT(lost, 8U) << "of 2,920 edges, 960 of them of positions that are off";
}

/// Two days of one street whose receivers disagree by more than they say.
TEST(DropEdgesAgainstHeadings, KeepsTwoDrivesThatGnssPutsBesideEachOther) {
  for (uint64_t seed = 0; seed < 10; ++seed) {
    const BendingDrive first(30, seed);
    const BendingDrive second(30, seed + 100);
    BendingDrive both(0);
    for (const BendingDrive* drive : {&first, &second}) {
      for (uint32_t i = 0; i < 30; ++i) {
        both.cams_from_world.push_back(drive->cams_from_world[i]);
        ImageRecord image = drive->manifest.images[i];
        image.id = ImageId(static_cast<uint32_t>(both.manifest.images.size()));
        image.drive = drive == &first ? 0 : 1;
        if (drive == &second) *image.prior.position_in_enu += Vector3d(7.0, -7.0, 0.0);
        both.manifest.images.push_back(image);
      }
    }
    std::vector<ViewEdge> edges;
    for (const uint32_t drive : {0U, 30U}) {
      for (uint32_t a = 0; a < 30; ++a) {
        for (uint32_t b = a + 1; b <= a + 3 && b < 30; ++b)
          edges.push_back(both.TrueEdge(drive + a, drive + b));
      }
    }
    for (uint32_t a = 0; a < 29; ++a) edges.push_back(both.TrueEdge(a, 30 + a + 1));
    EXPECT_TRUE(DroppedOf(edges, both.manifest).empty()) << seed;
  }
}

}  // namespace
}  // namespace orbweave
