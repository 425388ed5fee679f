// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/certify_seams.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

namespace orbweave {
namespace {

constexpr uint32_t kMinPoints = 12;  // to place an image by one side alone
constexpr double kDegPerRad = 180.0 / std::numbers::pi;

}  // namespace

SeamCertifier::SeamCertifier(const std::vector<Seam>& seams, const std::set<uint32_t>& clusters) {
  for (const Seam& seam : seams) {
    if (!clusters.contains(seam.cluster_a) || !clusters.contains(seam.cluster_b)) continue;
    seams_.push_back(seam);
    for (const ImageId id : seam.shared) {
      placements_[{id, seam.cluster_a}];
      placements_[{id, seam.cluster_b}];
    }
  }
}

void SeamCertifier::Add(std::span<const SidePlacement> placements) {
  for (const SidePlacement& placement : placements) {
    const auto found = placements_.find({placement.image, placement.cluster});
    if (found == placements_.end()) continue;
    found->second.hessian += placement.hessian;
    found->second.gradient += placement.gradient;
    found->second.num_points += placement.num_points;
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
    const SidePlacement& a = placements_.at({id, seam.cluster_a});
    const SidePlacement& b = placements_.at({id, seam.cluster_b});
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
