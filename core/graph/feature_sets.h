// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/graph/disjoint_sets.h"
#include "core/scene/ids.h"

namespace orbweave {

/// Sets of features of which each holds at most one feature per image. Features are addressed by
/// their position in a sorted list.
class FeatureSets {
 public:
  /// `features`: sorted, without repetition.
  explicit FeatureSets(std::span<const FeatureRef> features);

  enum class Join { kJoined, kAlreadyOne, kConflict };
  /// Joins the sets of features x and y unless the union would hold two features of one image.
  /// Costs the size of the two sets.
  Join TryJoin(uint32_t x, uint32_t y);

  [[nodiscard]] uint32_t Find(uint32_t x) { return sets_.Find(x); }
  [[nodiscard]] uint32_t SizeOf(uint32_t x) { return sets_.SizeOf(x); }

 private:
  DisjointSets sets_;
  std::vector<uint32_t> image_;  // per feature: dense image number
  std::vector<uint32_t> next_;   // ring through the features of a set
  std::vector<uint64_t> stamp_;  // per image: the last join that looked at it
  uint64_t num_joins_ = 0;
};

}  // namespace orbweave
