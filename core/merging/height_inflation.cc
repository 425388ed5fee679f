// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/height_inflation.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/quantile.h"
#include "core/geometry/rotation.h"
#include "core/merging/gnss_variance.h"

namespace orbweave {
namespace {

constexpr double kSigmaOfMad = 1.4826;
constexpr double kDamping = 1e-9;         // holds the roll about a straight line
constexpr double kOutlierSigmas = 2.576;  // 99 % of a normal variable

// What gravity knows of the tilt, 1 / rad^2.
double GravityInformation(const std::optional<Gravity>& gravity, const Sim3& enu_from_world) {
  if (!gravity) return 0.0;
  const double away_rad =
      AngleBetween(enu_from_world.rotation * gravity->down_in_world, -Eigen::Vector3d::UnitZ());
  return std::pow(gravity->SigmaAt(away_rad), -2);
}

// Takes off what a shift and a tilt of the model would: what gravity keeps the model from following
// says nothing of how errors hang together.
void TakeOffPlane(std::vector<MeasuredRun>& runs) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  const auto row = [](const MeasuredFix& fix) {
    return Eigen::Vector3d(Eigen::Vector3d(1.0, fix.at.y(), -fix.at.x()) / fix.sigma_m.z());
  };
  for (const MeasuredRun& run : runs) {
    for (const MeasuredFix& fix : run) {
      A += row(fix) * row(fix).transpose();
      b += row(fix) * fix.residual.z();
    }
  }
  A.diagonal().array() += kDamping * A.diagonal().maxCoeff();
  const Eigen::Vector3d plane = A.ldlt().solve(b);
  for (MeasuredRun& run : runs) {
    for (MeasuredFix& fix : run) fix.residual.z() -= row(fix).dot(plane);
  }
}

}  // namespace

double HeightInflation(std::span<const GnssDrive> drives,
                       std::span<const Eigen::Vector3d> positions_in_enu,
                       const std::optional<Gravity>& gravity,
                       const Sim3& enu_from_world) {
  const auto n = static_cast<double>(positions_in_enu.size());
  std::vector<MeasuredRun> runs;
  std::vector<double> heights_off;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  size_t i = 0;
  for (const GnssDrive& drive : drives) {
    MeasuredRun& run = runs.emplace_back();
    for (const DrivenFix& fix : drive.fixes) {
      const Eigen::Vector3d at = enu_from_world * fix.centre_in_world;
      run.push_back({.at = at,
                     .residual = (at - positions_in_enu[i++]) / fix.vertical_sigma_m,
                     .sigma_m = Eigen::Vector3d::Constant(fix.vertical_sigma_m),
                     .way_m = enu_from_world.scale * fix.way});
      heights_off.push_back(std::abs(run.back().residual.z()));
      middle += at / n;
    }
  }
  const double scatter = kSigmaOfMad * Quantile(std::move(heights_off), 0.5);
  double squared_extent_m2 = 0.0;
  for (MeasuredRun& run : runs) {
    for (MeasuredFix& fix : run) squared_extent_m2 += (fix.at - middle).squaredNorm() / n;
    std::erase_if(run, [&](const MeasuredFix& fix) {
      return std::abs(fix.residual.z()) > kOutlierSigmas * scatter;
    });
  }
  if (!(squared_extent_m2 > 0.0)) return 1.0;
  for (MeasuredRun& run : runs) {
    for (MeasuredFix& fix : run) fix.at = (fix.at - middle) / std::sqrt(squared_extent_m2);
  }
  std::erase_if(runs, [](const MeasuredRun& run) { return run.empty(); });
  TakeOffPlane(runs);
  const double information = scatter * scatter * GravityInformation(gravity, enu_from_world);
  const double inflation = EstimateHeightNoise(runs, information / squared_extent_m2).inflation;
  return std::max(1.0, std::min(n, inflation));
}

}  // namespace orbweave
