// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>

#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// A rotation that makes what the cameras call up, on the mean, the third axis. nullopt: they do
/// not agree which way that is (SumOfUps).
[[nodiscard]] std::optional<Eigen::Quaterniond> UprightFromWorld(
    std::span<const Eigen::Quaterniond> cams_from_world);
/// Of registered images.
[[nodiscard]] std::optional<Eigen::Quaterniond> UprightFromWorld(const MappingState& state,
                                                                 std::span<const ImageSlot> images);

}  // namespace orbweave
