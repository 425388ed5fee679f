// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <map>
#include <vector>

#include "core/geometry/rigid3.h"
#include "core/geometry/sim3.h"
#include "core/scene/features.h"
#include "core/scene/ids.h"

namespace orbweave {

/// A point seen by an image. It carries its own bearing, so that a Reconstruction is complete
/// without the features it came from.
struct Observation {
  FeatureRef ref{};
  Eigen::Vector3d bearing = Eigen::Vector3d::UnitZ();  ///< unit, in the camera frame
  double sigma_rad = 1e-3;                             ///< angular standard deviation
};

/// A scene point and the observations it explains, sorted by FeatureRef, at most one per image.
struct Track {
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
  Rgb color{};
  std::vector<Observation> observations{};

  /// Identity across clusters: the smallest observation.
  [[nodiscard]] const FeatureRef& Name() const { return observations.front().ref; }
};

struct RegisteredImage {
  Rigid3 cam_from_world{};
  /// Placed by GNSS and neighbours only, not by its own observations.
  bool loose = false;
};

/// Poses and points in one frame ("world").
struct Reconstruction {
  std::map<ImageId, RegisteredImage> images{};
  std::vector<Track> tracks{};  ///< sorted by Name()

  [[nodiscard]] size_t NumObservations() const {
    size_t n = 0;
    for (const Track& track : tracks) n += track.observations.size();
    return n;
  }
  void SortTracks() {
    std::sort(tracks.begin(), tracks.end(), [](const Track& x, const Track& y) {
      return x.Name() < y.Name();
    });
  }
};

/// The same reconstruction in frame b.
inline Reconstruction Transformed(const Sim3& b_from_world, Reconstruction reconstruction) {
  for (auto& [id, image] : reconstruction.images)
    image.cam_from_world = TransformCamera(b_from_world, image.cam_from_world);
  for (Track& track : reconstruction.tracks)
    track.point_in_world = b_from_world * track.point_in_world;
  return reconstruction;
}

}  // namespace orbweave
