// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/feature_sets.h"

#include <numeric>
#include <utility>

namespace orbweave {

FeatureSets::FeatureSets(std::span<const FeatureRef> features)
    : sets_(static_cast<uint32_t>(features.size())),
      image_(features.size()),
      next_(features.size()) {
  std::iota(next_.begin(), next_.end(), 0U);
  uint32_t num_images = 0;
  for (size_t i = 0; i < features.size(); ++i) {
    if (i == 0 || features[i].image != features[i - 1].image) ++num_images;
    image_[i] = num_images - 1;
  }
  stamp_.assign(num_images, 0);
}

FeatureSets::Join FeatureSets::TryJoin(uint32_t x, uint32_t y) {
  if (sets_.Find(x) == sets_.Find(y)) return Join::kAlreadyOne;
  ++num_joins_;
  uint32_t member = x;
  do {
    stamp_[image_[member]] = num_joins_;
    member = next_[member];
  } while (member != x);
  member = y;
  do {
    if (stamp_[image_[member]] == num_joins_) return Join::kConflict;
    member = next_[member];
  } while (member != y);
  std::swap(next_[x], next_[y]);  // two rings become one
  sets_.Unite(x, y);
  return Join::kJoined;
}

}  // namespace orbweave
