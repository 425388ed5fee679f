// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/map_of_planes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/dense/equiangular_raster.h"

namespace orbweave {
namespace {

constexpr int kSize = 16;
constexpr float kSigma = 0.002F;

/// Every pixel's own match says 5 m along z of its face; a plane of the surroundings, 3 m or 5 m
/// away along the camera's z, says something of the front face.
struct Scene {
  ReferenceRaster raster{.face_px = kSize};
  PlaneField field{kSize};
  PlanarPrior prior{.face_px = kSize / 2};

  Scene(float cost, float prior_m, float texture) {
    for (int k = 0; k < raster.Stride(); ++k)
      raster.tangents.push_back(0.05F * static_cast<float>(k - raster.Stride() / 2));
    std::ranges::fill(field.z, 1.0F / 5.0F);
    std::ranges::fill(field.cost, cost);
    std::ranges::fill(field.sigma, kSigma);
    prior.planes = {Eigen::Vector3f(0.0F, 0.0F, 1.0F / prior_m)};
    prior.errors = {{.relief_m = 0.014F}};
    prior.labels.assign(EquiangularRaster{kSize / 2}.NumPixels(), 0);
    prior.texture.assign(EquiangularRaster{kSize / 4}.NumPixels(), texture);
  }

  /// The middle of the face that looks along the camera's z.
  struct Answer {
    float range_m = 0.0F;
    bool prior_only = false;
    float sigma_m = 0.0F;
  };
  [[nodiscard]] Answer Middle() const {
    const DepthMap map = MapOfPlanes(raster, field, prior, {0.5F, 50.0F}, {});
    const EquiangularRaster places{kSize};
    const size_t k = places.Index(places.PixelFromBearing({0.01, 0.01, 1.0}));
    return {map.range_m[k], (map.flags[k] & kDepthPriorOnly) != 0, map.sigma_m[k]};
  }
};

constexpr float kGood = 0.1F;
constexpr float kWeak = 0.6F;  // correlates at 0.4: not enough to stand alone
constexpr float kNone = 0.9F;
constexpr float kMuchTexture = 100.0F;
constexpr float kNoTexture = 1.0F;

TEST(MapOfPlanes, BelievesAGoodMatchRatherThanAPlaneWhereThereIsTexture) {
  const Scene::Answer answer = Scene(kGood, 3.0F, kMuchTexture).Middle();
  EXPECT_NEAR(answer.range_m, 5.0F, 0.1F);
  EXPECT_FALSE(answer.prior_only);
}

TEST(MapOfPlanes, BelievesAPlaneRatherThanAMatchWhereThereIsNoTexture) {
  const Scene::Answer answer = Scene(kGood, 3.0F, kNoTexture).Middle();
  EXPECT_NEAR(answer.range_m, 3.0F, 0.1F);
  EXPECT_TRUE(answer.prior_only);
}

TEST(MapOfPlanes, HasNothingWhereAWeakMatchContradictsAPlaneOnTexture) {
  EXPECT_EQ(Scene(kWeak, 3.0F, kMuchTexture).Middle().range_m, 0.0F);
  EXPECT_NEAR(Scene(kNone, 3.0F, kMuchTexture).Middle().range_m, 3.0F, 0.1F);
}

TEST(MapOfPlanes, AWeakMatchThatAgreesLeavesThePlanesRange) {
  const Scene::Answer weak = Scene(kWeak, 5.0F, kMuchTexture).Middle();
  EXPECT_NEAR(weak.range_m, 5.0F, 0.1F);
  EXPECT_TRUE(weak.prior_only);
  EXPECT_FALSE(Scene(kGood, 5.0F, kMuchTexture).Middle().prior_only);
}

TEST(MapOfPlanes, DoubtsAMatchByWhatAPlaneNearbyContradicts) {
  const Scene::Answer near = Scene(kGood, 5.15F, kMuchTexture).Middle();
  EXPECT_NEAR(near.range_m, 5.0F, 0.01F);
  EXPECT_NEAR(near.sigma_m, 0.15F, 0.01F);
  // What stands well before a wall is not the wall.
  EXPECT_NEAR(Scene(kGood, 6.0F, kMuchTexture).Middle().sigma_m, 5.0F * kSigma, 0.001F);
}

}  // namespace
}  // namespace orbweave
