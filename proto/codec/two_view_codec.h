// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/artifacts/stage_results.h"
#include "core/base/status.h"
#include "core/scene/two_view_geometry.h"

namespace orbweave {

[[nodiscard]] absl::StatusOr<std::string> EncodeTwoViewGeometries(
    const std::vector<TwoViewGeometry>& pairs);
/// DataLoss: not a list of ordered pairs with proper poses and numbers.
[[nodiscard]] absl::StatusOr<std::vector<TwoViewGeometry>> DecodeTwoViewGeometries(
    std::string_view bytes);

[[nodiscard]] absl::StatusOr<std::string> EncodeDividedViewGraph(const DividedViewGraph& divided);
/// DataLoss: images not in order, seams that are not between the clusters.
[[nodiscard]] absl::StatusOr<DividedViewGraph> DecodeDividedViewGraph(std::string_view bytes);

}  // namespace orbweave
