// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/rigid3.h"
#include "core/scene/image_manifest.h"
#include "core/synthetic/street_world.h"

namespace orbweave {

/// A street and the drive through it. Poses and positions are in the east-north-up frame at
/// `origin`, which differs from the street's frame by a translation.
struct Street {
  StreetWorld world;
  std::vector<std::string> names{};  ///< street_0000.jpg, ...
  std::vector<double> stations_m{};  ///< arc length along the axis
  std::optional<StreetWorld> second_day{};
  std::vector<bool> on_second_day{};
  std::vector<double> capture_times_s{};                    ///< since 1970
  Eigen::Vector3d street_in_enu = Eigen::Vector3d::Zero();  ///< origin of the street's frame
  std::vector<Rigid3> cams_from_enu{};                      ///< truth
  /// Median of the measured positions: the origin that an honest reader of the GNSS table would
  /// choose as well.
  GeodeticPosition origin{};
  std::vector<std::optional<Eigen::Vector3d>> measured_in_enu{};  ///< GNSS; absent in the gap

  /// What stood there when panorama i was taken.
  [[nodiscard]] const StreetWorld& WorldOf(size_t i) const {
    return on_second_day[i] ? *second_day : world;
  }
};

}  // namespace orbweave
