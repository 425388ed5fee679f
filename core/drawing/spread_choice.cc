// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/drawing/spread_choice.h"

#include <algorithm>

namespace orbweave {

std::vector<uint32_t> ChooseSpread(std::span<const Eigen::Vector3d> bearings, size_t count) {
  std::vector<uint32_t> chosen;
  if (bearings.empty()) return chosen;
  std::vector<double> nearest_cos(bearings.size(), -2.0);
  uint32_t next = 0;
  while (chosen.size() < std::min(count, bearings.size())) {
    chosen.push_back(next);
    nearest_cos[next] = 2.0;  // never again
    for (size_t i = 0; i < bearings.size(); ++i) {
      nearest_cos[i] = std::max(nearest_cos[i], bearings[i].dot(bearings[next]));
    }
    next = static_cast<uint32_t>(std::min_element(nearest_cos.begin(), nearest_cos.end()) -
                                 nearest_cos.begin());
  }
  return chosen;
}

}  // namespace orbweave
