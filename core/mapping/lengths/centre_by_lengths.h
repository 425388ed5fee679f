// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Where a registered image stands by the rays of the images around it, which its own place has no
/// part in. A pair leads to it from a registered image a in a known direction; how far, says each
/// ray of a that another pair q of a shares (MeasurePairLengths). Candidates are where one pair
/// leads by the length that most of its rays say, or by the one that second most do; the one that
/// most rays of all pairs agree with (ToldLengths::CountAgreeing) wins.
///
/// nullopt unless that are a fifth more than agree with where it stands, and rays of three pairs
/// or more.
[[nodiscard]] std::optional<Eigen::Vector3d> CentreByLengths(const MappingState& state,
                                                             ImageSlot image,
                                                             const MappingOptions& options);

}  // namespace orbweave
