// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <utility>
#include <vector>

namespace orbweave {

/// y = factor * x^exponent.
struct PowerLaw {
  double factor = 0.0;
  double exponent = 0.0;
};

/// The power law through points (x, y): least squares of log y over log x. Points that are not
/// positive say nothing and are left out; nothing when fewer than two different x remain.
[[nodiscard]] std::optional<PowerLaw> FitGrowth(
    const std::vector<std::pair<double, double>>& points);

}  // namespace orbweave
