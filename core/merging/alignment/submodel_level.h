// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>

namespace orbweave {

/// Which way is up in a submodel, as its cameras have it.
struct SubmodelLevel {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< unit, in the submodel
  double sigma_rad = 0.1;                         ///< about either level axis
};

/// The mean of what cameras call up (RobustMeanDirection, at two degrees). It is as good as streets
/// climb and mounts lean, three degrees, and as the median camera leans away from it: of a submodel
/// that is bent some say one thing and some another. nullopt: fewer than ten cameras, or they do
/// not agree (SumOfUps).
[[nodiscard]] std::optional<SubmodelLevel> LevelOf(
    std::span<const Eigen::Quaterniond> cams_from_submodel);

}  // namespace orbweave
