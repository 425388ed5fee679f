// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/synthetic/street.h"
#include "core/synthetic/street_options.h"

namespace orbweave {

/// What the receiver says of cameras at `centres` of the street's frame; absent in one gap without
/// reception in the last third. Each day has a bias of its own; positions are late by
/// gnss_late_s of the way along the axis, and heights of the second day raised by gnss_datum_m.
[[nodiscard]] std::vector<std::optional<Eigen::Vector3d>> MeasureStreet(
    const Street& street,
    const std::vector<Eigen::Vector3d>& centres,
    const StreetOptions& options);

}  // namespace orbweave
