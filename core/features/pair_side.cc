// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/pair_side.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/features/descriptor_blocks.h"

namespace orbweave {
namespace {

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

}  // namespace

PairSide::PairSide(Features image_features)
    : features(std::move(image_features)),
      bearings(BearingsOf(features)),
      num_plain(features.NumPlain()),
      by_scale(OrderByScale(features)) {
  descriptors_by_scale.reserve(num_plain * kDescriptorSize);
  for (const FeatureIndex i : by_scale) {
    if (features.descriptors.empty()) break;
    const uint8_t* const descriptor = features.Descriptor(i);
    descriptors_by_scale.insert(
        descriptors_by_scale.end(), descriptor, descriptor + kDescriptorSize);
  }
  for (FeatureIndex i = 0; i < features.size() && !features.descriptors.empty(); ++i)
    squared_norms.push_back(internal::SquaredNorm(features.Descriptor(i)));
  for (size_t view = 0; view < first_of_view.size(); ++view) {
    first_of_view[view] =
        features.view.empty()
            ? features.size()
            : static_cast<size_t>(std::ranges::lower_bound(features.view, view + 1) -
                                  features.view.begin());
  }
}

}  // namespace orbweave
