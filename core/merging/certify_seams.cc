// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/certify_seams.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

#include "core/bundle/bearing_term.h"

namespace orbweave {
namespace {

constexpr uint32_t kMinPoints = 12;  // to place an image by one side alone
constexpr double kDegPerRad = 180.0 / std::numbers::pi;

/// [[d]x; -I]: a pose's Jacobian is this times the point's.
Eigen::Matrix<double, 6, 3> PoseFromPoint(const Eigen::Vector3d& d) {
  Eigen::Matrix<double, 6, 3> A;
  A << 0.0, -d.z(), d.y(), d.z(), 0.0, -d.x(), -d.y(), d.x(), 0.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0,
      0.0, 0.0, -1.0;
  return A;
}

}  // namespace

SeamCertifier::SeamCertifier(const std::vector<Seam>& seams, std::map<ImageId, uint32_t> owners)
    : owners_(std::move(owners)) {
  std::map<uint32_t, uint32_t> images_of_cluster;
  for (const auto& [id, cluster] : owners_) ++images_of_cluster[cluster];
  for (const Seam& seam : seams) {
    if (!images_of_cluster.contains(seam.cluster_a) || !images_of_cluster.contains(seam.cluster_b))
      continue;
    seams_.push_back(seam);
    for (const ImageId id : seam.shared) {
      placements_[{id, seam.cluster_a}];
      placements_[{id, seam.cluster_b}];
    }
  }
}

void SeamCertifier::Add(const WorldBlock& block) {
  for (const Track& track : block.scene.tracks) AddTrack(track, block.scene);
}

void SeamCertifier::AddTrack(const Track& track, const Reconstruction& scene) {
  std::map<uint32_t, uint32_t> seen_from;  // cluster: its panoramas
  for (const Observation& seen : track.observations) ++seen_from[owners_.at(seen.ref.image)];
  for (const Observation& seen : track.observations) {
    for (const auto& [cluster, count] : seen_from) {
      const bool is_own = owners_.at(seen.ref.image) == cluster;
      if (count - (is_own ? 1 : 0) < 2) continue;  // the point is not theirs without this image
      const auto found = placements_.find({seen.ref.image, cluster});
      if (found == placements_.end()) continue;
      const Rigid3& cam_from_world = scene.images.at(seen.ref.image).cam_from_world;
      const BearingTerm term = LineariseBearing(cam_from_world.Centre(),
                                                track.point_in_world,
                                                cam_from_world.rotation.conjugate() * seen.bearing);
      const double weight = 1.0 / (seen.sigma_rad * seen.sigma_rad);
      const Eigen::Matrix<double, 6, 3> A = PoseFromPoint(term.d);
      Placement& placement = found->second;
      placement.hessian += A * PointHessian(term, weight) * A.transpose();
      placement.gradient += A * PointGradient(term, weight);
      ++placement.num_points;
    }
  }
}

std::vector<SeamCertificate> SeamCertifier::Finish(double bearing_factor) const {
  std::vector<SeamCertificate> certificates;
  for (const Seam& seam : seams_) AddSeam(seam, bearing_factor, certificates);
  return certificates;
}

void SeamCertifier::AddSeam(const Seam& seam,
                            double bearing_factor,
                            std::vector<SeamCertificate>& out) const {
  SeamCertificate certificate{.cluster_a = seam.cluster_a, .cluster_b = seam.cluster_b};
  Eigen::Vector2d jumps = Eigen::Vector2d::Zero();  // squared; rotation, position
  Eigen::Vector2d noise = Eigen::Vector2d::Zero();
  for (const ImageId id : seam.shared) {
    const Placement& a = placements_.at({id, seam.cluster_a});
    const Placement& b = placements_.at({id, seam.cluster_b});
    if (std::min(a.num_points, b.num_points) < kMinPoints) continue;
    const Eigen::LDLT<Block6> by_a(a.hessian);
    const Eigen::LDLT<Block6> by_b(b.hessian);
    if (!by_a.isPositive() || !by_b.isPositive()) continue;
    const Vector6 jump = by_b.solve(b.gradient) - by_a.solve(a.gradient);
    const Vector6 variance = bearing_factor * (by_a.solve(Block6::Identity()).diagonal() +
                                               by_b.solve(Block6::Identity()).diagonal());
    if (!jump.allFinite() || !variance.allFinite()) continue;
    ++certificate.num_images;
    jumps += Eigen::Vector2d(jump.head<3>().squaredNorm(), jump.tail<3>().squaredNorm());
    noise += Eigen::Vector2d(variance.head<3>().sum(), variance.tail<3>().sum());
  }
  if (certificate.num_images > 0) {
    jumps = (jumps / certificate.num_images).cwiseSqrt();
    noise = (noise / certificate.num_images).cwiseSqrt();
  }
  certificate.rotation_jump_deg = kDegPerRad * jumps[0];
  certificate.position_jump_m = jumps[1];
  certificate.rotation_noise_deg = kDegPerRad * noise[0];
  certificate.position_noise_m = noise[1];
  out.push_back(certificate);
}

}  // namespace orbweave
