// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "core/geometry/rotation.h"
#include "core/synthetic/corridor.h"
#include "core/synthetic/make_corridor.h"

namespace orbweave {
namespace {

TEST(CorridorHardships, UturnsComeBackAndSeeTheSamePoints) {
  const Corridor corridor = MakeCorridor({.panoramas = 60, .shape = CorridorShape::kUturn});
  const Eigen::Vector3d out = corridor.cams_from_world[10].Centre();
  const Eigen::Vector3d back = corridor.cams_from_world[49].Centre();
  EXPECT_LT((out - back).norm(), 7.0);
  const Eigen::Vector3d forward_out =
      corridor.cams_from_world[10].rotation.conjugate() * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d forward_back =
      corridor.cams_from_world[49].rotation.conjugate() * Eigen::Vector3d::UnitZ();
  EXPECT_LT(forward_out.dot(forward_back), -0.99);
  EXPECT_TRUE(
      std::any_of(corridor.pairs.begin(), corridor.pairs.end(), [](const PairMatches& pair) {
        return pair.pair.a.value == 10 && pair.pair.b.value >= 45;
      }));
}

TEST(CorridorHardships, StopsForSoManyPanoramasWithinMillimetres) {
  const Corridor corridor = MakeCorridor({.panoramas = 40, .stop_panoramas = 10});
  int standing = 0;
  for (size_t i = 1; i < 40; ++i) {
    const Rigid3& cam = corridor.cams_from_world[i];
    const Rigid3& before = corridor.cams_from_world[i - 1];
    const double step_m = (cam.Centre() - before.Centre()).norm();
    if (step_m > 1.0) continue;
    ++standing;
    EXPECT_GT(step_m, 0.0);
    EXPECT_LT(step_m, 0.02);
    EXPECT_LT(RotationAngle(cam.rotation * before.rotation.conjugate()), 0.002);
  }
  EXPECT_EQ(standing, 9);
}

TEST(CorridorHardships, TunnelsHaveFewFeaturesOfLittleParallax) {
  const Corridor corridor = MakeCorridor({.panoramas = 60, .tunnel_panoramas = 24});
  for (uint32_t i = 26; i < 34; ++i) {
    EXPECT_NEAR(static_cast<double>(corridor.features[i].size()), 40.0, 20.0) << i;
    const Eigen::Vector3d along =
        (corridor.cams_from_world[i + 1].Centre() - corridor.cams_from_world[i].Centre())
            .normalized();
    for (const uint32_t point : corridor.point_of_feature[i]) {
      const Eigen::Vector3d ray =
          corridor.points_in_world[point] - corridor.cams_from_world[i].Centre();
      EXPECT_GT(std::abs(ray.normalized().dot(along)), 0.8);
    }
  }
  EXPECT_GT(corridor.features[5].size(), 400U);
}

std::vector<Eigen::Vector3d> GnssErrors(const Corridor& corridor) {
  std::vector<Eigen::Vector3d> errors;
  for (const ImageRecord& image : corridor.manifest.images) {
    errors.emplace_back(*image.prior.position_in_enu -
                        corridor.cams_from_world[image.id.value].Centre());
  }
  return errors;
}

TEST(CorridorHardships, CarriersClimbHillsAndLeanWithThem) {
  const CorridorOptions options{
      .panoramas = 200, .shape = CorridorShape::kGrid, .hill_grade = 0.15, .hill_length_m = 300.0};
  const Corridor hilly = MakeCorridor(options);
  const Corridor flat = MakeCorridor({.panoramas = 200, .shape = CorridorShape::kGrid});
  double steepest = 0.0;
  for (size_t i = 0; i + 1 < hilly.cams_from_world.size(); ++i) {
    const Rigid3& cam = hilly.cams_from_world[i];
    const Eigen::Vector3d centre = cam.Centre();
    EXPECT_LT((centre - flat.cams_from_world[i].Centre()).head<2>().norm(), 1e-9);
    const Eigen::Vector3d step = hilly.cams_from_world[i + 1].Centre() - centre;
    const double slope = step.z() / step.head<2>().norm();
    steepest = std::max(steepest, std::abs(slope));
    const Eigen::Vector3d forward = cam.rotation.conjugate() * Eigen::Vector3d::UnitZ();
    EXPECT_NEAR(std::asin(forward.z()), std::atan(slope), 0.08) << i;  // sway, and a step
  }
  EXPECT_GT(steepest, 0.09);
  EXPECT_LE(steepest, 0.15);
  for (size_t i = 0; i < hilly.cams_from_world.size(); i += 20) {
    ASSERT_EQ(hilly.point_of_feature[i], flat.point_of_feature[i]);
    for (size_t f = 0; f < hilly.point_of_feature[i].size(); f += 50) {
      const uint32_t point = hilly.point_of_feature[i][f];
      const Features& features = hilly.features[i];
      const Eigen::Vector3d seen =
          (hilly.cams_from_world[i] * hilly.points_in_world[point]).normalized();
      const Keypoint& keypoint = features.keypoints[f];
      const Eigen::Vector3d ray = features.camera.BearingFromPixel({keypoint.x_px, keypoint.y_px});
      EXPECT_LT(AngleBetween(seen, ray), 5.0 * features.camera.AngleFromPixels(options.noise_px));
    }
  }
}

TEST(CorridorHardships, GnssRepeatsWhatItSaid) {
  const Corridor corridor = MakeCorridor({.panoramas = 20, .gnss_held_panoramas = 6, .drives = 2});
  const std::vector<ImageRecord>& images = corridor.manifest.images;
  for (size_t i = 1; i < images.size(); ++i) {
    const bool is_held = i % 6 != 0 && images[i].drive == images[i - 1].drive;
    EXPECT_EQ(*images[i].prior.position_in_enu == *images[i - 1].prior.position_in_enu, is_held)
        << i;
  }
}

TEST(CorridorHardships, PositionsMayHaveNoHeights) {
  const Corridor with = MakeCorridor({.panoramas = 5, .hill_grade = 0.1});
  const Corridor without = MakeCorridor({.panoramas = 5, .gnss_heights = false, .hill_grade = 0.1});
  for (size_t i = 0; i < 5; ++i) {
    const PosePrior& known = with.manifest.images[i].prior;
    const PosePrior& unknown = without.manifest.images[i].prior;
    EXPECT_TRUE(IsHeightKnown(known.vertical_sigma_m));
    EXPECT_FALSE(IsHeightKnown(unknown.vertical_sigma_m));
    EXPECT_EQ(unknown.position_in_enu->z(), 0.0);
    EXPECT_EQ(unknown.position_in_enu->head<2>(), known.position_in_enu->head<2>());
  }
}

TEST(CorridorHardships, GnssJumpsOnceAndTogether) {
  const auto errors = GnssErrors(MakeCorridor(
      {.panoramas = 30, .gnss_sigma_m = 0.01, .gnss_jump_panoramas = 10, .gnss_jump_m = 100.0}));
  for (size_t i = 0; i < 30; ++i) {
    const bool jumped = i >= 10 && i < 20;
    EXPECT_NEAR(errors[i].norm(), jumped ? 100.0 : 0.0, 0.1) << i;
    if (jumped) {
      EXPECT_LT((errors[i] - errors[10]).norm(), 0.1);
    }
  }
}

TEST(CorridorHardships, DrivesShareTheStreetAndTheLastingPointsAlone) {
  const Corridor corridor = MakeCorridor({.panoramas = 60,
                                          .gnss_sigma_m = 0.01,
                                          .gnss_bias_m = 3.0,
                                          .drives = 2,
                                          .lasting_share = 0.25});
  std::set<uint32_t> seen[2];
  for (uint32_t i = 0; i < 60; ++i) {
    EXPECT_EQ(corridor.manifest.images[i].drive, i / 30);
    seen[i / 30].insert(corridor.point_of_feature[i].begin(), corridor.point_of_feature[i].end());
  }
  std::vector<uint32_t> both;
  std::set_intersection(
      seen[0].begin(), seen[0].end(), seen[1].begin(), seen[1].end(), std::back_inserter(both));
  const double all = static_cast<double>(seen[0].size() + seen[1].size() - both.size());
  EXPECT_NEAR(static_cast<double>(both.size()) / all, 0.25, 0.03);
  EXPECT_NEAR((corridor.cams_from_world[7].Centre() - corridor.cams_from_world[37].Centre()).norm(),
              2.0,
              1e-9);
  const auto errors = GnssErrors(corridor);
  EXPECT_NEAR(errors[7].norm(), 3.0, 0.1);
  EXPECT_NEAR(errors[37].norm(), 3.0, 0.1);
  EXPECT_GT((errors[7] - errors[37]).norm(), 0.5);
}

TEST(CorridorHardships, RoofsAreAtOnePlaceOfEveryPanoramaAndMatchInEveryPair) {
  const Corridor corridor = MakeCorridor({.panoramas = 30, .noise_px = 0.0, .roof_features = 50});
  const auto bearing_of = [&](ImageId image, uint32_t feature) {
    return corridor.features[image.value].Bearing(feature);
  };
  for (const PairMatches& pair : corridor.pairs) {
    int on_roof = 0;
    for (const FeatureMatch& match : pair.matches) {
      const uint32_t name_a = corridor.point_of_feature[pair.pair.a.value][match.a];
      const uint32_t name_b = corridor.point_of_feature[pair.pair.b.value][match.b];
      if (name_a < kCarrierPoint || name_a != name_b) continue;
      ++on_roof;
      EXPECT_LT(AngleBetween(bearing_of(pair.pair.a, match.a), bearing_of(pair.pair.b, match.b)),
                1e-5);
    }
    EXPECT_GE(on_roof, 25);
  }
  EXPECT_LT(corridor.points_in_world.size(), kCarrierPoint);
}

TEST(CorridorHardships, RepeatedFacadesMatchAPeriodApartAsIfTheyWereNear) {
  const Corridor corridor = MakeCorridor({.panoramas = 60,
                                          .shape = CorridorShape::kStraight,
                                          .noise_px = 0.0,
                                          .outlier_share = 0.0,
                                          .repeat_after = 20,
                                          .repeat_share = 0.5});
  const Eigen::Vector3d period(60.0, 0.0, 0.0);
  int pairs_of_copies = 0;
  for (const PairMatches& pair : corridor.pairs) {
    const uint32_t a = pair.pair.a.value;
    const uint32_t b = pair.pair.b.value;
    if (b - a < 19) continue;
    ++pairs_of_copies;
    EXPECT_GT(pair.matches.size(), 100U);
    for (const FeatureMatch& match : pair.matches) {
      const uint32_t p = corridor.point_of_feature[a][match.a];
      const uint32_t q = corridor.point_of_feature[b][match.b];
      EXPECT_EQ(corridor.appearance_of_point[p], corridor.appearance_of_point[q]);
      const Eigen::Vector3d apart = corridor.points_in_world[q] - corridor.points_in_world[p];
      EXPECT_LT((apart - period).norm(), 1e-9);
    }
  }
  EXPECT_GT(pairs_of_copies, 100);
}

TEST(CorridorHardships, LensesOffTheCentreErrByTheirOffsetOverTheDepth) {
  const Corridor corridor = MakeCorridor({.panoramas = 20, .noise_px = 0.0, .lens_offset_m = 0.05});
  double largest = 0.0;
  for (uint32_t i = 0; i < 20; ++i) {
    for (uint32_t f = 0; f < corridor.features[i].size(); ++f) {
      const Eigen::Vector3d point_in_cam =
          corridor.cams_from_world[i] * corridor.points_in_world[corridor.point_of_feature[i][f]];
      const double error_rad = AngleBetween(point_in_cam, corridor.features[i].Bearing(f));
      const double depth_m = point_in_cam.norm();
      EXPECT_LT(error_rad, 0.05 / (depth_m - 0.05) + 1e-5);
      largest = std::max(largest, error_rad * depth_m);
    }
  }
  EXPECT_GT(largest, 0.03);
}

TEST(CorridorHardships, WithoutGnssNoImageHasAPosition) {
  const Corridor corridor = MakeCorridor({.panoramas = 10, .gnss_sigma_m = 0.0});
  EXPECT_FALSE(corridor.manifest.origin.has_value());
  for (const ImageRecord& image : corridor.manifest.images)
    EXPECT_FALSE(image.prior.position_in_enu.has_value());
}

}  // namespace
}  // namespace orbweave
