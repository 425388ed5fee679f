// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/reconstruct_cluster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/mapping/cluster_reconstruction.h"
#include "core/mapping/model/cluster_problem.h"
#include "core/mapping/model/mapping_options.h"
#include "core/synthetic/make_street.h"
#include "tests/core/mapping/model_error.h"
#include "tests/core/mapping/ray_street.h"
#include "tests/core/mapping/slow_street.h"

namespace orbweave {
namespace {

ClusterReconstruction Reconstruct(const RayStreet& world, const MappingOptions& options = {}) {
  auto result = ReconstructCluster(world.problem, options, {.seed = 5});
  EXPECT_TRUE(result.ok()) << result.status();
  return result.ok() ? *std::move(result) : ClusterReconstruction{};
}

void ExpectWellFormed(const Reconstruction& reconstruction) {
  const FeatureRef* previous = nullptr;
  for (const Track& track : reconstruction.tracks) {
    ASSERT_GE(track.observations.size(), 2U);
    if (previous != nullptr) {
      EXPECT_LT(*previous, track.Name());
    }
    previous = &track.Name();
    for (size_t i = 0; i < track.observations.size(); ++i) {
      EXPECT_TRUE(reconstruction.images.contains(track.observations[i].ref.image));
      if (i > 0) {
        EXPECT_LT(track.observations[i - 1].ref.image, track.observations[i].ref.image);
      }
    }
  }
}

TEST(ReconstructCluster, RecoversACleanStreet) {
  const RayStreet world = MakeStreet({.centres = StraightWalk(10, 3.0), .noise_px = 0.0});
  const ClusterReconstruction result = Reconstruct(world);
  ASSERT_EQ(result.submodels.size(), 1U);
  EXPECT_EQ(result.submodels[0].images.size(), 10U);
  EXPECT_TRUE(result.not_registered.empty());
  EXPECT_LT(result.residual_rms_px, 1e-4);
  const ModelError error = ErrorOf(result.submodels[0], world.cams_from_world);
  EXPECT_LT(error.position_rmse, 1e-5);
  EXPECT_LT(error.max_rotation_rad, 1e-6);
  ExpectWellFormed(result.submodels[0]);
}

TEST(ReconstructCluster, ReachesTheNoiseLevel) {
  const RayStreet world =
      MakeStreet({.centres = StraightWalk(30, 3.0), .noise_px = 0.5, .outlier_share = 0.02});
  const ClusterReconstruction result = Reconstruct(world);
  ASSERT_EQ(result.submodels.size(), 1U);
  EXPECT_EQ(result.submodels[0].images.size(), 30U);
  EXPECT_GT(result.residual_rms_px, 0.60);
  EXPECT_LT(result.residual_rms_px, 0.71);  // 0.5 px along two axes, less what is fitted
  const ModelError error = ErrorOf(result.submodels[0], world.cams_from_world);
  EXPECT_LT(error.position_rmse, 0.01);
  EXPECT_LT(error.max_rotation_rad, 1e-3);
  ExpectWellFormed(result.submodels[0]);
}

TEST(ReconstructCluster, PanoramasMayBeTurnedAnyWay) {
  RayStreetOptions options{.centres = StraightWalk(15, 3.0), .noise_px = 0.4};
  const RayStreet upright = MakeStreet(options);
  options.random_rotations = true;
  const RayStreet turned = MakeStreet(options);
  const ClusterReconstruction of_upright = Reconstruct(upright);
  const ClusterReconstruction of_turned = Reconstruct(turned);
  ASSERT_EQ(of_turned.submodels.size(), 1U);
  EXPECT_EQ(of_turned.submodels[0].images.size(), of_upright.submodels[0].images.size());
  EXPECT_NEAR(static_cast<double>(of_turned.submodels[0].tracks.size()),
              static_cast<double>(of_upright.submodels[0].tracks.size()),
              0.01 * static_cast<double>(of_upright.submodels[0].tracks.size()));
  EXPECT_NEAR(of_turned.residual_rms_px, of_upright.residual_rms_px, 0.01);
  EXPECT_LT(ErrorOf(of_turned.submodels[0], turned.cams_from_world).position_rmse, 0.01);
}

TEST(ReconstructCluster, ClosesALoop) {
  RayStreetOptions options{.centres = RoundWalk(24, 12.0)};
  options.window = 23;
  const RayStreet world = MakeStreet(options);
  const ClusterReconstruction result = Reconstruct(world);
  ASSERT_EQ(result.submodels.size(), 1U);
  EXPECT_EQ(result.submodels[0].images.size(), 24U);
  EXPECT_LT(ErrorOf(result.submodels[0], world.cams_from_world).position_rmse, 0.01);
}

TEST(ReconstructCluster, WithstandsManyWrongMatches) {
  const RayStreet world = MakeStreet({.centres = StraightWalk(15, 3.0), .outlier_share = 0.3});
  const ClusterReconstruction result = Reconstruct(world);
  ASSERT_EQ(result.submodels.size(), 1U);
  EXPECT_EQ(result.submodels[0].images.size(), 15U);
  EXPECT_LT(ErrorOf(result.submodels[0], world.cams_from_world).position_rmse, 0.02);
}

TEST(ReconstructCluster, PassesAStopAtALight) {
  // Drives up, stands for 20 panoramas within millimetres, drives on.
  std::vector<Eigen::Vector3d> centres = StraightWalk(6, 3.0);
  const Eigen::Vector3d stop = centres.back();
  Random random(9);
  for (int i = 0; i < 20; ++i) {
    centres.push_back(stop +
                      1e-3 * Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal()));
  }
  for (int i = 1; i <= 6; ++i) centres.push_back(stop + Eigen::Vector3d(3.0 * i, 0.0, 0.0));
  const RayStreet world = MakeStreet({.centres = centres, .points_per_metre = 16, .window = 22});
  const ClusterReconstruction result = Reconstruct(world);
  ASSERT_EQ(result.submodels.size(), 1U);
  EXPECT_EQ(result.submodels[0].images.size(), 32U);
  EXPECT_LT(ErrorOf(result.submodels[0], world.cams_from_world).position_rmse, 0.02);
}

TEST(ReconstructCluster, FollowsACameraThatHardlyMoves) {
  // 5 cm in all: of what is to be measured nearly everything is below max_error_px.
  constexpr double kStep_m = 0.003;
  const RayStreet world = MakeSlowStreet(16, kStep_m);
  const auto rotations =
      std::ranges::count(world.problem.pairs, TwoViewKind::kPureRotation, &TwoViewGeometry::kind);
  ASSERT_GT(rotations, std::ssize(world.problem.pairs) / 2);
  const ClusterReconstruction result = Reconstruct(world);
  ASSERT_EQ(result.submodels.size(), 1U);
  EXPECT_EQ(result.submodels[0].images.size(), 16U);
  const ModelError error = ErrorOf(result.submodels[0], world.cams_from_world);
  EXPECT_LT(error.position_rmse, 0.25 * kStep_m);
  EXPECT_LT(error.max_rotation_rad, 1e-3);
  ExpectWellFormed(result.submodels[0]);
}

TEST(ReconstructCluster, FollowsACameraOfWhichEveryPairIsARotation) {
  constexpr double kStep_m = 0.002;
  const RayStreet world = MakeSlowStreet(12, kStep_m);
  for (const TwoViewGeometry& pair : world.problem.pairs)
    ASSERT_EQ(pair.kind, TwoViewKind::kPureRotation);
  const ClusterReconstruction result = Reconstruct(world);
  ASSERT_EQ(result.submodels.size(), 1U);
  EXPECT_EQ(result.submodels[0].images.size(), 12U);
  EXPECT_LT(ErrorOf(result.submodels[0], world.cams_from_world).position_rmse, 0.5 * kStep_m);
}

TEST(ReconstructCluster, HasNoSubmodelOfACameraThatNeverMoves) {
  const RayStreet world = MakeStreet({.centres = StraightWalk(6, 0.0), .points_per_metre = 80});
  ASSERT_FALSE(world.problem.pairs.empty());
  const ClusterReconstruction result = Reconstruct(world);
  EXPECT_TRUE(result.submodels.empty());
  EXPECT_EQ(result.not_registered.size(), 6U);
}

TEST(ReconstructCluster, KeepsTwoSubmodelsApart) {
  std::vector<Eigen::Vector3d> centres = StraightWalk(8, 3.0);
  for (const Eigen::Vector3d& centre : StraightWalk(6, 3.0)) {
    centres.push_back(centre + Eigen::Vector3d(500.0, 0.0, 0.0));
  }
  const RayStreet world = MakeStreet({.centres = centres});
  const ClusterReconstruction result = Reconstruct(world);
  ASSERT_EQ(result.submodels.size(), 2U);
  EXPECT_EQ(result.submodels[0].images.size(), 8U);
  EXPECT_EQ(result.submodels[1].images.size(), 6U);
  EXPECT_EQ(result.submodels[1].images.begin()->first, ImageId(8));
}

TEST(ReconstructCluster, NamesImagesThatItCannotPlace) {
  RayStreet world = MakeStreet({.centres = StraightWalk(10, 3.0)});
  // Image 9 shows something else: its features lead nowhere.
  Random random(2);
  for (Eigen::Vector3d& bearing : world.problem.images[9].bearings) {
    bearing = Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal()).normalized();
  }
  // Image 0 has no matches at all.
  std::erase_if(world.problem.pairs,
                [](const TwoViewGeometry& pair) { return pair.pair.a == ImageId(0); });
  const ClusterReconstruction result = Reconstruct(world);
  ASSERT_EQ(result.submodels.size(), 1U);
  EXPECT_EQ(result.submodels[0].images.size(), 8U);
  ASSERT_EQ(result.not_registered.size(), 2U);
  EXPECT_EQ(result.not_registered[0].image, ImageId(0));
  EXPECT_EQ(result.not_registered[0].reason, "no verified matches");
  EXPECT_EQ(result.not_registered[1].image, ImageId(9));
  EXPECT_NE(result.not_registered[1].reason.find("needed points agree"), std::string::npos)
      << result.not_registered[1].reason;
}

TEST(ReconstructCluster, RecoversFromABadSeed) {
  RayStreet world = MakeStreet({.centres = StraightWalk(12, 3.0)});
  // The pair that ranks first claims a wrong geometry.
  size_t first = 0;
  for (size_t i = 0; i < world.problem.pairs.size(); ++i) {
    if (world.problem.pairs[i].inliers.size() > world.problem.pairs[first].inliers.size())
      first = i;
  }
  world.problem.pairs[first].median_angle_rad = 0.5;
  world.problem.pairs[first].b_from_a.rotation =
      RotationFromVector({0.5, 0.2, 0.0}) * world.problem.pairs[first].b_from_a.rotation;
  const ClusterReconstruction result = Reconstruct(world);
  ASSERT_EQ(result.submodels.size(), 1U);
  EXPECT_EQ(result.submodels[0].images.size(), 12U);
  EXPECT_LT(ErrorOf(result.submodels[0], world.cams_from_world).position_rmse, 0.01);
}

TEST(ReconstructCluster, StartsInAScenePartlyTooFarForDepth) {
  // A short walk: the median angle of every pair is below that of a point that is kept.
  RayStreetOptions options{
      .centres = StraightWalk(12, 0.1), .points_per_metre = 60, .noise_px = 0.1};
  options.window = 11;
  const RayStreet world = MakeStreet(options);
  MappingOptions mapping;
  mapping.min_angle_deg = 9.0;
  for (const TwoViewGeometry& pair : world.problem.pairs) {
    ASSERT_LT(pair.median_angle_rad * 180.0 / std::numbers::pi, mapping.min_angle_deg);
  }
  const ClusterReconstruction result = Reconstruct(world, mapping);
  ASSERT_EQ(result.submodels.size(), 1U);
  EXPECT_EQ(result.submodels[0].images.size(), 12U);
}

/// Both starts of the same world end in the same model, but for what noise leaves open.
void ExpectStartsAgree(const RayStreet& world) {
  const ClusterReconstruction from_seed = Reconstruct(world, {.start = MappingStart::kIncremental});
  const ClusterReconstruction at_once = Reconstruct(world, {.start = MappingStart::kAuto});
  EXPECT_FALSE(from_seed.started_globally);
  EXPECT_TRUE(at_once.started_globally) << at_once.start_remark;
  EXPECT_EQ(at_once.start_remark, "");
  EXPECT_EQ(at_once.num_local_adjustments, 0);
  ASSERT_EQ(at_once.submodels.size(), 1U);
  ASSERT_EQ(from_seed.submodels.size(), 1U);
  EXPECT_EQ(at_once.submodels[0].images.size(), from_seed.submodels[0].images.size());
  EXPECT_NEAR(at_once.residual_rms_px, from_seed.residual_rms_px, 0.01);
  const double seed_error = ErrorOf(from_seed.submodels[0], world.cams_from_world).position_rmse;
  const double error = ErrorOf(at_once.submodels[0], world.cams_from_world).position_rmse;
  EXPECT_LT(error, 1.1 * seed_error + 1e-3);
  ExpectWellFormed(at_once.submodels[0]);
}

TEST(ReconstructCluster, StartsAgreeOnAStraightStreet) {
  ExpectStartsAgree(MakeStreet({.centres = StraightWalk(40, 3.0), .outlier_share = 0.02}));
}

TEST(ReconstructCluster, StartsAgreeOnALoopOfTurnedPanoramas) {
  RayStreetOptions options{.centres = RoundWalk(24, 12.0), .random_rotations = true};
  options.window = 23;
  ExpectStartsAgree(MakeStreet(options));
}

TEST(ReconstructCluster, StartsAgreeWithManyWrongMatches) {
  ExpectStartsAgree(MakeStreet({.centres = StraightWalk(20, 3.0), .outlier_share = 0.3}));
}

TEST(ReconstructCluster, StartsAgreeInABend) {
  std::vector<Eigen::Vector3d> centres = RoundWalk(60, 30.0);
  centres.resize(25);
  ExpectStartsAgree(MakeStreet({.centres = centres}));
}

/// Every pair claims a wrong rotation but the first, from which images can be registered.
RayStreet MakeStreetWithBadPairs() {
  RayStreet world = MakeStreet({.centres = StraightWalk(12, 3.0)});
  Random random(6);
  for (size_t i = 1; i < world.problem.pairs.size(); ++i) {
    world.problem.pairs[i].b_from_a.rotation = street_internal::RandomRotation(random);
    world.problem.pairs[i].median_angle_rad = 0.05;  // ranks behind the first as a seed
  }
  return world;
}

TEST(ReconstructCluster, AutoBeginsWithASeedWherePairsContradictEachOther) {
  const RayStreet world = MakeStreetWithBadPairs();
  const ClusterReconstruction result =
      Reconstruct(world, {.start = MappingStart::kAuto, .max_seeds = 100});
  EXPECT_FALSE(result.started_globally);
  EXPECT_NE(result.start_remark, "");
  ASSERT_EQ(result.submodels.size(), 1U);
  EXPECT_EQ(result.submodels[0].images.size(), 12U);
  EXPECT_LT(ErrorOf(result.submodels[0], world.cams_from_world).position_rmse, 0.01);
}

TEST(ReconstructCluster, AGlobalStartThatFailsIsNamedAndReplaced) {
  const ClusterReconstruction result =
      Reconstruct(MakeStreetWithBadPairs(), {.start = MappingStart::kGlobal, .max_seeds = 100});
  EXPECT_FALSE(result.started_globally);
  EXPECT_NE(result.start_remark.find("images only"), std::string::npos) << result.start_remark;
  ASSERT_EQ(result.submodels.size(), 1U);
  EXPECT_EQ(result.submodels[0].images.size(), 12U);
}

TEST(ReconstructCluster, AGlobalStartRegistersWhatPairsCannotPlace) {
  RayStreet world = MakeStreet({.centres = StraightWalk(15, 3.0)});
  // All pairs of image 8 claim to be pure rotations: no displacement leads to it.
  for (TwoViewGeometry& pair : world.problem.pairs) {
    if (pair.pair.a != ImageId(8) && pair.pair.b != ImageId(8)) continue;
    pair.kind = TwoViewKind::kPureRotation;
    pair.b_from_a.translation.setZero();
  }
  const ClusterReconstruction result = Reconstruct(world, {.start = MappingStart::kAuto});
  EXPECT_TRUE(result.started_globally) << result.start_remark;
  EXPECT_EQ(result.num_local_adjustments, 1);
  ASSERT_EQ(result.submodels.size(), 1U);
  EXPECT_EQ(result.submodels[0].images.size(), 15U);
}

TEST(ReconstructCluster, AGlobalStartKeepsSubmodelsApart) {
  std::vector<Eigen::Vector3d> centres = StraightWalk(8, 3.0);
  for (const Eigen::Vector3d& centre : StraightWalk(6, 3.0)) {
    centres.push_back(centre + Eigen::Vector3d(500.0, 0.0, 0.0));
  }
  const ClusterReconstruction result =
      Reconstruct(MakeStreet({.centres = centres}), {.start = MappingStart::kAuto});
  EXPECT_TRUE(result.started_globally) << result.start_remark;
  ASSERT_EQ(result.submodels.size(), 2U);
  EXPECT_EQ(result.submodels[0].images.size(), 8U);
  EXPECT_EQ(result.submodels[1].images.size(), 6U);
}

TEST(ReconstructCluster, ThePaperBeginsWithASeed) {
  const ClusterReconstruction result =
      Reconstruct(MakeStreet({.centres = StraightWalk(12, 3.0), .points_per_metre = 20}),
                  {.preset = MappingPreset::kPaper, .start = MappingStart::kGlobal});
  EXPECT_FALSE(result.started_globally);
}

TEST(ReconstructCluster, TinyInputsAreNoError) {
  for (const int count : {0, 1, 2, 3}) {
    const RayStreet world =
        MakeStreet({.centres = StraightWalk(count, 3.0), .points_per_metre = 40});
    const ClusterReconstruction result = Reconstruct(world);
    EXPECT_EQ(result.submodels.size(), count == 3 ? 1U : 0U) << count;
    EXPECT_EQ(result.not_registered.size(), count == 3 ? 0U : static_cast<size_t>(count)) << count;
  }
}

TEST(ReconstructCluster, PaperPresetReconstructsToo) {
  const RayStreet world = MakeStreet({.centres = StraightWalk(12, 3.0), .points_per_metre = 20});
  MappingOptions options;
  options.preset = MappingPreset::kPaper;
  const ClusterReconstruction result = Reconstruct(world, options);
  ASSERT_EQ(result.submodels.size(), 1U);
  EXPECT_EQ(result.submodels[0].images.size(), 12U);
}

TEST(ReconstructCluster, PaperPresetAdjustsLocallyOnceMoreThanThreeImagesAreNew) {
  const RayStreet world = MakeStreet({.centres = StraightWalk(12, 3.0), .points_per_metre = 20});
  // Nothing but the end adjusts globally: 10 images after the seed, local adjustments at 4 and 8.
  MappingOptions options = {.preset = MappingPreset::kPaper, .global_growth = 10.0};
  const ClusterReconstruction result = Reconstruct(world, options);
  ASSERT_EQ(result.submodels.size(), 1U);
  EXPECT_EQ(result.num_local_adjustments, 2);
}

TEST(ReconstructCluster, PaperPresetWeighsAndLimitsPixelsAlike) {
  RayStreet world = MakeStreet({.centres = StraightWalk(10, 3.0), .points_per_metre = 20});
  for (ClusterImage& image : world.problem.images) {
    for (size_t i = 0; i < image.sigma_rad.size(); i += 2) image.sigma_rad[i] *= 4.0F;
  }
  MappingOptions options;
  const ClusterReconstruction ours = Reconstruct(world, options);
  options.preset = MappingPreset::kPaper;
  const ClusterReconstruction paper = Reconstruct(world, options);
  ASSERT_EQ(paper.submodels.size(), 1U);
  for (const Track& track : paper.submodels[0].tracks) {
    for (const Observation& seen : track.observations)
      EXPECT_FLOAT_EQ(static_cast<float>(seen.sigma_rad),
                      static_cast<float>(kStreetCamera.AngleFromPixels(1.0)));
  }
  // Errors of up to 4 px stay, and so do points of two observations.
  EXPECT_GE(paper.submodels[0].tracks.size(), ours.submodels[0].tracks.size());
}

TEST(ReconstructCluster, GivesTheSameBytesForAnyThreadCount) {
  const RayStreet world = MakeStreet({.centres = StraightWalk(10, 3.0), .outlier_share = 0.05});
  const auto one = ReconstructCluster(world.problem, {}, {.num_threads = 1, .seed = 3}).value();
  const auto two = ReconstructCluster(world.problem, {}, {.num_threads = 2, .seed = 3}).value();
  ASSERT_EQ(one.submodels.size(), two.submodels.size());
  ASSERT_EQ(one.submodels[0].tracks.size(), two.submodels[0].tracks.size());
  for (const auto& [id, image] : one.submodels[0].images) {
    const Rigid3& other = two.submodels[0].images.at(id).cam_from_world;
    EXPECT_EQ(image.cam_from_world.rotation.coeffs(), other.rotation.coeffs());
    EXPECT_EQ(image.cam_from_world.translation, other.translation);
  }
  for (size_t i = 0; i < one.submodels[0].tracks.size(); ++i) {
    EXPECT_EQ(one.submodels[0].tracks[i].point_in_world, two.submodels[0].tracks[i].point_in_world);
  }
}

TEST(ReconstructCluster, IsCancelledBetweenImages) {
  const RayStreet world = MakeStreet({.centres = StraightWalk(20, 3.0)});
  std::stop_source source;
  uint64_t last_done = 0;
  const StageContext context{.stop = source.get_token(), .report = [&](const Progress& progress) {
                               last_done = progress.done;
                               EXPECT_EQ(progress.total, 20U);
                               if (progress.done >= 5) source.request_stop();
                             }};
  EXPECT_EQ(ReconstructCluster(world.problem, {}, context).status().code(),
            absl::StatusCode::kCancelled);
  EXPECT_EQ(last_done, 5U);
}

TEST(ReconstructCluster, ColoursATrackByTheMeanOfItsFeatures) {
  const RayStreet world = MakeStreet({.centres = StraightWalk(5, 3.0)});
  const ClusterReconstruction result = Reconstruct(world);
  ASSERT_FALSE(result.submodels.empty());
  for (const Track& track : result.submodels[0].tracks) {
    EXPECT_EQ(track.color.g, 100);
    EXPECT_EQ(track.color.b, 200);
  }
}

}  // namespace
}  // namespace orbweave
