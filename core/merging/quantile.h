// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace orbweave {

/// The value below which a share in [0, 1] of the values lie (one of them, no interpolation); 0
/// when there are none. Quantile(v, 0.5) is the median, the lower one of an even number.
[[nodiscard]] inline double Quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto rank = static_cast<ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<size_t>(rank)];
}

}  // namespace orbweave
