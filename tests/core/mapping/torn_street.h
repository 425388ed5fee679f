// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tests/core/mapping/true_state.h"

namespace orbweave {

/// A street of panoramas 8 m apart, turned any way, to be put together wrongly.
class TornStreet {
 public:
  static constexpr uint32_t kImages = 15;

  TornStreet()
      : fixture_({.centres = Centres(),
                  .points_per_metre = 8,
                  .reach_m = 30.0,
                  .window = 4,
                  .outlier_share = 0.1,
                  .random_rotations = true}) {
    for (uint32_t i = 0; i < kImages; ++i) fixture_.world.problem.images[i].rank_in_drive = i;
  }

  [[nodiscard]] StreetFixture& Fixture() { return fixture_; }
  [[nodiscard]] const StreetFixture& Fixture() const { return fixture_; }
  [[nodiscard]] static Eigen::Vector3d Centre(ImageSlot image) { return Centres()[image]; }
  [[nodiscard]] MappingState Right() const { return fixture_.StateWith(FirstImages(kImages)); }

  /// Positions of GNSS, `error_m` off and stated to `sigma_m`.
  void GivePositions(uint64_t seed, double error_m, double sigma_m) {
    Random random(seed);
    for (uint32_t i = 0; i < kImages; ++i) {
      PosePrior& prior = fixture_.world.problem.images[i].prior;
      prior.position_in_enu =
          Centre(i) + error_m * Eigen::Vector3d(random.Normal(), random.Normal(), 0.0);
      prior.horizontal_sigma_m = prior.vertical_sigma_m = sigma_m;
    }
  }

  static void Move(ImageSlot image, const Eigen::Vector3d& by, MappingState& state) {
    const Rigid3 pose = state.CamFromWorld(image);
    state.SetPose(image, Rigid3::FromCentre(pose.rotation, pose.Centre() + by));
  }

  /// Everything from `first` on turned together about the vertical through the image before it.
  static void TurnFrom(ImageSlot first, double angle_rad, MappingState& state) {
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ()));
    const Eigen::Vector3d pivot = state.Centre(first - 1);
    const Rigid3 after_from_before{turn, pivot - turn * pivot};
    for (ImageSlot image = first; image < kImages; ++image)
      state.SetPose(image, state.CamFromWorld(image) * after_from_before.Inverse());
  }

  /// The matches of two images as if they stood as they do in `state`: tracks that jump from a
  /// house to the next, more of them than right ones.
  void Fool(ImageSlot a, ImageSlot b, const MappingState& state) {
    const Rigid3 jump = state.CamFromWorld(b) * state.CamFromWorld(a).Inverse();
    for (TwoViewGeometry& pair : fixture_.world.problem.pairs) {
      if (pair.pair != ImagePair{ImageId(a), ImageId(b)}) continue;
      for (const FeatureMatch& match : pair.inliers) {
        const Eigen::Vector3d& ray = fixture_.world.problem.images[a].bearings[match.a];
        fixture_.world.problem.images[b].bearings[match.b] =
            (jump.rotation * (12.0 * ray) + jump.translation).normalized();
      }
    }
  }

  /// What an image sees to one side of the street as if it stood as it does in `state`: a wall
  /// whose houses are all alike.
  void FoolWall(ImageSlot image, const MappingState& state) {
    const Rigid3 jump = state.CamFromWorld(image) * fixture_.world.cams_from_world[image].Inverse();
    const Eigen::Quaterniond world_from_cam =
        fixture_.world.cams_from_world[image].rotation.conjugate();
    for (Eigen::Vector3d& ray : fixture_.world.problem.images[image].bearings) {
      if ((world_from_cam * ray).z() < 0.0)
        ray = (jump.rotation * (6.0 * ray) + jump.translation).normalized();
    }
  }

 private:
  static std::vector<Eigen::Vector3d> Centres() {
    std::vector<Eigen::Vector3d> centres;
    for (uint32_t i = 0; i < kImages; ++i) centres.emplace_back(8.0 * i, 0.0, 0.02 * i * i);
    return centres;
  }

  StreetFixture fixture_;
};

}  // namespace orbweave
