// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/positions_by_name.h"

#include <absl/strings/str_format.h>
#include <gtest/gtest.h>

#include "tests/core/graph/graph_samples.h"

namespace orbweave {
namespace {

constexpr double kStep_m = 5.0;
constexpr double kSigma_m = 2.0;

/// A straight street, of which the images [first, last) have no row in the table.
ImageManifest StreetWithout(uint32_t num_images, uint32_t first, uint32_t last) {
  ImageManifest manifest;
  for (uint32_t i = 0; i < num_images; ++i) {
    ImageRecord& image = manifest.images.emplace_back();
    image.id = ImageId(i);
    image.name = absl::StrFormat("street/%04d.jpg", i);
    if (i >= first && i < last) continue;
    image.prior.position_in_enu = Eigen::Vector3d(kStep_m * i, 1.0, 3.0);
    image.prior.horizontal_sigma_m = kSigma_m;
    image.prior.vertical_sigma_m = kSigma_m;
  }
  return manifest;
}

TEST(PlaceByName, PutsARunBetweenThoseBesideIt) {
  ImageManifest manifest = StreetWithout(40, 15, 25);
  PlaceByName(Street(40, 2).edges, manifest);
  for (uint32_t i = 15; i < 25; ++i) {
    const PosePrior& prior = manifest.images[i].prior;
    ASSERT_TRUE(prior.position_in_enu) << i;
    EXPECT_TRUE(prior.position_in_enu->isApprox(Eigen::Vector3d(kStep_m * i, 1.0, 3.0), 1e-9)) << i;
    EXPECT_GT(prior.horizontal_sigma_m, kStep_m) << "steps may be uneven";
    EXPECT_LT(prior.horizontal_sigma_m, 3.0 * kStep_m);
  }
  EXPECT_EQ(manifest.images[14].prior.horizontal_sigma_m, kSigma_m) << "a position stays";
}

TEST(PlaceByName, KnowsLessOfAWayThatLedRoundABlock) {
  ImageManifest manifest = StreetWithout(40, 15, 25);
  for (uint32_t i = 25; i < 40; ++i)  // 14 and 25 stand 10 m apart, eleven steps of 5 m on the way
    manifest.images[i].prior.position_in_enu->x() -= 9.0 * kStep_m;
  PlaceByName(Street(40, 2).edges, manifest);
  EXPECT_GT(manifest.images[20].prior.horizontal_sigma_m, 25.0);
}

TEST(PlaceByName, PutsAnEndBesideTheLastOfWhichAPositionIsKnown) {
  ImageManifest manifest = StreetWithout(20, 16, 20);
  PlaceByName(Street(20, 2).edges, manifest);
  const PosePrior& prior = manifest.images[19].prior;
  ASSERT_TRUE(prior.position_in_enu);
  EXPECT_DOUBLE_EQ(prior.position_in_enu->x(), 15.0 * kStep_m);
  EXPECT_DOUBLE_EQ(prior.horizontal_sigma_m, std::hypot(kSigma_m, 4.0 * kStep_m));
}

TEST(PlaceByName, CountsCapturesThatWereTakenOut) {
  ImageManifest manifest = StreetWithout(30, 10, 13);
  for (uint32_t i = 12; i < 30; ++i)  // two between 11 and 12
    manifest.images[i].name = absl::StrFormat("street/%04d.jpg", i + 2);
  for (uint32_t i = 13; i < 30; ++i) manifest.images[i].prior.position_in_enu->x() += 2.0 * kStep_m;
  PlaceByName(Street(30, 2).edges, manifest);
  EXPECT_NEAR(manifest.images[11].prior.position_in_enu->x(), 11.0 * kStep_m, 1e-9);
  EXPECT_NEAR(manifest.images[12].prior.position_in_enu->x(), 14.0 * kStep_m, 1e-9);
}

TEST(PlaceByName, SaysNothingWhereNoPairsLeadThere) {
  ImageManifest manifest = StreetWithout(40, 15, 25);
  std::vector<ViewEdge> edges = Street(40, 2).edges;
  std::erase_if(edges, [](const ViewEdge& edge) {
    const auto crosses = [&](uint32_t place) {
      return edge.pair.a.value < place && edge.pair.b.value >= place;
    };
    return crosses(15) || crosses(20) || crosses(25);
  });
  PlaceByName(edges, manifest);
  for (uint32_t i = 15; i < 25; ++i) EXPECT_FALSE(manifest.images[i].prior.position_in_enu) << i;
}

TEST(PlaceByName, SaysNothingAcrossFoldersNorWithoutAnyPosition) {
  ImageManifest manifest = StreetWithout(40, 15, 25);
  for (uint32_t i = 15; i < 25; ++i) manifest.images[i].name.insert(0, "another");
  PlaceByName(Street(40, 2).edges, manifest);
  EXPECT_FALSE(manifest.images[20].prior.position_in_enu);
  ImageManifest none = StreetWithout(40, 0, 40);
  PlaceByName(Street(40, 2).edges, none);
  EXPECT_FALSE(none.images[20].prior.position_in_enu);
}

}  // namespace
}  // namespace orbweave
