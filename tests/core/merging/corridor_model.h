// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <map>
#include <utility>

#include "core/scene/reconstruction.h"
#include "core/synthetic/corridor.h"
#include "tests/support/random_world.h"

namespace orbweave::testing {

/// The true model of a synthetic corridor, its observations with the corridor's noise.
inline Reconstruction TrueModel(const Corridor& corridor) {
  Reconstruction model;
  std::map<uint32_t, Track> tracks;
  const auto num_images = static_cast<uint32_t>(corridor.features.size());
  for (uint32_t i = 0; i < num_images; ++i) {
    const ImageId id(i);
    model.images[id].cam_from_world = corridor.cams_from_world[i];
    const Features& features = corridor.features[i];
    for (FeatureIndex f = 0; f < features.size(); ++f) {
      Track& track = tracks[corridor.point_of_feature[i][f]];
      if (!track.observations.empty() && track.observations.back().ref.image == id) continue;
      track.observations.push_back(
          {.ref = {id, f}, .bearing = features.Bearing(f), .sigma_rad = features.sigma_rad[f]});
    }
  }
  for (auto& [point, track] : tracks) {
    if (track.observations.size() < 2) continue;
    track.point_in_world = corridor.points_in_world[point];
    model.tracks.push_back(std::move(track));
  }
  model.SortTracks();
  return model;
}

/// What clusters and their alignment would hand over: every pose and point off by a little, a share
/// of the bearings random, and all of it in a frame of its own.
inline Reconstruction DisturbedModel(Reconstruction model,
                                     double outlier_share,
                                     const Sim3& frame_from_world,
                                     Random& random) {
  const auto noise = [&] { return Eigen::Vector3d(0.03 * RandomDirection(random)); };
  for (auto& [id, image] : model.images) {
    const Rigid3& truth = image.cam_from_world;
    image.cam_from_world = Rigid3::FromCentre(RotationFromVector(noise() / 10.0) * truth.rotation,
                                              truth.Centre() + noise());
  }
  for (Track& track : model.tracks) {
    track.point_in_world += noise();
    for (Observation& seen : track.observations) {
      if (random.Uniform() < outlier_share) seen.bearing = RandomDirection(random);
    }
  }
  return Transformed(frame_from_world, std::move(model));
}

}  // namespace orbweave::testing
