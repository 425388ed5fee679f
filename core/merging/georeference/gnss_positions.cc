// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/gnss_positions.h"

#include <algorithm>
#include <utility>

#include "core/base/quantile.h"

namespace orbweave {

double GnssPositions::MedianSigma_m() const {
  std::vector<double> sigmas_m;
  for (const Eigen::Vector3d& sigma : sigma_m) sigmas_m.push_back(sigma.x());
  return Quantile(std::move(sigmas_m), 0.5);
}

GnssPositions PositionsOf(const std::vector<GnssDrive>& drives) {
  GnssPositions positions;
  for (const GnssDrive& drive : drives) {
    for (const DrivenFix& fix : drive.fixes) {
      positions.in_world.push_back(fix.centre_in_world);
      positions.in_enu.push_back(fix.position_in_enu);
      positions.sigma_m.emplace_back(
          fix.horizontal_sigma_m, fix.horizontal_sigma_m, fix.vertical_sigma_m);
      positions.drive.push_back(drive.drive);
    }
  }
  return positions;
}

void TakeOffErrors(const std::vector<DriveErrors>& errors,
                   const std::vector<GnssDrive>& drives,
                   const Sim3& enu_from_world,
                   GnssPositions& positions) {
  size_t i = 0;
  for (const GnssDrive& drive : drives) {
    const auto of_drive = std::ranges::find(errors, drive.drive, &DriveErrors::drive);
    for (const DrivenFix& fix : drive.fixes) {
      positions.in_enu[i] = fix.position_in_enu;
      if (of_drive != errors.end()) positions.in_enu[i] -= ErrorAt(*of_drive, fix, enu_from_world);
      ++i;
    }
  }
}

}  // namespace orbweave
