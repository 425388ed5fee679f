// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/pair_side.h"

#include <algorithm>
#include <utility>

#include "core/features/descriptor_blocks.h"
#include "core/features/order_by_scale.h"

namespace orbweave {
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
