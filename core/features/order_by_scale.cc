// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/order_by_scale.h"

#include <algorithm>
#include <numeric>

namespace orbweave {

std::vector<FeatureIndex> OrderByScale(const Features& features) {
  std::vector<FeatureIndex> order(features.NumPlain());
  std::iota(order.begin(), order.end(), FeatureIndex{0});
  std::ranges::sort(order, [&](FeatureIndex x, FeatureIndex y) {
    const float scale_x = features.keypoints[x].scale_px;
    const float scale_y = features.keypoints[y].scale_px;
    return scale_x != scale_y ? scale_x > scale_y : x < y;
  });
  return order;
}

}  // namespace orbweave
