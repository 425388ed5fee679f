// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/filter_observations.h"

#include <gtest/gtest.h>

#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

constexpr int kWidth_px = 3600;  // ten pixels to the degree

// Four panoramas a metre apart on the x axis that see (0, 0, 5) and, far off, (0, 0, 500).
struct Scene {
  ImageManifest manifest{};
  Reconstruction model{};
};

Scene MakeScene() {
  Scene scene;
  for (uint32_t i = 0; i < 4; ++i) {
    ImageRecord image;
    image.id = ImageId(i);
    image.camera = {kWidth_px, kWidth_px / 2};
    scene.manifest.images.push_back(image);
    scene.model.images[ImageId(i)].cam_from_world =
        Rigid3::FromCentre(Eigen::Quaterniond::Identity(), {1.0 * i, 0.0, 0.0});
  }
  for (uint32_t t = 0; t < 2; ++t) {
    Track track{.point_in_world = {0.0, 0.0, t == 0 ? 5.0 : 500.0}};
    for (uint32_t i = 0; i < 4; ++i) {
      const Rigid3& cam_from_world = scene.model.images.at(ImageId(i)).cam_from_world;
      track.observations.push_back(
          {.ref = {ImageId(i), t},
           .bearing = (cam_from_world * track.point_in_world).normalized()});
    }
    scene.model.tracks.push_back(track);
  }
  return scene;
}

constexpr double kMinAngle_rad = 0.017;

TEST(FilterObservations, RemovesWhatIsTooFarFromItsBearing) {
  Scene scene = MakeScene();
  Eigen::Vector3d& bearing = scene.model.tracks[0].observations[2].bearing;
  bearing = RotationFromVector({0.0, 0.0087, 0.0}) * bearing;  // 5 px
  const auto lenient = FilterObservations(scene.model, scene.manifest, 5.5, 0.0);
  EXPECT_EQ(lenient.removed_observations, 0U);
  const auto strict = FilterObservations(scene.model, scene.manifest, 4.5, 0.0);
  EXPECT_EQ(strict.removed_observations, 1U);
  EXPECT_EQ(strict.removed_tracks, 0U);
  EXPECT_EQ(strict.reconstruction.tracks[0].observations[2].ref.image, ImageId(3));
}

TEST(FilterObservations, RemovesPointsBehindTheirBearing) {
  Scene scene = MakeScene();
  scene.model.tracks[0].point_in_world.z() *= -1.0;
  const auto filtered = FilterObservations(scene.model, scene.manifest, 4.0, 0.0);
  EXPECT_EQ(filtered.removed_observations, 4U);
  EXPECT_EQ(filtered.removed_tracks, 1U);
}

TEST(FilterObservations, RemovesPointsUnderSmallAngles) {
  const Scene scene = MakeScene();
  const auto filtered = FilterObservations(scene.model, scene.manifest, 4.0, kMinAngle_rad);
  ASSERT_EQ(filtered.reconstruction.tracks.size(), 1U);
  EXPECT_EQ(filtered.reconstruction.tracks[0].point_in_world.z(), 5.0);
  EXPECT_EQ(filtered.removed_observations, 4U);
}

TEST(FilterObservations, RemovesObservationsOfLooseAndMissingImages) {
  Scene scene = MakeScene();
  scene.model.images.at(ImageId(0)).loose = true;
  scene.model.images.erase(ImageId(1));
  const auto filtered = FilterObservations(scene.model, scene.manifest, 4.0, 0.0);
  EXPECT_EQ(filtered.removed_observations, 4U);
  for (const Track& track : filtered.reconstruction.tracks) {
    EXPECT_EQ(track.Name().image, ImageId(2));
  }
}

}  // namespace
}  // namespace orbweave
