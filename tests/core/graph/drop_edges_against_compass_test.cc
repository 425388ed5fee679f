// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/drop_edges_against_compass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "tests/core/graph/bending_drive.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr uint32_t kCount = 30;

/// States the headings of the cameras, 5 degrees off.
void StateHeadings(BendingDrive& drive, uint64_t seed) {
  Random random(seed);
  for (ImageRecord& image : drive.manifest.images) {
    const Rigid3& cam = drive.cams_from_world[image.id.value];
    const Vector3d forward = cam.rotation.conjugate() * Vector3d::UnitZ();
    image.prior.heading_deg =
        std::atan2(forward.x(), forward.y()) * 180.0 / std::numbers::pi + 5.0 * random.Normal();
  }
}

/// A house that repeats round the corner: a quarter turn too many.
std::set<ImagePair> TurnSome(std::vector<ViewEdge>& edges) {
  std::set<ImagePair> turned;
  const Eigen::Quaterniond quarter(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3d::UnitY()));
  for (size_t e = 2; e < edges.size(); e += 9) {
    edges[e].b_from_a.rotation = quarter * edges[e].b_from_a.rotation;
    turned.insert(edges[e].pair);
  }
  return turned;
}

std::set<ImagePair> DroppedOf(const std::vector<ViewEdge>& edges, const ImageManifest& manifest) {
  const SiftedEdges result = DropEdgesAgainstCompass(edges, manifest);
  EXPECT_EQ(result.kept.size() + result.dropped.size(), edges.size());
  return PairsOf(result.dropped);
}

TEST(DropEdgesAgainstCompass, DropsExactlyThoseThatTurnOtherwise) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    BendingDrive drive(kCount, seed);
    StateHeadings(drive, seed);
    std::vector<ViewEdge> edges = drive.Edges(3, {});
    const std::set<ImagePair> turned = TurnSome(edges);
    EXPECT_EQ(DroppedOf(edges, drive.manifest), turned) << "seed " << seed;
  }
}

TEST(DropEdgesAgainstCompass, DoesNotCareWhereNorthIs) {
  BendingDrive drive(kCount);
  StateHeadings(drive, 1);
  std::vector<ViewEdge> edges = drive.Edges(3, {});
  const std::set<ImagePair> turned = TurnSome(edges);
  for (ImageRecord& image : drive.manifest.images) *image.prior.heading_deg += 170.0;
  EXPECT_EQ(DroppedOf(edges, drive.manifest), turned);
}

TEST(DropEdgesAgainstCompass, DoesNotBelieveHeadingsOfTheWay) {
  BendingDrive drive(kCount);  // whose cameras look anywhere
  for (ImageRecord& image : drive.manifest.images)
    image.prior.heading_deg = 90.0 + 3.0 * image.id.value;
  EXPECT_TRUE(DroppedOf(drive.Edges(3, {}), drive.manifest).empty());
}

TEST(DropEdgesAgainstCompass, KeepsWhatJoinsDrivesWhoseCamerasAreMountedOtherwise) {
  BendingDrive drive(kCount);
  StateHeadings(drive, 4);
  for (ImageRecord& image : drive.manifest.images) {
    image.drive = image.id.value % 2;
    if (image.drive == 1) *image.prior.heading_deg += 180.0;
  }
  EXPECT_TRUE(DroppedOf(drive.Edges(4, {}), drive.manifest).empty());
}

TEST(DropEdgesAgainstCompass, DoesNotBelieveACompassBesideIron) {
  for (const double off_deg : {-130.0, -60.0, 45.0, 58.0, 140.0}) {
    BendingDrive drive(kCount);
    StateHeadings(drive, 6);
    *drive.manifest.images[12].prior.heading_deg += off_deg;
    EXPECT_TRUE(DroppedOf(drive.Edges(3, {}), drive.manifest).empty()) << off_deg;
  }
}

TEST(DropEdgesAgainstCompass, BelievesItWhereEdgesDisagreeByAQuarterTurnOrEachOtherwise) {
  BendingDrive drive(kCount);
  StateHeadings(drive, 7);
  std::set<ImagePair> of_image;
  const std::vector<ViewEdge> edges = drive.Edges(3, {});
  for (const ViewEdge& edge : edges) {
    if (edge.pair.a == ImageId(12) || edge.pair.b == ImageId(12)) of_image.insert(edge.pair);
  }
  for (const double off_deg : {-90.0, 80.0, 180.0}) {
    BendingDrive turned = drive;
    *turned.manifest.images[12].prior.heading_deg += off_deg;
    EXPECT_EQ(DroppedOf(edges, turned.manifest), of_image) << off_deg;
  }
  std::vector<ViewEdge> scattered = edges;
  double by_rad = 1.0;
  for (ViewEdge& edge : scattered) {
    if (!of_image.contains(edge.pair)) continue;
    edge.b_from_a.rotation = Eigen::AngleAxisd(by_rad, Vector3d::UnitY()) * edge.b_from_a.rotation;
    by_rad += 0.7;
  }
  EXPECT_EQ(DroppedOf(scattered, drive.manifest), of_image);
}

TEST(DropEdgesAgainstCompass, NeedsHeadings) {
  const BendingDrive drive(kCount);
  std::vector<ViewEdge> edges = drive.Edges(3, {});
  TurnSome(edges);
  EXPECT_TRUE(DroppedOf(edges, drive.manifest).empty());
  BendingDrive few(4);
  StateHeadings(few, 2);
  std::vector<ViewEdge> few_edges = few.Edges(3, {});
  TurnSome(few_edges);
  EXPECT_TRUE(DroppedOf(few_edges, few.manifest).empty());
}

}  // namespace
}  // namespace orbweave
