// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "core/geometry/sim3.h"
#include "tests/core/mapping/true_state.h"

namespace orbweave {

/// A straight street of 14 upright panoramas, 8 m apart, whose positions of 0.6 m are in east,
/// north and up; the model is in a frame of its own.
class GnssWalk {
 public:
  static constexpr uint32_t kImages = 14;
  static constexpr double kStep_m = 8.0;
  static constexpr double kSigma_m = 0.6;

  explicit GnssWalk(uint64_t seed = 1)
      : fixture_({.centres = StraightWalk(kImages, kStep_m),
                  .points_per_metre = 4,
                  .reach_m = 30.0,
                  .window = 4,
                  .seed = seed}) {
    Random random(seed + 100);
    for (uint32_t i = 0; i < kImages; ++i) {
      PosePrior& prior = fixture_.world.problem.images[i].prior;
      const Eigen::Vector3d noise(random.Normal(), random.Normal(), 0.0);
      prior.position_in_enu = TrueInEnu(i) + kSigma_m * noise;
      prior.horizontal_sigma_m = prior.vertical_sigma_m = kSigma_m;
    }
  }

  /// x east, z north, y down.
  [[nodiscard]] Eigen::Vector3d TrueInEnu(uint32_t image) const {
    const Eigen::Vector3d C = fixture_.world.cams_from_world[image].Centre();
    return {C.x() + 500.0, C.z() - 80.0, -C.y()};
  }
  [[nodiscard]] ClusterImage& Image(uint32_t image) { return fixture_.world.problem.images[image]; }
  [[nodiscard]] PosePrior& Prior(uint32_t image) { return Image(image).prior; }
  /// As if GNSS were exact, whatever it states.
  void SetExactPositions() {
    for (uint32_t i = 0; i < kImages; ++i) Prior(i).position_in_enu = TrueInEnu(i);
  }
  [[nodiscard]] Rigid3 InModel(uint32_t image) const {
    return TransformCamera(model_from_world, fixture_.world.cams_from_world[image]);
  }
  /// Where the image would be `metres` further along the street.
  [[nodiscard]] Rigid3 Further(uint32_t image, double metres) const {
    const Rigid3& truth = fixture_.world.cams_from_world[image];
    return TransformCamera(
        model_from_world,
        Rigid3::FromCentre(truth.rotation, truth.Centre() + metres * Eigen::Vector3d::UnitX()));
  }
  /// All but `left_out` as they are, with points.
  [[nodiscard]] MappingState StateWithout(ImageSlot left_out) const {
    MappingState state(fixture_.world.problem, fixture_.graph);
    for (ImageSlot image = 0; image < kImages; ++image) {
      if (image != left_out) state.Register(image, InModel(image));
    }
    for (const ImageSlot image : state.Registered()) TriangulateImage(state, image, TrackLimits{});
    return state;
  }
  [[nodiscard]] const StreetFixture& Fixture() const { return fixture_; }

  Sim3 model_from_world{0.3, RotationFromVector({0.4, -1.1, 0.7}), {3.0, -8.0, 1.0}};

 private:
  StreetFixture fixture_;
};

}  // namespace orbweave
