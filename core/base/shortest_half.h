// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

namespace orbweave {

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

/// The shortest interval that holds more than half of the values, the lowest of equal ones: where
/// they lie closest, however the others lie (Rousseeuw, Least Median of Squares Regression, JASA
/// 1984). There must be one value.
[[nodiscard]] inline Interval ShortestHalf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t span = values.size() / 2;
  Interval best{values.front(), values[span]};
  for (size_t i = 1; i + span < values.size(); ++i) {
    if (values[i + span] - values[i] < best.high - best.low) best = {values[i], values[i + span]};
  }
  return best;
}

}  // namespace orbweave
