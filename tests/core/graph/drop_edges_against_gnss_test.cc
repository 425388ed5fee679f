// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/drop_edges_against_gnss.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "tests/core/graph/graph_samples.h"

namespace orbweave {
namespace {

constexpr double kStepM = 3.0;
constexpr double kDepthM = 12.0;
constexpr double kSigmaM = 2.0;

/// Two panoramas `apart_m` from each other in a street as wide as the depth.
ViewEdge EdgeOver(uint32_t a, uint32_t b, double apart_m) {
  ViewEdge edge = Edge(a, b);
  edge.median_angle_rad = 2.0 * std::atan(0.5 * apart_m / kDepthM);
  return edge;
}

std::vector<ViewEdge> StraightDrive(uint32_t count) {
  std::vector<ViewEdge> edges;
  for (uint32_t a = 0; a < count; ++a) {
    for (uint32_t b = a + 1; b <= a + 6 && b < count; ++b)
      edges.push_back(EdgeOver(a, b, kStepM * (b - a)));
  }
  return edges;
}

ImageManifest Manifest(uint32_t count) {
  Random random(4);
  ImageManifest manifest;
  for (uint32_t i = 0; i < count; ++i) {
    ImageRecord image{.id = ImageId(i)};
    image.prior.position_in_enu =
        Eigen::Vector3d(kStepM * i + kSigmaM * random.Normal(), kSigmaM * random.Normal(), 0.0);
    image.prior.horizontal_sigma_m = kSigmaM;
    manifest.images.push_back(image);
  }
  return manifest;
}

TEST(DropEdgesAgainstGnss, DropsPlacesThatLookAlikeAndNothingElse) {
  std::vector<ViewEdge> edges = StraightDrive(60);
  const size_t right = edges.size();
  for (uint32_t a = 0; a < 40; ++a) edges.push_back(EdgeOver(a, a + 20, 1.0));
  const SiftedEdges result = DropEdgesAgainstGnss(edges, Manifest(60));
  EXPECT_EQ(result.kept.size(), right);
  ASSERT_EQ(result.dropped.size(), 40U);
  EXPECT_EQ(result.dropped[0].pair, (ImagePair{ImageId(0), ImageId(20)}));
  EXPECT_TRUE(result.dropped[0].reason.starts_with("GNSS puts its images "));
}

TEST(DropEdgesAgainstGnss, BelievesASmoothSequenceBeforeACountOfLookAlikes) {
  std::vector<ViewEdge> edges = StraightDrive(60);
  const size_t right = edges.size();
  for (uint32_t a = 0; a < 60; ++a) {
    for (uint32_t b = a + 20; b < 60; ++b) edges.push_back(EdgeOver(a, b, 1.0));
  }
  ASSERT_GT(edges.size(), 2 * right);
  EXPECT_EQ(DropEdgesAgainstGnss(edges, Manifest(60)).kept.size(), right);
}

TEST(DropEdgesAgainstGnss, TellsHousesApartWherePositionsProveExact) {
  std::vector<ViewEdge> edges = StraightDrive(60);
  const size_t right = edges.size();
  for (uint32_t a = 0; a + 8 < 60; ++a) edges.push_back(EdgeOver(a, a + 8, 1.0));
  ImageManifest manifest = Manifest(60);
  EXPECT_LT(DropEdgesAgainstGnss(edges, manifest).kept.size(), right + 10);
  for (uint32_t i = 0; i < 60; i += 2)
    *manifest.images[i].prior.position_in_enu += Eigen::Vector3d(0.0, 25.0, 0.0);
  EXPECT_GT(DropEdgesAgainstGnss(edges, manifest).kept.size(), right + 30) << "not in zigzags";
}

TEST(DropEdgesAgainstGnss, KeepsAStretchWhoseGnssJumped) {
  const std::vector<ViewEdge> edges = StraightDrive(60);
  ImageManifest manifest = Manifest(60);
  for (uint32_t i = 25; i < 40; ++i)
    *manifest.images[i].prior.position_in_enu += Eigen::Vector3d(0.0, 100.0, 0.0);
  *manifest.images[5].prior.position_in_enu += Eigen::Vector3d(70.0, 0.0, 0.0);
  EXPECT_TRUE(DropEdgesAgainstGnss(edges, manifest).dropped.empty());
}

TEST(DropEdgesAgainstGnss, DropsAChanceMeetingOfTwoStreets) {
  // Two streets that share nothing but a police car, seen from one panorama of each.
  std::vector<ViewEdge> edges;
  for (uint32_t a = 0; a < 60; ++a) {
    for (uint32_t b = a + 1; b <= a + 6 && b < (a < 30 ? 30U : 60U); ++b)
      edges.push_back(EdgeOver(a, b, kStepM * (b - a)));
  }
  const size_t right = edges.size();
  edges.push_back(EdgeOver(10, 50, 1.0));
  ImageManifest manifest = Manifest(60);
  for (uint32_t i = 30; i < 60; ++i) manifest.images[i].prior.position_in_enu->y() += 100.0;
  const SiftedEdges result = DropEdgesAgainstGnss(edges, manifest);
  EXPECT_EQ(result.kept.size(), right);
  ASSERT_EQ(result.dropped.size(), 1U);
  EXPECT_EQ(result.dropped[0].pair, (ImagePair{ImageId(10), ImageId(50)}));
}

TEST(DropEdgesAgainstGnss, KeepsLongBaselinesAndImagesWithoutPosition) {
  std::vector<ViewEdge> edges = StraightDrive(60);
  edges.push_back(EdgeOver(0, 20, 60.0));  // from afar, and the rays say so
  edges.push_back(EdgeOver(1, 41, 1.0));
  ImageManifest manifest = Manifest(60);
  manifest.images[41].prior.position_in_enu.reset();
  EXPECT_TRUE(DropEdgesAgainstGnss(edges, manifest).dropped.empty());
  EXPECT_EQ(DropEdgesAgainstGnss(edges, manifest).kept.size(), edges.size());
}

TEST(DropEdgesAgainstGnss, ChangesNothingWithoutGnss) {
  ImageManifest manifest;
  for (uint32_t i = 0; i < 60; ++i) manifest.images.push_back({.id = ImageId(i)});
  EXPECT_EQ(DropEdgesAgainstGnss(StraightDrive(60), manifest).kept.size(),
            StraightDrive(60).size());
  EXPECT_TRUE(DropEdgesAgainstGnss({}, {}).kept.empty());
}

}  // namespace
}  // namespace orbweave
