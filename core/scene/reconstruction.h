// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <map>
#include <numbers>
#include <optional>
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

/// So many images must see a point for it to tell how large what they hold together is: two alone
/// say which way one lies from the other.
inline constexpr size_t kImagesThatTellSize = 3;
/// And so many such points: fewer agree by chance, or look alike, often enough. 25 and more held
/// each panorama of right models of streets 12 m apart; asking for 30 divided one.
inline constexpr uint32_t kFewestThatTellSize = 15;

/// How far a pose may be off: one standard deviation, relative to what the adjustment holds.
struct PoseUncertainty {
  /// Of the camera centre, world axes, world units squared.
  Eigen::Matrix3d position_covariance = Eigen::Matrix3d::Zero();
  /// Root of the trace of the rotation's covariance: rms angle of the error, the same in camera
  /// and world axes.
  double rotation_sigma_rad = 0.0;

  /// Along each world axis.
  [[nodiscard]] Eigen::Vector3d PositionSigmas() const {
    return position_covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  }
  /// Root of the trace: rms distance of the error (the point error of Helmert).
  [[nodiscard]] double PositionSigma() const { return PositionSigmas().norm(); }
  [[nodiscard]] double RotationSigma_deg() const {
    return rotation_sigma_rad * 180.0 / std::numbers::pi;
  }
};

struct RegisteredImage {
  Rigid3 cam_from_world{};
  /// Placed by GNSS and neighbours only, not by its own observations.
  bool loose = false;
  /// Absent before the global adjustment, and where that could not tell.
  std::optional<PoseUncertainty> uncertainty{};
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

/// The same reconstruction in frame b. The similarity counts as exact.
inline Reconstruction Transformed(const Sim3& b_from_world, Reconstruction reconstruction) {
  const Eigen::Matrix3d turn_and_scale =
      b_from_world.scale * b_from_world.rotation.toRotationMatrix();
  for (auto& [id, image] : reconstruction.images) {
    image.cam_from_world = TransformCamera(b_from_world, image.cam_from_world);
    if (!image.uncertainty) continue;
    image.uncertainty->position_covariance =
        turn_and_scale * image.uncertainty->position_covariance * turn_and_scale.transpose();
  }
  for (Track& track : reconstruction.tracks)
    track.point_in_world = b_from_world * track.point_in_world;
  return reconstruction;
}

}  // namespace orbweave
