// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

namespace orbweave {

/// What one witness says of an azimuth, in no particular turn.
struct AzimuthVote {
  double azimuth_rad = 0.0;
  double sigma_rad = 1.0;
  double weight = 1.0;
};

/// Of the votes within `agree_rad` of one of them those that weigh most: their mean, each with its
/// weight over its sigma, in no particular turn. nullopt where these are fewer than three, or weigh
/// no more than half of all. Linear but for sorting.
[[nodiscard]] std::optional<double> AgreedAzimuth(std::vector<AzimuthVote> votes, double agree_rad);

}  // namespace orbweave
