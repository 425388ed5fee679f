// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace orbweave {

/// The value that stands at place `rank` (from 0) when they are sorted; there must be more than
/// `rank`. Linear time. No value is NaN.
[[nodiscard]] inline double ValueOfRank(std::vector<double> values, size_t rank) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The middle value, the upper one of an even number. There must be one.
[[nodiscard]] inline double UpperMedian(std::vector<double> values) {
  const size_t middle = values.size() / 2;
  return ValueOfRank(std::move(values), middle);
}

/// The value below which a share in [0, 1] of the values lie (one of them, no interpolation); 0
/// when there are none. Quantile(v, 0.5) is the median, the lower one of an even number.
[[nodiscard]] inline double Quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto rank = static_cast<size_t>(share * static_cast<double>(values.size() - 1));
  return ValueOfRank(std::move(values), rank);
}

}  // namespace orbweave
