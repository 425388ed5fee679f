// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace orbweave {

/// Indices of up to `count` of the unit bearings, far from each other: the first is the first, each
/// other one the farthest from all that were taken before (the smaller index of equals).
[[nodiscard]] std::vector<uint32_t> ChooseSpread(std::span<const Eigen::Vector3d> bearings,
                                                 size_t count);

}  // namespace orbweave
