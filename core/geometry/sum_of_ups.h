// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>

namespace orbweave {

/// The sum of what cameras call up, the negative of their second axis, in the world. nullopt: they
/// do not agree which way that is (a rig that tilts, or panoramas turned at random), that is, its
/// length is less than 0.95 of their number. Cameras on a car lean the same way in its own axes and
/// turn with it, which leaves the cosine of the lean, 0.97 for 15 degrees.
[[nodiscard]] std::optional<Eigen::Vector3d> SumOfUps(
    std::span<const Eigen::Quaterniond> cams_from_world);

}  // namespace orbweave
