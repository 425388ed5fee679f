// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/alignment/seam_evidence.h"

#include <algorithm>
#include <cmath>

#include "core/base/quantile.h"
#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

using Matrix37d = Eigen::Matrix<double, 3, 7>;

// Sightings of a point by those who observe its twin in the other submodel.
void AddSightings(const Eigen::Vector3d& point,
                  bool point_is_in_b,
                  const Track& twin,
                  const Reconstruction& observers,
                  std::vector<Sighting>& sightings) {
  for (const Observation& observation : twin.observations) {
    const auto image = observers.images.find(observation.ref.image);
    if (image == observers.images.end() || image->second.loose) continue;
    sightings.push_back({.point = point,
                         .camera = image->second.cam_from_world,
                         .bearing = observation.bearing,
                         .sigma_rad = observation.sigma_rad,
                         .point_is_in_b = point_is_in_b});
  }
}

// Largest distance of a common centre from their mean; 1 when all are one.
double ExtentOfCentres(const Reconstruction& a, const std::vector<ImageId>& images) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const ImageId id : images)
    mean += a.images.at(id).cam_from_world.Centre() / static_cast<double>(images.size());
  double extent = 0.0;
  for (const ImageId id : images) {
    extent = std::max(extent, (a.images.at(id).cam_from_world.Centre() - mean).norm());
  }
  return extent > 0.0 ? extent : 1.0;
}

SeamCamera MakeCamera(ImageId id,
                      const Reconstruction& a,
                      std::span<const TrackedFeature> index_a,
                      const Reconstruction& b,
                      double fallback_depth) {
  SeamCamera camera{.cam_from_a = a.images.at(id).cam_from_world,
                    .cam_from_b = b.images.at(id).cam_from_world,
                    .depth_in_a = fallback_depth};
  std::vector<double> depths;
  std::vector<double> sigmas;
  for (const TrackedFeature& feature : FeaturesOf(index_a, id)) {
    const Track& track = a.tracks[feature.track];
    depths.push_back((camera.cam_from_a * track.point_in_world).norm());
    for (const Observation& observation : track.observations) {
      if (observation.ref == feature.ref) sigmas.push_back(observation.sigma_rad);
    }
  }
  if (depths.empty()) return camera;
  camera.depth_in_a = Quantile(std::move(depths), 0.5);
  camera.sigma_rad = Quantile(std::move(sigmas), 0.5);
  return camera;
}

// Vector along which a camera sees a sighting's point, of any length.
Eigen::Vector3d RayTo(const Sighting& sighting, const Sim3& a_from_b) {
  const Rigid3& camera = sighting.camera;
  if (sighting.point_is_in_b) return camera * (a_from_b * sighting.point);
  return camera.rotation *
         (a_from_b.rotation.conjugate() * (sighting.point - a_from_b * camera.Centre()));
}

// The ray and its derivatives by the coordinates of the chart at its origin.
Matrix37d RayDerivatives(const Sighting& sighting, const SimilarityChart& chart) {
  const Sim3& X = chart.a_from_b;
  const Eigen::Matrix3d R_cam = sighting.camera.rotation.toRotationMatrix();
  const Eigen::Vector3d anchor_in_a = X * chart.anchor_in_b;
  Matrix37d J;
  if (sighting.point_is_in_b) {
    const Eigen::Vector3d arm = X * sighting.point - anchor_in_a;
    J.leftCols<3>() = -R_cam * SkewSymmetric(arm);
    J.col(3) = R_cam * arm;
    J.rightCols<3>() = chart.length_in_a * R_cam;
    return J;
  }
  const Eigen::Matrix3d cam_from_a = R_cam * X.rotation.conjugate().toRotationMatrix();
  const Eigen::Vector3d camera_arm = X * sighting.camera.Centre() - anchor_in_a;
  J.leftCols<3>() = cam_from_a * SkewSymmetric(sighting.point - anchor_in_a);
  J.col(3) = -cam_from_a * camera_arm;
  J.rightCols<3>() = -chart.length_in_a * cam_from_a;
  return J;
}

void AddRows(const Eigen::Vector3d& r, const Matrix37d& J, double weight, Linearisation<7>& sum) {
  for (int row = 0; row < 3; ++row) sum.Add(r[row], J.row(row).transpose(), weight);
}

}  // namespace

SeamEvidence GatherSeamEvidence(const Reconstruction& a,
                                std::span<const TrackedFeature> index_a,
                                const Reconstruction& b,
                                const CommonView& view) {
  SeamEvidence evidence;
  for (const CommonTrack& common : view.tracks) {
    const Track& in_a = a.tracks[common.track_a];
    const Track& in_b = b.tracks[common.track_b];
    SeamTrack track{.point_in_a = in_a.point_in_world, .point_in_b = in_b.point_in_world};
    AddSightings(in_b.point_in_world, true, in_a, a, track.sightings);
    AddSightings(in_a.point_in_world, false, in_b, b, track.sightings);
    if (!track.sightings.empty()) evidence.tracks.push_back(std::move(track));
  }
  const double extent = ExtentOfCentres(a, view.images);
  for (const ImageId id : view.images) {
    evidence.cameras.push_back(MakeCamera(id, a, index_a, b, extent));
  }
  return evidence;
}

double TrackError(const SeamTrack& track, const Sim3& a_from_b) {
  std::vector<double> errors_in_a;
  std::vector<double> errors_in_b;
  for (const Sighting& sighting : track.sightings) {
    const double angle = AngleBetween(RayTo(sighting, a_from_b), sighting.bearing);
    (sighting.point_is_in_b ? errors_in_a : errors_in_b).push_back(angle / sighting.sigma_rad);
  }
  return std::max(Quantile(std::move(errors_in_a), 0.5), Quantile(std::move(errors_in_b), 0.5));
}

double CameraError(const SeamCamera& camera, const Sim3& a_from_b) {
  const Rigid3 transformed = TransformCamera(a_from_b, camera.cam_from_b);
  const double turn = RotationAngle(camera.cam_from_a.rotation * transformed.rotation.conjugate());
  const double parallax =
      (camera.cam_from_a.Centre() - transformed.Centre()).norm() / camera.depth_in_a;
  return std::sqrt(turn * turn + parallax * parallax) / camera.sigma_rad;
}

void AddTrack(const SeamTrack& track,
              const SimilarityChart& chart,
              const CauchyLoss& loss,
              Linearisation<7>& sum) {
  const double share = 1.0 / static_cast<double>(track.sightings.size());
  for (const Sighting& sighting : track.sightings) {
    const Eigen::Vector3d ray = RayTo(sighting, chart.a_from_b);
    const double length = ray.norm();
    if (length == 0.0) continue;
    const Eigen::Vector3d u = ray / length;
    const Eigen::Vector3d r = (u - sighting.bearing) / sighting.sigma_rad;
    const Eigen::Matrix3d du = (Eigen::Matrix3d::Identity() - u * u.transpose()) / length;
    const Matrix37d J = du * RayDerivatives(sighting, chart) / sighting.sigma_rad;
    AddRows(r, J, share * loss.Weight(r.squaredNorm()), sum);
    sum.cost += share * loss.Cost(r.squaredNorm());
  }
}

void AddCamera(const SeamCamera& camera,
               const SimilarityChart& chart,
               const CauchyLoss& loss,
               Linearisation<7>& sum) {
  const Sim3& X = chart.a_from_b;
  const Eigen::Quaterniond& R_a = camera.cam_from_a.rotation;
  Matrix37d J_turn = Matrix37d::Zero();
  J_turn.leftCols<3>() = R_a.toRotationMatrix() / camera.sigma_rad;
  const Eigen::Vector3d turn =
      VectorFromRotation(R_a * X.rotation * camera.cam_from_b.rotation.conjugate()) /
      camera.sigma_rad;

  const double sigma = camera.sigma_rad * camera.depth_in_a;
  const Eigen::Vector3d centre = X * camera.cam_from_b.Centre();
  const Eigen::Vector3d arm = centre - X * chart.anchor_in_b;
  Matrix37d J_shift;
  J_shift.leftCols<3>() = -SkewSymmetric(arm) / sigma;
  J_shift.col(3) = arm / sigma;
  J_shift.rightCols<3>() = Eigen::Matrix3d::Identity() * (chart.length_in_a / sigma);
  const Eigen::Vector3d shift = (centre - camera.cam_from_a.Centre()) / sigma;

  const double squared = turn.squaredNorm() + shift.squaredNorm();
  AddRows(turn, J_turn, loss.Weight(squared), sum);
  AddRows(shift, J_shift, loss.Weight(squared), sum);
  sum.cost += loss.Cost(squared);
}

}  // namespace orbweave
