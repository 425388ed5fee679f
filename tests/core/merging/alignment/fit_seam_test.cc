// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/alignment/fit_seam.h"

#include <gtest/gtest.h>

#include "tests/core/merging/alignment/seam_world.h"

namespace orbweave {
namespace {

using testing::MakeSeam;
using testing::SeamWorld;

constexpr double kMaxError = 8.0;

TEST(FitSeam, RecoversTheSimilarity) {
  const SeamWorld seam = MakeSeam(20, 0.0, 1);
  const SeamFit fit = FitSeam(seam.evidence, kMaxError);
  EXPECT_LT(fit.chart.Of(seam.a_from_b).norm(), 1e-3);
  EXPECT_EQ(fit.inlier_tracks, seam.evidence.tracks.size());
  EXPECT_EQ(fit.inlier_cameras, seam.evidence.cameras.size());
  EXPECT_LT(fit.condition_number, 1e3);
}

TEST(FitSeam, StatesItsErrorWithinItsCovariance) {
  for (uint64_t seed = 2; seed < 8; ++seed) {
    const SeamWorld seam = MakeSeam(20, 0.005, seed);
    const SeamFit fit = FitSeam(seam.evidence, kMaxError);
    const Vector7d error = fit.chart.Of(seam.a_from_b);
    EXPECT_LT(error.dot(fit.covariance.inverse() * error), 40.0);
  }
}

TEST(FitSeam, FixesTheRollOfAStraightStreetByTracksAlone) {
  SeamWorld seam = MakeSeam(20, 0.0, 9);
  Random random(10);
  for (size_t c = 1; c < seam.evidence.cameras.size(); ++c) {  // rotations are wrong but for one
    SeamCamera& camera = seam.evidence.cameras[c];
    camera.cam_from_b =
        Rigid3::FromCentre(testing::RandomRotation(random), camera.cam_from_b.Centre());
  }
  EXPECT_LT(FitSeam(seam.evidence, kMaxError).chart.Of(seam.a_from_b).norm(), 1e-3);
}

TEST(FitSeam, FindsTheScaleOfASingleCommonImageFromDistances) {
  SeamWorld seam = MakeSeam(20, 0.0, 11);
  seam.evidence.cameras.resize(1);
  EXPECT_LT(FitSeam(seam.evidence, kMaxError).chart.Of(seam.a_from_b).norm(), 1e-2);
}

TEST(FitSeam, HoldsAgainstSixtyPercentWrongTracks) {
  SeamWorld seam = MakeSeam(20, 0.0, 12);
  Random random(13);
  const size_t num_wrong = seam.evidence.tracks.size() * 6 / 10;
  for (size_t t = 0; t < num_wrong; ++t) {
    SeamTrack& track = seam.evidence.tracks[t];
    track.point_in_a += 30.0 * testing::RandomDirection(random);
    for (Sighting& sighting : track.sightings) sighting.bearing = testing::RandomDirection(random);
  }
  const SeamFit fit = FitSeam(seam.evidence, kMaxError);
  EXPECT_LT(fit.chart.Of(seam.a_from_b).norm(), 2e-3);
  EXPECT_NEAR(fit.inlier_tracks, seam.evidence.tracks.size() - num_wrong, 5.0);
}

TEST(FitSeam, AdmitsThatASingleImageAloneHasNoScale) {
  SeamWorld seam = MakeSeam(20, 0.0, 14);
  seam.evidence.cameras.resize(1);
  seam.evidence.tracks.clear();
  EXPECT_GT(FitSeam(seam.evidence, kMaxError).condition_number, 1e12);
}

}  // namespace
}  // namespace orbweave
