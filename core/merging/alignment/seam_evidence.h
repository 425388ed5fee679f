// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/averaging/similarity_chart.h"
#include "core/merging/alignment/find_common_view.h"
#include "core/robust/levenberg_marquardt.h"
#include "core/robust/loss.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// A point of one submodel seen by a camera of the other.
struct Sighting {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< in the frame of its submodel
  Rigid3 camera{};                                  ///< from the frame of the other submodel
  Eigen::Vector3d bearing = Eigen::Vector3d::UnitZ();
  double sigma_rad = 1e-3;
  bool point_is_in_b = true;
};

/// A common track: its two points and the sightings of either in the other's cameras.
struct SeamTrack {
  Eigen::Vector3d point_in_a = Eigen::Vector3d::Zero();
  Eigen::Vector3d point_in_b = Eigen::Vector3d::Zero();
  std::vector<Sighting> sightings{};  ///< at least one
};

/// A common image: its pose in both submodels, and how far (in a) the points are that it sees.
struct SeamCamera {
  Rigid3 cam_from_a{};
  Rigid3 cam_from_b{};
  double depth_in_a = 1.0;
  double sigma_rad = 1e-3;  ///< typical for its observations
};

/// All that two submodels say about their relative similarity.
struct SeamEvidence {
  std::vector<SeamTrack> tracks{};
  std::vector<SeamCamera> cameras{};
};

/// Cameras without an observation take the extent of the common centres as depth.
[[nodiscard]] SeamEvidence GatherSeamEvidence(const Reconstruction& a,
                                              std::span<const TrackedFeature> index_a,
                                              const Reconstruction& b,
                                              const CommonView& view);

/// Angle between bearings and a point in standard deviations, median over the cameras of the other
/// submodel, and of the two points the worse: a wrong point tells, a few wrong observers do not.
[[nodiscard]] double TrackError(const SeamTrack& track, const Sim3& a_from_b);

/// Disagreement of a camera's two poses in standard deviations of a bearing: the root of squared
/// rotation angle plus squared parallax (distance of the centres / depth).
[[nodiscard]] double CameraError(const SeamCamera& camera, const Sim3& a_from_b);

/// Adds a track's robust cost at chart.At(0), the mean of the loss over its sightings, and its
/// derivatives by the chart's coordinates. The residual of a sighting is the chord between unit
/// vectors over sigma, which no seam, pole or antipode disturbs.
void AddTrack(const SeamTrack& track,
              const SimilarityChart& chart,
              const CauchyLoss& loss,
              Linearisation<7>& sum);

/// The same for a camera's CameraError; rotation derivatives to first order in the residual.
void AddCamera(const SeamCamera& camera,
               const SimilarityChart& chart,
               const CauchyLoss& loss,
               Linearisation<7>& sum);

}  // namespace orbweave
