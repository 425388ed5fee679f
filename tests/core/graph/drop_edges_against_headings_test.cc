// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/drop_edges_against_headings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/base/random.h"
#include "core/geometry/rotation.h"
#include "tests/core/graph/graph_samples.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kStep_m = 8.0;
constexpr double kSigma_m = 1.0;

/// A drive round a wide bend, with cameras that look anywhere and stand upright to a few degrees.
struct Drive {
  std::vector<Rigid3> cams_from_world{};
  ImageManifest manifest{};

  explicit Drive(uint32_t count, uint64_t seed = 5) {
    Random random(seed);
    // World: east, north, up; cameras: right, down, forward.
    const Eigen::Quaterniond level((Eigen::Matrix3d() << 1, 0, 0, 0, 0, -1, 0, 1, 0).finished());
    for (uint32_t i = 0; i < count; ++i) {
      const double angle = 0.05 * i;
      const Vector3d centre = 160.0 * Vector3d(std::sin(angle), std::cos(angle), 0.0);
      const Eigen::Quaterniond turn(
          Eigen::AngleAxisd(random.Uniform(-3.0, 3.0), Vector3d::UnitY()));
      const Eigen::Quaterniond tilt =
          RotationFromVector(0.03 * Vector3d(random.Normal(), random.Normal(), random.Normal()));
      cams_from_world.push_back(Rigid3::FromCentre((tilt * turn * level).normalized(), centre));
      ImageRecord image{.id = ImageId(i)};
      image.prior.position_in_enu =
          centre + kSigma_m * Vector3d(random.Normal(), random.Normal(), random.Normal());
      image.prior.horizontal_sigma_m = kSigma_m;
      manifest.images.push_back(image);
    }
  }

  [[nodiscard]] ViewEdge TrueEdge(uint32_t a, uint32_t b) const {
    ViewEdge edge = Edge(a, b);
    edge.b_from_a = cams_from_world[b] * cams_from_world[a].Inverse();
    edge.b_from_a.translation.normalize();
    return edge;
  }

  /// Every window taken for the next: the right rotation, backwards.
  [[nodiscard]] ViewEdge BackwardEdge(uint32_t a, uint32_t b) const {
    ViewEdge edge = TrueEdge(a, b);
    edge.b_from_a.translation *= -1.0;
    return edge;
  }

  [[nodiscard]] std::vector<ViewEdge> Edges(uint32_t window,
                                            const std::set<ImagePair>& backward) const {
    std::vector<ViewEdge> edges;
    const auto count = static_cast<uint32_t>(cams_from_world.size());
    for (uint32_t a = 0; a < count; ++a) {
      for (uint32_t b = a + 1; b <= a + window && b < count; ++b) {
        const bool is_backward = backward.contains({ImageId(a), ImageId(b)});
        edges.push_back(is_backward ? BackwardEdge(a, b) : TrueEdge(a, b));
      }
    }
    return edges;
  }
};

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
    const Drive drive(30, seed);
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
    const Drive drive(30, seed);
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
    Drive drive(30, seed);
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
  Drive drive(30);
  const std::vector<ViewEdge> edges = drive.Edges(2, kBackward);
  for (ImageRecord& image : drive.manifest.images) image.prior.horizontal_sigma_m = 8.0;
  EXPECT_TRUE(DroppedOf(edges, drive.manifest).empty());
  for (ImageRecord& image : drive.manifest.images) image.prior.position_in_enu.reset();
  EXPECT_TRUE(DroppedOf(edges, drive.manifest).empty());
  EXPECT_TRUE(DroppedOf({}, {}).empty());
}

TEST(DropEdgesAgainstHeadings, SaysNothingOfALonelyPairAndOfPureRotations) {
  const Drive drive(3);
  EXPECT_TRUE(DroppedOf({drive.BackwardEdge(0, 1)}, drive.manifest).empty());
  const Drive longer(30);
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
