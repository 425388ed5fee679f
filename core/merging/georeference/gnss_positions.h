// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry/sim3.h"
#include "core/merging/georeference/drive_errors.h"
#include "core/merging/georeference/gnss_track.h"
#include "core/merging/georeference/refine_georeference.h"

namespace orbweave {

/// Camera centres and what GNSS says of them, less what is known to be wrong of it; drive by drive,
/// in the order of GnssDrivesOf.
struct GnssPositions {
  std::vector<Eigen::Vector3d> in_world{};
  std::vector<Eigen::Vector3d> in_enu{};
  std::vector<Eigen::Vector3d> sigma_m{};
  std::vector<uint32_t> drive{};

  [[nodiscard]] size_t size() const { return in_world.size(); }
  [[nodiscard]] bool KnowsHeight(size_t i) const { return IsHeightKnown(sigma_m[i].z()); }
  [[nodiscard]] double MedianSigma_m() const;  ///< along a level axis
  /// Valid as long as these positions.
  [[nodiscard]] PositionPairs Pairs() const { return {in_world, in_enu, sigma_m}; }
};

[[nodiscard]] GnssPositions PositionsOf(const std::vector<GnssDrive>& drives);

/// Sets `positions`, which are those of the drives, to what GNSS says without these errors.
void TakeOffErrors(const std::vector<DriveErrors>& errors,
                   const std::vector<GnssDrive>& drives,
                   const Sim3& enu_from_world,
                   GnssPositions& positions);

}  // namespace orbweave
