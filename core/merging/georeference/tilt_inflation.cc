// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/tilt_inflation.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/quantile.h"
#include "core/geometry/rotation.h"
#include "core/geometry/symmetric_eigen.h"
#include "core/merging/georeference/gnss_variance.h"

namespace orbweave {
namespace {

constexpr double kSigmaOfMad = 1.4826;
constexpr double kDamping = 1e-9;        // holds the roll about a straight line
constexpr double kOutlierSigmas = 3.37;  // 99 % of three normal variables

// What gravity knows of the tilt, 1 / rad^2.
double GravityInformation(const std::optional<Gravity>& gravity, const Sim3& enu_from_world) {
  if (!gravity) return 0.0;
  const double away_rad =
      AngleBetween(enu_from_world.rotation * gravity->down_in_world, -Eigen::Vector3d::UnitZ());
  return std::pow(gravity->SigmaAt(away_rad), -2);
}

// What positions know of a tilt if they are independent, in any one unit; about the axis that
// heights know least of, as the roll about a street.
struct TiltInformation {
  double by_heights = 0.0;
  double by_hills = 0.0;  // along the ground, as these stand out of the plane
};

TiltInformation TiltInformationOf(const std::vector<MeasuredRun>& runs) {
  Eigen::Matrix2d by_heights = Eigen::Matrix2d::Zero();
  TiltInformation information;
  for (const MeasuredRun& run : runs) {
    for (const MeasuredFix& fix : run) {
      const Eigen::Vector2d lever = Eigen::Vector2d(fix.at.y(), -fix.at.x()) / fix.sigma_m.z();
      if (fix.is_height_known) by_heights += lever * lever.transpose();
      information.by_hills += std::pow(fix.at.z() / fix.sigma_m.x(), 2);
    }
  }
  information.by_heights = std::max(EigenOf<2>(by_heights).values[0], 0.0);
  return information;
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
      if (!fix.is_height_known) continue;
      A += row(fix) * row(fix).transpose();
      b += row(fix) * fix.residual.z();
    }
  }
  if (A.isZero(0.0)) return;
  A.diagonal().array() += kDamping * A.diagonal().maxCoeff();
  const Eigen::Vector3d plane = A.ldlt().solve(b);
  for (MeasuredRun& run : runs) {
    for (MeasuredFix& fix : run) fix.residual.z() -= row(fix).dot(plane);
  }
}

// Robust standard deviation of the residuals per axis, x and y equal; z one where no height is
// known.
Eigen::Vector3d ScatterOf(const std::vector<MeasuredRun>& runs) {
  std::array<std::vector<double>, 2> off;  // horizontally, vertically
  for (const MeasuredRun& run : runs) {
    for (const MeasuredFix& fix : run) {
      off[0].push_back(std::abs(fix.residual.x()));
      off[0].push_back(std::abs(fix.residual.y()));
      if (fix.is_height_known) off[1].push_back(std::abs(fix.residual.z()));
    }
  }
  const double horizontal = kSigmaOfMad * Quantile(std::move(off[0]), 0.5);
  const double vertical = off[1].empty() ? 1.0 : kSigmaOfMad * Quantile(std::move(off[1]), 0.5);
  return {horizontal, horizontal, vertical};
}

}  // namespace

double TiltInflation(std::span<const GnssDrive> drives,
                     std::span<const Eigen::Vector3d> positions_in_enu,
                     const std::optional<Gravity>& gravity,
                     const Sim3& enu_from_world) {
  const auto n = static_cast<double>(positions_in_enu.size());
  std::vector<MeasuredRun> runs;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  size_t i = 0;
  for (const GnssDrive& drive : drives) {
    MeasuredRun& run = runs.emplace_back();
    for (const DrivenFix& fix : drive.fixes) {
      const Eigen::Vector3d at = enu_from_world * fix.centre_in_world;
      const Eigen::Vector3d sigma_m(
          fix.horizontal_sigma_m, fix.horizontal_sigma_m, fix.vertical_sigma_m);
      run.push_back({.at = at,
                     .residual = (at - positions_in_enu[i++]).cwiseQuotient(sigma_m),
                     .sigma_m = sigma_m,
                     .way_m = enu_from_world.scale * fix.way,
                     .is_height_known = IsHeightKnown(fix.vertical_sigma_m)});
      middle += at / n;
    }
  }
  const Eigen::Vector3d scatter = ScatterOf(runs);
  if (!(scatter.minCoeff() > 0.0)) return 1.0;  // exact
  double squared_extent_m2 = 0.0;
  for (MeasuredRun& run : runs) {
    for (MeasuredFix& fix : run) squared_extent_m2 += (fix.at - middle).squaredNorm() / n;
    std::erase_if(run, [&](const MeasuredFix& fix) {
      return fix.residual.cwiseQuotient(scatter).norm() > kOutlierSigmas;
    });
  }
  if (!(squared_extent_m2 > 0.0)) return 1.0;
  for (MeasuredRun& run : runs) {
    for (MeasuredFix& fix : run) fix.at = (fix.at - middle) / std::sqrt(squared_extent_m2);
  }
  std::erase_if(runs, [](const MeasuredRun& run) { return run.empty(); });
  TakeOffPlane(runs);
  const double information =
      scatter.z() * scatter.z() * GravityInformation(gravity, enu_from_world);
  const PositionNoise noise = EstimatePositionNoise(runs, information / squared_extent_m2);
  const TiltInformation tilt = TiltInformationOf(runs);
  const double claimed = tilt.by_heights + tilt.by_hills;
  if (!(claimed > 0.0)) return 1.0;
  const double left =
      tilt.by_heights / noise.vertical.inflation + tilt.by_hills / noise.horizontal.inflation;
  return std::clamp(claimed / left, 1.0, n);
}

}  // namespace orbweave
