// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/positioning/turn_to_enu.h"

#include <Eigen/SVD>
#include <cmath>
#include <optional>
#include <vector>

#include "core/mapping/positioning/upright.h"
#include "core/robust/loss.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr int kReweightings = 10;

/// The rotation R that makes trace(R^T M) largest.
Eigen::Quaterniond NearestRotation(const Eigen::Matrix3d& M) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vector3d signs = Vector3d::Ones();
  signs.z() = svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0 ? -1.0 : 1.0;
  return Eigen::Quaterniond(
      Eigen::Matrix3d(svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose()));
}

/// A displacement as it is seen, in some frame, and as it is between positions.
struct Step {
  Vector3d seen = Vector3d::Zero();
  Vector3d in_enu = Vector3d::Zero();
  double sigma_m = 1.0;
};

std::vector<Step> StepsOf(const ClusterProblem& problem,
                          const DifferenceGraph& displacements,
                          const Eigen::Quaterniond& frame_from_world) {
  std::vector<Step> steps;
  for (size_t e = 0; e < displacements.edges.size(); ++e) {
    const PosePrior& a = problem.images[displacements.edges[e].a].prior;
    const PosePrior& b = problem.images[displacements.edges[e].b].prior;
    if (!a.position_in_enu || !b.position_in_enu) continue;
    const Vector3d seen = displacements.differences.row(static_cast<Eigen::Index>(e));
    steps.push_back({.seen = frame_from_world * seen,
                     .in_enu = *b.position_in_enu - *a.position_in_enu,
                     .sigma_m = std::hypot(a.horizontal_sigma_m, b.horizontal_sigma_m)});
  }
  return steps;
}

/// sum of w step seen^T, a step losing weight as it is off under `turn`.
Eigen::Matrix3d Across(const std::vector<Step>& steps,
                       const std::optional<Eigen::Quaterniond>& turn) {
  const CauchyLoss loss(1.0);
  Eigen::Matrix3d across = Eigen::Matrix3d::Zero();
  for (const Step& step : steps) {
    const double error = turn ? (step.in_enu - *turn * step.seen).norm() / step.sigma_m : 0.0;
    across += loss.Weight(error * error) / (step.sigma_m * step.sigma_m) * step.in_enu *
              step.seen.transpose();
  }
  return across;
}

/// About the third axis.
Eigen::Quaterniond NearestHeading(const Eigen::Matrix3d& M) {
  const double angle = std::atan2(M(1, 0) - M(0, 1), M(0, 0) + M(1, 1));
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitZ()));
}

template <typename Nearest>
Eigen::Quaterniond TurnSteps(const std::vector<Step>& steps, const Nearest& nearest) {
  Eigen::Quaterniond turn = nearest(Across(steps, std::nullopt));
  for (int round = 0; round < kReweightings; ++round) turn = nearest(Across(steps, turn));
  return turn;
}

}  // namespace

Eigen::Quaterniond EnuFromDisplacements(const ClusterProblem& problem,
                                        std::span<const ImageSlot> images,
                                        std::span<const Eigen::Quaterniond> cams_from_world,
                                        const DifferenceGraph& displacements) {
  std::vector<Eigen::Quaterniond> cams;
  for (const ImageSlot image : images) cams.push_back(cams_from_world[image]);
  const std::optional<Eigen::Quaterniond> upright = UprightFromWorld(cams);
  if (!upright) {
    return TurnSteps(StepsOf(problem, displacements, Eigen::Quaterniond::Identity()),
                     NearestRotation);
  }
  std::vector<Step> steps = StepsOf(problem, displacements, *upright);
  for (Step& step : steps) step.seen.z() = step.in_enu.z() = 0.0;
  return (TurnSteps(steps, NearestHeading) * *upright).normalized();
}

}  // namespace orbweave
