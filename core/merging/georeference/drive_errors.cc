// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/drive_errors.h"

#include <Eigen/Cholesky>

namespace orbweave {
namespace {

Eigen::Vector2d LeftOf(const Eigen::Vector3d& travel) {
  const double length = travel.head<2>().norm();
  if (!(length > 0.0)) return Eigen::Vector2d::Zero();
  return {-travel.y() / length, travel.x() / length};
}

Eigen::Vector3d TravelInEnu(const DrivenFix& fix, bool has_times, const Sim3& enu_from_world) {
  return (has_times ? enu_from_world.scale : 1.0) * (enu_from_world.rotation * fix.travel);
}

}  // namespace

Eigen::Vector3d ErrorAt(const DriveErrors& errors,
                        const DrivenFix& fix,
                        const Sim3& enu_from_world) {
  const Eigen::Vector3d travel = TravelInEnu(fix, errors.has_times, enu_from_world);
  Eigen::Vector3d error = errors.offset_m + errors.ahead * travel;
  error.head<2>() += errors.left_m * LeftOf(travel);
  return error;
}

std::vector<Eigen::Matrix3d> CovariancesOfErrors(std::span<const DriveErrors> errors,
                                                 std::span<const GnssDrive> drives,
                                                 std::span<const Eigen::Vector3d> at) {
  std::vector<Eigen::Matrix3d> covariances(at.size(), Eigen::Matrix3d::Zero());
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double count = 0.0;
  for (const GnssDrive& drive : drives) {
    for (const DrivenFix& fix : drive.fixes) middle += fix.centre_in_world.head<2>();
    count += static_cast<double>(drive.fixes.size());
  }
  if (count > 0.0) middle /= count;
  using FrameRow = Eigen::Matrix<double, 2, 4>;
  const auto row_at = [&](const Eigen::Vector3d& centre) {
    const Eigen::Vector2d from_middle = centre.head<2>() - middle;
    FrameRow row;
    row << 1.0, 0.0, -from_middle.y(), from_middle.x(), 0.0, 1.0, from_middle.x(), from_middle.y();
    return row;
  };
  for (const DriveErrors& of_drive : errors) {
    DriveErrors ahead{.has_times = of_drive.has_times, .ahead = of_drive.ahead_sigma};
    DriveErrors left{.has_times = of_drive.has_times, .left_m = of_drive.left_sigma_m};
    for (const DriveErrors& one_sigma : {ahead, left}) {
      Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
      Eigen::Vector4d b = Eigen::Vector4d::Zero();
      for (const GnssDrive& drive : drives) {
        for (const DrivenFix& fix : drive.fixes) {
          const FrameRow row = row_at(fix.centre_in_world);
          A += row.transpose() * row;
          if (drive.drive == of_drive.drive)
            b += row.transpose() * ErrorAt(one_sigma, fix, Sim3{}).head<2>();
        }
      }
      const Eigen::Vector4d shift = A.ldlt().solve(b);
      for (size_t i = 0; i < at.size(); ++i) {
        const Eigen::Vector2d moved = row_at(at[i]) * shift;
        covariances[i].topLeftCorner<2, 2>() += moved * moved.transpose();
      }
    }
  }
  return covariances;
}

}  // namespace orbweave
