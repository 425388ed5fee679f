// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/sim3.h"
#include "tests/core/mapping/true_state.h"

namespace orbweave {

/// A street of 24 panoramas, 8 m apart and with a bend, that was reconstructed in two submodels;
/// the second has a frame and a scale of its own. Few pairs are left between them.
class BrokenStreet {
 public:
  static constexpr uint32_t kImages = 24;
  static constexpr uint32_t kFirstOfSecond = 12;

  struct Options {
    bool has_gnss = true;
    bool random_rotations = false;
    uint32_t pairs_between = 1;  ///< those of the nearest images stay
  };

  explicit BrokenStreet(const Options& options)
      : fixture_({.centres = Centres(),
                  .points_per_metre = 8,
                  .reach_m = 30.0,
                  .window = 4,
                  .random_rotations = options.random_rotations,
                  .seed = 11}) {
    if (options.has_gnss) GiveGnss();
    KeepPairsBetween(options.pairs_between);
    fixture_.graph = BuildCorrespondenceGraph(fixture_.world.problem).value();
  }

  [[nodiscard]] static Sim3 TrueAFromB() {
    return {2.5, RotationFromVector({0.4, -1.1, 0.7}), {3.0, -8.0, 1.0}};
  }

  /// Images [first, end) as they stand in the frame that frame_from_world leads to, with points.
  [[nodiscard]] MappingState Part(uint32_t first,
                                  uint32_t end,
                                  const Sim3& frame_from_world) const {
    MappingState state(fixture_.world.problem, fixture_.graph);
    std::vector<ImageSlot> images;
    for (ImageSlot image = first; image < end; ++image) {
      state.Register(image,
                     TransformCamera(frame_from_world, fixture_.world.cams_from_world[image]));
      images.push_back(image);
    }
    for (const ImageSlot image : images) TriangulateImage(state, image, TrackLimits{});
    return state;
  }
  [[nodiscard]] MappingState First() const { return Part(0, kFirstOfSecond, {}); }
  [[nodiscard]] MappingState Second() const {
    return Part(kFirstOfSecond, kImages, TrueAFromB().Inverse());
  }

  /// The pairs between no longer share a ray with any other pair: nothing that is seen carries the
  /// scale from one side to the other.
  void DetachPairsBetween() {
    for (TwoViewGeometry& pair : fixture_.world.problem.pairs) {
      if (!IsBetween(pair)) continue;
      for (FeatureMatch& match : pair.inliers) {
        match.a = CopyFeature(pair.pair.a.value, match.a);
        match.b = CopyFeature(pair.pair.b.value, match.b);
      }
    }
    Rebuild();
  }

  /// Where an image truly is in east, north and up.
  [[nodiscard]] Eigen::Vector3d PlaceInEnu(uint32_t image) const {
    const Eigen::Vector3d C = fixture_.world.cams_from_world[image].Centre();
    return {C.x(), C.z(), -C.y()};
  }

  [[nodiscard]] RayStreet& World() { return fixture_.world; }
  [[nodiscard]] const CorrespondenceGraph& Graph() const { return fixture_.graph; }
  void Rebuild() { fixture_.graph = BuildCorrespondenceGraph(fixture_.world.problem).value(); }

  [[nodiscard]] static bool IsBetween(const TwoViewGeometry& pair) {
    return pair.pair.a.value < kFirstOfSecond && pair.pair.b.value >= kFirstOfSecond;
  }

 private:
  /// x east, z north, y down: cameras are upright.
  static std::vector<Eigen::Vector3d> Centres() {
    std::vector<Eigen::Vector3d> centres;
    for (uint32_t i = 0; i < kImages; ++i) {
      const double x = 8.0 * i;
      centres.emplace_back(x, 0.0, 0.002 * x * x);
    }
    return centres;
  }

  FeatureIndex CopyFeature(uint32_t image, FeatureIndex feature) {
    ClusterImage& of = fixture_.world.problem.images[image];
    // Beside it: what is at the same place is one node.
    const Eigen::Vector3d bearing = of.bearings[feature];
    of.bearings.push_back((bearing + 3e-4 * TangentBasis(bearing).col(0)).normalized());
    of.sigma_rad.push_back(of.sigma_rad[feature]);
    of.colors.push_back(of.colors[feature]);
    std::vector<int>& shown = fixture_.world.point_of_feature[image];
    shown.push_back(shown[feature]);
    return static_cast<FeatureIndex>(of.bearings.size() - 1);
  }

  void GiveGnss() {
    Random random(7);
    for (uint32_t i = 0; i < kImages; ++i) {
      const Eigen::Vector3d C = Centres()[i];
      PosePrior& prior = fixture_.world.problem.images[i].prior;
      prior.position_in_enu =
          Eigen::Vector3d(C.x() + random.Normal(), C.z() + random.Normal(), -C.y());
      prior.horizontal_sigma_m = 1.5;
      prior.vertical_sigma_m = 3.0;
    }
  }

  void KeepPairsBetween(uint32_t count) {
    std::vector<TwoViewGeometry>& pairs = fixture_.world.problem.pairs;
    std::vector<uint32_t> steps;
    for (const TwoViewGeometry& pair : pairs) {
      if (IsBetween(pair)) steps.push_back(pair.pair.b.value - pair.pair.a.value);
    }
    std::sort(steps.begin(), steps.end());
    uint32_t kept = 0;
    std::erase_if(pairs, [&](const TwoViewGeometry& pair) {
      if (!IsBetween(pair)) return false;
      const uint32_t limit = steps[std::min<size_t>(count, steps.size()) - 1];
      return pair.pair.b.value - pair.pair.a.value > limit || kept++ >= count;
    });
  }

  StreetFixture fixture_;
};

}  // namespace orbweave
