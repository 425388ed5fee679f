// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "core/merging/alignment/alignment.h"
#include "core/merging/alignment/submodel.h"
#include "core/scene/reconstruction.h"
#include "core/synthetic/make_street.h"
#include "tests/support/random_world.h"

/// A street of panoramas and points, and submodels cut from it.
namespace orbweave::testing {

constexpr double kBearingSigma_rad = 1e-3;

/// The true street: camera i looks somewhere near ahead, points stand on both sides.
inline Reconstruction MakeStreet(const std::vector<Eigen::Vector3d>& centres, Random& random) {
  Reconstruction street;
  for (uint32_t i = 0; i < centres.size(); ++i) {
    const Eigen::Quaterniond R = RotationFromVector(0.2 * RandomDirection(random));
    street.images[ImageId(i)].cam_from_world = Rigid3::FromCentre(R, centres[i]);
  }
  std::vector<FeatureIndex> next_feature(centres.size(), 0);
  for (size_t i = 0; i < 25 * centres.size(); ++i) {
    Track track;
    track.point_in_world = centres[i / 25] + RandomPoint(random, 4.0, 9.0);
    track.color.r = static_cast<uint8_t>(i % 256);
    for (const auto& [id, image] : street.images) {
      const Eigen::Vector3d ray = image.cam_from_world * track.point_in_world;
      if (ray.norm() > 10.0) continue;
      track.observations.push_back(
          {.ref = {id, next_feature[id.value]++},
           .bearing = WithNoise(random, ray.normalized(), kBearingSigma_rad),
           .sigma_rad = kBearingSigma_rad});
    }
    if (track.observations.size() >= 2) street.tracks.push_back(std::move(track));
  }
  street.SortTracks();
  return street;
}

inline std::vector<Eigen::Vector3d> StraightLine(uint32_t n, double spacing_m) {
  std::vector<Eigen::Vector3d> centres;
  for (uint32_t i = 0; i < n; ++i) centres.emplace_back(spacing_m * i, 0.0, 0.0);
  return centres;
}

inline std::vector<Eigen::Vector3d> Circle(uint32_t n, double spacing_m) {
  std::vector<Eigen::Vector3d> centres;
  const double radius_m = spacing_m * n / (2.0 * std::numbers::pi);
  for (uint32_t i = 0; i < n; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / n;
    centres.emplace_back(radius_m * std::cos(angle), radius_m * std::sin(angle), 0.0);
  }
  return centres;
}

/// The images `first` ... `first + count - 1` (modulo the street's length) and their tracks of two
/// observations and more, with poses and points off by `noise_m` (and its angle at 10 m).
inline Submodel Cut(
    const Reconstruction& street, uint32_t first, uint32_t count, double noise_m, Random& random) {
  const auto n = static_cast<uint32_t>(street.images.size());
  const auto noise = [&] {
    return Eigen::Vector3d(noise_m *
                           Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal()));
  };
  Submodel submodel;
  for (uint32_t i = 0; i < count; ++i) {
    const ImageId id((first + i) % n);
    const Rigid3& truth = street.images.at(id).cam_from_world;
    submodel.reconstruction.images[id].cam_from_world = Rigid3::FromCentre(
        RotationFromVector(noise() / 10.0) * truth.rotation, truth.Centre() + noise());
  }
  for (Track track : street.tracks) {
    std::erase_if(track.observations, [&](const Observation& observation) {
      return !submodel.reconstruction.images.contains(observation.ref.image);
    });
    if (track.observations.size() < 2) continue;
    track.point_in_world += noise();
    submodel.reconstruction.tracks.push_back(std::move(track));
  }
  submodel.reconstruction.SortTracks();
  return submodel;
}

inline Sim3 RandomFrame(Random& random) {
  return {
      std::exp(random.Uniform(-1.5, 1.5)), RandomRotation(random), RandomPoint(random, 0.0, 100.0)};
}

/// Consecutive submodels of `count` images every `step` images, each in a frame of its own.
struct SplitWorld {
  Reconstruction street{};
  std::vector<Submodel> submodels{};
  std::vector<Sim3> submodel_from_street{};

  void Add(Submodel submodel, Random& random) {
    submodel.cluster = static_cast<uint32_t>(submodels.size());
    submodel_from_street.push_back(RandomFrame(random));
    submodel.reconstruction =
        Transformed(submodel_from_street.back(), std::move(submodel.reconstruction));
    submodels.push_back(std::move(submodel));
  }
};

inline SplitWorld Split(Reconstruction street,
                        uint32_t num_submodels,
                        uint32_t step,
                        uint32_t count,
                        double noise_m,
                        Random& random) {
  SplitWorld world{.street = std::move(street)};
  for (uint32_t m = 0; m < num_submodels; ++m) {
    world.Add(Cut(world.street, m * step, count, noise_m, random), random);
  }
  return world;
}

/// Largest distance (street units) of a camera from the truth, submodel by submodel, after bringing
/// the world frame of submodel `reference` onto the street.
inline double WorstCentreError(const SplitWorld& world,
                               const Alignment& alignment,
                               size_t reference = 0) {
  const Sim3 street_from_world = world.submodel_from_street[reference].Inverse() *
                                 alignment.world_from_submodel[reference].Inverse();
  double worst = 0.0;
  for (size_t m = 0; m < world.submodels.size(); ++m) {
    if (alignment.world[m] != alignment.world[reference]) continue;
    const Sim3 street_from_submodel = street_from_world * alignment.world_from_submodel[m];
    for (const auto& [id, image] : world.submodels[m].reconstruction.images) {
      const Eigen::Vector3d found =
          TransformCamera(street_from_submodel, image.cam_from_world).Centre();
      worst = std::max(worst, (found - world.street.images.at(id).cam_from_world.Centre()).norm());
    }
  }
  return worst;
}

}  // namespace orbweave::testing
