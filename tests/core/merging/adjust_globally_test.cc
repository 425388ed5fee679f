// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/core/merging/adjust_globally.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cstring>

#include "core/geometry/rotation.h"
#include "core/synthetic/corridor_options.h"
#include "core/synthetic/make_corridor.h"
#include "tests/core/merging/corridor_model.h"

namespace orbweave {
namespace {

using testing::AdjustGlobally;
using testing::DisturbedModel;
using ::testing::ElementsAre;
using testing::GloballyAdjusted;
using ::testing::HasSubstr;
using testing::RandomDirection;
using testing::SpoilSupports;
using testing::TrueModel;

constexpr double kDegPerRad = 57.29577951308232;

Sim3 SomeFrame(Random& random) {
  return {0.37, testing::RandomRotation(random), 20.0 * RandomDirection(random)};
}

// A corridor whose GNSS is the truth plus `bias` and normal noise.
Corridor CorridorWithGnss(const CorridorOptions& options,
                          const Eigen::Vector3d& bias_m,
                          double sigma_m,
                          Random& random) {
  Corridor corridor = MakeCorridor(options);
  for (ImageRecord& image : corridor.manifest.images) {
    const double x = random.Normal();
    const double y = random.Normal();
    const Eigen::Vector3d noise(x, y, 2.0 * random.Normal());
    image.prior.position_in_enu =
        corridor.cams_from_world[image.id.value].Centre() + bias_m + sigma_m * noise;
    image.prior.horizontal_sigma_m = sigma_m;
    image.prior.vertical_sigma_m = 2.0 * sigma_m;
  }
  return corridor;
}

GloballyAdjusted Adjust(const Reconstruction& model,
                        const ImageManifest& manifest,
                        const GlobalAdjustOptions& options = {},
                        int num_threads = 1) {
  auto adjusted = AdjustGlobally(model, manifest, options, {}, {.num_threads = num_threads});
  EXPECT_TRUE(adjusted.ok()) << adjusted.status();
  return std::move(adjusted).value_or(GloballyAdjusted{});
}

double LargestCentreError(const Reconstruction& model,
                          const Corridor& corridor,
                          const Eigen::Vector3d& bias_m) {
  double largest = 0.0;
  for (const auto& [id, image] : model.images) {
    const Eigen::Vector3d truth = corridor.cams_from_world[id.value].Centre() + bias_m;
    largest = std::max(largest, (image.cam_from_world.Centre() - truth).norm());
  }
  return largest;
}

double MeanTilt_deg(const Reconstruction& model) {
  Eigen::Vector3d down = Eigen::Vector3d::Zero();
  for (const auto& [id, image] : model.images) {
    down += image.cam_from_world.rotation.conjugate() * Eigen::Vector3d::UnitY();
  }
  return kDegPerRad * AngleBetween(down, -Eigen::Vector3d::UnitZ());
}

TEST(AdjustGlobally, PutsTheStreetWithinTheGnssBiasOfTheTruth) {
  Random random(1);
  const Eigen::Vector3d bias_m(0.8, -0.6, 0.5);
  Corridor corridor =
      CorridorWithGnss({.panoramas = 60, .features_per_panorama = 200}, bias_m, 0.5, random);
  for (const uint32_t i : {7U, 30U}) {
    *corridor.manifest.images[i].prior.position_in_enu += Eigen::Vector3d(40.0, 25.0, 0.0);
  }
  const Reconstruction start = DisturbedModel(TrueModel(corridor), 0.02, SomeFrame(random), random);
  const GloballyAdjusted adjusted = Adjust(start, corridor.manifest);
  EXPECT_TRUE(adjusted.report.gnss.used) << adjusted.report.gnss.reason;
  EXPECT_THAT(adjusted.report.gnss.outliers,
              ElementsAre(corridor.manifest.images[7].name, corridor.manifest.images[30].name));
  EXPECT_EQ(adjusted.report.gnss.num_priors, 60U);
  EXPECT_EQ(adjusted.report.gnss.num_inliers, 58U);
  EXPECT_LT(LargestCentreError(adjusted.reconstruction, corridor, bias_m), 0.6);
  EXPECT_LT(LargestCentreError(adjusted.reconstruction, corridor, Eigen::Vector3d::Zero()),
            bias_m.norm() + 0.5);
  // Two axes of 0.5 px less what poses and points absorb.
  EXPECT_NEAR(adjusted.report.residual_px_rms, 0.6, 0.1);
  EXPECT_GT(adjusted.report.removed_observations, start.NumObservations() / 60);
}

TEST(AdjustGlobally, KeepsAStraightStreetFromRolling) {
  Random random(2);
  const Corridor corridor = CorridorWithGnss(
      {.panoramas = 40, .shape = CorridorShape::kStraight, .features_per_panorama = 150},
      {0, 0, 0},
      3.0,
      random);
  const GloballyAdjusted adjusted = Adjust(
      DisturbedModel(TrueModel(corridor), 0.0, SomeFrame(random), random), corridor.manifest);
  EXPECT_TRUE(adjusted.report.gnss.used) << adjusted.report.gnss.reason;
  EXPECT_LT(MeanTilt_deg(adjusted.reconstruction), 4.0);
  EXPECT_LT(LargestCentreError(adjusted.reconstruction, corridor, {0, 0, 0}), 4.0);
}

TEST(AdjustGlobally, DoesNotBendAnIndoorModelToScatteredGnss) {
  Random random(3);
  const Corridor corridor = CorridorWithGnss(
      {.panoramas = 11, .spacing_m = 0.6, .features_per_panorama = 300}, {0, 0, 0}, 12.0, random);
  const Reconstruction start = DisturbedModel(TrueModel(corridor), 0.0, SomeFrame(random), random);
  const GloballyAdjusted adjusted = Adjust(start, corridor.manifest);
  EXPECT_FALSE(adjusted.report.gnss.used);
  EXPECT_THAT(adjusted.report.gnss.reason, HasSubstr("scale"));
  const GloballyAdjusted without = Adjust(start, corridor.manifest, {.gnss = GnssUse::kOff});
  EXPECT_THAT(without.report.gnss.reason, HasSubstr("off"));
  EXPECT_NEAR(adjusted.report.residual_px_rms,
              without.report.residual_px_rms,
              0.01 * without.report.residual_px_rms);
  EXPECT_LT(MeanTilt_deg(adjusted.reconstruction), 1.0);
  const auto& images = adjusted.reconstruction.images;
  const double step = (images.at(ImageId(1)).cam_from_world.Centre() -
                       images.at(ImageId(0)).cam_from_world.Centre())
                          .norm();
  EXPECT_NEAR(step, 1.0, 0.1);
}

TEST(AdjustGlobally, NeedsNoGravityOnABentStreet) {
  Random random(4);
  const Corridor corridor = CorridorWithGnss({.panoramas = 60,
                                              .shape = CorridorShape::kLoop,
                                              .features_per_panorama = 150,
                                              .random_rotations = true},
                                             {0, 0, 0},
                                             0.5,
                                             random);
  const GloballyAdjusted adjusted = Adjust(
      DisturbedModel(TrueModel(corridor), 0.0, SomeFrame(random), random), corridor.manifest);
  EXPECT_TRUE(adjusted.report.gnss.used) << adjusted.report.gnss.reason;
  EXPECT_LT(LargestCentreError(adjusted.reconstruction, corridor, {0, 0, 0}), 1.0);
}

TEST(AdjustGlobally, EstimatesTheBiasOfEachDrive) {
  Random random(5);
  Corridor corridor =
      CorridorWithGnss({.panoramas = 60, .features_per_panorama = 150}, {0, 0, 0}, 0.3, random);
  for (ImageRecord& image : corridor.manifest.images) {
    image.drive = image.id.value % 2;
    image.prior.position_in_enu->x() += image.drive == 0 ? 2.0 : -2.0;
  }
  const GloballyAdjusted adjusted = Adjust(
      DisturbedModel(TrueModel(corridor), 0.0, SomeFrame(random), random), corridor.manifest);
  ASSERT_EQ(adjusted.report.adjustments.back().biases_m.size(), 2U);
  const auto& biases = adjusted.report.adjustments.back().biases_m;
  EXPECT_NEAR(biases[0].x() - biases[1].x(), 4.0, 0.3);
  EXPECT_LT(LargestCentreError(adjusted.reconstruction, corridor, {0, 0, 0}), 0.6);
}

TEST(AdjustGlobally, GivesTheSameBytesForAnyNumberOfThreads) {
  Random random(6);
  const Corridor corridor =
      CorridorWithGnss({.panoramas = 30, .features_per_panorama = 200}, {0, 0, 0}, 1.0, random);
  const Reconstruction start = DisturbedModel(TrueModel(corridor), 0.02, SomeFrame(random), random);
  const GloballyAdjusted one = Adjust(start, corridor.manifest, {}, 1);
  const GloballyAdjusted three = Adjust(start, corridor.manifest, {}, 3);
  for (const auto& [id, image] : one.reconstruction.images) {
    const Rigid3& other = three.reconstruction.images.at(id).cam_from_world;
    EXPECT_EQ(image.cam_from_world.rotation.coeffs(), other.rotation.coeffs());
    EXPECT_EQ(image.cam_from_world.translation, other.translation);
  }
  ASSERT_EQ(one.reconstruction.tracks.size(), three.reconstruction.tracks.size());
  for (size_t i = 0; i < one.reconstruction.tracks.size(); ++i) {
    EXPECT_EQ(one.reconstruction.tracks[i].point_in_world,
              three.reconstruction.tracks[i].point_in_world);
  }
}

TEST(AdjustGlobally, KeepsTracksSortedAndLeavesLooseImagesOut) {
  Random random(7);
  const Corridor corridor =
      CorridorWithGnss({.panoramas = 20, .features_per_panorama = 150}, {0, 0, 0}, 1.0, random);
  Reconstruction start = DisturbedModel(TrueModel(corridor), 0.1, SomeFrame(random), random);
  start.images.at(ImageId(4)).loose = true;
  const GloballyAdjusted adjusted = Adjust(start, corridor.manifest);
  const std::vector<Track>& tracks = adjusted.reconstruction.tracks;
  ASSERT_FALSE(tracks.empty());
  for (size_t i = 0; i < tracks.size(); ++i) {
    EXPECT_GE(tracks[i].observations.size(), 2U);
    EXPECT_TRUE(i == 0 || tracks[i - 1].Name() < tracks[i].Name());
    for (const Observation& seen : tracks[i].observations) EXPECT_NE(seen.ref.image, ImageId(4));
  }
  EXPECT_EQ(adjusted.reconstruction.images.size(), 20U);
  EXPECT_TRUE(adjusted.report.weak_images.empty());
}

TEST(AdjustGlobally, NamesImagesThatLoseAllObservations) {
  Random random(8);
  const Corridor corridor =
      CorridorWithGnss({.panoramas = 12, .features_per_panorama = 150}, {0, 0, 0}, 1.0, random);
  Reconstruction start = DisturbedModel(TrueModel(corridor), 0.0, SomeFrame(random), random);
  for (Track& track : start.tracks) {
    std::erase_if(track.observations,
                  [](const Observation& seen) { return seen.ref.image == ImageId(5); });
  }
  start.SortTracks();
  const GloballyAdjusted adjusted = Adjust(start, corridor.manifest);
  ASSERT_EQ(adjusted.report.weak_images.size(), 1U);
  EXPECT_EQ(adjusted.report.weak_images[0].name, corridor.manifest.images[5].name);
  EXPECT_EQ(adjusted.report.weak_images[0].reason,
            "it has no observations of points that other images hold");
  EXPECT_FALSE(adjusted.reconstruction.images.contains(ImageId(5)));
  EXPECT_TRUE(adjusted.reconstruction.images.at(ImageId(6)).uncertainty.has_value());
}

TEST(AdjustGlobally, KnowsHowFarGnssLeavesTheStreetFromTheTruth) {
  double sum = 0.0;
  constexpr int kStreets = 20;
  for (int street = 0; street < kStreets; ++street) {
    Random random(static_cast<uint64_t>(100 + street));
    const Corridor corridor = CorridorWithGnss({.panoramas = 30,
                                                .shape = CorridorShape::kLoop,
                                                .features_per_panorama = 100,
                                                .seed = 100 + street},
                                               {0, 0, 0},
                                               0.5,
                                               random);
    const GloballyAdjusted adjusted = Adjust(
        DisturbedModel(TrueModel(corridor), 0.0, SomeFrame(random), random), corridor.manifest);
    EXPECT_TRUE(adjusted.report.uncertainty.known) << adjusted.report.uncertainty.reason;
    EXPECT_EQ(adjusted.report.uncertainty.held_image, "");
    const RegisteredImage& image = adjusted.reconstruction.images.at(ImageId(15));
    const Eigen::Vector3d error =
        image.cam_from_world.Centre() - corridor.cams_from_world[15].Centre();
    ASSERT_TRUE(image.uncertainty.has_value());
    sum += error.dot(image.uncertainty->position_covariance.inverse() * error);
  }
  // 99.9 % of chi^2 with 60 degrees of freedom.
  EXPECT_GT(sum / (3.0 * kStreets), 0.50);
  EXPECT_LT(sum / (3.0 * kStreets), 1.72);
}

TEST(AdjustGlobally, GivesUncertaintyInTheFrameOfTheModel) {
  Random random(9);
  const Corridor corridor = MakeCorridor({.panoramas = 20, .features_per_panorama = 150});
  const Reconstruction start = DisturbedModel(TrueModel(corridor), 0.0, SomeFrame(random), random);
  const Sim3 elsewhere = SomeFrame(random);
  const GlobalAdjustOptions no_gnss{.gnss = GnssUse::kOff};
  const GloballyAdjusted here = Adjust(start, corridor.manifest, no_gnss);
  const GloballyAdjusted there = Adjust(Transformed(elsewhere, start), corridor.manifest, no_gnss);
  EXPECT_TRUE(here.report.uncertainty.known);
  EXPECT_EQ(here.report.uncertainty.held_image, corridor.manifest.images[0].name);
  EXPECT_NE(here.report.uncertainty.held_distance_to, "");
  EXPECT_EQ(here.reconstruction.images.at(ImageId(0)).uncertainty->PositionSigma(), 0.0);
  const double sigma = here.reconstruction.images.at(ImageId(10)).uncertainty->PositionSigma();
  EXPECT_GT(sigma, 1e-5);
  EXPECT_LT(sigma, 1e-2);  // the step between images is 1
  for (const auto& [id, image] : here.reconstruction.images) {
    const PoseUncertainty& other = *there.reconstruction.images.at(id).uncertainty;
    // Headings of free frames differ.
    EXPECT_NEAR(image.uncertainty->PositionSigma(), other.PositionSigma(), 1e-3 * sigma);
    EXPECT_NEAR(image.uncertainty->rotation_sigma_rad,
                other.rotation_sigma_rad,
                1e-3 * other.rotation_sigma_rad);
  }
}

// What whole patches of panorama 7 say of its pose is five times what their scatter lets expect.
void SpoilPanorama7(std::vector<PatchSupport>& supports) {
  for (PatchSupport& patch : supports) {
    if (patch.image == ImageId(7)) patch.gradient *= 5.0;
  }
}

TEST(AdjustGlobally, KnowsTheFrameNoWorseForOneDisturbedPanorama) {
  Random random(21);
  const Corridor corridor =
      CorridorWithGnss({.panoramas = 20, .features_per_panorama = 150}, {0, 0, 0}, 1.0, random);
  const Reconstruction start = DisturbedModel(TrueModel(corridor), 0.0, SomeFrame(random), random);
  const auto sigma_of_panorama_7 = [&](GnssUse gnss, const SpoilSupports& spoil) {
    const auto adjusted = AdjustGlobally(start, corridor.manifest, {.gnss = gnss}, {}, {}, spoil);
    EXPECT_TRUE(adjusted.ok()) << adjusted.status();
    return adjusted->reconstruction.images.at(ImageId(7)).uncertainty->PositionSigma();
  };
  const double in_model = sigma_of_panorama_7(GnssUse::kOff, {});
  EXPECT_GT(sigma_of_panorama_7(GnssUse::kOff, SpoilPanorama7), 1.5 * in_model);
  const double on_earth = sigma_of_panorama_7(GnssUse::kAuto, {});
  EXPECT_GT(on_earth, 20.0 * in_model);
  EXPECT_NEAR(sigma_of_panorama_7(GnssUse::kAuto, SpoilPanorama7), on_earth, 0.02 * on_earth);
}

TEST(AdjustGlobally, AcceptsAnEmptyModel) {
  const GloballyAdjusted adjusted = Adjust({}, {});
  EXPECT_FALSE(adjusted.report.gnss.used);
  EXPECT_NE(adjusted.report.uncertainty.reason, "");
  EXPECT_TRUE(adjusted.reconstruction.images.empty());
}

}  // namespace
}  // namespace orbweave
