// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/fuse_poses.h"

#include <algorithm>
#include <limits>

#include "core/base/quantile.h"
#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

constexpr int kRounds = 10;

struct HuberScales {
  double distance = 0.0;
  double angle_rad = 0.0;
};

double DistanceOf(const Rigid3& x, const Rigid3& y) { return (x.Centre() - y.Centre()).norm(); }

double AngleOf(const Rigid3& x, const Rigid3& y) {
  return RotationAngle(x.rotation * y.rotation.conjugate());
}

const PoseEstimate& Heaviest(const std::vector<PoseEstimate>& estimates) {
  return *std::max_element(
      estimates.begin(), estimates.end(), [](const PoseEstimate& x, const PoseEstimate& y) {
        return x.weight < y.weight;
      });
}

HuberScales MeasureDisagreement(const PoseEstimates& estimates) {
  std::vector<double> distances;
  std::vector<double> angles_rad;
  for (const auto& [id, of_image] : estimates) {
    const PoseEstimate& heaviest = Heaviest(of_image);
    for (const PoseEstimate& estimate : of_image) {
      if (&estimate == &heaviest) continue;
      distances.push_back(DistanceOf(estimate.cam_from_world, heaviest.cam_from_world));
      angles_rad.push_back(AngleOf(estimate.cam_from_world, heaviest.cam_from_world));
    }
  }
  return {3.0 * Quantile(std::move(distances), 0.5), 3.0 * Quantile(std::move(angles_rad), 0.5)};
}

// Influence of a Huber loss: 1 within the scale, then falling like 1 / r.
double HuberWeight(double residual, double scale) {
  if (residual <= scale) return 1.0;
  return std::max(scale, std::numeric_limits<double>::min()) / residual;
}

Rigid3 RobustMean(const std::vector<PoseEstimate>& estimates, const HuberScales& scales) {
  Rigid3 mean = Heaviest(estimates).cam_from_world;
  if (estimates.size() == 1) return mean;
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();
    double centre_weight = 0.0;
    double turn_weight = 0.0;
    for (const PoseEstimate& estimate : estimates) {
      const Rigid3& pose = estimate.cam_from_world;
      const double by_distance =
          estimate.weight * HuberWeight(DistanceOf(pose, mean), scales.distance);
      centre += by_distance * pose.Centre();
      centre_weight += by_distance;
      const double by_angle = estimate.weight * HuberWeight(AngleOf(pose, mean), scales.angle_rad);
      turn += by_angle * VectorFromRotation(pose.rotation * mean.rotation.conjugate());
      turn_weight += by_angle;
    }
    const Eigen::Quaterniond R = RotationFromVector(turn / turn_weight) * mean.rotation;
    mean = Rigid3::FromCentre(R.normalized(), centre / centre_weight);
  }
  return mean;
}

}  // namespace

std::map<ImageId, RegisteredImage> FusePoses(const PoseEstimates& estimates) {
  PoseEstimates firm;
  for (const auto& [id, of_image] : estimates) {
    std::vector<PoseEstimate>& kept = firm[id];
    std::copy_if(of_image.begin(),
                 of_image.end(),
                 std::back_inserter(kept),
                 [](const PoseEstimate& estimate) { return !estimate.loose; });
    if (kept.empty()) kept = of_image;
  }
  const HuberScales scales = MeasureDisagreement(firm);
  std::map<ImageId, RegisteredImage> images;
  for (const auto& [id, of_image] : firm) {
    images[id] = {.cam_from_world = RobustMean(of_image, scales), .loose = of_image.front().loose};
  }
  return images;
}

}  // namespace orbweave
